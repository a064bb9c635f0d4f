// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "base/diagnostics.h"
#include "scene/number.h"

namespace pbrtmedia {

/// Numbers that are written as none should be and that PBRT-v3 reads all the same: with text behind them
/// (`1.5abc`, `0,`), in hexadecimal, with a fraction where a whole number is meant. Collected while text is
/// read and reported once for each file and manner, since exporters that write one so write all of them so.
class LooseNumbers {
 public:
  explicit LooseNumbers(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

  /// `word` was read as the number of its first `number.length` bytes.
  void add(const SourceLocation& at, std::string_view word, const NumberPrefix& number);
  /// The fraction of `word` was cut off.
  void addFraction(const SourceLocation& at, std::string_view word);
  /// Says what was collected since the last time.
  void report();

 private:
  struct Seen {
    SourceLocation at;  ///< of the first
    std::string word;   ///< the first, printable
    std::string what;   ///< " where a number is expected: …"
    std::size_t count = 0;
  };
  /// `what()` is asked for the first of a manner only: there may be millions.
  template <class What>
  void count(const SourceLocation& at, std::string_view manner, std::string_view word, const What& what);

  /// Of all files; more of a hostile text are not told apart.
  static constexpr std::size_t kMaxManners = 1000;
  Diagnostics& diagnostics_;
  std::map<std::pair<const std::string*, std::string>, Seen> seen_;  ///< by file and manner
};

}  // namespace pbrtmedia
