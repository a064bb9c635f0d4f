// SPDX-License-Identifier: BSD-2-Clause
#include "construct/textures.h"

#include "construct/probe.h"
#include "image/image.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

class ConstructTexture : public testing::Test {
 protected:
  ConstructTexture() {
    Image map(4, 4, {"R", "G", "B"});
    for (int y = 0; y < 4; ++y) {
      for (int x = 0; x < 4; ++x) {
        const auto i = static_cast<float>(x + 4 * y);
        map.setRgb(x, y, Rgb(i / 16, 0.5f - i / 40, 0.2f));
      }
    }
    writeImage(folder_.path() / "map.png", map);
    writeImage(folder_.path() / "map.pfm", map);
    folder_.write("broken.png", "this is no picture");
  }
  Attempt with(const std::string& world) const { return attemptWorld(world, {.folder = folder_.path()}); }
  auto maker() const {
    return [this](const std::string& world) { return with(world); };
  }
  /// A float texture as the roughness of a plastic, a spectrum texture as the colour of a matte; line 2,
  /// column 1.
  static std::string shown(const std::string& flavour, const std::string& texture) {
    const std::string use = flavour == "float"
                                ? "Material \"matte\" \"rgb Kd\" [ 1 1 1 ] \"texture sigma\" \"t\" "
                                : "Material \"matte\" \"texture Kd\" \"t\" ";
    return "Texture \"t\" \"" + flavour + "\" " + texture + "\nIdentity " + use +
           "Shape \"sphere\" Shape \"disk\" \"float height\" 1.2 \"float radius\" 0.4";
  }
  TemporaryFolder folder_;
};

Numbers values(const Attempt& a) { return materials(a); }
Numbers filtered(const Attempt& a) { return materials(a, 0.13f); }

