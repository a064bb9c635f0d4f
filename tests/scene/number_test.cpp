// SPDX-License-Identifier: BSD-2-Clause
#include "scene/number.h"

#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>

#include "scene/lexer.h"

namespace pbrtmedia {
namespace {

float fastFloat(const std::string& text, bool& usedFastPath) {
  const char* p = text.data();
  Decimal d;
  float value = 0;
  usedFastPath =
      scanDecimal(p, text.data() + text.size(), d) && p == text.data() + text.size() && exactFloat(d, value);
  if (!usedFastPath) {
    EXPECT_EQ(parseFloat(text, value), NumberStatus::Ok) << text;
  }
  return value;
}

TEST(Number, FastPathEqualsCorrectRoundingOnRandomDecimals) {
  std::mt19937_64 random(7);
  std::size_t fast = 0;
  constexpr int kCount = 200000;
  for (int i = 0; i < kCount; ++i) {
    std::string text = random() % 3 == 0 ? "-" : "";
    const int before = static_cast<int>(random() % 8), after = static_cast<int>(random() % 10);
    for (int k = 0; k < before; ++k) text += static_cast<char>('0' + random() % 10);
    text += '.';
    for (int k = 0; k <= after; ++k) text += static_cast<char>('0' + random() % 10);
    if (random() % 4 == 0) text.append("e").append(std::to_string(static_cast<int>(random() % 40) - 20));
    bool isFast;
    const float value = fastFloat(text, isFast);
    fast += isFast;
    ASSERT_EQ(value, std::strtof(text.c_str(), nullptr)) << text;
  }
  EXPECT_GT(fast, kCount / 2);  // else nothing was tested
}

TEST(Number, FastPathTakesTheDigitsOfDoublesAndRoundsThemRight) {
  std::mt19937_64 random(11);
  std::size_t fast = 0;
  constexpr int kCount = 100000;
  for (int i = 0; i < kCount; ++i) {
    // 17 digits, as doubles are printed to be read back: every other one as near to half-way between two
    // floats as a double gets.
    double value = std::ldexp(static_cast<double>(random() >> 11), -53 + static_cast<int>(random() % 20));
    if (i % 2 == 1) {
      const double half = (1 + 2 * static_cast<double>(random() >> 40)) * 0x1p-24;
      const int steps = static_cast<int>(random() % 9) - 4;
      value = half;
      for (int k = 0; k < std::abs(steps); ++k) value = std::nextafter(value, steps > 0 ? 4.0 : 0.0);
    }
    char text[64];
    std::snprintf(text, sizeof text, "%.17g", value);
    bool isFast;
    const float read = fastFloat(text, isFast);
    if (i % 2 == 0) fast += isFast;
    ASSERT_EQ(read, std::strtof(text, nullptr)) << text;
  }
  EXPECT_GT(fast, kCount / 2 - kCount / 100);
}

float fromChars(const std::string& text) {
  float value = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  EXPECT_TRUE(stop == end && error == std::errc()) << text;
  return value;
}

TEST(Number, LongDecimalsTakeTheFastPathAndRoundAsFromChars) {
  std::mt19937_64 random(13);
  std::size_t fast = 0;
  constexpr int kCount = 300000;
  for (int i = 0; i < kCount; ++i) {
    std::string text;
    const auto digits = [&](std::uint64_t count) {
      for (std::uint64_t k = 0; k < count; ++k) text += static_cast<char>('0' + random() % 10);
    };
    // Up to 60 digits around a point anywhere, some with many zeros first, and normal floats after all.
    const std::uint64_t before = random() % 30, zeros = random() % 3 == 0 ? random() % 25 : 0;
    digits(before);
    text += '.';
    text.append(before == 0 ? zeros : 0, '0');
    digits(1 + random() % 30);
    if (random() % 2 == 0) text.append("e").append(std::to_string(static_cast<int>(random() % 20) - 12));
    if (before == 0) text.insert(text.begin(), '0');
    bool isFast;
    const float value = fastFloat(text, isFast);
    fast += isFast;
    ASSERT_EQ(value, fromChars(text)) << text;
  }
  EXPECT_GT(fast, kCount - kCount / 100);
}

TEST(Number, DecimalsAtAndBesideHalfWayRoundAsFromChars) {
  std::mt19937_64 random(17);
  for (int i = 0; i < 20000; ++i) {
    // Half-way between two floats, in all its digits; then with the rest of the digits a little more or less.
    const double half = std::ldexp(static_cast<double>((random() >> 40 | std::uint64_t{1} << 23) * 2 + 1),
                                   -25 - static_cast<int>(random() % 60) + 30);
    char text[256];
    std::snprintf(text, sizeof text, "%.110f", half);
    std::string exact(text);
    exact.erase(exact.find_last_not_of('0') + 1);
    std::string below = exact;
    if (below.back() == '.') below += '0';
    for (std::size_t k = below.size(); k-- > 0;) {  // subtracts 1 from the last place
      if (below[k] == '.') continue;
      if (below[k]-- != '0') break;
      below[k] = '9';
    }
    const std::string point = exact.back() == '.' ? "0" : "";
    for (const std::string& t :
         {exact, exact + point + "0000", exact + point + "00000000001", below, below + "99999999999"}) {
      bool isFast;
      ASSERT_EQ(fastFloat(t, isFast), fromChars(t)) << t;
    }
    bool isFast;
    fastFloat(exact, isFast);
    ASSERT_FALSE(isFast) << exact << ": rounding a rounded tie would be luck";
  }
}

TEST(Number, LongDigitRunsKeepTheirPlace) {
  for (const char* text :
       {"123456789012345678901234567890", "12345678901234567890.", "1234567890123456789.01",
        "0.000000000000000000000000000000123456789", "00000000000000000000000000000000000001",
        "00000000000000000000.00000000000000000000", "100000000000000000000000000000000000000",
        "999999999999999999999999e-20", "0.00000000000000000000000000000000000001175494351"}) {
    bool fast;
    EXPECT_EQ(fastFloat(text, fast), fromChars(text)) << text;
    EXPECT_TRUE(fast) << text;
  }
}

TEST(Number, HalfWayCasesRoundOnce) {
  // 1 + 2^-24 is half-way between two floats: it rounds to even, and anything above it up. As doubles, the
  // second text and the first are equal, so rounding by way of a double would get the second wrong.
  bool fast;
  EXPECT_EQ(fastFloat("1.000000059604644775390625", fast), 1.0f);
  EXPECT_EQ(fastFloat("1.0000000596046447753906250000001", fast), std::nextafter(1.0f, 2.0f));
  EXPECT_EQ(fastFloat("16777217", fast), 16777216.0f);
  EXPECT_FALSE(fast);  // 2^24 + 1, exactly half-way
  EXPECT_EQ(fastFloat("16777219", fast), 16777220.0f);
}

TEST(Number, TooSmallIsZeroAndTooLargeIsSaid) {
  float f;
  EXPECT_EQ(parseFloat("1e-60", f), NumberStatus::Ok);
  EXPECT_EQ(f, 0.0f);
  EXPECT_EQ(parseFloat("-1e-400", f), NumberStatus::Ok);
  EXPECT_TRUE(f == 0.0f && std::signbit(f));
  EXPECT_EQ(parseFloat("0." + std::string(500, '0') + "1", f), NumberStatus::Ok);
  EXPECT_EQ(f, 0.0f);
  EXPECT_EQ(parseFloat("1e39", f), NumberStatus::TooLarge);
  EXPECT_EQ(parseFloat("1" + std::string(60, '0'), f), NumberStatus::TooLarge);
  EXPECT_EQ(parseFloat("1e99999999999999999999", f), NumberStatus::TooLarge);
  EXPECT_EQ(parseFloat("1e-99999999999999999999", f), NumberStatus::Ok);
  EXPECT_EQ(parseFloat("0e99999999999999999999", f), NumberStatus::Ok);
  EXPECT_EQ(f, 0.0f);
  EXPECT_EQ(parseFloat("3.4028235e38", f), NumberStatus::Ok);
  EXPECT_EQ(f, std::numeric_limits<float>::max());
  double d;
  EXPECT_EQ(parseDouble("1e300", d), NumberStatus::Ok);
  EXPECT_EQ(parseDouble("1e309", d), NumberStatus::TooLarge);
}

TEST(Number, AcceptsTheUsualFormsAndNothingElse) {
  float f;
  for (const char* good : {"1", "+1", "-1", ".5", "5.", "-.5", "1e5", "1E+5", "1.e-5", "007"}) {
    EXPECT_EQ(parseFloat(good, f), NumberStatus::Ok) << good;
    EXPECT_EQ(f, std::strtof(good, nullptr)) << good;
  }
  for (const char* bad : {"", "-", "+", ".", "e5", "1e", "1e+", "--1", "+-1", "1.5abc", "1,2", "0x10", "inf",
                          "nan", "-inf", "1.2.3", "1 2"}) {
    EXPECT_EQ(parseFloat(bad, f), NumberStatus::NotANumber) << bad;
  }
}

/// Value and length of what strtof reads.
void expectPrefixAsStrtof(const std::string& text) {
  float value = -7;
  const NumberPrefix prefix = parseFloatPrefix(text, value);
  char* end = nullptr;
  const float expected = std::strtof(text.c_str(), &end);
  const auto length = static_cast<std::size_t>(end - text.c_str());
  if (prefix.kind == NumberPrefix::Kind::NotANumber) {
    ASSERT_TRUE(std::isnan(expected) && std::isnan(value)) << text;
    return;  // strtof takes nan(…) as a whole
  }
  ASSERT_EQ(prefix.length, length) << text;
  if (length == 0) {
    ASSERT_EQ(prefix.kind, NumberPrefix::Kind::Nothing) << text;
    return;
  }
  ASSERT_EQ(std::isinf(expected), prefix.kind == NumberPrefix::Kind::Infinite) << text;
  // Numbers below the smallest normal one are 0 here.
  if (std::abs(expected) < std::numeric_limits<float>::min()) {
    ASSERT_LT(std::abs(value), std::numeric_limits<float>::min()) << text;
  } else {
    ASSERT_EQ(value, expected) << text;
  }
}

TEST(Number, PrefixesAreThoseOfStrtof) {
  for (const char* text : {"",
                           "+",
                           "-",
                           ".",
                           "1",
                           "1.5abc",
                           "1,2",
                           "5#x",
                           "1e",
                           "1e+",
                           "1e+5x",
                           "1.2.3",
                           "..5",
                           ".5.",
                           "-.",
                           "--1",
                           "x1",
                           "0x10",
                           "0X1.8p1",
                           "0x",
                           "0xg",
                           "0x.",
                           "0x.8",
                           "-0x1p-2q",
                           "0x1p",
                           "0x1p+",
                           "0x1p999999",
                           "0x1p-999999",
                           "inf",
                           "-Infinity",
                           "infinit",
                           "INFx",
                           "in",
                           "nan",
                           "-NaN",
                           "nano",
                           "nan(1)",
                           "na",
                           "1e39",
                           "-1e999,",
                           "1e-60",
                           "1e-999f",
                           "3.4028235e38",
                           "3.4028236e38",
                           "0x1.fffffep127",
                           "0x1.ffffffp127"}) {
    expectPrefixAsStrtof(text);
  }
  std::mt19937_64 random(23);
  constexpr std::string_view kAlphabet = "0011259..+--eExXpPabfinI,#";
  for (int i = 0; i < 300000; ++i) {
    std::string text;
    for (std::uint64_t k = random() % 12; k > 0; --k) text += kAlphabet[random() % kAlphabet.size()];
    expectPrefixAsStrtof(text);
  }
}

TEST(Number, LexerReadsRunsAndStopsBeforeAnythingElse) {
  const std::string text = "1 2.5\n-3e2\t4]5";
  Lexer lexer(text, 0, false);
  float out[8] = {};
  ASSERT_EQ(lexer.readFloats(out, 8), 4u);
  EXPECT_EQ(out[1], 2.5f);
  EXPECT_EQ(out[2], -300.0f);
  const Token close = lexer.next();
  EXPECT_EQ(close.kind, Token::Kind::Close);
  EXPECT_EQ(close.line, 2u);
  EXPECT_EQ(close.column, 7u);
  EXPECT_EQ(lexer.readFloats(out, 8), 1u);
  EXPECT_EQ(lexer.next().kind, Token::Kind::End);
}

TEST(Number, LexerConvertsInFullWhereTheFastPathMayBeWrong) {
  const std::string text = "1 16777217 1.0000000596046447753906250000001 1e-60 2 1e39 3";
  Lexer lexer(text, 0, false);
  float out[8];
  ASSERT_EQ(lexer.readFloats(out, 8), 5u);
  EXPECT_EQ(out[1], 16777216.0f);
  EXPECT_EQ(out[2], std::nextafter(1.0f, 2.0f));
  EXPECT_EQ(out[3], 0.0f);
  EXPECT_EQ(lexer.next().raw, "1e39") << "too large: left to those who can say so";
  EXPECT_EQ(lexer.readFloats(out, 1), 1u);
  const std::string ints = "2147483647 2147483648";
  Lexer other(ints, 0, false);
  int i[2];
  EXPECT_EQ(other.readInts(i, 2), 1u);
  EXPECT_EQ(i[0], 2147483647);
}

}  // namespace
}  // namespace pbrtmedia
