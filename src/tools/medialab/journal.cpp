// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/journal.h"

#include <array>
#include <bit>
#include <charconv>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <vector>

namespace pbrtmedia {
namespace {

constexpr std::string_view kMagic = "medialab journal 1: ";

/// Numbers of a measurement, doubles by their bits, in the order of the file.
using Words = std::array<std::uint64_t, 15>;

Words wordsOf(std::uint64_t seed, const TrialStats& s) {
  const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x); };
  const Moments::State m = s.value.state();
  return {seed,       m.count,       bits(m.mean),  bits(m.m2),   bits(m.m3),
          bits(m.m4), s.nonFinite,   s.lookups,     s.estimates,  s.violations,
          s.capped,   s.mostLookups, bits(s.least), bits(s.most), bits(s.largestDeviation)};
}

TrialStats statsOf(const Words& w, std::uint64_t seconds) {
  const auto real = [](std::uint64_t x) { return std::bit_cast<double>(x); };
  TrialStats s;
  s.value = Moments(Moments::State{w[1], real(w[2]), real(w[3]), real(w[4]), real(w[5])});
  s.nonFinite = w[6];
  s.lookups = w[7];
  s.estimates = w[8];
  s.violations = w[9];
  s.capped = w[10];
  s.mostLookups = w[11];
  s.least = real(w[12]);
  s.most = real(w[13]);
  s.largestDeviation = real(w[14]);
  s.seconds = real(seconds);
  return s;
}

/// Hexadecimal numbers between blanks. Nothing where a word is something else.
std::optional<std::vector<std::uint64_t>> numbersOf(std::string_view line) {
  std::vector<std::uint64_t> numbers;
  while (!line.empty()) {
    std::uint64_t x = 0;
    const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), x, 16);
    if (error != std::errc()) return std::nullopt;
    numbers.push_back(x);
    line.remove_prefix(static_cast<std::size_t>(end - line.data()));
    if (line.empty()) break;
    if (line.front() != ' ') return std::nullopt;
    line.remove_prefix(1);
  }
  return numbers;
}

void append(std::string& line, std::uint64_t x) {
  std::array<char, 16> digits{};
  const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), x, 16);
  static_cast<void>(error);  // 16 digits hold any
  if (!line.empty()) line += ' ';
  line.append(digits.data(), end);
}

}  // namespace

TrialJournal::TrialJournal(const std::string& file, const std::string& identity) : file_(file) {
  if (file.empty()) return;
  const std::string head = std::string(kMagic) + identity;
  std::string text;
  if (std::ifstream in(file, std::ios::binary); in) {
    text.assign(std::istreambuf_iterator<char>(in), {});
  }
  const std::size_t whole = text.rfind('\n') + 1;  // 0 without a line
  std::string_view rest = std::string_view(text).substr(0, whole);
  bool isFirst = true;
  while (!rest.empty()) {
    const std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(line.size() + 1);
    if (isFirst) {
      isFirst = false;
      if (line == head) continue;
      if (!line.starts_with(kMagic)) {
        throw std::runtime_error(file + ": --resume: no journal of medialab; nothing was measured");
      }
      std::string message = file + ": --resume: belongs to other measurements\n  there: ";
      message += line.substr(kMagic.size());
      message += "\n  here:  ";
      throw std::runtime_error(message + identity);
    }
    const auto numbers = numbersOf(line);
    Words words{};
    if (!numbers || numbers->size() != words.size() + 1) {
      throw std::runtime_error(file + ": --resume: damaged; remove it to measure anew");
    }
    std::copy_n(numbers->begin(), words.size(), words.begin());
    done_[words[0]] = statsOf(words, numbers->back());
  }
  if (isFirst && !text.empty() && !head.starts_with(text)) {
    throw std::runtime_error(file + ": --resume: no journal of medialab; nothing was measured");
  }
  if (whole < text.size()) std::filesystem::resize_file(file, whole);
  out_.open(file, std::ios::binary | std::ios::app);
  if (isFirst) out_ << head << '\n' << std::flush;
  if (!out_) throw std::runtime_error(file + ": --resume: cannot be written");
}

std::optional<TrialStats> TrialJournal::find(std::uint64_t seed) const {
  const std::lock_guard lock(mutex_);
  const auto found = done_.find(seed);
  if (found == done_.end()) return std::nullopt;
  return found->second;
}

void TrialJournal::add(std::uint64_t seed, const TrialStats& stats) {
  if (file_.empty()) return;
  std::string line;
  for (const std::uint64_t word : wordsOf(seed, stats)) append(line, word);
  append(line, std::bit_cast<std::uint64_t>(stats.seconds));
  const std::lock_guard lock(mutex_);
  out_ << line << '\n' << std::flush;
  if (!out_) throw std::runtime_error(file_ + ": --resume: cannot be written");
}

}  // namespace pbrtmedia
