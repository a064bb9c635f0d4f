// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_reader.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/parse.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

/// A reader over the parameters of one Film directive.
struct Fixture {
  Parsed parsed;
  Diagnostics diagnostics;
  ParamReader reader;
  explicit Fixture(std::string_view params, bool strict = false)
      : parsed(parse("Film \"image\"\n" + std::string(params) + "\nWorldBegin WorldEnd")),
        reader(parsed.scene().film, diagnostics, "Film \"image\"") {
    EXPECT_EQ(parsed.messages(), "");
    diagnostics.strict = strict;
  }
};

TEST(ParamReader, FindsScalarsOfEveryKindAndFallsBack) {
  Fixture f(R"("float f" 2 "integer i" 3 "bool b" "true" "string s" "x"
               "point3 P" [1 2 3] "vector V" [4 5 6] "rgb c" [1 2 3] "texture t" "wood")");
  ParamReader& r = f.reader;
  EXPECT_EQ(r.findFloat("f", 0), 2);
  EXPECT_EQ(r.findInt("i", 0), 3);
  EXPECT_TRUE(r.findBool("b", false));
  EXPECT_EQ(r.findString("s", ""), "x");
  EXPECT_EQ(r.findPoint3("P", {}), Point3f(1, 2, 3));
  EXPECT_EQ(r.findVector3("V", {}), Vector3f(4, 5, 6));
  EXPECT_EQ(r.findSpectrum("c", Rgb(0)), Rgb(1, 2, 3));
  EXPECT_EQ(r.findTextureName("t"), "wood");
  EXPECT_EQ(r.findFloat("none", 7), 7);
  EXPECT_EQ(r.optionalInt("none"), std::nullopt);
  EXPECT_EQ(r.findSpectrum("none", Rgb(2)), Rgb(2));
  EXPECT_EQ(r.findTextureName("none"), std::nullopt);
  r.reportUnused();
  EXPECT_EQ(f.diagnostics.format(), "");
}

TEST(ParamReader, AScalarNeedsExactlyOneElement) {
  Fixture f(R"("float fov" [40 50] "float none" [])");
  EXPECT_EQ(f.reader.findFloat("fov", 90), 90);
  EXPECT_EQ(f.reader.findFloat("none", 1), 1);
  EXPECT_EQ(f.diagnostics.errorCount(), 0u);
  ASSERT_EQ(f.diagnostics.all().size(), 2u);
  EXPECT_EQ(
      f.diagnostics.all()[0].message,
      "Film \"image\": parameter \"fov\": found 2 values, expected 1; it is ignored, as in PBRT-v3 [an error "
      "with --strict]");
  EXPECT_EQ(f.diagnostics.all()[0].location.toString(), "t.pbrt:2:14");
  Fixture strict(R"("float fov" [40 50])", true);
  EXPECT_EQ(strict.reader.findFloat("fov", 90), 90);
  EXPECT_EQ(strict.diagnostics.errorCount(), 1u);
}

TEST(ParamReader, NumbersOutOfRangeAreErrorsWithTheRange) {
  Fixture f(R"("float r" -1 "integer n" 0 "rgb c" [0 2 0])");
  EXPECT_EQ(f.reader.findFloat("r", 5, Range::positive()), 5);
  EXPECT_EQ(f.reader.findInt("n", 4, Range::atLeast(1)), 4);
  EXPECT_EQ(f.reader.findSpectrum("c", Rgb(0.5f), Range::closed(0, 1)), Rgb(0.5f));
  ASSERT_EQ(f.diagnostics.errorCount(), 3u);
  EXPECT_EQ(f.diagnostics.all()[0].message, "Film \"image\": parameter \"r\": found -1, expected > 0");
  EXPECT_EQ(f.diagnostics.all()[1].message, "Film \"image\": parameter \"n\": found 0, expected >= 1");
  EXPECT_EQ(f.diagnostics.all()[2].message,
            "Film \"image\": parameter \"c\": found RGB (0, 2, 0), expected each in [0, 1]");
  EXPECT_EQ(Range::open(-1, 1).toString(), "in (-1, 1)");
  EXPECT_FALSE(Range::open(-1, 1).contains(1));
  EXPECT_TRUE(Range::closed(-1, 1).contains(1));
  EXPECT_FALSE(Range{}.contains(NAN));
}

TEST(ParamReader, TakesLargeArraysWithoutACopy) {
  Fixture f(R"("float density" [1 2 3] "point P" [1 2 3 4 5 6] "integer indices" [0 1 2])");
  const float* const data = f.reader.floats("density").data();
  const std::vector<float> taken = f.reader.takeFloats("density");
  EXPECT_EQ(taken.data(), data);
  EXPECT_EQ(taken, (std::vector<float>{1, 2, 3}));
  EXPECT_TRUE(f.reader.takeFloats("density").empty());
  EXPECT_EQ(f.reader.takePoint3s("P").size(), 2u);
  EXPECT_EQ(f.reader.takeInts("indices").size(), 3u);
  EXPECT_TRUE(f.reader.takeNormals("N").empty());
  f.reader.reportUnused();
  EXPECT_EQ(f.diagnostics.format(), "");
}