TEST_F(ConstructTexture, EveryParameterHasItsEffectInBothFlavours) {
  for (const std::string flavour : {"float", "spectrum"}) {
    const bool isFloat = flavour == "float";
    // Values that show in sigma (degrees) as well as in a colour.
    const std::string kind = isFloat ? "float" : "rgb", high = isFloat ? " 9 " : " [ .8 .6 .4 ] ";
    const auto constant = [&](const std::string& name) { return "\"" + kind + ' ' + name + '"' + high; };
    std::vector<Effect> effects;
    const std::string low = isFloat ? " 2 " : " [ .1 .1 .1 ] ";
    /// The texture against itself with another value for a constant that it has.
    const auto change = [&](const std::string& texture, const std::string& name) {
      const std::string given = constant(name);
      const std::size_t at = texture.find(given);
      ASSERT_NE(at, std::string::npos) << texture << given;
      std::string changed = texture;
      changed.replace(at, given.size(), "\"" + kind + ' ' + name + '"' + low);
      effects.push_back({shown(flavour, texture), shown(flavour, changed)});
    };
    const auto add = [&](const std::string& texture, const std::vector<std::string>& parameters) {
      for (const std::string& p : parameters)
        effects.push_back({shown(flavour, texture), shown(flavour, texture + ' ' + p)});
    };
    const std::vector<std::string> uv = {"\"float uscale\" 3",
                                         "\"float vscale\" 3",
                                         "\"float udelta\" 0.3",
                                         "\"float vdelta\" 0.3",
                                         "\"string mapping\" \"spherical\"",
                                         "\"string mapping\" \"cylindrical\"",
                                         "\"string mapping\" \"planar\""};
    add("\"constant\"", {constant("value")});
    const std::string scale = "\"scale\" " + constant("tex1") + constant("tex2");
    change(scale, "tex1");
    change(scale, "tex2");
    const std::string mix = "\"mix\" " + constant("tex2");
    change(mix, "tex2");
    add(mix, {constant("tex1"), "\"float amount\" 0.9"});
    const std::string corners = "\"bilerp\" " + constant("v00");
    change(corners, "v00");
    add(corners, {constant("v01"), constant("v10"), constant("v11")});
    add(corners, uv);
    const std::string checks = "\"checkerboard\" " + constant("tex1");
    change(checks + "\"float uscale\" 5", "tex1");
    add(checks + "\"float vscale\" 5", {constant("tex2")});
    add(checks, {"\"float uscale\" 7", "\"float vscale\" 7"});
    add(checks + "\"float uscale\" 5 \"float vscale\" 4.3", {"\"float udelta\" 0.7", "\"float vdelta\" 0.7"});
    const std::string dots = "\"dots\" " + constant("inside") + "\"float uscale\" 9 \"float vscale\" 9 ";
    change(dots, "inside");
    add(dots, {constant("outside"), "\"float udelta\" 0.4", "\"float vdelta\" 0.4"});
    const std::string picture = "\"imagemap\" \"string filename\" \"map.pfm\" ";
    const std::string map = picture + (isFloat ? "\"float scale\" 60" : "\"float scale\" 0.9");
    add(map, uv);
    add(map, {"\"bool gamma\" \"true\""});
    add(picture, {"\"float scale\" 0.3"});
    const std::string tiled = map + " \"float uscale\" 3 ";
    add(tiled, {"\"string wrap\" \"black\"", "\"string wrap\" \"clamp\""});
    add("\"fbm\"", {"\"integer octaves\" 2", "\"float roughness\" 0.8"});
    add("\"wrinkled\"", {"\"integer octaves\" 2", "\"float roughness\" 0.8"});
    expectEffects(effects, maker(), values);
    // Parameters that only filtering shows.
    expectEffects({{shown(flavour, map), shown(flavour, map + " \"bool trilinear\" \"true\"")},
                   {shown(flavour, map), shown(flavour, map + " \"float maxanisotropy\" 1")},
                   {shown(flavour, checks + "\"float uscale\" 5"),
                    shown(flavour, checks + "\"float uscale\" 5 \"string aamode\" \"none\"")}},
                  maker(), filtered);
    // The transformation at the directive.
    for (const std::string& texture :
         {std::string("\"fbm\""), std::string("\"wrinkled\""), std::string("\"windy\""),
          checks + "\"integer dimension\" 3", map + " \"string mapping\" \"spherical\"",
          map + " \"string mapping\" \"cylindrical\""}) {
      const std::string plain = shown(flavour, texture);
      expectEffects({{plain, "Rotate 25 1 0 0 Scale 3 3 3 Translate 0.2 0 0 " + plain}}, maker(), values);
    }
    const std::string planar = map + " \"string mapping\" \"planar\" ";
    expectEffects({{shown(flavour, planar), shown(flavour, planar + "\"vector v1\" [ 0.3 0 1 ]")},
                   {shown(flavour, planar), shown(flavour, planar + "\"vector v2\" [ 0.3 0 1 ]")},
                   {shown(flavour, planar), shown(flavour, planar + "\"float udelta\" 0.3")},
                   {shown(flavour, planar), shown(flavour, planar + "\"float vdelta\" 0.3")}},
                  maker(), values);
    expectSame({{shown(flavour, planar), "Rotate 25 1 0 0 " + shown(flavour, planar)},
                {shown(flavour, "\"imagemap\" \"string filename\" \"map.png\""),
                 shown(flavour,
                       "\"imagemap\" \"string filename\" \"map.png\" \"bool gamma\" \"true\" "
                       "\"string wrap\" \"repeat\" \"float scale\" 1 \"bool trilinear\" \"false\" "
                       "\"float maxanisotropy\" 8")},
                {shown(flavour, "\"fbm\""),
                 shown(flavour, "\"fbm\" \"integer octaves\" 8 \"float roughness\" 0.5")}},
               maker(), filtered);
  }
}

TEST_F(ConstructTexture, WrapsAsItsWordSays) {
  // Far beyond the picture: nothing, or the texel in its corner.
  const std::string far =
      "\"imagemap\" \"string filename\" \"map.pfm\" \"float uscale\" 0 \"float vscale\" 0 "
      "\"float udelta\" 9.125 \"float vdelta\" 9.125 \"string wrap\" ";
  const auto constant = [](const std::string& rgb) {
    return shown("spectrum", "\"constant\" \"rgb value\" [ " + rgb + " ]");
  };
  expectSame({{shown("spectrum", far + "\"black\""), constant("0 0 0")},
              {shown("spectrum", far + "\"clamp\""), constant("0.1875 0.425 0.2")}},
             maker(), values);
}

