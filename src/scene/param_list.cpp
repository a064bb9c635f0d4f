// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_list.h"

namespace pbrtmedia {

std::string_view keyword(ParamKind kind) {
  switch (kind) {
    case ParamKind::Integer:
      return "integer";
    case ParamKind::Bool:
      return "bool";
    case ParamKind::Float:
      return "float";
    case ParamKind::Point2:
      return "point2";
    case ParamKind::Vector2:
      return "vector2";
    case ParamKind::Point3:
      return "point";
    case ParamKind::Vector3:
      return "vector";
    case ParamKind::Normal:
      return "normal";
    case ParamKind::Spectrum:
      return "rgb";
    case ParamKind::String:
      return "string";
    case ParamKind::Texture:
      return "texture";
  }
  return {};
}

SourceLocation Param::locationOf(std::size_t element) const {
  SourceLocation at = valuesAt;
  if (const std::size_t token = element * tokensPerElement; token < marks.size()) {
    at.line = marks[token].line;
    at.column = marks[token].column;
    at.length = marks[token].length;
  }
  return at;
}

const Param* ParamList::find(ParamKind kind, std::string_view name) const {
  for (const Param& p : params_) {
    if (p.kind == kind && p.name == name) return &p;
  }
  return nullptr;
}

Param* ParamList::find(ParamKind kind, std::string_view name) {
  for (Param& p : params_) {
    if (p.kind == kind && p.name == name) return &p;
  }
  return nullptr;
}

bool ParamList::add(Param param) {
  if (Param* const earlier = find(param.kind, param.name)) {
    *earlier = std::move(param);
    return true;
  }
  params_.push_back(std::move(param));
  return false;
}

}  // namespace pbrtmedia
