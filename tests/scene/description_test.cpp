// SPDX-License-Identifier: BSD-2-Clause
// What each directive does to the description.
#include "scene/description.h"

#include <gtest/gtest.h>

#include "scene/parse.h"

namespace pbrtmedia {
namespace {

void expectPoint(Vec3d p, Vec3d expected) {
  EXPECT_NEAR(p.x, expected.x, 1e-12);
  EXPECT_NEAR(p.y, expected.y, 1e-12);
  EXPECT_NEAR(p.z, expected.z, 1e-12);
}

/// Parses a world of transforms and one shape; gives the shape's CTM.
TransformPair ctmOf(std::string_view directives) {
  Parsed p = parseWorld(std::string(directives) + " Shape \"sphere\"");
  EXPECT_EQ(p.messages(), "");
  return *p.scene().shapes.at(0).ctm;
}

TEST(Description, OptionsAreStoredAndTheLastWins) {
  Parsed p = parse(
      "Film \"a\"\nFilm \"image\" \"integer xresolution\" 64\nPixelFilter \"box\" Sampler \"halton\"\n"
      "Accelerator \"bvh\" Integrator \"volpath\" TransformTimes 2 3 WorldBegin WorldEnd");
  EXPECT_EQ(p.messages(), "");
  const SceneDescription& s = p.scene();
  EXPECT_TRUE(s.film.given);
  EXPECT_EQ(s.film.type, "image");
  EXPECT_EQ(s.film.location.toString(), "t.pbrt:2:1");
  EXPECT_EQ(s.film.typeLocation.toString(), "t.pbrt:2:6");
  EXPECT_NE(s.film.params.find(ParamKind::Integer, "xresolution"), nullptr);
  EXPECT_EQ(s.filter.type, "box");
  EXPECT_EQ(s.sampler.type, "halton");
  EXPECT_EQ(s.accelerator.type, "bvh");
  EXPECT_EQ(s.integrator.type, "volpath");
  EXPECT_EQ(s.transformStartTime, 2);
  EXPECT_EQ(s.transformEndTime, 3);
  EXPECT_FALSE(s.camera.given);
  EXPECT_TRUE(s.camera.worldFromCamera->start.isIdentity());
}

TEST(Description, TransformsPostMultiply) {
  expectPoint(ctmOf("Translate 1 2 3 Scale 2 2 2").start.point(Vec3d{1, 0, 0}), {3, 2, 3});
  expectPoint(ctmOf("Scale 2 2 2 Translate 1 2 3").start.point(Vec3d{1, 0, 0}), {4, 4, 6});
  expectPoint(ctmOf("Rotate 90 0 0 1").start.point(Vec3d{1, 0, 0}), {0, 1, 0});
  expectPoint(ctmOf("Rotate 90 0 0 1e-300").start.point(Vec3d{1, 0, 0}), {0, 1, 0});
  expectPoint(ctmOf("Translate 1 2 3 Identity").start.point(Vec3d{1, 0, 0}), {1, 0, 0});
}

TEST(Description, MatricesAreColumnMajor) {
  expectPoint(ctmOf("Transform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1]").start.point(Vec3d{0, 0, 0}), {5, 6, 7});
  expectPoint(
      ctmOf("Scale 2 2 2 ConcatTransform [0 1 0 0  -1 0 0 0  0 0 1 0  5 6 7 1]").start.point(Vec3d{1, 0, 0}),
      {10, 14, 14});
  expectPoint(ctmOf("Scale 2 2 2 Transform [1 0 0 0  0 1 0 0  0 0 1 0  5 6 7 1]").start.point(Vec3d{0, 0, 0}),
              {5, 6, 7});
}

TEST(Description, TheCameraStoresTheInverseOfTheCtm) {
  Parsed p = parse("LookAt 1 2 3  1 2 10  0 1 0\nCamera \"perspective\"\nWorldBegin WorldEnd");
  EXPECT_EQ(p.messages(), "");
  const Transform& t = p.scene().camera.worldFromCamera->start;
  expectPoint(t.point(Vec3d{0, 0, 0}), {1, 2, 3});
  expectPoint(t.point(Vec3d{0, 0, 1}), {1, 2, 4});
  expectPoint(t.vector(Vec3d{1, 0, 0}), {1, 0, 0});  // left-handed: x to the right with y up and z forward
}

TEST(Description, NamedCoordinateSystems) {
  Parsed p = parse(
      "Translate -5 0 0 Camera \"perspective\" CoordinateSystem \"mine\" WorldBegin\n"
      "Shape \"a\" CoordSysTransform \"camera\" Shape \"b\" CoordSysTransform \"world\" Shape \"c\"\n"
      "CoordSysTransform \"mine\" Shape \"d\" WorldEnd");
  EXPECT_EQ(p.messages(), "");
  const auto origin = [&](std::size_t i) { return p.scene().shapes.at(i).ctm->start.point(Vec3d{}); };
  expectPoint(origin(0), {0, 0, 0});  // WorldBegin resets
  expectPoint(origin(1), {5, 0, 0});  // camera to world
  expectPoint(origin(2), {0, 0, 0});
  expectPoint(origin(3), {-5, 0, 0});
}

TEST(Description, ActiveTransformSelectsTheTimes) {
  const TransformPair t = ctmOf(
      "ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 0 2 0 "
      "ActiveTransform All Translate 0 0 3");
  EXPECT_TRUE(t.isAnimated());
  expectPoint(t.start.point(Vec3d{}), {1, 0, 3});
  expectPoint(t.end.point(Vec3d{}), {0, 2, 3});
  EXPECT_FALSE(ctmOf("ActiveTransform StartTime Translate 1 0 0 ActiveTransform EndTime Translate 1 0 0")
                   .isAnimated());
}

TEST(Description, CoordSysTransformIgnoresTheActiveTimes) {
  const TransformPair t =
      ctmOf("Translate 1 0 0 ActiveTransform StartTime CoordSysTransform \"world\" ActiveTransform All");
  EXPECT_FALSE(t.isAnimated());
  expectPoint(t.end.point(Vec3d{}), {0, 0, 0});
}

TEST(Description, TransformBlocksSaveTransformAndSelectionOnly) {
  for (const std::string time : {"StartTime", "EndTime"}) {
    Parsed p = parseWorld("TransformBegin ActiveTransform " + time +
                          " Translate 1 0 0 Material \"glass\" ReverseOrientation TransformEnd\n"
                          "Translate 0 1 0 Shape \"sphere\"");
    EXPECT_EQ(p.messages(), "");
    const ShapeDescription& s = p.scene().shapes.at(0);
    EXPECT_FALSE(s.ctm->isAnimated()) << time;
    expectPoint(s.ctm->start.point(Vec3d{}), {0, 1, 0});
    EXPECT_EQ(s.material, 0);
    EXPECT_TRUE(s.reverseOrientation);
  }
}

TEST(Description, AttributeBlocksSaveEverything) {
  Parsed p = parseWorld(
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n"
      "AttributeBegin Translate 1 0 0 Material \"glass\" ReverseOrientation AreaLightSource \"diffuse\"\n"
      "MediumInterface \"fog\" \"\" MakeNamedMaterial \"gold\" \"string type\" \"metal\"\n"
      "Texture \"t\" \"float\" \"constant\" Shape \"inner\" AttributeEnd Shape \"outer\"");
  EXPECT_EQ(p.messages(), "");
  const ShapeDescription& in = p.scene().shapes.at(0);
  const ShapeDescription& out = p.scene().shapes.at(1);
  expectPoint(in.ctm->start.point(Vec3d{}), {1, 0, 0});
  EXPECT_EQ(in.material, 0);
  EXPECT_EQ(in.areaLight, 0);
  EXPECT_TRUE(in.reverseOrientation);
  EXPECT_EQ(in.media->inside.name, "fog");
  EXPECT_EQ(in.media->inside.index, 0);
  EXPECT_EQ(in.media->inside.location.toString(), "t.pbrt:4:17");
  EXPECT_TRUE(NameScope::find(in.scope, NameScope::Kind::Materials, "gold"));
  EXPECT_TRUE(NameScope::find(in.scope, NameScope::Kind::FloatTextures, "t"));
  EXPECT_TRUE(out.ctm->start.isIdentity());
  EXPECT_EQ(out.material, kNone);
  EXPECT_EQ(out.areaLight, kNone);
  EXPECT_FALSE(out.reverseOrientation);
  EXPECT_EQ(out.media->inside.index, kNone);
  EXPECT_FALSE(NameScope::find(out.scope, NameScope::Kind::Materials, "gold"));
  EXPECT_FALSE(NameScope::find(out.scope, NameScope::Kind::FloatTextures, "t"));
}

TEST(Description, NamedMediaAndObjectsAndCoordinateSystemsAreGlobal) {
  Parsed p = parseWorld(
      "AttributeBegin MakeNamedMedium \"m\" \"string type\" \"homogeneous\" Translate 1 0 0 CoordinateSystem "
      "\"c\"\n"
      "ObjectBegin \"o\" Shape \"sphere\" ObjectEnd AttributeEnd\n"
      "MediumInterface \"m\" CoordSysTransform \"c\" ObjectInstance \"o\" Shape \"disk\"");
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().shapes.at(1).media->inside.index, 0);
  expectPoint(p.scene().shapes.at(1).ctm->start.point(Vec3d{}), {1, 0, 0});
  EXPECT_EQ(p.scene().instances.size(), 1u);
}

TEST(Description, AReusedTextureNameKeepsItsOldMeaningForOlderObjects) {
  Parsed p = parseWorld(
      "Texture \"t\" \"color\" \"constant\" Material \"matte\" \"texture Kd\" \"t\" Shape \"a\"\n"
      "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"matte\" \"texture Kd\" \"t\" Shape \"b\"");
  EXPECT_FALSE(p.diagnostics.hasErrors());
  const SceneDescription& s = p.scene();
  const auto used = [&](std::size_t material) {
    return NameScope::find(s.materials.at(material).scope, NameScope::Kind::SpectrumTextures, "t");
  };
  EXPECT_EQ(used(0), 0u);
  EXPECT_EQ(used(1), 1u);
  EXPECT_EQ(s.textures.at(1).type, "checkerboard");
  EXPECT_EQ(s.textures.at(1).flavour, TextureFlavour::Spectrum);
  // The second texture itself sees the first: textures may build on their own name.
  EXPECT_EQ(NameScope::find(s.textures.at(1).scope, NameScope::Kind::SpectrumTextures, "t"), 0u);
  EXPECT_EQ(s.shapes.at(0).material, 0);
  EXPECT_EQ(s.shapes.at(1).material, 1);
}

TEST(Description, FloatAndSpectrumTexturesOfOneNameCoexist) {
  Parsed p =
      parseWorld("Texture \"t\" \"float\" \"constant\" Texture \"t\" \"color\" \"constant\" Shape \"s\"");
  EXPECT_EQ(p.messages(), "");
  const auto& scope = p.scene().shapes.at(0).scope;
  EXPECT_EQ(NameScope::find(scope, NameScope::Kind::FloatTextures, "t"), 0u);
  EXPECT_EQ(NameScope::find(scope, NameScope::Kind::SpectrumTextures, "t"), 1u);
}

TEST(Description, NamedMaterialsAreSelectedByNameAndMakeDoesNotSelect) {
  Parsed p = parseWorld(
      "MakeNamedMaterial \"m\" \"string type\" \"glass\" Shape \"a\" NamedMaterial \"m\" Shape \"b\" "
      "Material \"\" "
      "Shape \"c\"");
  EXPECT_EQ(p.messages(), "");
  const SceneDescription& s = p.scene();
  EXPECT_EQ(s.materials.at(0).name, "m");
  EXPECT_EQ(s.materials.at(0).type, "glass");
  EXPECT_TRUE(s.materials.at(0).params.find(ParamKind::String, "type")->used);
  EXPECT_EQ(s.shapes.at(0).material, kNone);
  EXPECT_EQ(s.shapes.at(1).material, 0);
  EXPECT_TRUE(s.materials.at(static_cast<std::size_t>(s.shapes.at(2).material)).isNone());
  EXPECT_FALSE(s.materials.at(0).isNone());
}

TEST(Description, AreaLightsLastUntilSwitchedOff) {
  Parsed p = parseWorld(
      "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1] Shape \"a\" Shape \"b\" AreaLightSource \"\" Shape "
      "\"c\"");
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().shapes.at(1).areaLight, 0);
  EXPECT_EQ(p.scene().shapes.at(2).areaLight, kNone);
  EXPECT_EQ(p.scene().areaLights.size(), 1u);
}