TEST_F(ConstructTexture, SomeClassesAreSpectraOnly) {
  expectEffects({{shown("spectrum", "\"uv\""), shown("spectrum", "\"uv\" \"float uscale\" 3")},
                 {shown("color", "\"uv\""), shown("color", "\"uv\" \"string mapping\" \"planar\"")},
                 {shown("spectrum", "\"marble\""), shown("spectrum", "\"marble\" \"float scale\" 3")},
                 {shown("spectrum", "\"marble\""), shown("spectrum", "\"marble\" \"float variation\" 0.9")},
                 {shown("spectrum", "\"marble\""), shown("spectrum", "\"marble\" \"integer octaves\" 1")},
                 {shown("spectrum", "\"marble\""), shown("spectrum", "\"marble\" \"float roughness\" 0.9")}},
                maker(), values);
  expectMistakes(
      {{shown("float", "\"uv\""), "float texture \"t\": unknown type \"uv\"", "t.pbrt:2:21", kTolerated},
       {shown("float", "\"marble\""), "unknown type \"marble\"", "", kTolerated}},
      maker());
}

TEST_F(ConstructTexture, TexturesReferToTextures) {
  const std::string inner =
      "Texture \"i\" \"spectrum\" \"constant\" \"rgb value\" [ .3 .4 .5 ] "
      "Texture \"a\" \"float\" \"constant\" \"float value\" 0.25 ";
  const std::string plain = shown("spectrum", "\"constant\" \"rgb value\" [ .3 .4 .5 ]");
  expectSame(
      {{inner + shown("spectrum", "\"scale\" \"texture tex1\" \"i\""), plain},
       {inner + shown("spectrum", "\"scale\" \"texture tex2\" \"i\""), plain},
       {inner + shown("spectrum",
                      "\"mix\" \"texture tex1\" \"i\" \"texture tex2\" \"i\" \"texture amount\" \"a\""),
        plain},
       {inner + shown("spectrum", "\"checkerboard\" \"texture tex1\" \"i\" \"texture tex2\" \"i\""), plain},
       {inner + shown("spectrum", "\"dots\" \"texture inside\" \"i\" \"texture outside\" \"i\""), plain},
       {inner + shown("spectrum",
                      "\"mix\" \"rgb tex1\" [ 1 1 1 ] \"rgb tex2\" [ 0 0 0 ] \"texture amount\" \"a\""),
        shown("spectrum", "\"constant\" \"rgb value\" [ .75 .75 .75 ]")}},
      maker(), values);
}

TEST_F(ConstructTexture, PtexIsGreyAsLongAsThereIsNoLibrary) {
  for (const std::string kind : {"float", "spectrum"}) {
    const Attempt a = maker()(shown(kind, "\"ptex\" \"string filename\" \"x.ptx\" \"float gamma\" 1"));
    EXPECT_TRUE(a.warns("needs the Ptex library")) << a.messages();
    EXPECT_FALSE(a.warns("unknown parameter")) << a.messages();
    const std::string value = kind == "float" ? "\"float value\" .5" : "\"rgb value\" [ .5 .5 .5 ]";
    EXPECT_EQ(values(a), values(maker()(shown(kind, "\"constant\" " + value))));
  }
}

