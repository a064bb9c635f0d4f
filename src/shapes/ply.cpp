// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/ply.h"

#include <bit>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <limits>

#include "base/files.h"
#include "base/interruption.h"
#include "shapes/ply_header.h"

namespace pbrtmedia {
namespace {

/// A number of a file for a message: any magnitude, few characters.
std::string shortText(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.15g", value);
  return text;
}

[[noreturn]] void fail(const PlyHeader& header, std::uint32_t line, const std::string& message) {
  throw SceneError({.file = header.file, .line = line, .column = 0, .length = 1}, message);
}

/// Numbers of a binary body, one after the other.
class BinaryNumbers {
 public:
  BinaryNumbers(const PlyHeader& header, std::string_view body)
      : header_(header),
        body_(body),
        swaps_(header.isBigEndian != (std::endian::native == std::endian::big)) {}

  /// Fewest bytes a value of the type takes.
  static std::size_t leastBytes(PlyType type) { return plyTypeSize(type); }
  std::size_t bytesLeft() const { return body_.size() - at_; }
  std::uint32_t line() const { return 0; }

  double next(PlyType type, const PlyProperty& property) {
    switch (type) {
      case PlyType::Int8:
        return read<std::int8_t>(property);
      case PlyType::UInt8:
        return read<std::uint8_t>(property);
      case PlyType::Int16:
        return read<std::int16_t>(property);
      case PlyType::UInt16:
        return read<std::uint16_t>(property);
      case PlyType::Int32:
        return read<std::int32_t>(property);
      case PlyType::UInt32:
        return read<std::uint32_t>(property);
      case PlyType::Float32:
        return static_cast<double>(read<float>(property));
      case PlyType::Float64:
        return read<double>(property);
    }
    return 0;
  }

 private:
  template <class T>
  T read(const PlyProperty& property) {
    std::array<char, sizeof(T)> bytes;
    if (bytesLeft() < sizeof(T)) fail(header_, 0, "ends in the middle of property \"" + property.name + "\"");
    std::memcpy(bytes.data(), body_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    if (swaps_) std::ranges::reverse(bytes);
    return std::bit_cast<T>(bytes);
  }

  const PlyHeader& header_;
  std::string_view body_;
  std::size_t at_ = 0;
  bool swaps_;
};

/// Numbers of an ASCII body, separated by white space.
class TextNumbers {
 public:
  TextNumbers(const PlyHeader& header, std::string_view body)
      : header_(header), body_(body), line_(header.lineCount + 1) {}

  /// One digit and a separator (which the last number of the file may lack).
  static std::size_t leastBytes(PlyType) { return 2; }
  std::size_t bytesLeft() const { return body_.size() - at_ + 1; }
  std::uint32_t line() const { return line_; }

  double next(PlyType type, const PlyProperty& property) {
    while (at_ < body_.size() && isSpace(body_[at_])) {
      if (body_[at_] == '\n') ++line_;
      ++at_;
    }
    std::size_t end = at_;
    while (end < body_.size() && !isSpace(body_[end])) ++end;
    if (end == at_) fail(header_, line_, "ends before property \"" + property.name + "\"");
    std::string_view token = body_.substr(at_, end - at_);
    at_ = end;
    const std::string_view shown = token.substr(0, 40);
    if (token.starts_with('+')) token.remove_prefix(1);
    double value = 0;
    const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (stop != token.data() + token.size() ||
        (error != std::errc() && error != std::errc::result_out_of_range)) {
      fail(header_, line_,
           "property \"" + property.name + "\": expected a number, found \"" + std::string(shown) + "\"");
    }
    if (error == std::errc::result_out_of_range) {
      fail(header_, line_, "property \"" + property.name + "\": " + std::string(shown) + " is out of range");
    }
    if (isPlyInteger(type) && !(value == std::floor(value))) {
      fail(header_, line_,
           "property \"" + property.name + "\": expected an integer, found \"" + std::string(shown) + "\"");
    }
    return value;
  }

