// SPDX-License-Identifier: BSD-2-Clause
#include "scene/lexer.h"

#include <gtest/gtest.h>

#include <vector>

namespace pbrtmedia {
namespace {

using Kind = Token::Kind;

std::vector<Token> tokens(std::string_view text, bool keepComments = false) {
  Lexer lexer(text, 0, keepComments);
  std::vector<Token> all;
  for (Token t = lexer.next(); t.kind != Kind::End; t = lexer.next()) all.push_back(t);
  return all;
}

TEST(Lexer, WordsEndAtQuotesAndBrackets) {
  const auto t = tokens("Shape\"sphere\"[1]x");
  ASSERT_EQ(t.size(), 6u);
  EXPECT_EQ(t[0].raw, "Shape");
  EXPECT_EQ(t[1].kind, Kind::String);
  EXPECT_EQ(t[1].raw, "\"sphere\"");
  EXPECT_EQ(t[2].kind, Kind::Open);
  EXPECT_EQ(t[4].kind, Kind::Close);
  EXPECT_EQ(t[5].raw, "x");
}

TEST(Lexer, CountsLinesAndColumnsFromOne) {
  const auto t = tokens("a b\r\n  c\n\n\t\"d\"");
  ASSERT_EQ(t.size(), 4u);
  EXPECT_EQ(t[1].column, 3u);
  EXPECT_EQ(t[2].line, 2u);
  EXPECT_EQ(t[2].column, 3u);
  EXPECT_EQ(t[3].line, 4u);
  EXPECT_EQ(t[3].column, 2u);
}

TEST(Lexer, CommentsStartOnlyAtATokenAndNotInStrings) {
  const auto t = tokens("# all\na #b\n5#x \"a # b\" #end");
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].raw, "a");
  EXPECT_EQ(t[1].raw, "5#x");
  EXPECT_EQ(t[2].raw, "\"a # b\"");
  const auto kept = tokens("a #b\rc", true);
  ASSERT_EQ(kept.size(), 3u);
  EXPECT_EQ(kept[1].kind, Kind::Comment);
  EXPECT_EQ(kept[1].raw, "#b");
}

TEST(Lexer, StringsMustCloseOnTheirLine) {
  const auto t = tokens("\"open\nnext \"");
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].kind, Kind::Unclosed);
  EXPECT_EQ(t[1].raw, "next");
  EXPECT_EQ(t[2].kind, Kind::Unclosed);
  EXPECT_EQ(tokens("\"a\\").at(0).kind, Kind::Unclosed);
  EXPECT_EQ(tokens("\"\"").at(0).kind, Kind::String);
}

TEST(Lexer, AnEscapedQuoteEndsNoString) {
  const auto t = tokens(R"("a \" b" c "\\" d)");
  ASSERT_EQ(t.size(), 4u);
  EXPECT_EQ(t[0].kind, Kind::String);
  EXPECT_EQ(t[0].raw, R"("a \" b")");
  EXPECT_EQ(t[1].raw, "c");
  EXPECT_EQ(t[2].raw, R"("\\")");
  EXPECT_EQ(t[3].raw, "d");
}

TEST(Lexer, EscapesAreThoseOfTheLanguage) {
  EXPECT_EQ(unescaped(R"("\b\f\n\r\t\\\'\"")", {}), "\b\f\n\r\t\\'\"");
  const SourceLocation at{nullptr, 3, 10, 5};
  try {
    unescaped(R"("ab\qc")", at);
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_EQ(e.location().line, 3u);
    EXPECT_EQ(e.location().column, 13u);
    EXPECT_NE(std::string(e.what()).find("unknown escape \\q"), std::string::npos);
  }
}

TEST(Lexer, QuotingReadsBack) {
  const std::string all = "a\"b\\c\n\t\r\f\b'é";
  EXPECT_EQ(unescaped(inQuotes(all), {}), all);
}

TEST(Lexer, ShownTextIsShortAndPrintable) {
  EXPECT_EQ(shown("a\x1b[31m"), "a\\x1b[31m");
  EXPECT_EQ(shown(std::string(100, 'x')), std::string(40, 'x') + "…");
}

}  // namespace
}  // namespace pbrtmedia
