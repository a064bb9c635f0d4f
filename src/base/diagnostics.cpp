// SPDX-License-Identifier: BSD-2-Clause
#include "base/diagnostics.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "base/files.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kExcerptColumns = 100;  // what fits a terminal next to our indent
constexpr std::size_t kExcerptBytes = 400;  // read around the caret, so that a line of megabytes is no burden
constexpr std::size_t kTabWidth = 4;
constexpr std::size_t kMaxComparedLength = 32;  // longer names are no misspellings of ours
constexpr std::size_t kMaxMisspelt = 15;        // longer ones are compared with names of like length only

std::string_view name(Severity s) {
  return s == Severity::Error ? "error" : (s == Severity::Warning ? "warning" : "note");
}

/// The part of a source line that is shown, with the 0-based byte the caret points at.
struct Excerpt {
  std::string_view bytes;
  std::size_t caret = 0;
  bool cutLeft = false, cutRight = false;
};

Excerpt cutAround(std::string_view line, std::size_t column) {
  Excerpt e;
  e.caret = std::min(column, line.size());
  std::size_t begin = e.caret > kExcerptBytes ? e.caret - kExcerptBytes : 0;
  const std::size_t end = std::min(line.size(), e.caret + kExcerptBytes);
  while (begin > 0 && begin < e.caret && (line[begin] & 0xc0) == 0x80) ++begin;
  e.bytes = line.substr(begin, end - begin);
  e.caret -= begin;
  e.cutLeft = begin > 0;
  e.cutRight = end < line.size();
  return e;
}

/// Finds lines of a text; quick when asked in ascending order.
class LineFinder {
 public:
  explicit LineFinder(FileBytes file) : file_(std::move(file)), text_(file_->text()) { start(); }
  explicit LineFinder(std::string_view text) : text_(text) { start(); }

  std::optional<Excerpt> find(std::uint32_t line, std::uint32_t column) {
    if (line < line_) start();
    while (line_ < line) {
      const std::size_t next = text_.find('\n', offset_);
      if (next == std::string_view::npos) return std::nullopt;
      offset_ = next + 1;
      ++line_;
    }
    std::string_view rest = text_.substr(offset_);
    rest = rest.substr(0, std::size_t{column} + 2 * kExcerptBytes);
    rest = rest.substr(0, rest.find('\n'));
    if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
    return cutAround(rest, column - 1);
  }

 private:
  void start() {
    line_ = 1;
    offset_ = text_.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;
  }
  std::optional<FileBytes> file_;
  std::string_view text_;
  std::size_t offset_ = 0;
  std::uint32_t line_ = 1;
};

/// Bytes of the UTF-8 character at `i`, 0 when it is no printable character.
std::size_t printableLength(std::string_view s, std::size_t i) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(s[k]); };
  const unsigned char c = byte(i);
  if (c < 0x80) return c >= 0x20 && c != 0x7f ? 1 : 0;
  const std::size_t n =
      c >= 0xc2 && c < 0xe0 ? 2 : (c >= 0xe0 && c < 0xf0 ? 3 : (c >= 0xf0 && c < 0xf5 ? 4 : 0));
  if (n == 0 || i + n > s.size()) return 0;
  for (std::size_t k = 1; k < n; ++k) {
    if ((byte(i + k) & 0xc0) != 0x80) return 0;
  }
  if (c == 0xc2 && byte(i + 1) < 0xa0) return 0;  // C1 control characters
  return n;
}

