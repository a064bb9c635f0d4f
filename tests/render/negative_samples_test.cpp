// SPDX-License-Identifier: BSD-2-Clause
// Unbiased estimators whose samples may be negative need all of them on the film.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// White light through a cube of optical depth 1, whose medium has `more` parameters.
std::string cube(const std::string& more, int samples = 512) {
  return pencil(4, samples, "\"volpath\"", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .3) + "WorldBegin\n" +
         kWhiteEnvironment + constantMedium(Storage::OneVoxel, 1, 0, 0, {0, 0, 0}, {1, 1, 1}, "m", more) +
         mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
}

/// The bound is 0.6 times the density: each null collision turns the sign.
const std::string kTooLow = R"("string bounds" "constant" "float majorant" .6)";

TEST(NegativeSamples, AreKeptUnderABoundThatIsTooLow) {
  const ZTest test = zTestOfMean(cube(kTooLow, 8192), std::exp(-1));
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees()) << test;
  EXPECT_EQ(renderText(cube(kTooLow), {.seed = 1}).result.counters.droppedTotal(), 0u);
}

TEST(NegativeSamples, WouldBeMissed) {
  const Construction scene = constructText(cube(kTooLow));
  const std::unique_ptr<Sampler> sampler = scene.sampler->clone();
  RenderCounters counters;
  RunningStats cut;
  int negatives = 0;
  for (std::int64_t i = 0; i < 4000; ++i) {
    const Rgb radiance =
        renderSample(*scene.camera, *sampler, samplingIntegrator(scene), {1, 1}, i, 4000, 3, counters);
    negatives += radiance.g < 0;
    cut.add(static_cast<double>(std::max(0.0f, radiance.g)));
  }
  EXPECT_GT(negatives, 100);
  EXPECT_GT(zTest(cut, std::exp(-1)).z(), kMaxAbsZ);
}

TEST(NegativeSamples, AreFaultsWhereNoEstimatorHasThem) {
  const auto keeps = [](const std::string& more) { return constructText(cube(more)).film->keepsNegatives(); };
  EXPECT_FALSE(keeps(""));
  EXPECT_FALSE(keeps(R"("string transmittance" "regular" "string freeflight" "decomposition")"));
  EXPECT_TRUE(keeps(R"("string transmittance" "debiased-ray-marching")"));
  EXPECT_TRUE(keeps(R"("string bounds" "progressive")"));
  EXPECT_TRUE(keeps(kTooLow));
}

}  // namespace
}  // namespace pbrtmedia::test
