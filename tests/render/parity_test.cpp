// SPDX-License-Identifier: BSD-2-Clause
// Real PBRT-v3 scenes against images that PBRT-v3 rendered.
//
// The reference is one image of unknown noise. Our noise is measured: the mean image of several seeds and the
// variance between them. If both programs compute the same expectation with the same number of samples of the
// same sampler, then the squared distance of the reference to our mean is, on average over the image, the
// variance of one image (theirs) plus that of our mean. The test asks that it is not more than a small
// multiple of that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr int kSeeds = 4;
constexpr double kMaxMeanDifference = 0.005;  // of the reference's mean
/// Their variance over ours, per pixel: other scrambling of the samples, half-float storage, clumped noise.
constexpr double kMaxNoiseRatio = 2.5;

class Parity : public testing::TestWithParam<const char*> {};

TEST_P(Parity, AgreesWithPbrtUpToNoise) {
  const auto folder = pbrtSceneFolder();
  if (!folder) GTEST_SKIP() << "the PBRT-v3 scenes are not beside this checkout";
  const std::filesystem::path scene = *folder / (std::string(GetParam()) + ".pbrt");
  const Image reference = readImage(*folder / "reference" / (std::string(GetParam()) + ".exr"));

  std::vector<Image> images;
  for (int seed = 0; seed < kSeeds; ++seed) {
    images.push_back(renderFile(scene, {.seed = static_cast<std::uint64_t>(seed)}).image);
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
        variance += ours.variance() * (1 + 1.0 / kSeeds) + halfSpacing * halfSpacing;
      }
    }
  }
  const double meanDifference = (sumOurs - sumReference) / sumReference;
  RecordProperty("meanDifference", std::to_string(meanDifference));
  RecordProperty("noiseRatio", std::to_string(squaredDistance / variance));
  std::printf("%-18s mean difference %+.4f %%, squared distance %.3f of the noise\n", GetParam(),
              100 * meanDifference, squaredDistance / variance);
  EXPECT_LT(std::abs(meanDifference), kMaxMeanDifference);
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
