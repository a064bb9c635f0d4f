// SPDX-License-Identifier: BSD-2-Clause
// The messages for broken scenes: place and text of each.
#include <gtest/gtest.h>

#include <algorithm>

#include "scene/parse.h"

namespace pbrtmedia {
namespace {

struct Case {
  const char* text;
  const char* message;  ///< "line:column: severity: text", a prefix of the whole
};

/// The first message must be the expected one, and reading must go on behind it.
void check(const Case& c, bool inWorld) {
  const std::string text = inWorld ? "WorldBegin\n" + std::string(c.text) + "\nWorldEnd\n"
                                   : std::string(c.text) + "\nWorldBegin WorldEnd\n";
  const Parsed p = parse(text);
  ASSERT_FALSE(p.diagnostics.all().empty()) << c.text;
  EXPECT_EQ(p.diagnostics.format().rfind("t.pbrt:" + std::string(c.message), 0), 0u)
      << c.text << "\nexpected " << c.message << "\n"
      << p.messages();
  EXPECT_EQ(p.scenes.size(), 1u) << c.text << "\n" << p.messages();

  // What is tolerated is an error of the same words when strict.
  constexpr std::string_view kSuffix = " [an error with --strict]";
  for (const Diagnostic& said : p.diagnostics.all()) {
    if (said.severity == Severity::Error || !said.message.ends_with(kSuffix)) continue;
    const std::string plain = said.message.substr(0, said.message.size() - kSuffix.size());
    const Parsed strict = parse(text, true);
    EXPECT_TRUE(std::any_of(strict.diagnostics.all().begin(), strict.diagnostics.all().end(),
                            [&](const Diagnostic& d) {
                              return d.severity == Severity::Error && d.message == plain + " [--strict]" &&
                                     d.location.toString() == said.location.toString();
                            }))
        << strict.messages();
  }
}

TEST(Messages, OfParameters) {
  const Case cases[] = {
      {R"(Film "image" "int xresolution" 3)",
       R"(1:14: warning: parameter "int xresolution": unknown type "int", left out as in PBRT-v3; did you mean "integer"?)"},
      {R"(Film "image" "flaot scale" 3)",
       R"(1:14: warning: parameter "flaot scale": unknown type "flaot", left out as in PBRT-v3; did you mean "float"? known: )"},
      {R"(Film "image" "float" 3)", R"(1:14: warning: found "float", expected a parameter "type name")"},
      {R"(Film "image" "" 3)", R"(1:14: warning: found "", expected a parameter "type name")"},
      {R"(Film "image" "float a b" 3)",
       R"(1:14: warning: parameter "float a b": found "b" after the name, which PBRT-v3 ignores)"},
      {R"(Film "image" "float scale" 1.5abc)",
       R"(1:28: warning: found 1.5abc where a number is expected: the "abc" behind it is ignored, as in PBRT-v3)"},
      {R"(Film "image" "float scale" [1,2])",
       R"(1:29: warning: found 1,2 where a number is expected: as in PBRT-v3 only its beginning is read, and ",2" is lost; sep)"},
      {R"(Film "image" "float scale" 5#x)",
       R"(1:28: warning: found 5#x where a number is expected: the "#x" behind it is ignored, as in PBRT-v3; a comment needs a)"},
      {R"(Film "image" "float scale" inf)",
       R"(1:28: warning: parameter "float scale": found inf, expected a finite number; it is infinite in PBRT-v3, the)"},
      {R"(Film "image" "float scale" -NaN)",
       R"(1:28: error: parameter "float scale": found -NaN, expected a finite number)"},
      {R"(Film "image" "float scale" 0x10)",
       R"(1:28: warning: found 0x10, a hexadecimal number, read as PBRT-v3 reads it)"},
      {R"(Film "image" "float scale" 1e39)",
       R"(1:28: warning: parameter "float scale": found 1e39, expected a finite number; it is infinite in PBRT-v3, the)"},
      {R"(Film "image" "integer n" 3000000000)",
       R"(1:26: error: parameter "integer n": found 3000000000, which is too large)"},
      {R"(Film "image" "integer n" 1.5)",
       R"(1:26: warning: found 1.5 where a whole number is expected: the fraction is cut off)"},
      {R"(Film "image" "bool b" true)",
       R"(1:23: error: parameter "bool b": found true, expected "true" or "false" with quotes)"},
      {R"(Film "image" "bool b" "True")",
       R"(1:23: warning: parameter "bool b": found "True", expected "true" or "false")"},
      {R"(Film "image" "float x" "3")",
       R"(1:24: warning: parameter "float x": found "3", expected a number)"},
      {R"(Film "image" "string s" 3)",
       R"(1:25: warning: parameter "string s": found 3, expected a quoted string)"},
      {R"(Film "image" "string s" [foo])",
       R"(1:26: error: parameter "string s": found foo, expected a quoted string)"},
      {R"(Film "image" "texture t" ["a" "b"])",
       R"(1:27: warning: parameter "texture t": found 2 names, expected one)"},
      {R"(Film "image" "texture t" [])",
       R"(1:26: warning: parameter "texture t": found 0 names, expected one)"},
      {R"(Film "image" "float x" [1 "a"])", R"(1:27: error: parameter "float x": found "a" among numbers)"},
      {R"(Film "image" "string x" ["a" 1])", R"(1:30: error: parameter "string x": found 1 among strings)"},
      {R"(Film "image" "float x" [1 [2]])", R"(1:27: error: parameter "float x": found [ among numbers)"},
      {"Film \"image\" \"float x\" [1 2\nSampler \"halton\"",
       R"(2:1: error: parameter "float x": found Sampler among numbers; is a ] missing?)"},
      {R"(Film "image" "float x" 1 2)",
       R"(1:26: error: parameter "float x": several values need brackets: [ … ])"},
      {R"(Film "image" "float x" "float y" 3)", R"(1:14: error: parameter "float x": no value follows)"},
      {R"(Film "image" "float x" Sampler "halton")",
       R"(1:24: error: parameter "float x": found the directive Sampler, expected a value)"},
      {R"(Film "image" "float x" ])", R"(1:24: error: parameter "float x": found ], expected a value)"},
      {R"(Film "image" "point P" [1 2 3 4])",
       R"(1:25: warning: parameter "point P": found 4 numbers, expected a multiple of 3)"},
      {R"(Film "image" "spectrum L" [400])",
       R"(1:28: warning: parameter "spectrum L": found 1 numbers, expected a multiple of 2)"},
      {R"(Film "image" "blackbody L" [5000 1 0 1])",
       R"(1:36: warning: parameter "blackbody L": a black body without temperature is black here)"},
      {R"(Film "image" "spectrum L" [400 1 400 2])", R"(1:28: error: parameter "spectrum L": )"},
      {"Film \"image\" \"string s\" \"abc\nSampler \"halton\"",
       "1:25: error: the string has no closing \" on its line\n  Film \"image\" \"string s\" \"abc\n"},
      {R"(Film "image" "string s" "a\pb")", R"(1:27: error: unknown escape \p in a string)"}};
  for (const Case& c : cases) check(c, false);
}

TEST(Messages, OfStatements) {
  const Case cases[] = {
      {R"(Flim "image")", R"(1:1: error: unknown directive Flim; did you mean "Film"? known: )"},
      {R"(film "image")", R"(1:1: error: unknown directive film; did you mean "Film"? known: )"},
      {R"(Option "seed" 3)", "1:1: error: unknown directive Option; PBRT-v4 knows it"},
      {R"(SurfaceIntegrator "path")", "1:1: error: unknown directive SurfaceIntegrator; PBRT-v2 knew it"},
      {"Translate 1 2 3 4", "1:17: error: found 4, expected a directive; is it a number too many?"},
      {"Translate 1 2",
       "2:1: error: Translate: found WorldBegin after 2, expected 3 numbers without brackets"},
      {"Translate [1 2 3]", "1:11: error: Translate: found [, expected 3 numbers without brackets"},
      {"Scale 1 2 x", "1:11: error: Scale: found x after 2, expected 3 numbers"},
      {"Scale 1 2 1e999",
       "1:1: warning: Scale: found a number that is not finite; what stands under it is not seen"},
      {"Transform 1 2 3", "1:11: error: Transform: found 1, expected 16 numbers in brackets"},
      {"ConcatTransform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0]",
       "1:50: error: ConcatTransform: found ] after 15, expected 16 numbers in brackets"},
      {"Transform [1 0 0 0  0 1 0 0  0 0 1 0  0 0 0 1 0]",
       "1:47: error: Transform: found 0 after 16, expected 16 numbers in brackets"},
      {"Film image", "1:6: error: Film: found image, expected a quoted type\n  Film image\n       ^~~~~\n"},
      {"Film", "2:1: error: Film: found WorldBegin, expected a quoted type"},
      {R"("Film")", R"(1:1: error: found "Film", expected a directive)"},
      {"]", "1:1: error: found ], expected a directive"},
      {"ActiveTransform Both", "1:17: error: ActiveTransform: unknown selection Both; known: "},
      {"ActiveTransform Starttime",
       R"(1:17: error: ActiveTransform: unknown selection Starttime; did you mean "StartTime"?)"},
      {R"(ActiveTransform "All")",
       R"(1:17: error: ActiveTransform: found "All", expected All, StartTime or)"},
      {"Rotate 90 0 0 0", "1:1: warning: Rotate: the axis has length 0"},
      {"LookAt 0 0 0  0 0 0  0 1 0", "1:1: warning: LookAt: eye and target coincide"},
      {"LookAt 0 0 0  0 1 0  0 1 0",
       "1:1: warning: LookAt: the up vector is parallel to the view; it is ignored, as in"},
      {"Scale 1 0 1", "1:1: warning: Scale: the matrix has no inverse"},
      {"Transform [0 0 0 0  0 0 0 0  0 0 0 0  0 0 0 0]",
       "1:1: warning: Transform: the matrix has no inverse"},
      {"Scale 1e200 1 1 Scale 1e200 1 1", "1:17: warning: Scale: the transformation exceeds the range"},
      {"TransformTimes 1 0", "1:1: warning: TransformTimes: the end lies before the start"},
      {R"(CoordinateSystem "left" CoordSysTransform "lfet")",
       R"(1:43: warning: unknown coordinate system "lfet": the transformation in force stays, as in PBRT-v3; did you mean "left"? known: left)"},
      {"AttributeBegin",
       "1:1: warning: AttributeBegin belongs between WorldBegin and WorldEnd; PBRT-v3 ignores it"},
      {R"(Shape "sphere")", "1:1: warning: Shape belongs between WorldBegin and WorldEnd"},
      {R"(Include "nowhere.pbrt")", R"(1:9: warning: there is no file "nowhere.pbrt")"},
      {R"(MakeNamedMedium "m")", R"(1:17: warning: MakeNamedMedium "m": expected one "string type")"},
      {R"(MakeNamedMedium "m" "texture type" "x")",
       R"(1:36: warning: MakeNamedMedium "m": expected one "string type")"},
      {R"(MakeNamedMedium "" "string type" "homogeneous")",
       R"(1:17: warning: MakeNamedMedium: the name "" means vacuum)"}};
  for (const Case& c : cases) check(c, false);
}

TEST(Messages, OfTheWorld) {
  const Case cases[] = {
      {R"(Film "image")", "2:1: warning: Film belongs before WorldBegin"},
      {"WorldBegin", "2:1: warning: WorldBegin belongs before WorldBegin"},
      {"AttributeEnd", "2:1: warning: AttributeEnd without AttributeBegin"},
      {"TransformEnd", "2:1: warning: TransformEnd without TransformBegin"},
      {"ObjectEnd", "2:1: warning: ObjectEnd without ObjectBegin"},
      {"AttributeBegin\nTransformBegin\nAttributeEnd",
       "4:1: warning: AttributeEnd: the TransformBegin at t.pbrt:3:1 is still open; expected TransformEnd"},
      {"AttributeBegin\nTransformEnd AttributeEnd",
       "3:1: warning: TransformEnd: the AttributeBegin at t.pbrt:2:1 is still open; expected AttributeEnd"},
      {"ObjectBegin \"o\"\nAttributeBegin\nObjectEnd",
       "4:1: warning: ObjectEnd: the AttributeBegin at t.pbrt:3:1 is still open; expected AttributeEnd"},
      {"AttributeBegin", "2:1: warning: AttributeBegin without AttributeEnd at WorldEnd"},
      {R"(ObjectBegin "o")", "2:1: warning: ObjectBegin without ObjectEnd at WorldEnd"},
      {R"(ObjectInstance "tree")", R"(2:16: warning: unknown object "tree")"},
      {R"(ObjectBegin "tree" ObjectEnd ObjectInstance "tere")",
       R"(2:45: warning: unknown object "tere": left out, as in PBRT-v3; did you mean "tree"? known: tree)"},
      {R"(ObjectBegin "a" ObjectInstance "a" ObjectEnd)",
       R"(2:32: warning: object "a" would contain itself)"},
      {R"(ObjectBegin "a" ObjectBegin "b" ObjectEnd ObjectEnd)",
       R"(2:17: warning: ObjectBegin inside the definition of object "a" begun at t.pbrt:2:1)"},
      {R"(ObjectBegin "a" ObjectEnd ObjectBegin "a" ObjectEnd)",
       R"(2:39: warning: object "a" was defined before at t.pbrt:2:1)"},
      {R"(NamedMaterial "gold")", R"(2:15: warning: unknown material "gold")"},
      {R"(MakeNamedMaterial "gold" "string type" "metal" NamedMaterial "glod")",
       R"(2:62: warning: unknown material "glod": the material in force stays, as in PBRT-v3; did you mean "gold"? known: gold)"},
      {R"(MakeNamedMaterial "m" "rgb Kd" [1 1 1])",
       R"(2:19: warning: MakeNamedMaterial "m": expected one "string type")"},
      {R"(Texture "t" "colour" "constant")",
       R"(2:13: warning: Texture "t": unknown flavour "colour", left out as in PBRT-v3; did you mean "color"? known: )"},
      {R"(Texture "t" "float")",
       "3:1: error: Texture: found WorldEnd, expected a quoted name, flavour and class"},
      {"Texture \"t\" \"float\" \"constant\"\nTexture \"t\" \"float\" \"constant\"",
       R"(3:9: warning: texture "t" was defined before at t.pbrt:2:1)"},
      {R"(MediumInterface "smok" ""  Shape "sphere" MakeNamedMedium "smoke" "string type" "homogeneous")",
       R"(2:17: warning: undefined medium "smok": vacuum is rendered in its place, as in PBRT-v3; did you mean "smoke"? known: smoke)"},
      {"MediumInterface \"m\" \"\"\nShape \"sphere\"\nMakeNamedMedium \"m\" \"string type\" \"homogeneous\"",
       R"(2:17: warning: medium "m" is used at t.pbrt:3:1 but defined only at t.pbrt:4:1)"},
      {"ActiveTransform EndTime Translate 1 0 0\nLightSource \"point\"",
       "3:1: warning: LightSource does not move; the transformation at the start is used"}};
  for (const Case& c : cases) check(c, true);
}

TEST(Messages, AllProblemsAreShownTogether) {
  const Parsed p = parseWorld(
      "Shpae \"sphere\" \"float radius\" 1\nTranslate 1 2\nShape \"sphere\" \"float radius\" x\n"
      "NamedMaterial \"none\"");
  EXPECT_EQ(p.diagnostics.errorCount(), 3u) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), 4u) << p.messages();
  EXPECT_EQ(p.scenes.size(), 1u);
}

TEST(Messages, AfterAnErrorReadingGoesOnAtTheNextDirective) {
  Parsed p = parseWorld("Foo \"a\" [1 2 [ \"x\n Shape \"sphere\"");
  EXPECT_EQ(p.diagnostics.errorCount(), 1u) << p.messages();
  EXPECT_EQ(p.scene().shapes.size(), 1u);
}

TEST(Messages, AnInputWithoutAWorldIsAnError) {
  EXPECT_EQ(parse("Film \"image\"").messages(),
            "error: nothing to render: the input has no WorldBegin … WorldEnd\n");
  EXPECT_EQ(parse("").diagnostics.errorCount(), 1u);
  EXPECT_EQ(parse("\nWorldBegin\nShape \"sphere\"").messages(),
            "t.pbrt:2:1: error: the input ends without the WorldEnd of this WorldBegin\n  WorldBegin\n  "
            "^~~~~~~~~~\n");
}

TEST(Messages, InputThatEndsInAStatementSaysSo) {
  EXPECT_NE(parse("Film").messages().find("t.pbrt:1:5: error: Film: the input ends, expected a quoted type"),
            std::string::npos);
  EXPECT_NE(parse("Film \"image\" \"float x\"").messages().find("the input ends where a value is expected"),
            std::string::npos);
  EXPECT_NE(
      parse("Film \"image\" \"float x\" [1").messages().find("the input ends among numbers; is a ] missing?"),
      std::string::npos);
  EXPECT_NE(parse("Translate 1").messages().find("the input ends after 1, expected 3 numbers"),
            std::string::npos);
}

TEST(Messages, ParsingStopsAfterTooManyErrors) {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += "Foo\nFilm \"image\"\n";
  const Parsed p = parse(text);
  EXPECT_EQ(p.diagnostics.errorCount(), 201u);
  EXPECT_EQ(p.diagnostics.all().back().message, "too many errors; the rest is not read");
}

TEST(Messages, ManyMistakesAmongManyNamesTakeLittleTime) {
  std::string text;
  for (int i = 0; i < 20000; ++i) text += "CoordinateSystem \"c" + std::to_string(i) + "\"\n";
  for (int i = 0; i < 20000; ++i) text += "CoordSysTransform \"d" + std::to_string(i) + "\"\n";
  for (int i = 0; i < 20000; ++i) text += "MediumInterface \"m" + std::to_string(i) + "\" Shape \"s\"\n";
  const Parsed p = parseWorld(text);
  EXPECT_EQ(p.diagnostics.errorCount(), 0u);
  EXPECT_EQ(p.diagnostics.all().size(), Diagnostics::kMaxKept);
}

TEST(Messages, WhatPbrtOnlyComplainsOfIsLeftOutOrReplaced) {
  Parsed p = parse(
      "Shape \"sphere\"\nWorldBegin\nFilm \"image\"\nMediumInterface \"m\" \"\"\nShape \"disk\"\n"
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\"\nCoordSysTransform \"x\"\nWorldEnd");
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), 4u);
  EXPECT_FALSE(p.scene().film.given);
  ASSERT_EQ(p.scene().shapes.size(), 1u);
  EXPECT_EQ(p.scene().shapes[0].media->inside.index, kNone);
}

}  // namespace
}  // namespace pbrtmedia
