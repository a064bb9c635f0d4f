// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "tools/imgtool/merge.h"

namespace pbrtmedia {
namespace {

NamedImage render(const std::string& name, float value, const std::string& samples, const std::string& seed) {
  NamedImage out{name, Image(2, 1)};
  for (float& v : out.image.data()) v = value;
  out.image.metadata = {
      {"samples", samples}, {"seed", seed}, {"sceneHash", "abc"}, {"command", "pbrt a.pbrt"}};
  return out;
}

void expectRefused(const std::vector<NamedImage>& inputs, const std::string& part) {
  try {
    mergeRenders(inputs);
    ADD_FAILURE() << "merged; expected an error with \"" << part << "\"";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(MergeRenders, WeighsBySamples) {
  const Image out = mergeRenders({render("a", 1, "16", "1"), render("b", 4, "48", "2")});
  for (const float v : out.data()) EXPECT_EQ(v, 3.25f);  // (16 * 1 + 48 * 4) / 64
  EXPECT_EQ(out.metadata.at("samples"), "64");
  EXPECT_EQ(out.metadata.at("seed"), "1,2");
  EXPECT_EQ(out.metadata.at("sceneHash"), "abc");
  EXPECT_EQ(out.metadata.at("command"), "pbrt a.pbrt");
}

TEST(MergeRenders, OfMergesEqualsOneMerge) {
  const NamedImage a = render("a", 0.1f, "3", "1"), b = render("b", 0.7f, "5", "2"),
                   c = render("c", 9, "8", "3");
  const Image once = mergeRenders({a, b, c});
  const Image twice = mergeRenders({{"ab", mergeRenders({a, b})}, c});
  EXPECT_EQ(twice.metadata.at("seed"), "1,2,3");
  EXPECT_EQ(twice.metadata.at("samples"), "16");
  for (std::size_t i = 0; i < once.data().size(); ++i) EXPECT_FLOAT_EQ(twice.data()[i], once.data()[i]);
}

TEST(MergeRenders, MergesLayersByWhatTheyAre) {
  const auto layered = [](const std::string& name, std::vector<float> values, const std::string& samples) {
    NamedImage out = render(name, 0, samples, name);
    out.image = Image(1, 1, {"R", "G", "B", "A", "Z", "lookups", "variance.R", "variance.G", "variance.B"},
                      std::move(values));
    out.image.metadata = render(name, 0, samples, name).image.metadata;
    out.image.metadata["layers"] = "variance,lookups,alpha,depth";
    return out;
  };
  const NamedImage a = layered("1", {1, 1, 1, .5f, 4, 100, 8, 8, 8}, "10"),
                   b = layered("2", {2, 2, 2, .75f, 8, 50, 4, 4, 0}, "30"),
                   empty = layered("3", {0, 0, 0, 0, 0, 7, 0, 0, 0}, "40");
  const Image ab = mergeRenders({a, b});
  EXPECT_EQ(ab.data(),
            (std::vector<float>{1.75f, 1.75f, 1.75f, .6875f, 7, 150, 8.0f / 16 + 4 * 9.0f / 16, 2.75f, .5f}));
  EXPECT_EQ(ab.metadata.at("layers"), "variance,lookups,alpha,depth");
  const Image all = mergeRenders({a, b, empty});
  EXPECT_FLOAT_EQ(all.at(0, 0, 3), .34375f) << "a mean over all";
  EXPECT_FLOAT_EQ(all.at(0, 0, 4), 7) << "a depth of those that have any";
  EXPECT_EQ(all.at(0, 0, 5), 157);
  // In steps it is the same.
  const Image steps = mergeRenders({{"ab", ab}, empty});
  for (std::size_t i = 0; i < all.data().size(); ++i) EXPECT_FLOAT_EQ(steps.data()[i], all.data()[i]) << i;
  NamedImage strange = a;
  strange.image.metadata["layers"] = "variance,glow";
  expectRefused({strange, b}, "\"glow\", which this program does not know");
  strange.image.metadata["layers"] = "albedo";
  expectRefused({strange, b}, "the channels of layer \"albedo\" are not there");
}

TEST(MergeRenders, AccumulatesInDouble) {
  // In float, 2^24 + 1 stays 2^24: the small renders would vanish.
  std::vector<NamedImage> inputs{render("big", 0x1p24f, "1", "0")};
  for (int i = 1; i <= 64; ++i) inputs.push_back(render("small", 1, "1", std::to_string(i)));
  EXPECT_EQ(mergeRenders(inputs).data()[0], static_cast<float>((0x1p24 + 64) / 65));
  EXPECT_NE(static_cast<float>((0x1p24 + 64) / 65), static_cast<float>(0x1p24 / 65));
}

TEST(MergeRenders, SumsSecondsAndKeepsEveryCommand) {
  NamedImage a = render("a", 1, "1", "1"), b = render("b", 1, "1", "2");
  a.image.metadata["seconds"] = "1.5";
  b.image.metadata["seconds"] = "2";
  b.image.metadata["command"] = "pbrt --seed 2 a.pbrt";
  const Image out = mergeRenders({a, b});
  EXPECT_EQ(out.metadata.at("seconds"), "3.5");
  EXPECT_EQ(out.metadata.at("command"), "pbrt a.pbrt\npbrt --seed 2 a.pbrt");
  // A merge of merges comes apart again, and what occurs twice stands once.
  NamedImage c = render("c", 1, "1", "3");
  c.image.metadata["seconds"] = "1";
  EXPECT_EQ(mergeRenders({{"ab", out}, c}).metadata.at("command"), "pbrt a.pbrt\npbrt --seed 2 a.pbrt");
}

TEST(MergeRenders, SaysWhatTellsScenesApart) {
  const auto part = [](const std::string& seed, const std::string& hash) {
    NamedImage image = render(seed + ".exr", 1, "4", seed);
    image.image.metadata["sceneHash"] = hash;
    image.image.metadata["sceneText"] = "t";
    image.image.metadata["sceneFiles"] = "1f smoke.nvdb\n2f my sky.exr";
    return image;
  };
  const NamedImage a = part("1", "x");
  NamedImage b = part("2", "y");
  b.image.metadata["mediumParams"] = "\"float g\" 0.5";
  expectRefused({a, b},
                "1.exr and 2.exr: different scenes: --mediumparams (none and '\"float g\" 0.5') differs");
  b = part("2", "y");
  b.image.metadata["sceneFiles"] = "1e smoke.nvdb\n2f my sky.exr";
  expectRefused({a, b}, "different scenes: the content of smoke.nvdb differs");
  b.image.metadata["sceneText"] = "u";
  b.image.metadata["sceneFiles"] = "1f smoke.nvdb\n3f other.exr";
  expectRefused({a, b},
                "the text of the scene files, the file my sky.exr (only in the first), the file other.exr "
                "(only in the second) differ");
  expectRefused({a, part("2", "y")}, "nothing else says in what");
  const Image merged = mergeRenders({a, part("2", "x")});
  EXPECT_EQ(merged.metadata.at("sceneText"), "t");
  EXPECT_EQ(merged.metadata.at("sceneFiles"), a.image.metadata.at("sceneFiles"));
}

TEST(MergeRenders, OfOneIsThatOne) {
  const NamedImage a = render("a", 0.3f, "7", "1");
  EXPECT_EQ(mergeRenders({a}).data(), a.image.data());
}

TEST(MergeRenders, RefusesRendersThatDoNotBelongTogether) {
  const NamedImage a = render("a.exr", 1, "4", "1");
  expectRefused({}, "nothing to merge");
  expectRefused({a, render("b.exr", 1, "4", "1")}, "a.exr and b.exr: both used seed 1");
  expectRefused({render("ab.exr", 1, "4", "1,2"), render("b.exr", 1, "4", "2")}, "both used seed 2");
  NamedImage other = render("b.exr", 1, "4", "2");
  other.image.metadata["sceneHash"] = "xyz";
  expectRefused({a, other}, "different scenes");
  other = render("b.exr", 1, "4", "2");
  other.image.metadata.erase("sceneHash");
  expectRefused({a, other}, "no metadata \"sceneHash\"");
  NamedImage larger{"b.exr", Image(3, 1)};
  larger.image.metadata = render("", 1, "4", "2").image.metadata;
  expectRefused({a, larger}, "different sizes");
  other = render("b.exr", 1, "4", "2");
  other.image.dataWindow = {{5, 5}, {7, 6}};
  expectRefused({a, other}, "different windows");
  NamedImage channels{"b.exr", Image(2, 1, {"R", "G", "X"})};
  channels.image.metadata = a.image.metadata;
  expectRefused({a, channels}, "different channels");
}

TEST(MergeRenders, RefusesPartsWhoseBoundsWereStillRising) {
  NamedImage a = render("a.exr", 1, "4", "1"), b = render("b.exr", 1, "4", "2");
  for (const char* state : {"settled", "cached"}) {
    a.image.metadata["boundsState"] = b.image.metadata["boundsState"] = state;
    EXPECT_EQ(mergeRenders({a, b}).metadata.at("boundsState"), state);
  }
  b.image.metadata["boundsState"] = "rising";
  expectRefused({a, b}, "b.exr: its progressive bounds were still rising");
  expectRefused({b, a}, "--bounds-cache");
  EXPECT_EQ(mergeRenders({b}).metadata.at("boundsState"), "rising") << "one alone is what it is";
}

TEST(MergeRenders, RefusesMissingOrSenselessCountsAndSeeds) {
  for (const char* samples : {"", "0", "-4", "many", "nan", "inf", "4 "}) {
    expectRefused({render("a.exr", 1, samples, "1")}, "metadata \"samples\" should be");
  }
  for (const char* seed : {"", "x", "1,", "-1", "1;2"}) {
    expectRefused({render("a.exr", 1, "4", seed)}, "metadata \"seed\" should be");
  }
  NamedImage bare{"a.png", Image(1, 1)};
  bare.image.metadata["sceneHash"] = "abc";
  expectRefused({bare}, "a.png: no metadata \"seed\"");
}

TEST(MergeRenders, RefusesValuesThatAreNotFinite) {
  NamedImage a = render("a.exr", 1, "4", "1");
  a.image.at(1, 0, 2) = std::numeric_limits<float>::quiet_NaN();
  expectRefused({a}, "a.exr: the value at pixel (1, 0) is not finite");
}

}  // namespace
}  // namespace pbrtmedia
