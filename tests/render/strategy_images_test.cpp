// SPDX-License-Identifier: BSD-2-Clause
// The images that bdpt makes of its strategies.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "film/side_images.h"
#include "integrators/bdpt/strategy_images.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// A lamp that reflects, a floor and a wall that touch nowhere: all strategies find paths between them, at
/// bounded distances.
const std::string kSurfaces =
    "Material \"matte\" \"rgb Kd\" [ .8 .7 .6 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 0 2 -2 0 2 2 0 -2 2 0 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 2.3 .3 2 2.3 .3 2 2.3 3 -2 "
    "2.3 "
    "3 ]\n"
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 3 3 2 ]\nMaterial \"matte\" \"rgb Kd\" [ .9 .9 "
    ".9 "
    "]\nShape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2 ] \"point P\" [ -1 -1 1.8 1 -1 1.8 1 1 1.8 "
    "-1 "
    "1 1.8 ]\nAttributeEnd\n";
const std::string kMore =
    "LightSource \"point\" \"point from\" [ -1.2 -.9 1 ] \"rgb I\" [ .5 .4 .3 ]\n" + kWhiteEnvironment +
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [ 1 .6 .3 ] \"rgb sigma_a\" [ .3 .3 .3 "
    "] "
    "\"rgb sigma_s\" [ 1 .8 .6 ]\n" +
    mediumBox("m", {-.6, -.6, .2}, {.6, .6, 1.1}) +
    "AttributeBegin\nMaterial \"glass\"\nTranslate 1 .2 .5\nShape \"sphere\" \"float radius\" "
    ".3\nAttributeEnd\n";

std::string textOf(const std::string& world, const std::string& integrator, int samples,
                   const std::string& film = "") {
  return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 6 " + film +
         "\nPixelFilter \"box\"\nSampler \"random\" \"integer pixelsamples\" " + std::to_string(samples) +
         "\nIntegrator " + integrator +
         "\nLookAt 0 -4 1.6  0 0 .6  0 0 1\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n" + world +
         "WorldEnd\n";
}

struct Shown {
  Image image;
  std::vector<SideImage> names;
  std::vector<Image> sides;
};

Shown render(const std::string& text, std::uint64_t seed, unsigned threads = 0, int tileSize = 16,
             std::optional<int> samplesPerPass = std::nullopt) {
  const ThreadLimit limit(threads);
  const Construction made = constructText(text, {.seed = seed});
  Shown shown{{}, made.integrator->sideImages(), {}};
  SideImages sides(shown.names, made.film->settings().resolution);
  made.integrator->render(
      *made.camera, *made.sampler, *made.film,
      {.seed = seed, .tileSize = tileSize, .samplesPerPass = samplesPerPass, .sides = &sides});
  shown.image = made.film->develop();
  for (std::size_t i = 0; i < sides.count(); ++i) shown.sides.push_back(sides.develop(i));
  return shown;
}

TEST(StrategyImages, HaveTheNamesOfPbrtV3) {
  const std::vector<SideImage> images = strategyImages(2);
  const std::vector<std::string> expected = {
      "bdpt_d00_s00_t02.exr", "bdpt_d01_s00_t03.exr", "bdpt_d01_s01_t02.exr", "bdpt_d01_s02_t01.exr",
      "bdpt_d02_s00_t04.exr", "bdpt_d02_s01_t03.exr", "bdpt_d02_s02_t02.exr", "bdpt_d02_s03_t01.exr"};
  ASSERT_EQ(images.size(), expected.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    EXPECT_EQ(images[i].name, expected[i]);
    EXPECT_EQ(images[i].isFromLights, images[i].name.substr(13, 3) == "t01") << images[i].name;
  }
  const std::vector<SideImage> all = strategyImages(kMostShownDepth);
  EXPECT_EQ(all.size(), 26u);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string& name = all[i].name;
    EXPECT_EQ(strategyImage(static_cast<std::size_t>(std::stoi(name.substr(10, 2))),
                            static_cast<std::size_t>(std::stoi(name.substr(14, 2)))),
              i)
        << name;
  }
}

