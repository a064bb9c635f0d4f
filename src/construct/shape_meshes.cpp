// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "construct/shape_kinds.h"
#include "construct/tolerance.h"
#include "shapes/heightfield.h"
#include "shapes/loop_subdivision.h"
#include "shapes/nurbs.h"
#include "shapes/ply.h"
#include "shapes/triangle_mesh.h"

namespace pbrtmedia {
namespace {

/// Opaque unless the parameter is given (scene-language reference 13.9).
void readAlpha(const ShapeInput& input, ShapePlan& plan) {
  Texturable texturable(input.in, input.shape.scope);
  plan.alpha = texturable.optionalFloat("alpha");
  plan.shadowAlpha = texturable.optionalFloat("shadowalpha");
  // Only exactly 0 cuts, so any other constant is no cut at all.
  const auto isOpaque = [](const std::optional<TextureUse<float>>& a) {
    return a && a->isConstant() && a->constant != 0;
  };
  if (isOpaque(plan.alpha)) plan.alpha.reset();
  if (isOpaque(plan.shadowAlpha)) plan.shadowAlpha.reset();
}

/// How a user may have written (u, v): the first that is there counts.
constexpr std::array<std::pair<ParamKind, std::string_view>, 4> kUvNames = {{{ParamKind::Point2, "uv"},
                                                                             {ParamKind::Point2, "st"},
                                                                             {ParamKind::Float, "uv"},
                                                                             {ParamKind::Float, "st"}}};

/// The array a mesh problem speaks of, as the user wrote it.
std::pair<ParamKind, std::string_view> writtenAs(ParamReader& in, std::string_view parameter) {
  if (parameter == "P") return {ParamKind::Point3, parameter};
  if (parameter == "N") return {ParamKind::Normal, parameter};
  if (parameter == "S") return {ParamKind::Vector3, parameter};
  if (parameter != "uv") return {ParamKind::Integer, parameter};
  for (const auto& [kind, name] : kUvNames) {
    if (in.has(kind, name)) return {kind, name};
  }
  return kUvNames.front();
}

/// Whether the mesh stands without an array: PBRT-v3 drops one that does not fit.
bool isOptional(std::string_view array) {
  return array == "N" || array == "S" || array == "uv" || array == "faceIndices";
}

/// Empties an optional array.
void drop(std::string_view array, TriangleMesh::Params& params) {
  if (array == "N") params.N.clear();
  if (array == "S") params.S.clear();
  if (array == "uv") params.uv.clear();
  if (array == "faceIndices") params.faceIndices.clear();
}

/// Hands each problem to `tell`, as a text that says what is done; drops arrays that do not fit. Whether a
/// mesh is left.
template <class Tell>
bool mend(TriangleMesh::Params& params, const std::vector<MeshProblem>& problems, const Tell& tell) {
  bool usable = true;
  for (const MeshProblem& problem : problems) {
    std::string message = problem.message;
    if (problem.severity == Severity::Error) {
      if (isOptional(problem.parameter)) {
        drop(problem.parameter, params);
        message += "; the array is left out, as in PBRT-v3";
      } else {
        usable = false;
        message += kShapeLeftOut;
      }
    }
    tell(problem, message);
  }
  return usable;
}

/// Mends the mesh of a Shape directive.
bool mend(const ShapeInput& input, TriangleMesh::Params& params) {
  return mend(params, TriangleMesh::validate(params),
              [&](const MeshProblem& problem, const std::string& message) {
                const auto& [kind, name] = writtenAs(input.in, problem.parameter);
                tolerate(input.in, kind, name, message);
              });
}

std::vector<Point2f> takeUv(ParamReader& in) {
  std::vector<Point2f> uv;
  bool found = false;
  for (const auto& [kind, name] : kUvNames) {
    if (!in.has(kind, name) || std::exchange(found, true))
      continue;  // the others are known, but do not count
    if (kind == ParamKind::Point2) {
      uv = in.takePoint2s(name);
      continue;
    }
    const std::span<const float> numbers = in.floats(name);
    if (numbers.size() % 2 != 0) {
      tolerate(in, kind, name,
               "found " + std::to_string(numbers.size()) + " numbers, expected pairs; the last is left out");
    }
    uv.resize(numbers.size() / 2);
    for (std::size_t i = 0; i < uv.size(); ++i) uv[i] = {numbers[2 * i], numbers[2 * i + 1]};
  }
  return uv;
}

/// A mesh in its place.
std::unique_ptr<Shape> placedMesh(TriangleMesh::Params params, const ShapePlacement& placement,
                                  std::string_view typeName) {
  return std::make_unique<TriangleMesh>(std::move(params), placement, typeName);
}

ShapePlan planMesh(const ShapeInput& input, std::string_view typeName,
                   const std::shared_ptr<TriangleMesh::Params>& params) {
  return planOf([params, placement = input.placement, typeName](Diagnostics&) {
    return placedMesh(std::move(*params), placement, typeName);
  });
}

/// Whether all are there; `consequence` says what happens if not ("": an error).
bool require(ParamReader& in, std::initializer_list<std::pair<ParamKind, std::string_view>> parameters,
             std::string_view consequence) {
  bool complete = true;
  for (const auto& [kind, name] : parameters) {
    if (in.has(kind, name)) continue;
    std::string message =
        "parameter \"" + std::string(keyword(kind)) + ' ' + std::string(name) + "\" is missing";
    complete = false;
    if (consequence.empty()) {
      in.error(message);
    } else {
      tolerate(in, message + std::string(consequence));
    }
  }
  return complete;
}

}  // namespace

ShapePlan readTriangleMesh(const ShapeInput& input) {
  const bool complete =
      require(input.in, {{ParamKind::Integer, "indices"}, {ParamKind::Point3, "P"}}, kShapeLeftOut);
  auto params = std::make_shared<TriangleMesh::Params>();
  params->indices = input.in.takeInts("indices");
  params->P = input.in.takePoint3s("P");
  params->N = input.in.takeNormals("N");
  params->S = input.in.takeVector3s("S");
  params->uv = takeUv(input.in);
  params->faceIndices = input.in.takeInts("faceIndices");
  ShapePlan alphas;
  readAlpha(input, alphas);
  if (!complete || !mend(input, *params)) return {};
  ShapePlan plan = std::move(alphas);
  plan.make = planMesh(input, "trianglemesh", params).make;
  return plan;
}

ShapePlan readLoopSubdivision(const ShapeInput& input) {
  ParamReader& in = input.in;
  const bool complete =
      require(in, {{ParamKind::Integer, "indices"}, {ParamKind::Point3, "P"}}, kShapeLeftOut);
  auto params = std::make_shared<LoopSubdivisionParams>();
  // PBRT-v3 has no levels below 0; too many are refused, as they fill any memory.
  constexpr Range kAtMost{.max = LoopSubdivisionParams::kMaxLevels};
  const std::size_t errorsBefore = in.diagnostics().errorCount();
  const std::optional<int> alias = in.optionalInt("nlevels", kAtMost);
  params->levels = in.findInt("levels", alias.value_or(params->levels), kAtMost);
  if (params->levels < 0) {
    tolerate(in, "found " + std::to_string(params->levels) + " levels, expected at least 0; taken as 0");
    params->levels = 0;
  }
  in.findString("scheme", "");  // accepted and ignored by PBRT-v3 too
  params->indices = in.takeInts("indices");
  params->P = in.takePoint3s("P");
  if (!complete || in.diagnostics().errorCount() > errorsBefore) return {};
  if (params->P.empty() || params->indices.empty()) {
    tolerate(in, std::string("the mesh is empty") + std::string(kShapeLeftOut));
    return {};
  }
  for (const MeshProblem& problem : validateLoop(*params)) {
    const auto& [kind, name] = writtenAs(in, problem.parameter);
    if (problem.severity == Severity::Error) {
      in.error(kind, name, problem.message);
    } else {
      tolerate(in, kind, name, problem.message);
    }
  }
  if (in.diagnostics().errorCount() > errorsBefore) return {};
  return planOf([params, placement = input.placement](Diagnostics&) {
    return placedMesh(subdivideLoop(*params), placement, "loopsubdiv");
  });
}

namespace {

/// Null, and told at `location`, for a file that cannot be read or holds no mesh.
std::unique_ptr<Shape> makePlyMesh(const std::filesystem::path& path, const ShapePlacement& placement,
                                   const SourceLocation& location, Diagnostics& diagnostics) {
  const std::string context = "PLY file \"" + path.string() + "\": ";
  try {
    PlyMesh ply = readPly(path);
    for (const std::string& notice : ply.notices) diagnostics.warning(location, context + notice);
    const bool usable = mend(ply.mesh, TriangleMesh::validate(ply.mesh),
                             [&](const MeshProblem& problem, const std::string& message) {
                               diagnostics.tolerated(location, context + problem.parameter + ": " + message);
                             });
    return usable ? placedMesh(std::move(ply.mesh), placement, "plymesh") : nullptr;
  } catch (const SceneError& e) {
    diagnostics.tolerated(location, problemOf(e) + std::string(kShapeLeftOut));
    return nullptr;
  }
}

}  // namespace

ShapePlan readPlyMesh(const ShapeInput& input) {
  ShapePlan plan;
  readAlpha(input, plan);
  if (input.in.findString("filename", "").empty()) {
    tolerate(input.in, "parameter \"string filename\" is missing or empty" + std::string(kShapeLeftOut));
    return plan;
  }
  const auto file = input.in.findInputFile("filename", kShapeLeftOut.substr(2));
  if (!file) return plan;
  plan.make = [path = *file, placement = input.placement,
               location = input.in.locationOf(ParamKind::String, "filename")](Diagnostics& diagnostics) {
    return makePlyMesh(path, placement, location, diagnostics);
  };
  return plan;
}

namespace {

/// A mesh that is tessellated while it is read: its checks belong to the reading, and its input is small.
/// What cannot be made is left out where PBRT-v3 does so, else an error.
template <class Tessellate>
ShapePlan planTessellation(const ShapeInput& input, std::string_view typeName, bool isTolerated,
                           const Tessellate& tessellate) {
  try {
    return planMesh(input, typeName, std::make_shared<TriangleMesh::Params>(tessellate()));
  } catch (const std::invalid_argument& e) {
    if (isTolerated) {
      tolerate(input.in, e.what() + std::string(kShapeLeftOut));
    } else {
      input.in.error(e.what());
    }
    return {};
  }
}

}  // namespace

ShapePlan readHeightfield(const ShapeInput& input) {
  ParamReader& in = input.in;
  // PBRT-v3 ends there.
  const bool complete =
      require(in, {{ParamKind::Integer, "nu"}, {ParamKind::Integer, "nv"}, {ParamKind::Float, "Pz"}}, "");
  HeightfieldParams p;
  p.nu = in.findInt("nu", 2);
  p.nv = in.findInt("nv", 2);
  p.Pz = in.takeFloats("Pz");
  if (!complete) return {};
  const bool isEmpty =
      std::min(p.nu, p.nv) < 2 && std::int64_t{p.nu} * p.nv == static_cast<std::int64_t>(p.Pz.size());
  return planTessellation(input, "heightfield", isEmpty, [&] { return tessellateHeightfield(p); });
}

ShapePlan readNurbs(const ShapeInput& input) {
  ParamReader& in = input.in;
  bool complete = require(in,
                          {{ParamKind::Integer, "nu"},
                           {ParamKind::Integer, "nv"},
                           {ParamKind::Integer, "uorder"},
                           {ParamKind::Integer, "vorder"},
                           {ParamKind::Float, "uknots"},
                           {ParamKind::Float, "vknots"}},
                          kShapeLeftOut);
  if (!in.has(ParamKind::Point3, "P") && !in.has(ParamKind::Float, "Pw")) {
    tolerate(in, "parameter \"point P\" or \"float Pw\" is missing" + std::string(kShapeLeftOut));
    complete = false;
  }
  NurbsParams p;
  p.nu = in.findInt("nu", 0);
  p.nv = in.findInt("nv", 0);
  p.uorder = in.findInt("uorder", 0);
  p.vorder = in.findInt("vorder", 0);
  p.uknots = in.takeFloats("uknots");
  p.vknots = in.takeFloats("vknots");
  p.u0 = in.optionalFloat("u0");
  p.u1 = in.optionalFloat("u1");
  p.v0 = in.optionalFloat("v0");
  p.v1 = in.optionalFloat("v1");
  p.P = in.takePoint3s("P");
  p.Pw = in.takeFloats("Pw");
  if (!complete) return {};
  return planTessellation(input, "nurbs", true, [&] { return tessellateNurbs(p); });
}

}  // namespace pbrtmedia
