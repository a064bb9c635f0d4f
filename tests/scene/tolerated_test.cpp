// SPDX-License-Identifier: BSD-2-Clause
// What becomes of mistakes that PBRT-v3 renders in spite of: its fallback, a warning, an error when strict.
#include <gtest/gtest.h>

#include "scene/description.h"
#include "scene/lexer.h"
#include "scene/parse.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

/// A world that is tolerated with as many warnings, and refused when strict.
Parsed tolerated(std::string_view text, std::size_t warnings) {
  Parsed p = parseWorld(text);
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), warnings) << p.messages();
  for (const Diagnostic& d : p.diagnostics.all()) {
    EXPECT_NE(d.message.find("[an error with --strict]"), std::string::npos) << d.message;
    EXPECT_GT(d.location.line, 0u) << d.message;
  }
  const Parsed strict = parseWorld(text, true);
  EXPECT_EQ(strict.diagnostics.errorCount(), warnings) << strict.messages();
  return p;
}

Vec3d originOf(const SharedTransform& ctm) { return ctm->start.point(Vec3d{}); }

// ---- Blocks: two stacks, as in PBRT-v3 ------------------------------------------------------------------

TEST(Tolerated, AttributeEndBeforeObjectEndClosesBothBlocks) {
  Parsed p = tolerated(
      "AttributeBegin Translate 1 0 0 ObjectBegin \"o\" Translate 0 1 0 Shape \"a\"\nAttributeEnd Shape "
      "\"b\"\n"
      "ObjectEnd\nShape \"c\" ObjectInstance \"o\"",
      2);
  const SceneDescription& s = p.scene();
  ASSERT_EQ(s.shapes.size(), 3u);
  // The object goes on to its ObjectEnd, the transformation is that of each Begin in turn.
  EXPECT_EQ(s.objects.at(0).shapes, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(originOf(s.shapes[0].ctm), Vec3d(1, 1, 0));
  EXPECT_EQ(originOf(s.shapes[1].ctm), Vec3d(1, 0, 0));
  EXPECT_EQ(originOf(s.shapes[2].ctm), Vec3d(0, 0, 0));
  EXPECT_EQ(s.shapes[2].object, kNone);
}

TEST(Tolerated, AttributesAndTransformationsAreRestoredFromStacksOfTheirOwn) {
  Parsed p = tolerated(
      "AttributeBegin\nTranslate 1 0 0 TransformBegin Translate 0 1 0 Material "
      "\"glass\"\nAttributeEnd\nShape \"a\"\n"
      "TransformEnd\nShape \"b\"",
      2);
  const SceneDescription& s = p.scene();
  EXPECT_EQ(originOf(s.shapes.at(0).ctm), Vec3d(1, 0, 0));  // that of TransformBegin
  EXPECT_EQ(s.shapes.at(0).material, kNone);                // those of AttributeBegin
  EXPECT_EQ(originOf(s.shapes.at(1).ctm), Vec3d(0, 0, 0));
}

TEST(Tolerated, TransformEndRestoresTheTransformationOfAnAttributeBegin) {
  Parsed p = parseWorld(
      "AttributeBegin Translate 1 0 0 AttributeBegin Translate 0 1 0 Material \"glass\"\nTransformEnd Shape "
      "\"a\"\n"
      "AttributeEnd Shape \"b\"\nAttributeEnd");
  const SceneDescription& s = p.scene();
  EXPECT_EQ(originOf(s.shapes.at(0).ctm), Vec3d(1, 0, 0));
  EXPECT_EQ(s.shapes.at(0).material, 0);
  EXPECT_EQ(originOf(s.shapes.at(1).ctm), Vec3d(0, 0, 0));
  EXPECT_EQ(s.shapes.at(1).material, kNone);
  // Nothing is left of the transformations for the last: PBRT-v3 reads beyond its stack.
  EXPECT_EQ(p.diagnostics.errorCount(), 1u) << p.messages();
}

TEST(Tolerated, AnEndWithoutBeginIsIgnored) {
  Parsed p = tolerated("Translate 1 0 0\nAttributeEnd\nTransformEnd\nObjectEnd\nShape \"a\"", 3);
  EXPECT_EQ(originOf(p.scene().shapes.at(0).ctm), Vec3d(1, 0, 0));
}

TEST(Tolerated, AnObjectBeginInsideAnotherEndsIt) {
  Parsed p = tolerated(
      "ObjectBegin \"outer\" Shape \"a\"\nObjectBegin \"inner\" Shape \"b\" ObjectEnd\nShape "
      "\"c\"\nObjectEnd\nShape "
      "\"d\"",
      2);
  const SceneDescription& s = p.scene();
  EXPECT_EQ(s.objects.at(0).shapes, (std::vector<std::uint32_t>{0}));
  EXPECT_EQ(s.objects.at(1).shapes, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(s.shapes.at(2).object, kNone);
  EXPECT_EQ(s.shapes.at(3).object, kNone);
}

TEST(Tolerated, ObjectsThatAreUnknownOrWouldContainThemselvesAreLeftOut) {
  Parsed p = tolerated(
      "ObjectBegin \"o\" Shape \"a\"\nObjectInstance \"o\"\nObjectEnd\nObjectInstance \"p\"\nObjectInstance "
      "\"o\"",
      2);
  EXPECT_EQ(p.scene().instances.size(), 1u);
  EXPECT_EQ(p.scene().instances.at(0).parent, kNone);
}

// ---- Transformations ------------------------------------------------------------------------------------

TEST(Tolerated, NothingUnderASingularTransformationIsSeen) {
  Parsed p = tolerated(
      "AttributeBegin Scale 0 0 0 Translate 1 2 3\nShape \"sphere\" ObjectInstance \"o\" LightSource "
      "\"distant\"\n"
      "AttributeBegin Rotate 90 0 0 1 Shape \"trianglemesh\" AttributeEnd AttributeEnd\nShape \"disk\"\n"
      "ObjectBegin \"p\" Shape \"disk\" ObjectEnd Scale 0 1 1\nObjectInstance \"p\"",
      3);  // both scales and the unknown object
  EXPECT_EQ(p.scene().shapes.size(), 2u);
  EXPECT_TRUE(p.scene().lights.empty());
  EXPECT_TRUE(p.scene().instances.empty());
}

TEST(Tolerated, MeshesPressedFlatAreSeenQuadricsAreNot) {
  Parsed p = tolerated(
      "AttributeBegin Rotate 30 1 1 0 Scale 1 0 2\nShape \"trianglemesh\" Shape \"plymesh\" Shape "
      "\"loopsubdiv\"\n"
      "Shape \"sphere\" Shape \"disk\" AttributeEnd\nScale 0 0 1 Shape \"trianglemesh\"",
      2);
  EXPECT_EQ(p.scene().shapes.size(), 3u);
}

TEST(Tolerated, IdentityAndTransformLeaveASingularSpace) {
  Parsed p = tolerated(
      "Scale 0 0 0\nIdentity Shape \"a\" Scale 0 1 1\nTransform [1 0 0 0 0 1 0 0 0 0 1 0 5 6 7 1] Shape "
      "\"b\"",
      2);
  ASSERT_EQ(p.scene().shapes.size(), 2u);
  EXPECT_EQ(originOf(p.scene().shapes[1].ctm), Vec3d(5, 6, 7));
}

TEST(Tolerated, APointLightNeedsThePlaceAlone) {
  Parsed p = tolerated("Translate 1 2 3 Scale 0 0 0\nLightSource \"point\" LightSource \"spot\"", 1);
  ASSERT_EQ(p.scene().lights.size(), 1u);
  EXPECT_EQ(originOf(p.scene().lights[0].ctm), Vec3d(1, 2, 3));
  EXPECT_FALSE(p.scene().lights[0].ctm->start.isSingular());
}

TEST(Tolerated, AMediumInASingularSpaceIsVacuumUnlessItHasNoPlace) {
  Parsed p = tolerated(
      "AttributeBegin Scale 1 1 0\nMakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      "MakeNamedMedium \"smoke\" \"string type\" \"heterogeneous\" AttributeEnd\n"
      "MediumInterface \"smoke\" \"fog\" Shape \"sphere\"",
      1);
  EXPECT_EQ(p.scene().media.size(), 1u);
  EXPECT_EQ(p.scene().shapes.at(0).media->inside.index, kNone);
  EXPECT_EQ(p.scene().shapes.at(0).media->outside.index, 0);
}

TEST(Tolerated, NumbersThatAreNoneHideWhatFollows) {
  for (const char* text :
       {"Translate nan 0 0", "Scale inf 1 1", "Rotate 90 0 0 -nan", "LookAt 0 0 nan 0 0 0 0 1 0",
        "Scale 1e999 1 1", "ConcatTransform [1 0 0 0 0 1 0 0 0 0 1 0 nan nan nan 1]",
        "Transform [inf 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1]"}) {
    Parsed p = tolerated("AttributeBegin " + std::string(text) +
                             "\nShape \"a\" Shape \"trianglemesh\" AttributeEnd Shape \"b\"",
                         1);
    ASSERT_EQ(p.scene().shapes.size(), 1u) << text;
    EXPECT_EQ(p.scene().shapes[0].type, "b") << text;
  }
  EXPECT_TRUE(parse("TransformTimes 0 nan WorldBegin WorldEnd").diagnostics.hasErrors());
}

TEST(Tolerated, RotationsAndViewsWithoutDirectionAreLeftOut) {
  Parsed p = tolerated(
      "Translate 1 2 3 Rotate 90 0 0 0\nLookAt 1 1 1 1 1 1 0 1 0\nLookAt 0 0 0 0 1 0 0 1 0\nLookAt 0 0 0 0 0 "
      "1 0 0 0\nShape "
      "\"a\"",
      4);
  EXPECT_EQ(originOf(p.scene().shapes.at(0).ctm), Vec3d(1, 2, 3));
  EXPECT_EQ(p.scene().shapes.at(0).ctm->start.vector(Vec3d(1, 0, 0)), Vec3d(1, 0, 0));
}

TEST(Tolerated, TimesThatRunBackwardsAreAJump) {
  Parsed p = parse("TransformTimes 1 0\nWorldBegin WorldEnd");
  EXPECT_FALSE(p.diagnostics.hasErrors());
  EXPECT_EQ(p.scene().transformStartTime, 1);
  EXPECT_EQ(p.scene().transformEndTime, 1);
  EXPECT_TRUE(parse("TransformTimes 1 0\nWorldBegin WorldEnd", true).diagnostics.hasErrors());
}

TEST(Tolerated, CommasBehindTheNumbersOfTransformationsAreSaidOnce) {
  Parsed p = tolerated("LookAt 0, 0, -4,  0, 0, 0,  0, 1, 0\nTranslate 1, 2, 3f Shape \"a\"", 2);
  EXPECT_EQ(originOf(p.scene().shapes.at(0).ctm), Vec3d(1, 2, 7));
}

// ---- Names ----------------------------------------------------------------------------------------------

TEST(Tolerated, AnUnknownMaterialLeavesTheOneInForce) {
  Parsed p = tolerated(
      "Material \"glass\" AttributeBegin NamedMaterial \"later\" Shape \"a\" AttributeEnd\n"
      "MakeNamedMaterial \"later\" \"string type\" \"metal\" NamedMaterial \"later\" Shape \"b\"",
      1);
  EXPECT_EQ(p.scene().shapes.at(0).material, 0);
  EXPECT_EQ(p.scene().shapes.at(1).material, 1);
}

TEST(Tolerated, AMaterialWithoutTypeIsNone) {
  Parsed p =
      tolerated("MakeNamedMaterial \"m\" \"string type\" [\"a\" \"b\"]\nNamedMaterial \"m\" Shape \"a\"", 1);
  EXPECT_TRUE(p.scene().materials.at(0).isNone());
  EXPECT_EQ(p.scene().shapes.at(0).material, 0);
}

TEST(Tolerated, UndefinedMediaAndThoseWithoutTypeAreVacuum) {
  Parsed p = tolerated(
      "MakeNamedMedium \"typeless\" \"float g\" .5\nMediumInterface \"typeless\" \"nowhere\" Shape \"a\" "
      "Shape \"b\"",
      2);
  EXPECT_EQ(p.scene().shapes.at(0).media->inside.index, kNone);
  EXPECT_EQ(p.scene().shapes.at(0).media->outside.index, kNone);
  EXPECT_TRUE(p.scene().media.empty());
}

TEST(Tolerated, ATextureOfUnknownFlavourIsNotDefined) {
  Parsed p = tolerated("Texture \"t\" \"colour\" \"constant\"\nShape \"a\"", 1);
  EXPECT_TRUE(p.scene().textures.empty());
}

// ---- Ends of the input ----------------------------------------------------------------------------------

TEST(Tolerated, WhatIsBehindTheLastWorldIsNotNeeded) {
  Parsed p = parse("WorldBegin Shape \"a\" WorldEnd\n% end of file\nShape \"b\" \"float x");
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), 1u);
  EXPECT_EQ(p.scenes.size(), 1u);
  EXPECT_TRUE(parse("WorldBegin WorldEnd\n% end\n", true).diagnostics.hasErrors());
  // With another world behind it the mistake is one.
  Parsed two = parse("WorldBegin Shape \"a\" WorldEnd\n% end of file\nWorldBegin WorldEnd");
  EXPECT_EQ(two.diagnostics.errorCount(), 1u);
  EXPECT_EQ(two.scenes.size(), 2u);
}