/// Up to the rounding of single precision; the same samples.
TEST(StrategyImages, WeightedAddUpToTheImage) {
  const std::string weighted = "\"bdpt\" \"integer maxdepth\" 4 \"bool visualizeweights\" \"true\"";
  for (const std::string film : {"", "\"float cropwindow\" [ .25 .75 0 .5 ]"}) {
    const Shown shown = render(textOf(kSurfaces + kMore, weighted, 16, film), 5);
    ASSERT_EQ(shown.sides.size(), strategyImages(4).size());
    ASSERT_GT(imageMean(shown.image), .1);
    const Bounds2i window = shown.image.dataWindow;
    for (int y = window.min.y; y < window.max.y; ++y) {
      for (int x = window.min.x; x < window.max.x; ++x) {
        Rgb sum;
        for (const Image& side : shown.sides) sum += side.rgb(x, y);
        const Rgb all = shown.image.rgb(x - window.min.x, y - window.min.y);
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_NEAR(sum[c], all[c], 1e-5f * (1 + all[c])) << x << ' ' << y;
      }
    }
    // Control: all of them bring something.
    for (std::size_t i = 0; i < shown.sides.size(); ++i)
      EXPECT_GT(imageMean(shown.sides[i]), 0) << shown.names[i].name;
  }
}

TEST(StrategyImages, AreTheSameBitsForAnyThreadsTilesAndPasses) {
  const std::string text =
      textOf(kSurfaces + kMore, "\"bdpt\" \"integer maxdepth\" 3 \"bool visualizestrategies\" \"true\"", 6);
  const Shown one = render(text, 9, 1);
  for (const Shown& other : {render(text, 9, 3, 5), render(text, 9, 2, 16, 1)}) {
    for (std::size_t i = 0; i < one.sides.size(); ++i)
      EXPECT_EQ(one.sides[i].data(), other.sides[i].data()) << one.names[i].name;
  }
  EXPECT_NE(one.sides[2].data(), render(text, 10, 1).sides[2].data());
}

TEST(StrategyImages, LeaveTheImageAsItIs) {
  const auto image = [](const std::string& more) {
    return render(textOf(kSurfaces + kMore, "\"bdpt\" \"integer maxdepth\" 3 " + more, 4), 2).image;
  };
  const Image plain = image("");
  EXPECT_EQ(image("\"bool visualizestrategies\" \"true\"").data(), plain.data());
  EXPECT_EQ(image("\"bool visualizeweights\" \"true\"").data(), plain.data());
}

/// Each finds every path here, so that without weights each makes the whole light of its depth.
TEST(StrategyImages, UnweightedAreEachTheLightOfTheirDepth) {
  constexpr int kDepth = 2, kSamples = 128;
  constexpr std::uint64_t kSeeds = 24;
  std::array<RunningStats, kDepth + 1> light;  // of paths of one length, by paths from the camera
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    double shorter = 0;
    for (int depth = 0; depth <= kDepth; ++depth) {
      // The same random numbers: what differs is the light of the longest paths alone.
      const double all = imageMean(
          render(textOf(kSurfaces, "\"volpath\" \"integer maxdepth\" " + std::to_string(depth), kSamples),
                 seed)
              .image);
      light[static_cast<std::size_t>(depth)].add(all - shorter);
      shorter = all;
    }
  }
  const auto means = [&](const std::string& view) {
    const std::string text =
        textOf(kSurfaces,
               "\"bdpt\" \"integer maxdepth\" " + std::to_string(kDepth) + " \"bool " + view + "\" \"true\"",
               kSamples);
    std::vector<RunningStats> all(strategyImages(kDepth).size());
    for (std::uint64_t seed = 1001; seed <= 1000 + kSeeds; ++seed) {
      const Shown shown = render(text, seed);
      for (std::size_t i = 0; i < all.size(); ++i) all[i].add(imageMean(shown.sides[i]));
    }
    return all;
  };
  const std::vector<SideImage> names = strategyImages(kDepth);
  const std::vector<RunningStats> unweighted = means("visualizestrategies"),
                                  weighted = means("visualizeweights");
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto depth = static_cast<std::size_t>(std::stoi(names[i].name.substr(6, 2)));
    const ZTest test = zTest(unweighted[i], light[depth]);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << names[i].name << ": " << test;
    EXPECT_TRUE(test.sees(.15)) << names[i].name << ": " << test;
    if (depth == 0) continue;
    const ZTest control = zTest(weighted[i], light[depth]);
    EXPECT_LT(control.z(), -kMaxAbsZ) << names[i].name << ": weights must take something away: " << control;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