TEST_F(ConstructTexture, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{shown("spectrum", "\"chekerboard\""),
        "spectrum texture \"t\": unknown type \"chekerboard\"; did you mean \"checkerboard\"?", "t.pbrt:2:24",
        kTolerated},
       {shown("float", "\"pctx\""), "unknown type \"pctx\"", "", kTolerated},
       {shown("spectrum", "\"ptex\" \"string filename\" \"x.ptx\""),
        "spectrum texture \"t\": needs the Ptex library", "", kTolerated},
       {shown("float", "\"constant\" \"float valeu\" 1"),
        "unknown parameter \"valeu\"; did you mean \"value\"?", "t.pbrt:2:32", kTolerated},
       {shown("spectrum", "\"constant\" \"float value\" 1"), "\"value\": found type float, expected rgb", "",
        kTolerated},
       {shown("float", "\"checkerboard\" \"integer dimension\" 4"),
        "\"dimension\": found 4, expected 2 or 3; the texture is not defined", "", kTolerated},
       {shown("float", "\"checkerboard\" \"string aamode\" \"best\""), "unknown aamode \"best\"", "",
        kTolerated},
       {shown("float", "\"uv\" \"string mapping\" \"x\""), "unknown type \"uv\"", "", kTolerated},
       {shown("spectrum", "\"uv\" \"string mapping\" \"spherikal\""),
        "unknown mapping \"spherikal\"; did you mean \"spherical\"?", "", kTolerated},
       {shown("float", "\"imagemap\""), "parameter \"filename\" is missing", "t.pbrt:2:1", kTolerated},
       {shown("float", "\"imagemap\" \"string filename\" \"nil.png\""), "there is no file \"", "",
        kTolerated},
       {shown("float", "\"imagemap\" \"string filename\" \"broken.png\""), "", "", kTolerated},
       {shown("float", "\"imagemap\" \"string filename\" \"map.png\" \"string wrap\" \"mirror\""),
        "unknown wrap \"mirror\"; ", "", kTolerated},
       {shown("float", "\"imagemap\" \"string filename\" \"map.png\" \"float maxanisotropy\" 0"),
        "expected in [1, 1024]", "", kTolerated},
       {shown("float", "\"imagemap\" \"string filename\" \"map.png\" \"float gamma\" 2.2"),
        "found type float, expected bool", "", kTolerated},
       {shown("float", "\"fbm\" \"integer octaves\" -1"), "\"octaves\": found -1, expected in [0, 64]", "",
        kTolerated},
       {shown("float", "\"scale\" \"texture tex1\" \"t\""),
        "unknown float texture \"t\"; none is defined here", "", kTolerated}},
      maker());
}

TEST_F(ConstructTexture, WhatIsNotUsedIsNotBuilt) {
  const std::string corrupt = "Texture \"c\" \"spectrum\" \"imagemap\" \"string filename\" \"broken.png\" ";
  const Attempt unused =
      with(corrupt + "Material \"matte\" \"texture Kd\" \"c\" Material \"mirror\" Shape \"sphere\"");
  EXPECT_TRUE(unused.isSilent()) << unused.messages();
  const auto& report = unused.made->report;
  EXPECT_NE(std::find(report.begin(), report.end(), "textures: 0 built of 1 defined"), report.end());
  EXPECT_NE(std::find(report.begin(), report.end(), "materials: 1 built of 2 defined"), report.end());
  EXPECT_TRUE(
      with(corrupt + "Material \"matte\" \"texture Kd\" \"c\" Shape \"sphere\"").warns("a grey picture"));
  EXPECT_TRUE(with(corrupt + "Material \"matte\" \"texture Kd\" \"c\" Shape \"sphere\" \"rgb Kd\" [ 1 1 1 ]")
                  .isSilent())
      << "the shape's constant replaces the texture";
}

TEST_F(ConstructTexture, RefusesTexturesThatMultiplyOrNestWithoutEnd) {
  const auto chain = [](int length, bool twice) {
    std::string world = "Texture \"t0\" \"spectrum\" \"constant\" ";
    for (int i = 1; i <= length; ++i) {
      const std::string inner = "\"t" + std::to_string(i - 1) + "\" ";
      world += "Texture \"t" + std::to_string(i) + "\" \"spectrum\" \"scale\" \"texture tex1\" " + inner;
      if (twice) world += "\"texture tex2\" " + inner;
    }
    return world + "Material \"matte\" \"texture Kd\" \"t" + std::to_string(length) + "\" Shape \"sphere\"";
  };
  EXPECT_TRUE(with(chain(200, false)).isSilent());
  EXPECT_TRUE(with(chain(10, true)).isSilent());
  EXPECT_TRUE(with(chain(50, true)).failsWith("one value takes more than 65536 look-ups"));
  EXPECT_TRUE(with(chain(5000, false)).failsWith("is nested more than 256 textures deep"));
}

TEST_F(ConstructTexture, WarnsThatTexturesDoNotMove) {
  EXPECT_TRUE(with("ActiveTransform EndTime Translate 1 0 0 ActiveTransform All " + shown("float", "\"fbm\""))
                  .warns("textures do not move"));
}

}  // namespace
}  // namespace pbrtmedia::test
