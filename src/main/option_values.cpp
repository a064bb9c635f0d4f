// SPDX-License-Identifier: BSD-2-Clause
#include "main/option_values.h"

#include <charconv>
#include <system_error>

#include "base/frame_names.h"
#include "scene/variables.h"

namespace pbrtmedia {

std::optional<SampleRange> parseSampleRange(const std::string& text) {
  SampleRange range;
  const char *const begin = text.data(), *const end = begin + text.size();
  const auto first = std::from_chars(begin, end, range.first);
  if (first.ec != std::errc() || first.ptr == end || *first.ptr != ':') return std::nullopt;
  const auto last = std::from_chars(first.ptr + 1, end, range.end);
  const bool isRange =
      last.ec == std::errc() && last.ptr == end && range.first >= 0 && range.end > range.first;
  return isRange ? std::optional(range) : std::nullopt;
}

CLI::Validator sampleRange() {
  const auto check = [](std::string& text) -> std::string {
    if (parseSampleRange(text)) return {};
    return "found " + text + ", expected FIRST:LAST, whole numbers with 0 <= FIRST < LAST";
  };
  return CLI::Validator(check, "");
}

CLI::Validator fileName() {
  const auto check = [](std::string& text) -> std::string {
    return text.empty() ? "found an empty name, expected a file" : "";
  };
  return CLI::Validator(check, "");
}

CLI::Validator frameRange() {
  const auto check = [](std::string& text) -> std::string {
    if (parseFrameRange(text)) return {};
    return "found " + text +
           ", expected FIRST:LAST or FIRST:LAST:STEP, whole numbers with FIRST <= LAST and STEP > 0";
  };
  return CLI::Validator(check, "");
}

CLI::Validator variableName() {
  const auto check = [](std::string& text) -> std::string {
    return Variables::isName(text) ? "" : "found " + text + ", expected a name of letters, digits and _";
  };
  return CLI::Validator(check, "");
}

CLI::Validator definition() {
  const auto check = [](std::string& text) -> std::string {
    const std::size_t equals = text.find('=');
    if (equals != std::string::npos && Variables::isName(text.substr(0, equals))) return {};
    return "found " + text + ", expected NAME=VALUE, the name of letters, digits and _";
  };
  return CLI::Validator(check, "");
}

}  // namespace pbrtmedia
