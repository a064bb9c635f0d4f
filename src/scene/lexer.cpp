// SPDX-License-Identifier: BSD-2-Clause
#include "scene/lexer.h"

#include <algorithm>
#include <array>
#include <limits>

#include "scene/number.h"

namespace pbrtmedia {
namespace {

constexpr std::array<bool, 256> delimiters() {
  std::array<bool, 256> is{};
  for (const unsigned char c : {' ', '\t', '\n', '\r', '\f', '\v', '"', '[', ']'}) is[c] = true;
  return is;
}
constexpr std::array<bool, 256> kDelimiter = delimiters();
bool isDelimiter(char c) { return kDelimiter[static_cast<unsigned char>(c)]; }

constexpr std::uint32_t kLongestUnderline = 1000;  // of a caret line; a token may be megabytes

}  // namespace

std::uint32_t Token::length() const {
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(raw.size(), 1, kLongestUnderline));
}

Lexer::Lexer(std::string_view text, std::size_t start, bool keepComments)
    : begin_(text.data()),
      p_(text.data() + start),
      end_(text.data() + text.size()),
      lineStart_(p_),
      keepComments_(keepComments) {}

void Lexer::skipBlanks() {
  for (; p_ != end_; ++p_) {
    if (*p_ == '\n') {
      ++line_;
      lineStart_ = p_ + 1;
    } else if (*p_ != ' ' && *p_ != '\t' && *p_ != '\r' && *p_ != '\f' && *p_ != '\v') {
      return;
    }
  }
}

Token Lexer::next() {
  skipBlanks();
  while (p_ != end_ && *p_ == '#') {
    const char* const start = p_;
    while (p_ != end_ && *p_ != '\n' && *p_ != '\r') ++p_;
    if (keepComments_) {
      return {Token::Kind::Comment, {start, static_cast<std::size_t>(p_ - start)}, line_, columnOf(start), 0};
    }
    skipBlanks();
  }
  const char* const start = p_;
  const auto token = [&](Token::Kind kind) {
    return Token{kind, {start, static_cast<std::size_t>(p_ - start)}, line_, columnOf(start), 0};
  };
  if (p_ == end_) return token(Token::Kind::End);
  switch (*p_) {
    case '[':
      ++p_;
      return token(Token::Kind::Open);
    case ']':
      ++p_;
      return token(Token::Kind::Close);
    case '"':
      for (++p_; p_ != end_ && *p_ != '\n'; ++p_) {
        if (*p_ == '"') {
          ++p_;
          return token(Token::Kind::String);
        }
        if (*p_ == '\\' && p_ + 1 != end_ && p_[1] != '\n') ++p_;
      }
      return token(Token::Kind::Unclosed);
    default:
      while (p_ != end_ && !isDelimiter(*p_)) ++p_;
      return token(Token::Kind::Word);
  }
}

template <class T, class Convert>
std::size_t Lexer::readNumbers(T* out, std::size_t most, const Convert& convert) {
  const char* p = p_;
  const char* const end = end_;
  std::size_t count = 0;
  while (count < most) {
    p_ = p;
    if (p == end) break;
    if (*p == ' ') {  // the usual separator, without a look at the line count
      ++p;
      if (p == end) break;
    }
    if (static_cast<unsigned char>(*p) <= ' ') {
      p_ = p;
      skipBlanks();
      p = p_;
      if (p == end) break;
    }
    if (static_cast<unsigned char>(*p - '0') < 10 && p + 1 != end && isDelimiter(p[1])) {
      out[count++] = static_cast<T>(*p++ - '0');  // grids are full of zeros
      continue;
    }
    Decimal d;
    const char* const start = p;
    T value;
    if (!scanDecimal(p, end, d) || (p != end && !isDelimiter(*p)) ||
        !convert(d, std::string_view(start, static_cast<std::size_t>(p - start)), value)) {
      p_ = start;
      return count;
    }
    out[count++] = value;
  }
  p_ = p;
  return count;
}

std::size_t Lexer::readFloats(float* out, std::size_t most) {
  return readNumbers(out, most, [](const Decimal& d, std::string_view word, float& value) {
    return exactFloat(d, value) || parseFloat(word, value) == NumberStatus::Ok;
  });
}

std::size_t Lexer::readInts(int* out, std::size_t most) {
  return readNumbers(out, most, [](const Decimal& d, std::string_view, int& value) {
    if (!d.exact || d.exponent != 0) return false;
    if (d.mantissa > static_cast<std::uint64_t>(std::numeric_limits<int>::max())) return false;
    value = static_cast<int>(d.mantissa);
    if (d.negative) value = -value;
    return true;
  });
}

std::string_view Lexer::lineAround(const char* p, std::ptrdiff_t most) const {
  const auto isEnd = [](char c) { return c == '\n' || c == '\r'; };
  const char* first = p;
  const char* last = p;
  while (first != begin_ && !isEnd(first[-1]) && p - first <= most) --first;
  while (last != end_ && !isEnd(*last) && last - p <= most) ++last;
  if (p - first > most || last - p > most) return {};
  return {first, static_cast<std::size_t>(last - first)};
}

std::uint32_t Lexer::lastLine() const {
  const bool endsLine = p_ != end_ && end_[-1] == '\n';
  return line_ + static_cast<std::uint32_t>(std::count(p_, end_, '\n')) - (endsLine ? 1 : 0);
}

std::string unescaped(std::string_view raw, const SourceLocation& at) {
  const std::string_view body = raw.substr(1, raw.size() - 2);
  std::string text;
  text.reserve(body.size());
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body[i] != '\\') {
      text += body[i];
      continue;
    }
    static constexpr std::string_view kLetters = "bfnrt\\'\"", kMeanings = "\b\f\n\r\t\\'\"";
    const std::size_t which = i + 1 < body.size() ? kLetters.find(body[i + 1]) : kLetters.npos;
    if (which == kLetters.npos) {
      SourceLocation here = at;
      here.column += static_cast<std::uint32_t>(i + 1);
      here.length = 2;
      throw SceneError(here, "unknown escape " + shown(body.substr(i, 2)) +
                                 R"( in a string; known: \b \f \n \r \t \\ \' \"; write folders with /)");
    }
    text += kMeanings[which];
    ++i;
  }
  return text;
}

std::string inQuotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    static constexpr std::string_view kLetters = "bfnrt\\\"", kMeanings = "\b\f\n\r\t\\\"";
    if (const std::size_t which = kMeanings.find(c); which != kMeanings.npos) {
      out += '\\';
      out += kLetters[which];
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string shown(std::string_view raw) {
  constexpr std::size_t kMost = 40;
  std::string out;
  for (const char c : raw.substr(0, kMost)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0x20 && byte != 0x7f) {
      out += c;
    } else {
      constexpr std::string_view kHex = "0123456789abcdef";
      out += "\\x";
      out += kHex[byte >> 4];
      out += kHex[byte & 15];
    }
  }
  return raw.size() > kMost ? out + "…" : out;
}

}  // namespace pbrtmedia
