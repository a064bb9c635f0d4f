// SPDX-License-Identifier: BSD-2-Clause
// Real PBRT-v3 scenes against images that PBRT-v3 rendered.
//
// The references were rendered with many samples; what noise they have is not known. Ours is measured:
// several seeds give a mean image, the standard error of each of its pixels, and that of its mean. The tests
// ask that the means agree within half a percent plus what our own noise allows for, and that the squared
// distance of the images is no more than a small multiple of our noise. The second needs no less noise than
// the reference has, the first as little as time allows: scenes whose mean is noisy are rendered again for
// it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/compare_images.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr int kSeeds = 8;
constexpr double kMaxMeanDifference = 0.005;  // of the reference's mean
/// The squared distance over the variance of our mean image: 1 when the reference has no noise, more with its
/// noise.
constexpr double kMaxNoiseRatio = 2;

struct ParityScene {
  const char* name;
  std::int64_t
      samples;  ///< per seed and pixel, of the images that are compared; fewer where the scene has fewer
  /// The same of the means: eight seeds bring their standard error to some 0.05 % and for the last two to
  /// 0.15 %.
  std::int64_t samplesOfMean;
  /// The reference has fireflies, whose noise is many times ours, and which decide what of it is dim: only
  /// the mean of all pixels tells something.
  bool hasFireflies = false;
};
constexpr ParityScene kScenes[] = {{"smoke", 16, 16},
                                   {"cylinder", 16, 16},
                                   {"depth-of-field", 16, 16},
                                   {"uber", 16, 16},
                                   {"cornell-box", 16, 16},
                                   {"glass", 16, 32},
                                   {"2d-checkerboard", 16, 32},
                                   {"projection", 16, 128},
                                   {"spotfog", 8, 64},  // with 16 our noise is far below the reference's
                                   {"killeroo-simple", 8, 32},
                                   {"own-hyperboloid", 16, 16},
                                   {"own-disney", 16, 16},
                                   {"own-subsurface", 16, 16},
                                   {"own-subsurface-preset", 16, 16},
                                   {"own-kdsubsurface", 16, 16},
                                   {"own-fourier", 16, 16},
                                   {"own-hair", 16, 16},
                                   {"own-hair-colour", 16, 16},
                                   {"own-ao", 16, 16},
                                   {"own-curve-flat", 16, 64},
                                   {"own-curve-ribbon", 16, 64},
                                   {"own-curve-cylinder", 16, 64},
                                   {"own-realistic", 16, 256},
                                   {"own-path-room", 16, 64},
                                   {"own-volpath-grid", 16, 64},
                                   // Light of the spot near its point in the fog, by the reference's samples
                                   // at collisions; by ours along the ray there is none of that noise.
                                   {"own-volpath-fog", 16, 128, true},
                                   {"own-bdpt-room", 16, 16},
                                   {"own-bdpt-fog", 16, 16},
                                   {"own-bdpt-grid", 8, 16}};

std::ostream& operator<<(std::ostream& os, const ParityScene& scene) { return os << scene.name; }

std::vector<Image> renderSeeds(const std::filesystem::path& scene, std::uint64_t first,
                               std::int64_t samples) {
  std::vector<Image> images;
  for (std::uint64_t seed = first; seed < first + kSeeds; ++seed) {
    images.push_back(renderFile(scene, {.seed = seed, .samplesPerPixel = samples}).image);
  }
  return images;
}

class Parity : public testing::TestWithParam<ParityScene> {};

TEST_P(Parity, AgreesWithPbrtUpToNoise) {
  const auto folder = pbrtSceneFolder();
  if (!folder) GTEST_SKIP() << "the PBRT-v3 scenes are not beside this checkout";
  const std::string name = GetParam().name;
  const std::filesystem::path scene = *folder / (name + ".pbrt");
  const Image reference = readImage(*folder / "reference" / (name + ".exr"));
  const std::vector<Image> images = renderSeeds(scene, 0, GetParam().samples);
  ASSERT_EQ(images[0].width(), reference.width());
  ASSERT_EQ(images[0].height(), reference.height());

  const PixelDistance distance = pixelDistance(images, reference, 1.0 / kSeeds);
  const MeanDistance mean =
      GetParam().samplesOfMean == GetParam().samples
          ? meanDistance(images, reference)
          : meanDistance(renderSeeds(scene, kSeeds, GetParam().samplesOfMean), reference);
  RecordProperty("meanDifference", std::to_string(mean.difference));
  RecordProperty("noiseRatio", std::to_string(distance.squared / distance.variance));
  std::printf(
      "%-18s mean difference %+.4f %% (standard error %.4f %%), dim part %+.4f %% (%.4f %%), squared "
      "distance %.3f of our noise\n",
      name.c_str(), 100 * mean.difference, 100 * mean.standardError, 100 * mean.dimDifference,
      100 * mean.dimError, distance.squared / distance.variance);
  EXPECT_LT(std::abs(mean.difference), kMaxMeanDifference + 3 * mean.standardError);
  if (GetParam().hasFireflies) {
    EXPECT_GT(distance.squared, kMaxNoiseRatio * distance.variance) << "it can be compared, then";
    return;
  }
  EXPECT_LT(std::abs(mean.dimDifference), kMaxMeanDifference + 3 * mean.dimError);
  EXPECT_LT(distance.squared, kMaxNoiseRatio * distance.variance);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Parity, testing::ValuesIn(kScenes), [](const auto& value) {
  std::string name = value.param.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace pbrtmedia::test