/// The source line and the caret line, each with the indent. Control characters never reach the terminal.
std::string draw(const Excerpt& e, std::uint32_t length) {
  std::vector<std::string> cells;  // one entry per terminal column
  std::size_t caretCell = 0, caretEnd = 0;
  const std::size_t stop = e.caret + std::max<std::size_t>(length, 1);
  for (std::size_t i = 0; i < e.bytes.size();) {
    if (i <= e.caret) caretCell = cells.size();
    if (e.bytes[i] == '\t') {
      do {
        cells.emplace_back(" ");
      } while (cells.size() % kTabWidth != 0);
      ++i;
    } else if (const std::size_t n = printableLength(e.bytes, i); n > 0) {
      cells.emplace_back(e.bytes.substr(i, n));
      i += n;
    } else {
      cells.emplace_back("?");
      ++i;
    }
    if (i <= stop) caretEnd = cells.size();
  }
  if (e.caret >= e.bytes.size()) caretCell = cells.size();
  caretEnd = std::max(caretEnd, caretCell + 1);

  std::size_t from = 0, to = cells.size();
  bool cutLeft = e.cutLeft, cutRight = e.cutRight;
  if (to > kExcerptColumns) {
    from = caretCell > kExcerptColumns / 2 ? caretCell - kExcerptColumns / 2 : 0;
    from = std::min(from, to - kExcerptColumns);
    to = from + kExcerptColumns;
    cutLeft = cutLeft || from > 0;
    cutRight = cutRight || to < cells.size();
  }
  std::string text = "  ", caret = "  ";
  if (cutLeft) {
    text += "... ";
    caret += "    ";
  }
  for (std::size_t i = from; i < to; ++i) text += cells[i];
  if (cutRight) text += " ...";
  caret.append(caretCell - from, ' ');
  caret += '^';
  caret.append(std::max(std::min(caretEnd, std::max(to, caretCell + 1)), caretCell + 1) - caretCell - 1, '~');
  return text + '\n' + caret + '\n';
}

/// Excerpts from kept texts and from files, each opened once.
class Excerpts {
 public:
  explicit Excerpts(const std::map<std::string, std::string>& kept) : kept_(kept) {}

  std::string of(const Diagnostic& d) {
    if (!d.excerpt.empty()) {
      return draw(cutAround(d.excerpt, std::max<std::uint32_t>(d.location.column, 1) - 1), d.location.length);
    }
    if (!d.location.file || d.location.line == 0 || d.location.column == 0) return {};
    std::optional<LineFinder>& finder = open(*d.location.file);
    if (!finder) return {};
    const std::optional<Excerpt> e = finder->find(d.location.line, d.location.column);
    return e ? draw(*e, d.location.length) : std::string();
  }

 private:
  std::optional<LineFinder>& open(const std::string& file) {
    const auto [it, isNew] = finders_.try_emplace(file);
    if (!isNew) return it->second;
    if (const auto text = kept_.find(file); text != kept_.end()) {
      it->second.emplace(std::string_view(text->second));
      return it->second;
    }
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return it->second;
    try {
      it->second.emplace(FileBytes::open(file));
    } catch (const std::exception&) {
      // A file that has gone is no reason to lose the message: it is shown without its line.
    }
    return it->second;
  }
  const std::map<std::string, std::string>& kept_;
  std::map<std::string, std::optional<LineFinder>> finders_;
};

/// The first letters of a word without regard to case, as far as they are compared.
struct ComparedWord {
  explicit ComparedWord(std::string_view word) : size(std::min(word.size(), kMaxComparedLength)) {
    std::transform(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(size), letters.begin(),
                   [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  }
  std::size_t size;
  std::array<char, kMaxComparedLength> letters{};
};

/// Edits (insert, delete, replace, swap of neighbours) between two words without regard to case.
std::size_t editDistance(const ComparedWord& a, const ComparedWord& b) {
  std::array<std::array<std::uint8_t, kMaxComparedLength + 1>, 3> rows{};  // of the table, used in turn
  std::iota(rows[0].begin(), rows[0].end(), std::uint8_t{0});
  for (std::size_t i = 1; i <= a.size; ++i) {
    auto& current = rows[i % 3];
    const auto &previous = rows[(i + 2) % 3], &before = rows[(i + 1) % 3];
    const char letter = a.letters[i - 1];
    current[0] = static_cast<std::uint8_t>(i);
    for (std::size_t j = 1; j <= b.size; ++j) {
      const bool same = letter == b.letters[j - 1];
      const int step = std::min(previous[j], current[j - 1]) + 1;
      int best = std::min(step, previous[j - 1] + (same ? 0 : 1));
      if (i > 1 && j > 1 && letter == b.letters[j - 2] && a.letters[i - 2] == b.letters[j - 1]) {
        best = std::min(best, before[j - 2] + 1);
      }
      current[j] = static_cast<std::uint8_t>(best);
    }
  }
  return rows[a.size % 3][b.size];
}

/// Twice the edits between two words, plus one if they differ at all: a difference of case alone counts half
/// an edit. A long word and one of less than half its length are no misspellings of each other, and count as
/// different in every letter.
std::size_t wordDistance(std::string_view a, std::string_view b, const ComparedWord& comparedA) {
  const ComparedWord comparedB(b);
  const auto [less, more] = std::minmax(comparedA.size, comparedB.size);
  const std::size_t edits =
      more > kMaxMisspelt && more > 2 * less ? more : editDistance(comparedA, comparedB);
  return 2 * edits + (a == b ? 0 : 1);
}

struct Ranked {
  std::size_t distance;
  std::string_view name;
};
std::vector<Ranked> rank(std::string_view found, std::span<const std::string_view> known) {
  std::vector<Ranked> ranked;
  ranked.reserve(known.size());
  const ComparedWord compared(found);
  for (const std::string_view k : known) ranked.push_back({wordDistance(found, k, compared), k});
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const Ranked& a, const Ranked& b) { return a.distance < b.distance; });
  return ranked;
}