TEST(Description, LightsKeepTransformAndOutsideMedium) {
  Parsed p = parseWorld(
      "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" MediumInterface \"\" \"a\" Translate 0 0 2\n"
      "LightSource \"point\" \"rgb I\" [1 1 1]");
  EXPECT_EQ(p.messages(), "");
  const LightDescription& light = p.scene().lights.at(0);
  EXPECT_EQ(light.type, "point");
  EXPECT_EQ(light.media->outside.index, 0);
  expectPoint(light.ctm->start.point(Vec3d{}), {0, 0, 2});
}

TEST(Description, OneMediumNameStandsForBothSides) {
  Parsed p =
      parseWorld("MakeNamedMedium \"a\" \"string type\" \"homogeneous\" MediumInterface \"a\" Shape \"s\"");
  EXPECT_EQ(p.scene().shapes.at(0).media->inside.index, 0);
  EXPECT_EQ(p.scene().shapes.at(0).media->outside.index, 0);
}

TEST(Description, MediaKeepTheirTransformAndType) {
  Parsed p = parse(
      "Translate 1 0 0 MakeNamedMedium \"a\" \"string type\" \"heterogeneous\" \"float density\" [1 2]\n"
      "WorldBegin WorldEnd");
  EXPECT_EQ(p.messages(), "");
  const MediumDescription& m = p.scene().media.at(0);
  EXPECT_EQ(m.name, "a");
  EXPECT_EQ(m.type, "heterogeneous");
  expectPoint(m.ctm->start.point(Vec3d{}), {1, 0, 0});
}

