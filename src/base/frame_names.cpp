// SPDX-License-Identifier: BSD-2-Clause
#include "base/frame_names.h"

#include <algorithm>
#include <charconv>
#include <filesystem>

namespace pbrtmedia {
namespace {

/// A place for a number that begins somewhere in a name.
struct Place {
  std::size_t length = 0;
  std::size_t width = 0;
  char fill = '0';
};

/// Two digits are wide enough for any frame number, and keep a long row of them from being one.
constexpr std::size_t kMaxWidthDigits = 2;

bool isDigit(char c) { return c >= '0' && c <= '9'; }

/// The number at `at`, of at most two digits; moves `at` behind it.
std::size_t widthAt(const std::string& name, std::size_t& at) {
  std::size_t width = 0;
  for (std::size_t digits = 0; at < name.size() && isDigit(name[at]) && digits < kMaxWidthDigits; ++digits) {
    width = 10 * width + static_cast<std::size_t>(name[at++] - '0');
  }
  return width;
}

/// "%d", "%Nd", "%0Nd".
std::optional<Place> percentAt(const std::string& name, std::size_t begin) {
  Place place{.fill = ' '};
  std::size_t at = begin + 1;
  if (at < name.size() && name[at] == '0') {
    place.fill = '0';
    ++at;
  }
  place.width = widthAt(name, at);
  if (at >= name.size() || name[at] != 'd') return std::nullopt;
  place.length = at + 1 - begin;
  return place;
}

/// "$F", "$FN", "${F}", "${FN}"; what goes on with a letter, as $FF or $FPS, is another variable.
std::optional<Place> dollarAt(const std::string& name, std::size_t begin) {
  const bool braced = name.compare(begin, 2, "${") == 0;
  std::size_t at = begin + (braced ? 2 : 1);
  if (at >= name.size() || name[at] != 'F') return std::nullopt;
  ++at;
  Place place;
  place.width = widthAt(name, at);
  if (braced) {
    if (at >= name.size() || name[at] != '}') return std::nullopt;
    ++at;
  } else if (at < name.size() && (isDigit(name[at]) || (name[at] >= 'A' && name[at] <= 'Z') ||
                                  (name[at] >= 'a' && name[at] <= 'z'))) {
    return std::nullopt;
  }
  place.length = at - begin;
  return place;
}

std::optional<Place> placeAt(const std::string& name, std::size_t at) {
  if (name[at] == '%') return percentAt(name, at);
  if (name[at] == '$') return dollarAt(name, at);
  if (name[at] != '#') return std::nullopt;
  const std::size_t end = std::min(name.find_first_not_of('#', at), name.size());
  return Place{.length = end - at, .width = end - at};
}

/// Where the first place is, or npos.
std::size_t firstPlace(const std::string& name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name.compare(i, 2, "%%") == 0) {
      ++i;
    } else if (placeAt(name, i)) {
      return i;
    }
  }
  return std::string::npos;
}

/// A name without places, with "%%" as the percent sign it stands for.
std::string literal(const std::string& name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    out += name[i];
    if (name.compare(i, 2, "%%") == 0) ++i;
  }
  return out;
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
  if (at != end && (*at == '-' || *at == ':')) {
    const std::optional<int> last = parseNumber(++at, end);
    if (!last || *last < *first) return std::nullopt;
    range.last = *last;
    if (at != end && (*at == ':' || *at == 'x')) {
      const std::optional<int> step = parseNumber(++at, end);
      if (!step || *step < 1) return std::nullopt;
      range.step = *step;
    }
  }
  return at == end ? std::optional(range) : std::nullopt;
}

bool hasFramePlace(const std::string& name) { return firstPlace(name) != std::string::npos; }

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

std::vector<int> framesThatExist(const std::string& name) {
  namespace fs = std::filesystem;
  std::vector<int> frames;
  const std::size_t place = firstPlace(name);
  if (place == std::string::npos) return frames;
  const std::size_t slash = name.rfind('/', place);
  const std::string folder = slash == std::string::npos ? "" : literal(name.substr(0, slash + 1));
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string file = entry.path().filename().string();
    // Every row of digits may be the number: the whole name decides.
    for (std::size_t i = 0; i < file.size(); ++i) {
      if (!isDigit(file[i]) || (i > 0 && isDigit(file[i - 1]))) continue;
      const char* at = file.data() + i;
      const std::optional<int> number = parseNumber(at, file.data() + file.size());
      if (!number) continue;
      const std::string whole = frameName(name, *number);
      const std::string expected = fs::path(whole.substr(folder.size())).begin()->string();
      if (file == expected && fs::exists(whole, error)) frames.push_back(*number);
    }
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace pbrtmedia
