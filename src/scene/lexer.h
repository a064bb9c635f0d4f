// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace pbrtmedia {

/// A token of the scene language (reference 1). Views point into the text.
struct Token {
  enum class Kind : std::uint8_t {
    End,
    Word,     ///< keyword, number or anything unquoted
    String,   ///< `raw` has the quotes
    Open,     ///< [
    Close,    ///< ]
    Comment,  ///< from # to the end of the line; only from a lexer that keeps comments
    Unclosed  ///< a string without its second quote on the same line
  };
  Kind kind = Kind::End;
  std::string_view raw;
  std::uint32_t line = 1, column = 1;
  std::uint32_t source = 0;  ///< set by TokenStream

  std::uint32_t length() const;
};

/// Cuts text into tokens. Blanks are space, tab, LF, CR and, beyond PBRT-v3, form feed and vertical tab.
class Lexer {
 public:
  /// `start` is where the first line begins (behind a byte order mark).
  Lexer(std::string_view text, std::size_t start, bool keepComments);

  Token next();
  /// Reads plain numbers while they follow each other, at most `most`; stops before anything else (a comment,
  /// a bracket, a number with a problem), which `next` then gives.
  std::size_t readFloats(float* out, std::size_t most);
  std::size_t readInts(int* out, std::size_t most);
  /// Whether `p` points into the text.
  bool holds(const char* p) const { return !std::less<>()(p, begin_) && !std::less<>()(end_, p); }
  /// The line of the text around `p`, without its end; empty where it is longer than `most` bytes to one
  /// side.
  std::string_view lineAround(const char* p, std::ptrdiff_t most) const;
  /// Number of the line in which the text ends; the end of the last line begins no further one.
  std::uint32_t lastLine() const;
  /// Bytes of the text already turned into tokens.
  std::size_t offset() const { return static_cast<std::size_t>(p_ - begin_); }

 private:
  template <class T, class Convert>
  std::size_t readNumbers(T* out, std::size_t most, const Convert& convert);
  void skipBlanks();
  std::uint32_t columnOf(const char* p) const { return static_cast<std::uint32_t>(p - lineStart_ + 1); }

  const char* begin_;
  const char* p_;
  const char* end_;
  const char* lineStart_;
  std::uint32_t line_ = 1;
  bool keepComments_;
};

/// Where a line with an odd number of quotes most likely lacks one.
struct MissingQuote {
  static constexpr std::ptrdiff_t kLongestLine =
      4096;             ///< bytes; longer ones a program wrote, with its quotes
  std::size_t at = 0;   ///< bytes from the start of the line
  std::string message;  ///< what is missing there
};
/// Nothing where the quotes of the line pair up.
std::optional<MissingQuote> findMissingQuote(std::string_view line);

/// The characters a quoted token stands for. Throws SceneError at a backslash that starts no escape of the
/// language; `at` is the place of the token.
std::string unescaped(std::string_view raw, const SourceLocation& at);
/// The quoted form that reads back as `text`.
std::string inQuotes(std::string_view text);
/// For messages: at most 40 bytes, everything unprintable as \xNN.
std::string shown(std::string_view raw);

}  // namespace pbrtmedia
