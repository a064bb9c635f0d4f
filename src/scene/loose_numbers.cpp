// SPDX-License-Identifier: BSD-2-Clause
#include "scene/loose_numbers.h"

#include <algorithm>
#include <tuple>
#include <vector>

#include "scene/lexer.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kManner = 8;  // bytes of the text behind a number that tell one manner from another

/// What is said of numbers that `rest` follows.
std::string whatOfRest(std::string_view rest) {
  const std::string quoted = inQuotes(shown(rest));
  const bool hasDigits = rest.find_first_of("0123456789") != rest.npos;
  std::string what = " where a number is expected: " +
                     (hasDigits ? "as in PBRT-v3 only its beginning is read, and " + quoted + " is lost"
                                : "the " + quoted + " behind it is ignored, as in PBRT-v3");
  if (rest[0] == ',' || rest[0] == ';') return what + "; separate numbers by blanks";
  if (rest[0] == '#') return what + "; a comment needs a blank before its #";
  return what;
}

}  // namespace

template <class What>
void LooseNumbers::count(const SourceLocation& at, std::string_view manner, std::string_view word,
                         const What& what) {
  auto key = std::make_pair(at.file.get(), std::string(manner));
  auto it = seen_.find(key);
  if (it == seen_.end()) {
    if (seen_.size() >= kMaxManners) return;
    it = seen_.emplace(std::move(key), Seen{at, shown(word), what(), 0}).first;
  }
  ++it->second.count;
}

void LooseNumbers::add(const SourceLocation& at, std::string_view word, const NumberPrefix& number) {
  const std::string_view rest = word.substr(number.length);
  if (!rest.empty()) count(at, rest.substr(0, kManner), word, [&] { return whatOfRest(rest); });
  if (number.kind != NumberPrefix::Kind::Hexadecimal) return;
  count(at, "0x", word, [] {
    return std::string(", a hexadecimal number, read as PBRT-v3 reads it; write decimal numbers");
  });
}

void LooseNumbers::addFraction(const SourceLocation& at, std::string_view word) {
  count(at, "fraction", word, [] {
    return std::string(" where a whole number is expected: the fraction is cut off, as in PBRT-v3");
  });
}

void LooseNumbers::report() {
  std::vector<const Seen*> inOrder;  // of the text, not of where the names of files lie in memory
  for (const auto& entry : seen_) inOrder.push_back(&entry.second);
  const auto place = [](const Seen* s) {
    return std::make_tuple(s->at.file ? *s->at.file : std::string(), s->at.line, s->at.column);
  };
  std::sort(inOrder.begin(), inOrder.end(), [&](auto* a, auto* b) { return place(a) < place(b); });
  for (const Seen* s : inOrder) {
    const std::string also =
        s->count > 1 ? " (and " + std::to_string(s->count - 1) + " more of this file)" : std::string();
    diagnostics_.tolerated(s->at, "found " + s->word + s->what + also);
  }
  seen_.clear();
}

}  // namespace pbrtmedia