std::string join(const std::vector<Ranked>& ranked, std::size_t most) {
  std::string list;
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i) {
    if (i > 0) list += ", ";
    list += ranked[i].name.empty() ? "\"\"" : ranked[i].name;
  }
  if (ranked.size() > most) list += ", …";
  return list;
}

}  // namespace

std::string SourceLocation::toString() const {
  if (!file) return {};
  if (line == 0) return *file;
  std::string s = *file + ':' + std::to_string(line);
  if (column > 0) s += ':' + std::to_string(column);
  return s;
}

void Diagnostics::tolerated(const SourceLocation& at, std::string message) {
  if (!message.empty()) message += strict ? " [--strict]" : " [an error with --strict]";
  add(strict ? Severity::Error : Severity::Warning, at, std::move(message));
}

void Diagnostics::add(Severity severity, const SourceLocation& at, std::string message) {
  if (severity == Severity::Error) ++errors_;
  if (isFull()) {
    ++notKept_;
    return;
  }
  items_.push_back({severity, at, std::move(message), {}});
}

std::string Diagnostics::format() const {
  std::string out;
  Excerpts excerpts(kept_);
  std::set<std::tuple<Severity, std::string, std::string>> shown;
  std::size_t errors = 0, others = 0;
  for (const Diagnostic& d : items_) {
    const std::string where = d.location.toString();
    if (!shown.emplace(d.severity, where, d.message).second) continue;
    if (++(d.severity == Severity::Error ? errors : others) > kMaxShown) continue;
    if (!where.empty()) out += where + ": ";
    out += std::string(name(d.severity)) + ": " + d.message + '\n' + excerpts.of(d);
  }
  if (errors > kMaxShown) out += "… and " + std::to_string(errors - kMaxShown) + " more errors\n";
  if (others > kMaxShown) out += "… and " + std::to_string(others - kMaxShown) + " more warnings and notes\n";
  if (notKept_ > 0) out += "… and " + std::to_string(notKept_) + " more messages\n";
  return out;
}

std::string suggestion(std::string_view found, std::span<const std::string_view> known) {
  if (known.empty()) return {};
  constexpr std::size_t kMost = 8;
  const std::vector<Ranked> ranked = rank(found, known);
  // Close: a third of the letters may differ, but not all of a short name.
  const std::size_t allowed = 2 * std::max<std::size_t>(1, ranked[0].name.size() / 3) + 1;
  std::string text = "; ";
  if (!found.empty() && !ranked[0].name.empty() && ranked[0].distance <= allowed &&
      ranked[0].distance < 2 * std::min(found.size(), ranked[0].name.size())) {
    text += "did you mean \"" + std::string(ranked[0].name) + "\"? ";
  }
  return text + "known: " + join(ranked, kMost);
}

}  // namespace pbrtmedia
