// SPDX-License-Identifier: BSD-2-Clause
#include "tools/command_line.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

/// What the check says of a text; empty: nothing.
std::string said(const CLI::Validator& check, std::string text) { return check(text); }

TEST(WholeNumber, HasItsRangeAndNothingElse) {
  const CLI::Validator check = wholeNumber(2ull, 1000ull);
  for (const char* good : {"2", "1000", "+7", "0007"}) EXPECT_EQ(said(check, good), "") << good;
  for (const char* bad : {"1", "1001", "-5", "99999999999999999999", "", "+", "-", "2.5", "1e2", "0x10", "7x",
                          " 7", "7 ", "nan", "--5", "+-5"}) {
    EXPECT_EQ(said(check, bad), std::string("found ") + bad + ", expected a whole number from 2 to 1000");
  }
  const CLI::Validator all = wholeNumber(std::uint64_t{0}, ~std::uint64_t{0});
  EXPECT_EQ(said(all, "18446744073709551615"), "");
  EXPECT_EQ(said(all, "18446744073709551616"),
            "found 18446744073709551616, expected a whole number of at least 0, below 2^64");
  const CLI::Validator negative = wholeNumber(-3, 3);
  EXPECT_EQ(said(negative, "-3"), "");
  EXPECT_NE(said(negative, "-4"), "");
}

TEST(Number, HasItsRangeAndIsFinite) {
  const CLI::Validator above = number(NumberRange::above(0));
  for (const char* good : {"1", "+1", ".5", "1e-300", "1e300"}) EXPECT_EQ(said(above, good), "") << good;
  for (const char* bad : {"0", "-1", "nan", "inf", "1e999", "", "x", "1,5", "1 "}) {
    EXPECT_EQ(said(above, bad), std::string("found ") + bad + ", expected a finite number above 0");
  }
  EXPECT_EQ(said(number(NumberRange::between(0, 1)), "2"), "found 2, expected a number from 0 to 1");
  EXPECT_EQ(said(number(NumberRange::between(0, 1)), "1"), "");
  EXPECT_EQ(said(number(NumberRange::atLeast(0)), "-1"), "found -1, expected a finite number of at least 0");
  EXPECT_EQ(said(number(NumberRange::any()), "inf"), "found inf, expected a finite number");
  EXPECT_EQ(NumberRange({.least = 0, .most = 2, .excludesLeast = true}).describe(),
            "a number above 0, at most 2");
}

TEST(OneOf, TakesItsWordsInAnyLettersAndListsThem) {
  enum class Kind { Plain, Packed };
  const CLI::Validator check =
      oneOf(std::map<std::string, Kind>{{"plain", Kind::Plain}, {"packed", Kind::Packed}});
  std::string text = "Packed";
  EXPECT_EQ(check(text), "");
  EXPECT_EQ(text, "1");
  EXPECT_EQ(said(check, "paked"), "found \"paked\"; did you mean \"packed\"? known: packed, plain");
  for (const char* bad : {"", "0", "1", "plain packed"}) EXPECT_NE(said(check, bad), "") << bad;
  const CLI::Validator words = oneOf({"auto", "none"});
  text = "AUTO";
  EXPECT_EQ(words(text), "");
  EXPECT_EQ(text, "auto");
}

class CommandLine : public testing::Test {
 protected:
  CommandLine() {
    app_.require_subcommand(1);
    CLI::App* convert = app_.add_subcommand("convert", "");
    convert->add_option("--scale", scale_)->check(number(NumberRange::above(0)));
    convert->add_option("--form", form_)->transform(oneOf({"plain", "packed"}));
    convert->add_option("input", input_)->required();
    app_.add_subcommand("info", "");
  }
  int status(const std::vector<std::string>& words) {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    const std::optional<int> answer = parseCommandLine(app_, words);
    out_ = testing::internal::GetCapturedStdout();
    error_ = testing::internal::GetCapturedStderr();
    return answer.value_or(-1);
  }

  CLI::App app_{"does things", "tool"};
  double scale_ = 1;
  std::string input_, form_, out_, error_;
};

TEST_F(CommandLine, GoesOnWhenAllIsWell) {
  EXPECT_EQ(status({"convert", "--scale", "2", "a.exr"}), -1);
  EXPECT_EQ(scale_, 2);
  EXPECT_EQ(input_, "a.exr");
  EXPECT_EQ(out_ + error_, "");
}

TEST_F(CommandLine, HelpAndVersionGoToStandardOutput) {
  EXPECT_EQ(status({"--help"}), 0);
  EXPECT_NE(out_.find("--version"), std::string::npos) << out_;
  EXPECT_EQ(status({"convert", "--help"}), 0);
  EXPECT_NE(out_.find("--scale"), std::string::npos) << out_;
  EXPECT_EQ(status({"--version"}), 0);
  EXPECT_EQ(out_, buildText() + '\n');
  EXPECT_EQ(error_, "");
}

TEST_F(CommandLine, ErrorsBeginWithTheProgramsNameAndTellTheNearest) {
  EXPECT_EQ(status({"convrt", "a.exr"}), 1);
  EXPECT_EQ(error_,
            "tool: error: unknown command \"convrt\"; did you mean \"convert\"? known: convert, info\n"
            "Run 'tool --help' for all options.\n");
  EXPECT_EQ(status({}), 1);
  EXPECT_EQ(error_.substr(0, error_.find('\n')), "tool: error: expected a command; known: convert, info");
  EXPECT_EQ(status({"convert", "--scal", "2", "a.exr"}), 1);
  EXPECT_EQ(error_.find("tool: error: unknown option \"--scal\"; did you mean \"--scale\"?"), 0u) << error_;
  EXPECT_NE(error_.find("Run 'tool convert --help'"), std::string::npos) << error_;
  EXPECT_EQ(status({"convert", "--scale=-2", "a.exr"}), 1);
  EXPECT_EQ(error_.find("tool: error: --scale: found -2, expected a finite number above 0\n"), 0u) << error_;
  EXPECT_EQ(status({"convert"}), 1);
  EXPECT_EQ(error_.find("tool: error: input is required"), 0u) << error_;
  EXPECT_EQ(status({"convert", "a.exr", "b.exr"}), 1);
  EXPECT_EQ(error_.find("tool: error: unexpected argument \"b.exr\"\n"), 0u) << error_;
  EXPECT_EQ(status({"convert", "a.exr", "b.exr", "c.exr"}), 1);
  EXPECT_EQ(error_.find("tool: error: unexpected argument \"b.exr\"\n"), 0u) << error_;
  EXPECT_EQ(status({"convert", "a.exr", "--xyzzy"}), 1);
  EXPECT_EQ(error_.substr(0, error_.find('\n')),
            "tool: error: unknown option \"--xyzzy\"; known: --help, --scale, --form, -h, --version");
  EXPECT_EQ(status({"convert", "--form", "paked", "a.exr"}), 1);
  EXPECT_EQ(
      error_.find("tool: error: --form: found \"paked\"; did you mean \"packed\"? known: packed, plain\n"),
      0u)
      << error_;
  EXPECT_EQ(out_, "");
}

TEST(BuildText, SaysWhichProgramThisIs) {
  const std::string text = buildText();
  EXPECT_EQ(text.find("pbrt-media "), 0u);
  EXPECT_NE(text.find(std::string(commitText())), std::string::npos);
  EXPECT_EQ(commitText().find("commit "), 0u);
  EXPECT_TRUE(text.find("GCC ") != std::string::npos || text.find("Clang ") != std::string::npos) << text;
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace pbrtmedia
