// SPDX-License-Identifier: BSD-2-Clause
// What is said of media and their boundaries: what is true, with the place of what is wrong, and nothing
// else.
#include <gtest/gtest.h>

#include <string>

#include "construct/attempt.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

const std::string kFog = "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" ";
const std::string kGrid =
    "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"float density\" [ 1 ] ";  // in the unit cube
const std::string kNone = " Material \"none\" ", kInside = " MediumInterface \"m\" \"\" ";

/// A box of outward triangles, its first `count` of twelve, in the unit cube grown by `by`.
std::string box(int count = 12, const std::string& extra = "", double by = 0.1) {
  const int corners[12][3] = {{0, 2, 1}, {0, 3, 2}, {4, 5, 6}, {4, 6, 7}, {0, 1, 5}, {0, 5, 4},
                              {1, 2, 6}, {1, 6, 5}, {2, 3, 7}, {2, 7, 6}, {3, 0, 4}, {3, 4, 7}};
  std::string text = " Shape \"trianglemesh\" \"integer indices\" [";
  for (int i = 0; i < count; ++i) {
    for (const int c : corners[i]) text += ' ' + std::to_string(c);
  }
  text += " ] \"point P\" [";
  for (const auto& [x, y, z] : std::vector<std::array<int, 3>>{
           {0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}) {
    for (const int v : {x, y, z}) text += ' ' + std::to_string(v == 0 ? -by : 1 + by);
  }
  return text + " ] " + extra;
}

/// Far from what stands at the origin.
const std::string kCamera = "LookAt 20 30 40  0 0 0  0 1 0 Camera \"perspective\" ";
Attempt seen(const std::string& world) { return attemptWorld(world, {}, kCamera); }

/// The message that holds `fragment` is a warning at `place`.
void expectWarning(const std::string& world, const std::string& fragment, const std::string& place) {
  const Attempt a = seen(world);
  ASSERT_TRUE(a.made) << a.messages();
  EXPECT_TRUE(a.warns(fragment)) << world << '\n' << a.messages();
  EXPECT_EQ(placeOf(a.find(Severity::Warning, fragment)), place) << world << '\n' << a.messages();
}
void expectSilence(const std::string& world) {
  const Attempt a = seen(world);
  EXPECT_TRUE(a.isSilent()) << world << '\n' << a.messages();
}

TEST(MediumWarnings, NameBoundariesThatFaceInward) {
  expectWarning(kFog + kInside + kNone + "ReverseOrientation\n" + box(), "\"m\" it faces inward",
                "t.pbrt:3:2");
  expectWarning(kFog + kInside + kNone + "Scale -1 1 1\nShape \"sphere\"", "\"m\" it faces inward",
                "t.pbrt:3:1");
  expectWarning("ObjectBegin \"o\" " + kFog + kInside + kNone + "ReverseOrientation\n" + box() +
                    "ObjectEnd ObjectInstance \"o\" Translate 5 0 0 ObjectInstance \"o\"",
                "\"m\" it faces inward", "t.pbrt:3:2");
  expectSilence(kFog + kInside + kNone + box());
  expectSilence(kFog + kInside + kNone + "ReverseOrientation Scale -1 1 1 Shape \"sphere\"");
  const std::string can =
      "Shape \"cylinder\" Shape \"disk\" \"float height\" 1 ReverseOrientation "
      "Shape \"disk\" \"float height\" -1";
  expectSilence(kFog + kInside + kNone + can);
  expectWarning(kFog + kInside + kNone + "ReverseOrientation\n" + can, "\"m\" it faces inward", "t.pbrt:3:1");
  // Around the camera: the region of the normals is the one that is enclosed.
  expectSilence(kFog + " MediumInterface \"\" \"m\" " + kNone +
                "ReverseOrientation Shape \"sphere\" \"float radius\" 99 MediumInterface \"\" \"\"");
  // A bubble.
  expectSilence(kFog + kInside + kNone + box(12, "", 9) + "ReverseOrientation Shape \"sphere\"");
}

TEST(MediumWarnings, NameBoundariesThatAreOpen) {
  expectWarning(kFog + kInside + kNone + "\n" + box(10), "\"m\" it is open", "t.pbrt:3:2");
  expectWarning(kFog + kInside + kNone + "\nShape \"cylinder\"", "\"m\" it is open", "t.pbrt:3:1");
  // What closes it may be another shape, or a floor that nothing passes.
  expectSilence(kFog + kInside + kNone + box(10) +
                " Shape \"trianglemesh\" \"integer indices\" [ 0 2 3 0 1 2 ] " +
                "\"point P\" [ -.1 1.1 -.1 -.1 -.1 -.1 -.1 -.1 1.1 -.1 1.1 1.1 ]");
}

TEST(MediumWarnings, NameMediaThatNobodySees) {
  expectWarning("\n" + kFog + box(), "medium \"m\": no shape has it", "t.pbrt:3:1");
  expectWarning("\n" + kFog + " MediumInterface \"m\" " + kNone + box() + " MediumInterface \"\" \"\"",
                "on both sides", "t.pbrt:3:1");
  expectWarning(kFog + kInside + "\n" + box(), "let no light through", "t.pbrt:3:2");
  expectWarning(
      kFog + kInside + "MakeNamedMaterial \"x\" \"string type\" \"mirror\" NamedMaterial \"x\"\n" + box(),
      "let no light through", "t.pbrt:3:2");
  expectWarning("\n" + kGrid + kInside + kNone + "Translate 7 0 0" + box(), "outside of all shapes",
                "t.pbrt:3:1");
  expectWarning("\n" + kGrid + "ObjectBegin \"o\"" + kInside + kNone + box() +
                    "ObjectEnd Translate 7 0 0 ObjectInstance \"o\"",
                "outside of all shapes", "t.pbrt:3:1");
}

TEST(MediumWarnings, DoNotNameMediaThatAreSeen) {
  expectSilence(kFog + kInside + "Material \"glass\"" + box());
  expectSilence(kFog +
                " MediumInterface \"\" \"m\" Material \"matte\" Shape \"sphere\" MediumInterface \"\" \"\"");
  expectSilence(kFog + kInside + "Material \"matte\" " +
                box(12, "\"texture alpha\" \"a\"").insert(0, " Texture \"a\" \"float\" \"checkerboard\" "));
  expectSilence(kFog + " MediumInterface \"\" \"m\"");  // of the camera
  expectSilence(kFog + kInside +
                "Material \"matte\" Shape \"sphere\" \"float radius\" 99");  // around the camera
  expectSilence("ObjectBegin \"o\"" + kGrid + kInside + kNone + box() +
                "ObjectEnd Translate 7 0 0 ObjectInstance \"o\"");
  expectSilence("ObjectBegin \"o\"" + kFog + kInside + kNone + box() + "ObjectEnd");  // never placed
  expectSilence(kGrid + kInside + kNone + "Translate 7 0 0" + box() + "Translate -7 0 0" + box());
}

TEST(MediumWarnings, OfMotionAreTrue) {
  const std::string move = "ActiveTransform EndTime Translate 0 0 2 ActiveTransform All ";
  const std::string stays = "media do not move by themselves";
  expectSilence(move + kGrid + kInside + kNone + box());
  expectSilence(kGrid + move + kInside + kNone + box());
  expectSilence("ObjectBegin \"o\" " + move + kGrid + kInside + kNone + box() +
                "ObjectEnd ObjectInstance \"o\"");
  expectSilence("ObjectBegin \"o\" " + kGrid + kInside + kNone + box() + "ObjectEnd " + move +
                " ObjectInstance \"o\"");
  expectSilence(move + kFog + "Identity" + kInside + kNone + box());  // the same everywhere
  expectWarning("AttributeBegin " + move + "\n" + kGrid + "AttributeEnd" + kInside + kNone + box(), stays,
                "t.pbrt:3:1");
  expectWarning(
      move + "\n" + kGrid + "ObjectBegin \"o\" " + kInside + kNone + box() + "ObjectEnd ObjectInstance \"o\"",
      stays, "t.pbrt:3:1");
}

TEST(MediumWarnings, OfLightFromInfinityNameTheBoundary) {
  const Attempt a = seen("LightSource \"infinite\" " + kFog + " \"rgb sigma_a\" [ 1 1 1 ] " + kNone +
                         " MediumInterface \"m\" \"m\" MediumInterface \"\" \"m\"");
  EXPECT_TRUE(a.warns("enclose the medium")) << a.messages();
  const Attempt open = seen("LightSource \"infinite\" " + kFog + kNone + kInside + "\n" + box(2, "", 60) +
                            " MediumInterface \"\" \"m\"");
  EXPECT_TRUE(open.warns("its boundary at t.pbrt:3:2 does not enclose it")) << open.messages();
}

}  // namespace
}  // namespace pbrtmedia::test
