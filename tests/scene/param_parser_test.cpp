// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_parser.h"

#include <gtest/gtest.h>

#include <limits>

#include "scene/parse.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

/// The parameters of a Film directive.
struct Read {
  Parsed parsed;
  const ParamList& list() { return parsed.scene().film.params; }
  template <class T>
  const std::vector<T>& values(ParamKind kind, std::string_view name) {
    static const std::vector<T> kNothing;
    const Param* const p = list().find(kind, name);
    return p ? std::get<std::vector<T>>(p->values) : kNothing;
  }
};
Read read(std::string_view params, bool strict = false) {
  return {parse("Film \"image\" " + std::string(params) + "\nWorldBegin WorldEnd", strict)};
}

TEST(ParamParser, ReadsEveryKind) {
  Read r = read(
      R"("integer i" [1 -2] "float f" [.5 1e-2] "bool b" ["true" "false"] "point2 p2" [1 2 3 4] "vector2 v2" [5 6]
         "point p" [1 2 3] "point3 q" [4 5 6] "vector v" [7 8 9] "vector3 w" [1 0 0] "normal n" [0 1 0]
         "string s" ["a b" ""] "texture t" "name")");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.values<int>(ParamKind::Integer, "i"), (std::vector<int>{1, -2}));
  EXPECT_EQ(r.values<float>(ParamKind::Float, "f"), (std::vector<float>{.5f, 1e-2f}));
  EXPECT_EQ(r.values<std::uint8_t>(ParamKind::Bool, "b"), (std::vector<std::uint8_t>{1, 0}));
  EXPECT_EQ(r.values<Point2f>(ParamKind::Point2, "p2"), (std::vector<Point2f>{{1, 2}, {3, 4}}));
  EXPECT_EQ(r.values<Point2f>(ParamKind::Vector2, "v2"), (std::vector<Point2f>{{5, 6}}));
  EXPECT_EQ(r.values<Point3f>(ParamKind::Point3, "p"), (std::vector<Point3f>{{1, 2, 3}}));
  EXPECT_EQ(r.values<Point3f>(ParamKind::Point3, "q"), (std::vector<Point3f>{{4, 5, 6}}));
  EXPECT_EQ(r.values<Point3f>(ParamKind::Vector3, "v"), (std::vector<Point3f>{{7, 8, 9}}));
  EXPECT_EQ(r.values<Point3f>(ParamKind::Vector3, "w"), (std::vector<Point3f>{{1, 0, 0}}));
  EXPECT_EQ(r.values<Point3f>(ParamKind::Normal, "n"), (std::vector<Point3f>{{0, 1, 0}}));
  EXPECT_EQ(r.values<std::string>(ParamKind::String, "s"), (std::vector<std::string>{"a b", ""}));
  EXPECT_EQ(r.values<std::string>(ParamKind::Texture, "t"), (std::vector<std::string>{"name"}));
}

void expectNear(Rgb a, Rgb b) {
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], 2e-4f);
}

TEST(ParamParser, ConvertsEverySpectrumForm) {
  Read r = read(
      R"("rgb a" [.1 .2 .3 1 2 3] "color b" [4 5 6] "xyz c" [1 0 0] "blackbody d" [5000 2] "spectrum e" [400 1 700 1])");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.values<Rgb>(ParamKind::Spectrum, "a"), (std::vector<Rgb>{{.1f, .2f, .3f}, {1, 2, 3}}));
  EXPECT_EQ(r.values<Rgb>(ParamKind::Spectrum, "b"), (std::vector<Rgb>{{4, 5, 6}}));
  expectNear(r.values<Rgb>(ParamKind::Spectrum, "c").at(0), {3.240479f, -0.969256f, 0.055648f});
  expectNear(r.values<Rgb>(ParamKind::Spectrum, "d").at(0), 2 * Rgb(1.19001f, 0.94206f, 0.74794f));
  ASSERT_EQ(r.values<Rgb>(ParamKind::Spectrum, "e").size(), 1u);
  expectNear(r.values<Rgb>(ParamKind::Spectrum, "e").at(0), {1.20233f, 0.94622f, 0.90734f});
}

TEST(ParamParser, ReadsSpectrumFiles) {
  const TemporaryFolder folder;
  folder.write("one.spd", "# constant\n400 1\n700 1\n");
  Diagnostics d;
  const auto scenes =
      parseText("Film \"image\" \"spectrum L\" [\"one.spd\" \"one.spd\"]\nWorldBegin WorldEnd", "t.pbrt",
                folder.path(), d);
  EXPECT_EQ(d.format(), "");
  const auto& colours =
      std::get<std::vector<Rgb>>(scenes.at(0).film.params.find(ParamKind::Spectrum, "L")->values);
  ASSERT_EQ(colours.size(), 2u);
  expectNear(colours[1], {1.20233f, 0.94622f, 0.90734f});
}

