// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pbrtmedia {

enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };
std::size_t plyTypeSize(PlyType type);  ///< bytes
inline bool isPlyInteger(PlyType type) { return type < PlyType::Float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;  ///< of the value, or of the values of a list
  bool isList = false;
  PlyType countType = PlyType::UInt8;  ///< of a list's length; an integer type
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::uint32_t line = 0;  ///< of the header line
  std::vector<PlyProperty> properties;

  /// properties.size() when there is none.
  std::size_t indexOf(std::string_view property) const;
  const PlyProperty* find(std::string_view property) const;
};

/// What a PLY file says about itself. Names of elements, and of properties in an element, are unique.
struct PlyHeader {
  std::shared_ptr<const std::string> file;
  bool isBinary = false, isBigEndian = false;
  std::vector<PlyElement> elements;
  std::size_t size = 0;         ///< bytes up to and with the end of the line "end_header"
  std::uint32_t lineCount = 0;  ///< lines of the header

  /// Lines end with LF or CR LF. Throws SceneError with the line.
  static PlyHeader parse(std::string_view bytes, const std::string& shownName);
};

}  // namespace pbrtmedia