TEST(ParamReader, UnusedParametersAreReportedWithTheNearestNames) {
  Fixture f("\"integer pixelsample\" 4\n\"float jitter\" 1\n\"bool jitter\" \"true\"");
  f.reader.findInt("pixelsamples", 16);
  f.reader.findBool("jitter", true);
  f.reader.reportUnused();
  ASSERT_EQ(f.diagnostics.all().size(), 2u);
  EXPECT_EQ(f.diagnostics.all()[0].message,
            "Film \"image\": unknown parameter \"pixelsample\"; did you mean \"pixelsamples\"? known: "
            "pixelsamples, jitter [an error with --strict]");
  EXPECT_EQ(f.diagnostics.all()[0].location.toString(), "t.pbrt:2:1");
  EXPECT_EQ(f.diagnostics.all()[1].message,
            "Film \"image\": parameter \"jitter\": found type float, expected bool; it is ignored, as in "
            "PBRT-v3 [an "
            "error with --strict]");
}

TEST(ParamReader, AWrongKindNamesAllKindsThatWereAskedFor) {
  Fixture f(R"("rgb alpha" [1 1 1])");
  f.reader.findTextureName("alpha");
  f.reader.findFloat("alpha", 1);
  f.reader.reportUnused();
  EXPECT_EQ(
      f.diagnostics.all().at(0).message,
      "Film \"image\": parameter \"alpha\": found type rgb, expected texture or float; it is ignored, as in "
      "PBRT-v3 [an error with --strict]");
}

TEST(ParamReader, StrictMakesUnusedParametersErrors) {
  Fixture f(R"("float nothing" 1)", true);
  f.reader.reportUnused();
  EXPECT_TRUE(f.diagnostics.hasErrors());
  EXPECT_EQ(f.diagnostics.all().at(0).message,
            "Film \"image\": unknown parameter \"nothing\"; no parameters are known here [--strict]");
}

TEST(ParamReader, ChoicesListWhatIsKnown) {
  constexpr std::string_view kWrap[] = {"repeat", "black", "clamp"};
  Fixture f(R"("string wrap" "blakc")");
  EXPECT_EQ(f.reader.findChoice("wrap", kWrap, 2), 2u);
  EXPECT_FALSE(f.diagnostics.hasErrors());
  EXPECT_EQ(f.diagnostics.all().at(0).message,
            "Film \"image\": unknown wrap \"blakc\"; did you mean \"black\"? known: black, clamp, repeat; "
            "\"clamp\" is "
            "taken, as in PBRT-v3 [an error with --strict]");
  Fixture good(R"("string wrap" "black")");
  EXPECT_EQ(good.reader.findChoice("wrap", kWrap, 0), 1u);
  EXPECT_EQ(good.reader.findChoice("other", kWrap, 0), 0u);
}

TEST(ParamReader, NothingIsTakenInTheWayOfAParameterOfOurOwn) {
  constexpr const char* kNothing = "; PBRT-v3 has no such parameter, and nothing is taken in its place";
  struct Case {
    const char* text;
    const char* found;  ///< behind the name
  };
  const Case cases[] = {{R"("string ours" [ "a" "b" ])", "found 2 values, expected 1"},
                        {R"("string ours" [])", "found no value"},
                        {R"("float ours" 3)", "found type float, expected string"},
                        {R"("texture ours" "t")", "found type texture, expected string"},
                        {R"("string ours" 3)", "found 3, expected a quoted string"},
                        {R"("str ours" "a")", "unknown type \"str\""},
                        {R"("string ours thing" "a")", "found \"thing\" after the name"}};
  for (const Case& c : cases) {
    for (const bool strict : {false, true}) {
      Parsed parsed = parse("Film \"image\"\n" + std::string(c.text) + "\nWorldBegin WorldEnd", strict);
      const bool isToldInText = !parsed.diagnostics.all().empty();
      EXPECT_EQ(parsed.diagnostics.hasErrors(), strict && isToldInText) << c.text;
      Diagnostics diagnostics;
      diagnostics.strict = strict;
      ParamReader r(parsed.scene().film, diagnostics, "Film \"image\"");
      r.setPbrtNames({"theirs"});
      r.optionalString("ours");
      r.reportUnused();
      if (strict && isToldInText) {  // once is enough
        EXPECT_EQ(diagnostics.format(), "") << c.text;
        continue;
      }
      ASSERT_EQ(diagnostics.errorCount(), 1u) << c.text << diagnostics.format();
      EXPECT_EQ(diagnostics.all().size(), 1u);
      const std::string message = diagnostics.all()[0].message;
      const std::string expected = "Film \"image\": parameter \"ours\": " + std::string(c.found);
      EXPECT_TRUE(message == expected || message == expected + kNothing) << message;
    }
  }
}