TEST(Tolerated, AnUnfinishedWorldBehindAnotherIsLeftOut) {
  Parsed p = parse("WorldBegin Shape \"a\" WorldEnd\nWorldBegin Shape \"b\"");
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_EQ(p.scenes.size(), 1u);
}

// ---- Quotes ---------------------------------------------------------------------------------------------

TEST(MissingQuote, IsNamedWhereItBelongs) {
  struct Case {
    const char* line;
    const char* message;
  };
  const Case cases[] = {
      {R"(Shape "sphere" "float radius 2 "float zmin" -1)", "2:29: error: a \" is missing here"},
      {R"(Shape "sphere "float radius" 2)", "2:14: error: a \" is missing here"},
      {R"(Shape "sphere" float radius" 2)", "2:16: error: a \" is missing here: float radius\" has only"},
      {R"(Shape sphere" "float radius" 2)", "2:7: error: a \" is missing here: sphere\" has only"},
      {R"(NamedMaterial gold")", "2:15: error: a \" is missing here: gold\" has only"},
      {R"(Shape "sphere" "float radius 2)", "2:16: error: the string has no closing \" on its line"},
      {R"(Shape "sphere)", "2:7: error: the string has no closing \" on its line"},
      {R"(Texture "t "float" "constant")", "2:11: error: a \" is missing here"},
      {R"(Shape "sphere" "string s "abc")", "2:25: error: a \" is missing here"}};
  for (const Case& c : cases) {
    const Parsed p = parseWorld(std::string(c.line) + "\nShape \"disk\"");
    EXPECT_EQ(p.diagnostics.errorCount(), 1u) << c.line << "\n" << p.messages();
    EXPECT_NE(p.messages().find("t.pbrt:" + std::string(c.message)), std::string::npos) << c.line << "\n"
                                                                                        << p.messages();
  }
}

TEST(MissingQuote, PairsAreNotSuspected) {
  EXPECT_FALSE(findMissingQuote(R"(Shape"sphere""float radius"2 # it's "one)"));
  EXPECT_FALSE(findMissingQuote(R"("a \" b" "c")"));
  EXPECT_FALSE(findMissingQuote(""));
  // A line of many megabytes is not searched again and again.
  std::string line = "Film \"image\" ";
  for (int i = 0; i < 200000; ++i)
    line += "\"foo x" + std::to_string(i % 4000) + "\" 1 " + (i % 4000 == 3999 ? "Film \"image\" " : "");
  EXPECT_FALSE(parse(line + "\nWorldBegin WorldEnd").diagnostics.hasErrors());
  EXPECT_NE(parseWorld("Shpae \"sphere\"").messages().find("unknown directive Shpae"), std::string::npos);
}

}  // namespace
}  // namespace pbrtmedia