TEST(Description, ARedefinedMediumHoldsForLaterShapes) {
  Parsed p = parseWorld(
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" \"\" Shape \"a\"\n"
      "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" Shape \"b\"");
  EXPECT_FALSE(p.diagnostics.hasErrors());
  EXPECT_NE(p.messages().find("t.pbrt:3:17: warning: medium \"m\" was defined before at t.pbrt:2:1"),
            std::string::npos);
  EXPECT_EQ(p.scene().shapes.at(0).media->inside.index, 0);
  EXPECT_EQ(p.scene().shapes.at(1).media->inside.index, 1);
}

TEST(Description, TheMediumMayBeDefinedAfterItsInterfaceButBeforeTheShape) {
  Parsed p = parseWorld(
      "MediumInterface \"m\" \"\" MakeNamedMedium \"m\" \"string type\" \"homogeneous\" Shape \"a\"");
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().shapes.at(0).media->inside.index, 0);
}

TEST(Description, TheCameraMediumIsTheOutsideMediumAtWorldEnd) {
  constexpr std::string_view kOptions =
      "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" MakeNamedMedium \"b\" \"string type\" "
      "\"homogeneous\"\n"
      "MediumInterface \"\" \"a\" Camera \"perspective\" ";
  const auto cameraMedium = [&](const std::string& world) {
    Parsed p = parse(std::string(kOptions) + "WorldBegin " + world + " WorldEnd");
    EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
    return p.scene().cameraMedium.name;
  };
  EXPECT_EQ(cameraMedium(""), "a");  // survives WorldBegin
  EXPECT_EQ(cameraMedium("MediumInterface \"a\" \"b\""), "b");
  EXPECT_EQ(cameraMedium("AttributeBegin MediumInterface \"a\" \"b\" AttributeEnd"), "a");
  EXPECT_EQ(cameraMedium("AttributeBegin MediumInterface \"a\" \"b\""), "b");  // open blocks are not restored
  EXPECT_EQ(cameraMedium("MediumInterface \"a\" \"\""), "");
}

