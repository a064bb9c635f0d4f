// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "base/diagnostics.h"
#include "base/files.h"
#include "spectrum/spectrum.h"

namespace pbrtmedia {
namespace {

/// What a compressed spectrum or lens file may unpack to: far above any real one, far below the memory.
constexpr std::size_t kMaxTextBytes = std::size_t{1} << 28;

constexpr bool isBlank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f';
}

/// A token as a finite float: decimal, with an optional sign and exponent. Values too small for a float are
/// 0.
std::optional<float> parseFinite(std::string_view token) {
  std::string_view digits = token;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const auto [end, status] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (status == std::errc::invalid_argument || end != digits.data() + digits.size()) return std::nullopt;
  // from_chars does not tell too large from too small; strtod does.
  if (status == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
  const float narrowed = static_cast<float>(value);
  if (!std::isfinite(narrowed)) return std::nullopt;
  return narrowed;
}

/// At most 40 printable characters of a token, for messages.
std::string shown(std::string_view token) {
  std::string out;
  for (const char c : token.substr(0, 40)) out += (c >= 0x20 && c < 0x7f) ? c : '?';
  return token.size() > 40 ? out + "..." : out;
}

/// The numbers among other text, as PBRT-v3 finds them: each is a run of digits, signs, points and exponents
/// that begins with no exponent.
void appendNumbersWithin(std::string_view token, std::vector<float>& numbers) {
  constexpr std::string_view kFirst = "0123456789.+-", kAny = "0123456789.+-eE";
  for (std::size_t i = token.find_first_of(kFirst); i < token.size(); i = token.find_first_of(kFirst, i)) {
    const std::size_t end = std::min(token.find_first_not_of(kAny, i), token.size());
    const std::string run(token.substr(i, end - i));
    const auto value = static_cast<float>(std::strtod(run.c_str(), nullptr));
    if (std::isfinite(value)) numbers.push_back(value);
    i = end;
  }
}

}  // namespace

std::vector<float> parseNumberText(std::string_view text, const std::filesystem::path& shownName,
                                   Diagnostics* tolerate) {
  std::vector<float> numbers;
  bool said = false;
  std::uint32_t line = 1;
  std::size_t lineStart = 0, i = 0;
  while (i < text.size()) {
    if (isBlank(text[i])) {
      if (text[i++] == '\n') {
        ++line;
        lineStart = i;
      }
      continue;
    }
    if (text[i] == '#') {
      i = std::min(text.find('\n', i), text.size());
      continue;
    }
    const std::size_t start = i;
    while (i < text.size() && !isBlank(text[i]) && text[i] != '#') ++i;
    const std::string_view token = text.substr(start, i - start);
    const std::optional<float> number = parseFinite(token);
    if (!number) {
      const SourceLocation at{std::make_shared<const std::string>(shownName.string()), line,
                              static_cast<std::uint32_t>(start - lineStart + 1),
                              static_cast<std::uint32_t>(token.size())};
      const std::string message = "expected a finite number, found \"" + shown(token) + "\"";
      if (tolerate == nullptr) throw SceneError(at, message);
      if (!std::exchange(said, true)) {
        tolerate->tolerated(at, message +
                                    "; as in PBRT-v3 such text is skipped, here and further on, but for "
                                    "the numbers in it");
      }
      appendNumbersWithin(token, numbers);
      continue;
    }
    numbers.push_back(*number);
  }
  return numbers;
}

std::vector<SpectralSample> parseSpectrumText(std::string_view text, const std::filesystem::path& shownName,
                                              Diagnostics* tolerate) {
  std::vector<float> numbers = parseNumberText(text, shownName, tolerate);
  const auto fail = [&](const std::string& message) {
    throw SceneError(SourceLocation{std::make_shared<const std::string>(shownName.string())}, message);
  };
  if (numbers.empty()) fail("a spectrum file needs pairs of wavelength and value, found no numbers");
  if (numbers.size() % 2 != 0) {
    const std::string message =
        "a spectrum file needs pairs of wavelength and value, found an odd count of " +
        std::to_string(numbers.size()) + " numbers";
    if (tolerate == nullptr || numbers.size() == 1) fail(message);
    tolerate->tolerated(SourceLocation{std::make_shared<const std::string>(shownName.string())},
                        message + "; the last is left out, as in PBRT-v3");
    numbers.pop_back();
  }
  std::vector<SpectralSample> samples;
  samples.reserve(numbers.size() / 2);
  for (std::size_t i = 0; i < numbers.size(); i += 2) samples.push_back({numbers[i], numbers[i + 1]});

  return samples;
}

std::vector<SpectralSample> readSpectrumFile(const std::filesystem::path& path, Diagnostics* tolerate) {
  const FileBytes file = FileBytes::open(path, kMaxTextBytes);
  return parseSpectrumText(file.text(), path, tolerate);
}

}  // namespace pbrtmedia