 private:
  static bool isSpace(char c) {
    return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\v' || c == '\f';
  }

  const PlyHeader& header_;
  std::string_view body_;
  std::size_t at_ = 0;
  std::uint32_t line_;
};

/// Fills the mesh from the elements of a body.
template <class Numbers>
class PlyBody {
 public:
  PlyBody(const PlyHeader& header, std::string_view body) : header_(header), numbers_(header, body) {}

  PlyMesh read() {
    bool hasVertices = false, hasFaces = false;
    for (const PlyElement& element : header_.elements) {
      checkSize(element);
      if (element.name == "vertex" && !std::exchange(hasVertices, true)) {
        readVertices(element);
      } else if (element.name == "face" && !std::exchange(hasFaces, true)) {
        readFaces(element);
      } else {
        skip(element);
      }
    }
    if (!hasVertices || mesh_.P.empty()) fail(header_, 0, "has no vertices");
    if (!hasFaces || mesh_.indices.empty()) fail(header_, 0, "has no faces");
    if (small_ > 0)
      notices_.push_back(std::to_string(small_) + " faces of fewer than three corners are left out");
    if (large_ > 0) {
      notices_.push_back(std::to_string(large_) +
                         " polygons of more than four corners are split into fans around their first corner");
    }
    return {std::move(mesh_), std::move(notices_)};
  }

 private:
  /// Before anything of that size is allocated.
  void checkSize(const PlyElement& element) {
    std::size_t least = 0;
    for (const PlyProperty& p : element.properties) {
      least += Numbers::leastBytes(p.isList ? p.countType : p.type);
    }
    if (least > 0 && element.count > numbers_.bytesLeft() / least) {
      fail(header_, element.line,
           "element \"" + element.name + "\": the header says " + std::to_string(element.count) +
               ", but the file is too short for that many");
    }
  }

  std::size_t listLength(const PlyProperty& property) {
    const double count = numbers_.next(property.countType, property);
    const std::size_t most = numbers_.bytesLeft() / Numbers::leastBytes(property.type);
    if (!(count >= 0 && count <= static_cast<double>(most))) {
      fail(header_, numbers_.line(),
           "list \"" + property.name + "\": length " + shortText(count) + " does not fit into the file");
    }
    return static_cast<std::size_t>(count);
  }

  void skipProperty(const PlyProperty& property) {
    const std::size_t n = property.isList ? listLength(property) : 1;
    for (std::size_t i = 0; i < n; ++i) numbers_.next(property.type, property);
  }

  void skip(const PlyElement& element) {
    if (element.properties.empty()) return;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      leaveIfStopped();
      for (const PlyProperty& property : element.properties) skipProperty(property);
    }
  }

  void readVertices(const PlyElement& element) {
    for (const char* name : {"x", "y", "z"}) {
      if (!element.find(name)) {
        fail(header_, element.line, std::string("element \"vertex\" has no property \"") + name + "\"");
      }
    }
    // Where each property goes: 0..2 P, 3..5 N, 6..7 uv.
    std::vector<int> slots(element.properties.size(), -1);
    const auto assign = [&](std::initializer_list<const char*> names, int first) {
      for (const char* name : names) {
        if (!element.find(name)) return false;
      }
      for (const char* name : names) slots[element.indexOf(name)] = first++;
      return true;
    };
    assign({"x", "y", "z"}, 0);
    const bool hasNormals = assign({"nx", "ny", "nz"}, 3);
    const bool hasUv = assign({"u", "v"}, 6) || assign({"s", "t"}, 6) ||
                       assign({"texture_u", "texture_v"}, 6) || assign({"texture_s", "texture_t"}, 6);
    const auto count = static_cast<std::size_t>(element.count);
    mesh_.P.reserve(count);
    if (hasNormals) mesh_.N.reserve(count);
    if (hasUv) mesh_.uv.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
      leaveIfStopped();
      std::array<float, 8> v{};
      for (std::size_t k = 0; k < slots.size(); ++k) {
        const PlyProperty& property = element.properties[k];
        if (slots[k] < 0) {
          skipProperty(property);
        } else {
          v[static_cast<std::size_t>(slots[k])] = toFloat(numbers_.next(property.type, property));
        }
      }
      mesh_.P.emplace_back(v[0], v[1], v[2]);
      if (hasNormals) mesh_.N.emplace_back(v[3], v[4], v[5]);
      if (hasUv) mesh_.uv.emplace_back(v[6], v[7]);
    }
  }

