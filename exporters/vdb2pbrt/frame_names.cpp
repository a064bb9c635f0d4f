// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/frame_names.h"

#include <cctype>
#include <charconv>

namespace pbrtmedia {
namespace {

/// A place "%d", "%Nd" or "%0Nd" that begins at `at`.
struct Place {
  std::size_t length = 0;
  std::size_t width = 0;
  char fill = ' ';
};

bool isDigit(char c) { return c >= '0' && c <= '9'; }

std::optional<Place> placeAt(const std::string& name, std::size_t at) {
  if (name[at] != '%') return std::nullopt;
  Place place;
  std::size_t i = at + 1;
  if (i < name.size() && name[i] == '0') {
    place.fill = '0';
    ++i;
  }
  // Two digits are wide enough for any frame number, and keep a long row of them from being one.
  for (int digits = 0; i < name.size() && isDigit(name[i]) && digits < 2; ++digits, ++i) {
    place.width = 10 * place.width + static_cast<std::size_t>(name[i] - '0');
  }
  if (i >= name.size() || name[i] != 'd') return std::nullopt;
  place.length = i + 1 - at;
  return place;
}

std::optional<int> parseNumber(const char*& at, const char* end) {
  int number = 0;
  if (at == end || !isDigit(*at)) return std::nullopt;
  const auto [next, error] = std::from_chars(at, end, number);
  if (error != std::errc{}) return std::nullopt;
  at = next;
  return number;
}

}  // namespace

std::optional<FrameRange> parseFrameRange(const std::string& text) {
  const char* at = text.data();
  const char* const end = at + text.size();
  const std::optional<int> first = parseNumber(at, end);
  if (!first) return std::nullopt;
  FrameRange range{*first, *first, 1};
  if (at != end && *at == '-') {
    const std::optional<int> last = parseNumber(++at, end);
    if (!last || *last < *first) return std::nullopt;
    range.last = *last;
    if (at != end && *at == ':') {
      const std::optional<int> step = parseNumber(++at, end);
      if (!step || *step < 1) return std::nullopt;
      range.step = *step;
    }
  }
  return at == end ? std::optional(range) : std::nullopt;
}

bool hasFramePlace(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name.compare(i, 2, "%%") == 0) {
      ++i;
    } else if (placeAt(name, i)) {
      return true;
    }
  }
  return false;
}

std::string frameName(const std::string& name, int frame) {
  if (!hasFramePlace(name)) return name;
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name.compare(i, 2, "%%") == 0) {
      out += '%';
      ++i;
    } else if (const auto place = placeAt(name, i)) {
      const std::string number = std::to_string(frame);
      if (number.size() < place->width) out.append(place->width - number.size(), place->fill);
      out += number;
      i += place->length - 1;
    } else {
      out += name[i];
    }
  }
  return out;
}

}  // namespace pbrtmedia