TEST(ParamReader, WhatIsNotOurOwnOrNotAskedForStaysAWarning) {
  Fixture f(R"("float theirs" 3 "string theirs2" [ "a" "b" ] "float elsewhere" 1 "string ours" "a")");
  f.reader.setPbrtNames({"theirs", "theirs2"});
  f.reader.findInt("theirs", 1);
  f.reader.findString("theirs2", "");
  EXPECT_EQ(f.reader.optionalString("ours"), "a");
  EXPECT_EQ(f.reader.optionalString("none"), std::nullopt);
  f.reader.reportUnused();
  EXPECT_FALSE(f.diagnostics.hasErrors()) << f.diagnostics.format();
  EXPECT_EQ(f.diagnostics.all().size(), 3u);
}

TEST(ParamReader, NumbersOfOurOwnAreTakenAsTheyAreWritten) {
  for (const char* text :
       {R"("integer n" 2.5)", R"("float x" inf)", R"("point P" [1 2 3 4])", R"("bool b" "yes")",
        R"("blackbody c" [0 1])", R"("spectrum c" "none.spd")", R"("texture t" ["a" "b"])"}) {
    Parsed parsed = parse("Film \"image\"\n" + std::string(text) + "\nWorldBegin WorldEnd");
    EXPECT_FALSE(parsed.diagnostics.hasErrors()) << parsed.messages();
    EXPECT_EQ(parsed.diagnostics.all().size(), 1u) << parsed.messages();
    for (const bool isOurs : {false, true}) {
      Diagnostics diagnostics;
      ParamReader r(parsed.scene().film, diagnostics, "Film \"image\"");
      if (isOurs) r.setPbrtNames({});
      r.findInt("n", 1);
      r.findFloat("x", 1);
      r.findPoint3("P", {});
      r.findBool("b", true);
      r.findSpectrum("c", Rgb(1));
      r.findTextureName("t");
      r.reportUnused();
      EXPECT_EQ(diagnostics.errorCount(), isOurs ? 1u : 0u) << text << diagnostics.format();
    }
  }
}

TEST(ParamReader, InputFilesAreLookedForWithTheSceneFirst) {
  const TemporaryFolder folder;
  folder.write("scene/main.pbrt", "Include \"sub/inc.pbrt\" WorldBegin WorldEnd");
  folder.write(
      "scene/sub/inc.pbrt",
      "Film \"image\" \"string a\" \"both.txt\" \"string b\" \"near.txt\" \"string c\" \"none.txt\"");
  folder.write("scene/both.txt", "");
  folder.write("scene/sub/both.txt", "");
  folder.write("scene/sub/near.txt", "");
  Diagnostics d;
  const std::filesystem::path files[] = {folder.path() / "scene/main.pbrt"};
  auto scenes = parseFiles(files, d);
  ASSERT_EQ(scenes.size(), 1u) << d.format();
  EXPECT_FALSE(d.hasErrors());
  Diagnostics found;
  ParamReader r(scenes[0].film, found, "Film \"image\"");
  EXPECT_EQ(r.findInputFile("a"), folder.path() / "scene/both.txt");
  EXPECT_EQ(r.findInputFile("b"), folder.path() / "scene/sub/near.txt");
  EXPECT_EQ(r.findInputFile("c"), std::nullopt);
  EXPECT_EQ(r.findInputFile("absent"), std::nullopt);
  ASSERT_EQ(found.all().size(), 2u);
  EXPECT_EQ(found.all()[0].severity, Severity::Warning);
  EXPECT_NE(found.all()[1].message.find("there is no file \"" + (folder.path() / "scene/none.txt").string()),
            std::string::npos);
}

TEST(ParamReader, ErrorsStandAtTheParameterOrTheDirective) {
  Fixture f("\"float x\" 3");
  f.reader.error(ParamKind::Float, "x", "is odd");
  f.reader.error(ParamKind::Float, "y", "is missing");
  f.reader.error("is wrong");
  EXPECT_EQ(f.diagnostics.all()[0].location.toString(), "t.pbrt:2:11");
  EXPECT_EQ(f.diagnostics.all()[0].message, "Film \"image\": parameter \"x\": is odd");
  EXPECT_EQ(f.diagnostics.all()[1].location.toString(), "t.pbrt:1:1");
  EXPECT_EQ(f.diagnostics.all()[2].message, "Film \"image\": is wrong");
}

}  // namespace
}  // namespace pbrtmedia