TEST(Description, ObjectsRecordShapesAndInstancesPlaceThem) {
  Parsed p = parseWorld(
      "Translate 1 0 0 ObjectBegin \"o\" Translate 0 1 0 Shape \"a\" Shape \"b\" ObjectEnd\n"
      "Translate 0 0 5 ObjectInstance \"o\" ObjectInstance \"o\" Shape \"c\"");
  EXPECT_EQ(p.messages(), "");
  const SceneDescription& s = p.scene();
  ASSERT_EQ(s.objects.size(), 1u);
  EXPECT_EQ(s.objects[0].name, "o");
  EXPECT_EQ(s.objects[0].shapes, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(s.objects[0].depth, 1u);
  EXPECT_EQ(s.objects[0].placedShapes, 2u);
  EXPECT_EQ(s.shapes.at(0).object, 0);
  EXPECT_EQ(s.shapes.at(2).object, kNone);
  expectPoint(s.shapes.at(0).ctm->start.point(Vec3d{}), {1, 1, 0});  // the CTM at the definition is kept
  ASSERT_EQ(s.instances.size(), 2u);
  EXPECT_EQ(s.instances[1].object, 0u);
  EXPECT_EQ(s.instances[1].parent, kNone);
  expectPoint(s.instances[1].ctm->start.point(Vec3d{}), {1, 0, 5});
  EXPECT_EQ(s.instances[0].location.toString(), "t.pbrt:3:17");
}

TEST(Description, ARedefinedObjectHoldsForLaterInstances) {
  Parsed p = parseWorld(
      "ObjectBegin \"o\" Shape \"a\" ObjectEnd ObjectInstance \"o\"\n"
      "ObjectBegin \"o\" Shape \"b\" ObjectEnd ObjectInstance \"o\"");
  EXPECT_FALSE(p.diagnostics.hasErrors());
  EXPECT_EQ(p.scene().instances.at(0).object, 0u);
  EXPECT_EQ(p.scene().instances.at(1).object, 1u);
}

TEST(Description, InstancesNest) {
  Parsed p = parseWorld(
      "ObjectBegin \"leaf\" Shape \"a\" Shape \"b\" ObjectEnd\n"
      "ObjectBegin \"twig\" Translate 1 0 0 ObjectInstance \"leaf\" ObjectInstance \"leaf\" Shape \"c\" "
      "ObjectEnd\n"
      "ObjectBegin \"tree\" ObjectInstance \"twig\" ObjectEnd ObjectInstance \"tree\"");
  EXPECT_FALSE(p.diagnostics.hasErrors());
  EXPECT_EQ(p.diagnostics.all().size(), 1u);  // one note, not one per instance
  const SceneDescription& s = p.scene();
  EXPECT_EQ(s.objects.at(1).instances, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(s.objects.at(1).placedShapes, 5u);
  EXPECT_EQ(s.objects.at(2).depth, 3u);
  EXPECT_EQ(s.objects.at(2).placedShapes, 5u);
  EXPECT_EQ(s.instances.at(0).parent, 1);
  expectPoint(s.instances.at(0).ctm->start.point(Vec3d{}), {1, 0, 0});
  EXPECT_EQ(s.instances.at(3).parent, kNone);
}

TEST(Description, InstancesThatMultiplyAreCountedWithoutOverflow) {
  std::string text = "ObjectBegin \"0\" Shape \"a\" ObjectEnd\n";
  for (int i = 1; i <= 40; ++i) {
    const std::string inner = "ObjectInstance \"" + std::to_string(i - 1) + "\" ";
    text += "ObjectBegin \"" + std::to_string(i) + "\" " + inner + inner + inner + inner + "ObjectEnd\n";
  }
  Parsed p = parseWorld(text);
  EXPECT_EQ(p.scene().objects.at(20).placedShapes, std::uint64_t{1} << 40);
  EXPECT_EQ(p.scene().objects.at(40).placedShapes, UINT64_MAX);
}

TEST(Description, EachWorldStartsAnew) {
  Parsed p = parse(
      "Film \"one\" TransformTimes 5 6 MediumInterface \"m\" MakeNamedMedium \"m\" \"string type\" "
      "\"homogeneous\"\n"
      "Translate 1 0 0 CoordinateSystem \"c\" WorldBegin Material \"glass\" ReverseOrientation\n"
      "ObjectBegin \"o\" Shape \"a\" ObjectEnd AreaLightSource \"diffuse\" Texture \"t\" \"float\" "
      "\"constant\"\n"
      "WorldEnd WorldBegin Shape \"b\" WorldEnd");
  EXPECT_EQ(p.messages(), "");
  ASSERT_EQ(p.scenes.size(), 2u);
  const SceneDescription& s = p.scenes[1];
  EXPECT_FALSE(s.film.given);
  EXPECT_EQ(s.transformStartTime, 0);
  EXPECT_TRUE(s.media.empty() && s.materials.empty() && s.objects.empty() && s.textures.empty());
  const ShapeDescription& b = s.shapes.at(0);
  EXPECT_EQ(b.material, kNone);
  EXPECT_EQ(b.areaLight, kNone);
  EXPECT_FALSE(b.reverseOrientation);
  EXPECT_EQ(b.media->inside.name, "");
  EXPECT_EQ(b.scope, nullptr);
  EXPECT_TRUE(b.ctm->start.isIdentity());
  EXPECT_EQ(p.scenes[0].worldBegin.toString(), "t.pbrt:2:38");
  EXPECT_EQ(s.worldEnd.toString(), "t.pbrt:4:31");
  EXPECT_NE(parse("CoordinateSystem \"c\" WorldBegin WorldEnd WorldBegin CoordSysTransform \"c\" WorldEnd")
                .messages()
                .find("unknown coordinate system \"c\""),
            std::string::npos);
}

TEST(Description, ManyOpenBlocksNeedNoStack) {
  std::string text;
  for (int i = 0; i < 60000; ++i) text += "AttributeBegin ";
  for (int i = 0; i < 60000; ++i) text += "AttributeEnd ";
  EXPECT_EQ(parseWorld(text).messages(), "");
  EXPECT_NE(parseWorld(text + text.substr(0, 15 * 60000) + text.substr(0, 15 * 60000))
                .messages()
                .find("blocks are open"),
            std::string::npos);
}

}  // namespace
}  // namespace pbrtmedia
