// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/ply_header.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array<TypeName, 16> kTypeNames{{{"char", PlyType::Int8},
                                               {"int8", PlyType::Int8},
                                               {"uchar", PlyType::UInt8},
                                               {"uint8", PlyType::UInt8},
                                               {"short", PlyType::Int16},
                                               {"int16", PlyType::Int16},
                                               {"ushort", PlyType::UInt16},
                                               {"uint16", PlyType::UInt16},
                                               {"int", PlyType::Int32},
                                               {"int32", PlyType::Int32},
                                               {"uint", PlyType::UInt32},
                                               {"uint32", PlyType::UInt32},
                                               {"float", PlyType::Float32},
                                               {"float32", PlyType::Float32},
                                               {"double", PlyType::Float64},
                                               {"float64", PlyType::Float64}}};
constexpr std::size_t kLongestLine = 1 << 16;  // bytes; comments stay far below

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> result;
  constexpr std::string_view kSpace = " \t";
  for (std::size_t at = line.find_first_not_of(kSpace); at != std::string_view::npos;) {
    const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
    result.push_back(line.substr(at, end - at));
    at = line.find_first_not_of(kSpace, end);
  }
  return result;
}

/// The header, line by line.
class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& shownName) : bytes_(bytes) {
    header_.file = std::make_shared<const std::string>(shownName);
  }

  PlyHeader read() {
    if (nextLine() != "ply") fail("not a PLY file: expected \"ply\" in the first line");
    bool hasFormat = false;
    while (true) {
      const std::string_view line = nextLine();
      const auto w = words(line);
      if (w.empty() || w[0] == "comment" || w[0] == "obj_info") continue;
      if (w[0] == "end_header") break;
      if (w[0] == "format") {
        readFormat(w);
        hasFormat = true;
      } else if (w[0] == "element") {
        readElement(w);
      } else if (w[0] == "property") {
        readProperty(w);
      } else {
        fail("unknown header line \"" + std::string(w[0].substr(0, 40)) +
             "\"; known: comment, element, end_header, format, obj_info, property");
      }
    }
    if (!hasFormat) fail("the header has no format line");
    header_.size = at_;
    return std::move(header_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError({.file = header_.file, .line = header_.lineCount, .column = 0, .length = 1}, message);
  }

  std::string_view nextLine() {
    ++header_.lineCount;
    const std::string_view rest = bytes_.substr(at_, kLongestLine);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos) {
      fail(header_.lineCount == 1 ? "not a PLY file: expected \"ply\" in the first line"
                                  : "the header has no end_header line");
    }
    at_ += end + 1;
    std::string_view line = rest.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
  }

  void readFormat(const std::vector<std::string_view>& w) {
    if (w.size() != 3 || w[2] != "1.0") fail("expected \"format <kind> 1.0\"");
    if (w[1] == "binary_little_endian" || w[1] == "binary_big_endian") {
      header_.isBinary = true;
      header_.isBigEndian = w[1] == "binary_big_endian";
    } else if (w[1] != "ascii") {
      fail("unknown format \"" + std::string(w[1].substr(0, 40)) +
           "\"; known: ascii, binary_big_endian, binary_little_endian");
    }
  }

  void readElement(const std::vector<std::string_view>& w) {
    if (w.size() != 3) fail("expected \"element <name> <count>\"");
    PlyElement element{.name = std::string(w[1]), .count = 0, .line = header_.lineCount, .properties = {}};
    const auto [stop, error] = std::from_chars(w[2].data(), w[2].data() + w[2].size(), element.count);
    if (error != std::errc() || stop != w[2].data() + w[2].size()) {
      fail("element \"" + element.name + "\": expected a count, found \"" + std::string(w[2].substr(0, 40)) +
           "\"");
    }
    for (const PlyElement& other : header_.elements) {
      if (other.name == element.name) fail("element \"" + element.name + "\" is declared twice");
    }
    header_.elements.push_back(std::move(element));
  }

  PlyType typeOf(std::string_view name) const {
    const auto known = std::ranges::find(kTypeNames, name, &TypeName::name);
    if (known == kTypeNames.end()) {
      fail("unknown type \"" + std::string(name.substr(0, 40)) +
           "\"; known: char, uchar, short, ushort, int, uint, float, double");
    }
    return known->type;
  }

  void readProperty(const std::vector<std::string_view>& w) {
    if (header_.elements.empty()) fail("a property before the first element");
    PlyProperty property;
    if (w.size() == 5 && w[1] == "list") {
      property = {std::string(w[4]), typeOf(w[3]), true, typeOf(w[2])};
      if (!isPlyInteger(property.countType)) fail("the length of a list must have an integer type");
    } else if (w.size() == 3) {
      property = {.name = std::string(w[2]), .type = typeOf(w[1])};
    } else {
      fail("expected \"property <type> <name>\" or \"property list <type> <type> <name>\"");
    }
    PlyElement& element = header_.elements.back();
    if (element.find(property.name)) fail("property \"" + property.name + "\" is declared twice");
    element.properties.push_back(std::move(property));
  }

  std::string_view bytes_;
  std::size_t at_ = 0;
  PlyHeader header_;
};

}  // namespace

std::size_t plyTypeSize(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::UInt8:
      return 1;
    case PlyType::Int16:
    case PlyType::UInt16:
      return 2;
    case PlyType::Int32:
    case PlyType::UInt32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      return 8;
  }
  return 0;
}

std::size_t PlyElement::indexOf(std::string_view property) const {
  const auto at = std::ranges::find(properties, property, &PlyProperty::name);
  return static_cast<std::size_t>(at - properties.begin());
}

const PlyProperty* PlyElement::find(std::string_view property) const {
  const std::size_t i = indexOf(property);
  return i < properties.size() ? &properties[i] : nullptr;
}

PlyHeader PlyHeader::parse(std::string_view bytes, const std::string& shownName) {
  return HeaderReader(bytes, shownName).read();
}

}  // namespace pbrtmedia