TEST(ParamParser, SaysWhenASpectrumFileCannotBeUsedOrHasNoFiniteColour) {
  const TemporaryFolder folder;
  folder.write("twice.spd", "400 1\n400 2\n");
  Diagnostics d;
  parseText("Film \"image\" \"spectrum L\" \"twice.spd\"\n\"xyz M\" [3e38 3e38 3e38]\nWorldBegin WorldEnd",
            "t.pbrt", folder.path(), d);
  const std::string out = d.format();
  EXPECT_NE(out.find("t.pbrt:1:27: error: parameter \"spectrum L\": \""), std::string::npos) << out;
  EXPECT_NE(out.find("wavelength 400 nm appears more than once"), std::string::npos) << out;
  EXPECT_NE(out.find("t.pbrt:2:10: error: parameter \"xyz M\": the spectrum has no finite RGB value"),
            std::string::npos)
      << out;
}

TEST(ParamParser, WarnsOfASpectrumFileBesideTheIncluder) {
  const TemporaryFolder folder;
  folder.write("main.pbrt", "Include \"sub/inc.pbrt\" WorldBegin WorldEnd");
  folder.write("sub/inc.pbrt", "Film \"image\" \"spectrum L\" \"near.spd\"");
  folder.write("sub/near.spd", "400 1\n700 1\n");
  Diagnostics d;
  const std::filesystem::path files[] = {folder.path() / "main.pbrt"};
  const auto scenes = parseFiles(files, d);
  EXPECT_FALSE(d.hasErrors()) << d.format();
  EXPECT_NE(d.format().find("PBRT-v3 looks for \"" + (folder.path() / "near.spd").string()),
            std::string::npos)
      << d.format();
  EXPECT_NEAR(
      std::get<std::vector<Rgb>>(scenes.at(0).film.params.find(ParamKind::Spectrum, "L")->values).at(0).g,
      0.946f, 0.01f);
}

TEST(ParamParser, AMissingSpectrumFileIsBlackAndAnOddOneIsReadAsFarAsItGoes) {
  const TemporaryFolder folder;
  const std::string bad = folder.write("bad.spd", "400, 1\n700 x 1 800").string();
  folder.write("empty.spd", "# nothing\n");
  const std::string text =
      "Film \"image\" \"spectrum L\" \"none.spd\"\n\"spectrum M\" \"bad.spd\"\nWorldBegin WorldEnd";
  Diagnostics d;
  const auto scenes = parseText(text, "t.pbrt", folder.path(), d);
  const std::string out = d.format();
  EXPECT_FALSE(d.hasErrors()) << out;
  EXPECT_NE(out.find("t.pbrt:1:27: warning: parameter \"spectrum L\": there is no file \""),
            std::string::npos)
      << out;
  EXPECT_NE(out.find(bad + ":1:1: warning: expected a finite number, found \"400,\""), std::string::npos)
      << out;
  EXPECT_NE(out.find(bad + ": warning: a spectrum file needs pairs"), std::string::npos) << out;
  const ParamList& list = scenes.at(0).film.params;
  EXPECT_EQ(std::get<std::vector<Rgb>>(list.find(ParamKind::Spectrum, "L")->values).at(0), Rgb(0));
  expectNear(std::get<std::vector<Rgb>>(list.find(ParamKind::Spectrum, "M")->values).at(0),
             {1.20233f, 0.94622f, 0.90734f});

  Diagnostics strict;
  strict.strict = true;
  parseText(text, "t.pbrt", folder.path(), strict);
  EXPECT_EQ(strict.errorCount(), 3u) << strict.format();

  Diagnostics nothing;
  parseText("Film \"image\"\n\"spectrum M\" \"empty.spd\"\nWorldBegin WorldEnd", "t.pbrt", folder.path(),
            nothing);
  EXPECT_FALSE(nothing.hasErrors()) << nothing.format();
  EXPECT_NE(nothing.format().find("found no numbers; black is taken, as in PBRT-v3"), std::string::npos)
      << nothing.format();
}

TEST(ParamParser, OneValueNeedsNoBrackets) {
  Read r = read(R"("float f" 3 "string s" "x" "integer i" 7 "bool b" "true")");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.values<float>(ParamKind::Float, "f"), (std::vector<float>{3}));
  EXPECT_EQ(r.values<int>(ParamKind::Integer, "i"), (std::vector<int>{7}));
  EXPECT_EQ(r.values<std::string>(ParamKind::String, "s"), (std::vector<std::string>{"x"}));
}

