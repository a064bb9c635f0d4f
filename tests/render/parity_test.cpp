// SPDX-License-Identifier: BSD-2-Clause
// Real PBRT-v3 scenes against images that PBRT-v3 rendered.
//
// The references were rendered with many samples; what noise they have is not known. Ours is measured:
// several seeds, each with some of the scene's samples, give a mean image, the standard error of each of its
// pixels, and that of its mean. The tests ask that the means agree within half a percent plus what our own
// noise allows for, and that the squared distance of the images is no more than a small multiple of our
// noise.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr std::int64_t kSamples = 16;  // per seed and pixel; fewer where the scene has fewer
constexpr int kSeeds = 8;
constexpr double kMaxMeanDifference = 0.005;  // of the reference's mean
/// Pixels this many times brighter than the mean (lights in view) are left out of the second comparison, in
/// which their noise would hide everything else. The reference alone decides which.
constexpr double kBright = 4;
/// The squared distance over the variance of our mean image: 1 when the reference has no noise, more with its
/// noise.
constexpr double kMaxNoiseRatio = 2;

class Parity : public testing::TestWithParam<const char*> {};

TEST_P(Parity, AgreesWithPbrtUpToNoise) {
  const auto folder = pbrtSceneFolder();
  if (!folder) GTEST_SKIP() << "the PBRT-v3 scenes are not beside this checkout";
  const std::filesystem::path scene = *folder / (std::string(GetParam()) + ".pbrt");
  const Image reference = readImage(*folder / "reference" / (std::string(GetParam()) + ".exr"));

  const std::int64_t samples = std::string(GetParam()) == "killeroo-simple" ? 8 : kSamples;
  std::vector<Image> images;
  RunningStats means;
  for (int seed = 0; seed < kSeeds; ++seed) {
    images.push_back(
        renderFile(scene, {.seed = static_cast<std::uint64_t>(seed), .samplesPerPixel = samples}).image);
    means.add((imageMean(images.back(), 0) + imageMean(images.back(), 1) + imageMean(images.back(), 2)) / 3);
  }
  ASSERT_EQ(images[0].width(), reference.width());
  ASSERT_EQ(images[0].height(), reference.height());

  double sumReference = 0, sumOurs = 0, squaredDistance = 0, variance = 0;
  for (int y = 0; y < reference.height(); ++y) {
    for (int x = 0; x < reference.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        RunningStats ours;
        for (const Image& image : images) ours.add(image.at(x, y, c));
        const double r = reference.at(x, y, c);
        const double halfSpacing = std::max(std::abs(r), 6e-5) * 0x1p-11;  // the reference is stored as half
        sumReference += r;
        sumOurs += ours.mean();
        squaredDistance += (r - ours.mean()) * (r - ours.mean());
        variance += ours.variance() / kSeeds + halfSpacing * halfSpacing;
      }
    }
  }
  // The same without what outshines the rest.
  RunningStats dimMeans;
  double dimReference = 0;
  const double limit = kBright * sumReference / (3.0 * reference.width() * reference.height());
  for (const Image& image : images) {
    double sum = 0;
    dimReference = 0;
    for (int y = 0; y < reference.height(); ++y) {
      for (int x = 0; x < reference.width(); ++x) {
        if (reference.rgb(x, y).max() > limit) continue;
        sum += image.rgb(x, y).average();
        dimReference += reference.rgb(x, y).average();
      }
    }
    dimMeans.add(sum);
  }
  const double dimDifference = (dimMeans.mean() - dimReference) / dimReference;
  const double dimError = dimMeans.standardError() / dimMeans.mean();

  const double meanDifference = (sumOurs - sumReference) / sumReference;
  const double standardError = means.standardError() / means.mean();
  RecordProperty("meanDifference", std::to_string(meanDifference));
  RecordProperty("noiseRatio", std::to_string(squaredDistance / variance));
  std::printf(
      "%-18s mean difference %+.4f %% (standard error %.4f %%), dim part %+.4f %% (%.4f %%), squared "
      "distance %.3f of our noise\n",
      GetParam(), 100 * meanDifference, 100 * standardError, 100 * dimDifference, 100 * dimError,
      squaredDistance / variance);
  EXPECT_LT(std::abs(meanDifference), kMaxMeanDifference + 3 * standardError);
  EXPECT_LT(std::abs(dimDifference), kMaxMeanDifference + 3 * dimError);
  EXPECT_LT(squaredDistance, kMaxNoiseRatio * variance);
}

INSTANTIATE_TEST_SUITE_P(Scenes, Parity,
                         testing::Values("2d-checkerboard", "cornell-box", "cylinder", "depth-of-field",
                                         "glass", "killeroo-simple", "projection", "smoke", "spotfog",
                                         "uber"),
                         [](const auto& value) {
                           std::string name = value.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace pbrtmedia::test
