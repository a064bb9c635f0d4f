// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/diagnostics.h"
#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// The tables of a parameter list: one name may stand in several kinds at once (reference 3.3).
enum class ParamKind : std::uint8_t {
  Integer,
  Bool,
  Float,
  Point2,
  Vector2,
  Point3,
  Vector3,
  Normal,
  Spectrum,
  String,
  Texture
};

/// The keyword a user writes for the kind: "integer", "float", "point", "rgb", …
std::string_view keyword(ParamKind kind);

/// Integer: int. Bool: 0 or 1. Float: float. Point2, Vector2: Point2f. Point3, Vector3, Normal: Point3f.
/// Spectrum: Rgb. String, Texture: std::string.
using ParamValues =
    std::variant<std::vector<int>, std::vector<std::uint8_t>, std::vector<float>, std::vector<Point2f>,
                 std::vector<Point3f>, std::vector<Rgb>, std::vector<std::string>>;

/// One `"type name" values` entry. Numbers are finite; spectra are linear RGB.
struct Param {
  /// Where one token of the value list stands; its file is that of `valuesAt`.
  struct Mark {
    std::uint32_t line, column, length;
  };
  static constexpr std::size_t kMaxMarks = 16;  ///< longer lists keep the places of their first tokens only

  ParamKind kind = ParamKind::Float;
  std::string name;
  SourceLocation declaredAt;  ///< the quoted declaration
  SourceLocation valuesAt;    ///< the first value, or the bracket of an empty list
  ParamValues values;
  std::vector<Mark> marks;             ///< of the first `kMaxMarks` tokens; empty for a single value
  std::uint32_t tokensPerElement = 1;  ///< numbers that made one element (3 for a point, 2 for a black body)
  mutable bool used = false;           ///< a consumer asked for it
  bool isConverted = false;  ///< Spectrum: the RGB was computed, from xyz, samples, a black body or a file

  std::size_t size() const {
    return std::visit([](const auto& v) { return v.size(); }, values);
  }
  /// The text of an element, or the start of the list where the element is too far into a long list: then say
  /// the index in the message.
  SourceLocation locationOf(std::size_t element) const;
};

/// The parameters of one directive: plain values. Read them through a `ParamReader`.
class ParamList {
 public:
  /// A later entry of the same kind and name replaces the earlier one (true: it did).
  bool add(Param param);
  /// Neither marks as used nor remembers the question.
  const Param* find(ParamKind kind, std::string_view name) const;
  Param* find(ParamKind kind, std::string_view name);
  const std::vector<Param>& all() const { return params_; }
  bool empty() const { return params_.empty(); }
  std::size_t size() const { return params_.size(); }

  /// A declaration that was read as PBRT-v3 reads it and not as it is written: left out, or with other
  /// values.
  struct Misread {
    std::string name;
    SourceLocation at;
    std::string found;  ///< "found 3, expected a quoted string"
  };
  void addMisread(Misread misread) { misread_.push_back(std::move(misread)); }
  const std::vector<Misread>& misread() const { return misread_; }

 private:
  std::vector<Param> params_;
  std::vector<Misread> misread_;
};

}  // namespace pbrtmedia