TEST(ParamParser, EmptyListsParse) {
  Read r = read(R"("float f" [] "string s" [ ] "point p" [] "rgb c" [])");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.list().size(), 4u);
  EXPECT_EQ(r.list().find(ParamKind::Point3, "p")->size(), 0u);
  EXPECT_EQ(r.list().find(ParamKind::String, "s")->size(), 0u);
}

TEST(ParamParser, BlanksInADeclarationDoNotMatter) {
  Read r = read("\" \tfloat \t  f  \" 3");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.values<float>(ParamKind::Float, "f"), (std::vector<float>{3}));
}

TEST(ParamParser, OneNameMayStandInSeveralKinds) {
  Read r = read(R"("float Kd" 1 "rgb Kd" [1 2 3] "texture Kd" "t")");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.list().size(), 3u);
}

TEST(ParamParser, TheLastOfTwoEntriesCountsAndTheRepeatIsSaid) {
  Read r = read("\"rgb L\" [1 1 1]\n\"xyz L\" [0 0 0]");
  EXPECT_EQ(r.list().size(), 1u);
  EXPECT_EQ(r.values<Rgb>(ParamKind::Spectrum, "L").at(0), Rgb(0));
  EXPECT_NE(r.parsed.messages().find("t.pbrt:2:1: warning: parameter \"xyz L\": given before"),
            std::string::npos);
  EXPECT_FALSE(r.parsed.diagnostics.hasErrors());
}

TEST(ParamParser, EveryEntryKnowsItsPlaces) {
  Read r = read("\n \"point P\" [1 2 3\n  4 5 6]");
  const Param& p = *r.list().find(ParamKind::Point3, "P");
  EXPECT_EQ(p.declaredAt.toString(), "t.pbrt:2:2");
  EXPECT_EQ(p.declaredAt.length, 9u);
  EXPECT_EQ(p.valuesAt.toString(), "t.pbrt:2:13");
  EXPECT_EQ(p.locationOf(1).toString(), "t.pbrt:3:3");
  EXPECT_EQ(p.locationOf(100).toString(), "t.pbrt:2:13");
}

TEST(ParamParser, LargeArraysAreExactAcrossBlocksCommentsAndLines) {
  // Longer than a block, with comments, line ends and numbers of the slow path in between.
  std::string text = "\"float f\" [\n\"integer i\" [";
  std::vector<float> floats;
  std::vector<int> ints;
  std::string f = "\"float f\" [", i = "\"integer i\" [", p = "\"point P\" [";
  for (int k = 0; k < 20001; ++k) {
    f += std::to_string(k) + ".25" + (k % 7 == 0 ? " # note 5 6\n" : " ");
    floats.push_back(static_cast<float>(k) + .25f);
    i += (k % 5 == 0 ? std::to_string(k) + ".0" : std::to_string(-k)) + (k % 11 == 0 ? "\r\n" : "\t");
    ints.push_back(k % 5 == 0 ? k : -k);
    p += std::to_string(k) + " 1e1 16777217 ";
  }
  Read r = read(f + "] " + i + "] " + p + "]");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.values<float>(ParamKind::Float, "f"), floats);
  EXPECT_EQ(r.values<int>(ParamKind::Integer, "i"), ints);
  const auto& points = r.values<Point3f>(ParamKind::Point3, "P");
  ASSERT_EQ(points.size(), 20001u);
  EXPECT_EQ(points[20000], Point3f(20000, 10, 16777216));
}

TEST(ParamParser, AnErrorFarIntoALargeArrayHasItsExactPlace) {
  std::string text = "Film \"image\" \"float density\" [\n";
  for (int line = 0; line < 3000; ++line) text += line == 2500 ? "0 1 x0.5 1\n" : "0 1 0.5 1\n";
  const Parsed p = parse(text + "]\nWorldBegin WorldEnd");
  EXPECT_EQ(p.messages(),
            "t.pbrt:2502:5: error: parameter \"float density\": found x0.5, expected a number\n  0 1 x0.5 1\n"
            "      ^~~~\n");
}

TEST(ParamParser, WholeNumbersInAnyFormAreIntegers) {
  Read r = read(R"("integer i" [16.0 1e3 -2147483648 2147483647 +4])");
  EXPECT_EQ(r.parsed.messages(), "");
  EXPECT_EQ(r.values<int>(ParamKind::Integer, "i"),
            (std::vector<int>{16, 1000, -2147483647 - 1, 2147483647, 4}));
}