  /// Beyond float: infinity, which TriangleMesh::validate reports with its index.
  static float toFloat(double v) {
    if (std::abs(v) > static_cast<double>(std::numeric_limits<float>::max())) {
      return std::copysign(kInfinity, static_cast<float>(std::copysign(1.0, v)));
    }
    return static_cast<float>(v);
  }

  int index(PlyType type, const PlyProperty& property) {
    const double value = numbers_.next(type, property);
    if (!(std::abs(value) <= std::numeric_limits<int>::max())) {
      fail(header_, numbers_.line(),
           "property \"" + property.name + "\": " + std::to_string(value) + " does not fit into 31 bits");
    }
    return static_cast<int>(value);
  }

  void readFaces(const PlyElement& element) {
    const PlyProperty* corners = element.find("vertex_indices");
    if (!corners || !corners->isList) corners = element.find("vertex_index");
    if (!corners || !corners->isList || !isPlyInteger(corners->type)) {
      fail(header_, element.line, "element \"face\" has no list \"vertex_indices\" of integers");
    }
    const PlyProperty* face = element.find("face_indices");
    if (face && (face->isList || !isPlyInteger(face->type))) face = nullptr;
    mesh_.indices.reserve(3 * static_cast<std::size_t>(element.count));
    std::vector<int> polygon;
    for (std::uint64_t i = 0; i < element.count; ++i) {
      leaveIfStopped();
      int faceIndex = 0;
      for (const PlyProperty& property : element.properties) {
        if (&property == corners) {
          polygon.resize(listLength(property));
          for (int& corner : polygon) corner = index(property.type, property);
        } else if (&property == face) {
          faceIndex = index(property.type, property);
        } else {
          skipProperty(property);
        }
      }
      const std::size_t triangles = addPolygon(polygon);
      if (face) mesh_.faceIndices.insert(mesh_.faceIndices.end(), triangles, faceIndex);
    }
  }

  std::size_t addPolygon(const std::vector<int>& p) {
    auto& out = mesh_.indices;
    if (p.size() < 3) {
      ++small_;
      return 0;
    }
    if (p.size() == 4) {
      out.insert(out.end(), {p[0], p[1], p[2], p[3], p[0], p[2]});
      return 2;
    }
    if (p.size() > 4) ++large_;
    for (std::size_t k = 2; k < p.size(); ++k) out.insert(out.end(), {p[0], p[k - 1], p[k]});
    return p.size() - 2;
  }

  const PlyHeader& header_;
  Numbers numbers_;
  TriangleMesh::Params mesh_;
  std::vector<std::string> notices_;
  std::size_t small_ = 0, large_ = 0;
};

}  // namespace

PlyMesh parsePly(std::string_view bytes, const std::string& shownName) {
  const PlyHeader header = PlyHeader::parse(bytes, shownName);
  const std::string_view body = bytes.substr(header.size);
  if (header.isBinary) return PlyBody<BinaryNumbers>(header, body).read();
  return PlyBody<TextNumbers>(header, body).read();
}

PlyMesh readPly(const std::filesystem::path& path) {
  const FileBytes file = FileBytes::open(path);
  return parsePly(file.text(), path.string());
}

}  // namespace pbrtmedia
