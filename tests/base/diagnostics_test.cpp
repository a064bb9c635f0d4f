// SPDX-License-Identifier: BSD-2-Clause
#include "base/diagnostics.h"

#include <gtest/gtest.h>

#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

SourceLocation at(const std::string& file, std::uint32_t line, std::uint32_t column,
                  std::uint32_t length = 1) {
  return {std::make_shared<const std::string>(file), line, column, length};
}

std::string formatOne(const std::string& text, const SourceLocation& where,
                      const std::string& message = "m") {
  Diagnostics d;
  d.keepText(*where.file, text);
  d.error(where, message);
  return d.format();
}

TEST(Diagnostics, ShowsPlaceLineAndCaret) {
  EXPECT_EQ(formatOne("one\n  \"string estimator\" \"ratoi\"\nthree", at("smoke.pbrt", 2, 22, 7),
                      "unknown estimator \"ratoi\""),
            "smoke.pbrt:2:22: error: unknown estimator \"ratoi\"\n"
            "    \"string estimator\" \"ratoi\"\n"
            "                       ^~~~~~~\n");
}

TEST(Diagnostics, ReadsTheLineFromTheFile) {
  const TemporaryFolder folder;
  const std::string file = folder
                               .write("a.pbrt",
                                      "\xef\xbb\xbf"
                                      "first\r\nsecond\r\n")
                               .string();
  Diagnostics d;
  d.warning(at(file, 2, 1, 6), "w");
  d.error(at(file, 1, 1, 5), "e");
  EXPECT_EQ(d.format(),
            file + ":2:1: warning: w\n  second\n  ^~~~~~\n" + file + ":1:1: error: e\n  first\n  ^~~~~\n");
}

TEST(Diagnostics, WorksWithoutALineAndWithoutAPlace) {
  Diagnostics d;
  d.error(at("/no/such/file", 3, 4), "gone");
  d.note(at("whole.pbrt", 0, 0), "n");
  d.error({}, "nowhere");
  EXPECT_EQ(d.format(), "/no/such/file:3:4: error: gone\nwhole.pbrt: note: n\nerror: nowhere\n");
}

TEST(Diagnostics, TabsKeepTheCaretInPlace) {
  EXPECT_EQ(formatOne("\tab\tc", at("t", 1, 5)), "t:1:5: error: m\n      ab  c\n          ^\n");
}

TEST(Diagnostics, CountsUtf8CharactersAsOneColumn) {
  EXPECT_EQ(formatOne("é \"x\"", at("t", 1, 4, 3)), "t:1:4: error: m\n  é \"x\"\n    ^~~\n");
}

TEST(Diagnostics, NeverPrintsControlCharactersOfTheFile) {
  const std::string out = formatOne("a\x1b[2Jb\xff\x7f", at("t", 1, 1));
  EXPECT_EQ(out, "t:1:1: error: m\n  a?[2Jb??\n  ^\n");
}

TEST(Diagnostics, LongLinesAreCutAroundTheCaret) {
  std::string text(1 << 20, 'x');
  text[500000] = '!';
  const std::string out = formatOne(text, at("t", 1, 500001));
  EXPECT_LT(out.size(), 400u);
  const std::size_t first = out.find('\n') + 1, second = out.find('\n', first) + 1;
  EXPECT_EQ(out.find('!', first) - first, out.find('^') - second);
  EXPECT_NE(out.find("... "), std::string::npos);
}

TEST(Diagnostics, ACaretBehindTheEndOfTheLineIsDrawn) {
  EXPECT_EQ(formatOne("ab", at("t", 1, 3)), "t:1:3: error: m\n  ab\n    ^\n");
  EXPECT_EQ(formatOne("ab", at("t", 1, 4000000000u)), "t:1:4000000000: error: m\n  ab\n    ^\n");
  EXPECT_EQ(formatOne("ab", at("t", 7, 1)), "t:7:1: error: m\n");
}

TEST(Diagnostics, RepeatsAreShownOnce) {
  Diagnostics d;
  for (int i = 0; i < 3; ++i) d.error(at("t", 1, 1), "same");
  d.warning(at("t", 1, 1), "same");
  EXPECT_EQ(d.errorCount(), 3u);
  EXPECT_EQ(d.format(), "t:1:1: error: same\nt:1:1: warning: same\n");
}

TEST(Diagnostics, ManyMessagesAreCutButErrorsAreNotHiddenByWarnings) {
  Diagnostics d;
  for (unsigned i = 0; i < 80; ++i) d.warning(at("t", i + 1, 1), "w");
  for (unsigned i = 0; i < 52; ++i) d.error(at("t", i + 1, 1), "e");
  const std::string out = d.format();
  EXPECT_NE(out.find("t:50:1: error: e\n"), std::string::npos);
  EXPECT_EQ(out.find("t:51:1: error"), std::string::npos);
  EXPECT_NE(out.find("… and 2 more errors\n… and 30 more warnings and notes\n"), std::string::npos);
}

TEST(Diagnostics, MemoryIsBoundedAndErrorsStillCount) {
  Diagnostics d;
  for (unsigned i = 0; i < Diagnostics::kMaxKept + 7; ++i) d.error({}, "e");
  EXPECT_EQ(d.all().size(), Diagnostics::kMaxKept);
  EXPECT_EQ(d.errorCount(), Diagnostics::kMaxKept + 7);
  EXPECT_NE(d.format().find("… and 7 more messages"), std::string::npos);
}

TEST(Diagnostics, WhatIsToleratedIsAnErrorWithStrictAndSaysSo) {
  Diagnostics d;
  d.tolerated({}, "a");
  EXPECT_FALSE(d.hasErrors());
  EXPECT_EQ(d.format(), "warning: a [an error with --strict]\n");
  Diagnostics strict;
  strict.strict = true;
  strict.tolerated({}, "a");
  EXPECT_TRUE(strict.hasErrors());
  EXPECT_EQ(strict.format(), "error: a [--strict]\n");
}

constexpr std::string_view kKnown[] = {"delta", "ratio", "residual-ratio"};

TEST(Suggestion, NamesTheEightNearest) {
  constexpr std::string_view kMany[] = {"ninth-", "x1", "x2", "x3", "x4", "x5", "x6", "x7", "x8"};
  EXPECT_EQ(suggestion("x", kMany), "; known: x1, x2, x3, x4, x5, x6, x7, x8, …");
}

TEST(Suggestion, NamesAMisspelling) {
  EXPECT_EQ(suggestion("ratoi", kKnown), "; did you mean \"ratio\"? known: ratio, delta, residual-ratio");
  EXPECT_EQ(suggestion("RATIO", kKnown).substr(0, 25), "; did you mean \"ratio\"? k");
  EXPECT_EQ(suggestion("zzz", kKnown).substr(0, 9), "; known: ");
  EXPECT_EQ(suggestion("zzz", {}), "");
  EXPECT_EQ(suggestion("", kKnown).substr(0, 9), "; known: ");
}

TEST(Suggestion, HugeNamesCostLittle) {
  EXPECT_EQ(suggestion(std::string(1 << 24, 'q'), kKnown).substr(0, 9), "; known: ");
}

}  // namespace
}  // namespace pbrtmedia