TEST(ParamParser, OddValuesAreTakenAsPbrtTakesThem) {
  Read r = read(R"("integer i" [1.9 -1.9] "bool b" "yes" "point P" [1 2 3 4] "float f x" 2)");
  EXPECT_FALSE(r.parsed.diagnostics.hasErrors());
  EXPECT_EQ(r.values<int>(ParamKind::Integer, "i"), (std::vector<int>{1, -1}));
  EXPECT_EQ(r.values<std::uint8_t>(ParamKind::Bool, "b"), (std::vector<std::uint8_t>{0}));
  EXPECT_EQ(r.values<Point3f>(ParamKind::Point3, "P"), (std::vector<Point3f>{{1, 2, 3}}));
  EXPECT_EQ(r.values<float>(ParamKind::Float, "f"), (std::vector<float>{2}));
  EXPECT_EQ(r.parsed.diagnostics.all().size(), 4u) << r.parsed.messages();  // both fractions in one
}

TEST(ParamParser, NumbersAreReadUpToWhatIsNone) {
  Read r = read(
      R"("rgb L" [.5, .25, 1,] "float f" [0x10 1.5f 2e 5#x -0X1.8p1] "integer i" [1,2 3; 0xff] "rgb one" [1,2,3]
         "float g" 1.5abc)");
  EXPECT_FALSE(r.parsed.diagnostics.hasErrors());
  EXPECT_EQ(r.values<Rgb>(ParamKind::Spectrum, "L"), (std::vector<Rgb>{{.5f, .25f, 1}}));
  EXPECT_EQ(r.values<float>(ParamKind::Float, "f"), (std::vector<float>{16, 1.5f, 2, 5, -3}));
  EXPECT_EQ(r.values<int>(ParamKind::Integer, "i"), (std::vector<int>{1, 3, 255}));
  EXPECT_TRUE(r.values<Rgb>(ParamKind::Spectrum, "one").empty());
  EXPECT_EQ(r.values<float>(ParamKind::Float, "g"), (std::vector<float>{1.5f}));
}

TEST(ParamParser, AMannerOfWritingNumbersIsSaidOnceWithTheirNumber) {
  std::string text = "\"float f\" [\n";
  for (int i = 0; i < 20000; ++i) text += i == 10000 ? "0.5f, " : "0.5, ";
  const Read r = read(text + "]");
  EXPECT_EQ(r.parsed.diagnostics.all().size(), 2u);
  EXPECT_EQ(r.parsed.diagnostics.all()[0].location.toString(), "t.pbrt:2:1");
  EXPECT_EQ(r.parsed.diagnostics.all()[0].message,
            "found 0.5, where a number is expected: the \",\" behind it is ignored, as in PBRT-v3; separate "
            "numbers by "
            "blanks (and 19998 more of this file) [an error with --strict]");
  EXPECT_EQ(r.parsed.diagnostics.all()[1].location.toString(), "t.pbrt:2:50001");
}

TEST(ParamParser, OnlyAFloatAloneMayBeInfinite) {
  Read r = read("\"float a\" inf \"float b\" [-Infinity] \"float c\" 1e39");
  EXPECT_FALSE(r.parsed.diagnostics.hasErrors());
  constexpr float kMost = std::numeric_limits<float>::max();
  EXPECT_EQ(r.values<float>(ParamKind::Float, "a"), (std::vector<float>{kMost}));
  EXPECT_EQ(r.values<float>(ParamKind::Float, "b"), (std::vector<float>{-kMost}));
  EXPECT_EQ(r.values<float>(ParamKind::Float, "c"), (std::vector<float>{kMost}));
  for (const char* bad :
       {"\"float a\" [1 inf]", "\"rgb L\" [inf 0 0]", "\"point P\" [0 0 1e39]", "\"integer i\" inf",
        "\"integer i\" 3000000000", "\"float a\" nan", "\"float a\" -NaN(1)"}) {
    const Read b = read(bad);
    EXPECT_EQ(b.parsed.diagnostics.errorCount(), 1u) << bad << "\n" << b.parsed.messages();
    EXPECT_EQ(b.parsed.messages().find("strict"), std::string::npos) << b.parsed.messages();
  }
}

TEST(ParamParser, ADroppedParameterDoesNotDisturbTheNext) {
  Read r =
      read(R"("foo x" [1 2 3] "foo y" "s" "float bad" ["a" "b"] "string worse" [1 2] "float half" [1 "a" 2]
                  "float open" [1 2 "float good" 3)");
  EXPECT_EQ(r.parsed.diagnostics.errorCount(), 2u) << r.parsed.messages();
  EXPECT_EQ(r.parsed.diagnostics.all().size(), 6u) << r.parsed.messages();
  EXPECT_EQ(r.list().size(), 1u);
  EXPECT_EQ(r.values<float>(ParamKind::Float, "good"), (std::vector<float>{3}));
}

TEST(ParamParser, TooManyParametersAreRefused) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "\"float a" + std::to_string(i) + "\" 1\n";
  const Read r = read(text);
  EXPECT_NE(r.parsed.messages().find("t.pbrt:4097:1: error: more than 4096 parameters"), std::string::npos);
}

}  // namespace
}  // namespace pbrtmedia
