// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/diagnostics.h"
#include "spectrum/spectrum.h"

namespace pbrtmedia {
namespace {

TEST(NumberText, ReadsNumbersBetweenBlanksAndComments) {
  const std::vector<float> expected{400, 0.5f, -1e-3f, 3, 7};
  EXPECT_EQ(parseNumberText("# head\r\n400\t.5 # tail 9 9\n-1e-3 +3#x\n\v7", "a.spd"), expected);
  EXPECT_TRUE(parseNumberText("", "a.spd").empty());
  EXPECT_TRUE(parseNumberText("# nothing", "a.spd").empty());
}

TEST(NumberText, KeepsTheLastNumberWithoutASeparatorAfterIt) {
  EXPECT_EQ(parseNumberText("1 2", "a.spd"), (std::vector<float>{1, 2}));
}

TEST(NumberText, ReadsBothCasesOfTheExponent) {
  EXPECT_EQ(parseNumberText("1e2 1E2", "a.spd"), (std::vector<float>{100, 100}));
}

TEST(NumberText, RoundsTooSmallNumbersToZero) {
  EXPECT_EQ(parseNumberText("1e-60 -1e-400", "a.spd"), (std::vector<float>{0, 0}));
}

void expectFailsAt(std::string_view text, std::uint32_t line, std::uint32_t column, std::uint32_t length) {
  SCOPED_TRACE(std::string(text));
  try {
    parseNumberText(text, "dir/lens.dat");
    FAIL() << "accepted";
  } catch (const SceneError& e) {
    ASSERT_TRUE(e.location().file);
    EXPECT_EQ(*e.location().file, "dir/lens.dat");
    EXPECT_EQ(e.location().line, line);
    EXPECT_EQ(e.location().column, column);
    EXPECT_EQ(e.location().length, length);
  }
}

TEST(NumberText, PointsAtTheFirstThingThatIsNoFiniteNumber) {
  expectFailsAt("400 1\n500 abc 3", 2, 5, 3);
  expectFailsAt("1,2", 1, 1, 3);
  expectFailsAt("nan", 1, 1, 3);
  expectFailsAt("1 inf", 1, 3, 3);
  expectFailsAt("1e39", 1, 1, 4);
  expectFailsAt("\n\n  1e400", 3, 3, 5);
  expectFailsAt("+-1", 1, 1, 3);
  expectFailsAt("-", 1, 1, 1);
  expectFailsAt("0x10", 1, 1, 4);
  expectFailsAt(std::string_view("1 \0 2", 5), 1, 3, 1);
}

TEST(NumberText, TextAmongNumbersMayBeSkippedAndIsSaidOnce) {
  Diagnostics d;
  const std::string_view text = "400, 0.5;\nnm 500 1.5e1x 3e39 abc-2";
  EXPECT_EQ(parseNumberText(text, "a.spd", &d), (std::vector<float>{400, 0.5f, 500, 15, -2}));
  ASSERT_EQ(d.all().size(), 1u) << d.format();
  EXPECT_EQ(d.all()[0].severity, Severity::Warning);
  EXPECT_EQ(d.all()[0].location.toString(), "a.spd:1:1");
  Diagnostics strict;
  strict.strict = true;
  parseNumberText(text, "a.spd", &strict);
  EXPECT_EQ(strict.errorCount(), 1u);
}

TEST(NumberText, ShowsOnlyPrintableTextInMessages) {
  try {
    parseNumberText("\x1b[31m\xff", "a.spd");
    FAIL() << "accepted";
  } catch (const SceneError& e) {
    EXPECT_EQ(std::string(e.what()), "expected a finite number, found \"?[31m?\"");
  }
}

TEST(SpectrumText, PairsWavelengthsWithValues) {
  const std::vector<SpectralSample> s = parseSpectrumText("500 1\n400 0.25\n", "a.spd");
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].wavelength, 500);
  EXPECT_EQ(s[0].value, 1);
  EXPECT_EQ(s[1].wavelength, 400);
  EXPECT_EQ(s[1].value, 0.25f);
}

TEST(SpectrumText, RefusesOddCountsAndEmptyFiles) {
  EXPECT_THROW(parseSpectrumText("400 1 500", "a.spd"), SceneError);
  EXPECT_THROW(parseSpectrumText("# only a comment\n", "a.spd"), SceneError);
}

TEST(SpectrumText, TheLastOfAnOddCountMayBeLeftOut) {
  Diagnostics d;
  EXPECT_EQ(parseSpectrumText("400 1 500", "a.spd", &d).size(), 1u);
  EXPECT_EQ(d.all().size(), 1u);
  EXPECT_THROW(parseSpectrumText("400", "a.spd", &d), SceneError);
  EXPECT_THROW(parseSpectrumText("", "a.spd", &d), SceneError);
  EXPECT_THROW(sampledSpectrumToRgb(parseSpectrumText("400 1 400 2", "a.spd", &d)), std::invalid_argument);
}

TEST(SpectrumFile, IsReadFromDiskAndMissingFilesAreNamed) {
  const std::filesystem::path path = std::filesystem::path(::testing::TempDir()) / "spectrum_file_test.spd";
  std::ofstream(path) << "# test\n400 1\n700 1";
  const std::vector<SpectralSample> s = readSpectrumFile(path);
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[1].wavelength, 700);
  std::filesystem::remove(path);
  try {
    readSpectrumFile(path);
    FAIL() << "read a file that is gone";
  } catch (const SceneError& e) {
    ASSERT_TRUE(e.location().file);
    EXPECT_NE(e.location().file->find("spectrum_file_test.spd"), std::string::npos);
  }
}

}  // namespace
}  // namespace pbrtmedia
