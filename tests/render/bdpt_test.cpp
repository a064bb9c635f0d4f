// SPDX-License-Identifier: BSD-2-Clause
// What is particular to bidirectional path tracing; its images are those of other integrators
// (integrators_agree_test.cpp).
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "film/splat_buffer.h"
#include "integrators/bdpt/bdpt.h"
#include "lighting/light_strategy.h"
#include "render/agreement_scenes.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr std::uint64_t kSeeds = 48;

/// The mean over the image of one seed, with one strategy left out, or none.
double meanWithout(const std::string& text, std::uint64_t seed, std::optional<BdptParams::Strategy> leftOut) {
  const Construction made = constructText(text, {.seed = seed});
  const auto selector = [&] {
    return makeLightSelector(LightStrategy::Power, made.scene->illuminants(), made.scene->bounds());
  };
  const BdptIntegrator integrator(*made.scene, {.maxDepth = 2, .leftOut = leftOut}, selector(), selector(),
                                  CameraMedium(*made.scene, {0, -4, 1.6f}, 0));
  integrator.render(*made.camera, *made.sampler, *made.film, {.seed = seed});
  return imageMean(made.film->develop(), 1);
}

// The same random numbers with and without: what is missing is what the strategy finds.
TEST(Bdpt, IsDarkerWithoutAnyOfItsStrategies) {
  const std::string text = textOf({"", kFloor + kBall + kLamp + inBox(kSmoke), 16, "", 2}, "bdpt");
  for (int depth = 1; depth <= 2; ++depth) {
    for (int s = 0; s <= depth + 1; ++s) {
      RunningStats missing;
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const double all = meanWithout(text, seed, std::nullopt);
        missing.add(1 - meanWithout(text, seed, BdptParams::Strategy{s, depth + 2 - s}) / all);
      }
      const ZTest test = zTest(missing, 0, 1);
      EXPECT_GT(test.z(), kMaxAbsZ) << "s " << s << ", t " << depth + 2 - s << ": " << test;
      std::printf("without s %d, t %d: darker by %.3f %%\n", s, depth + 2 - s, 100 * missing.mean());
    }
  }
}

/// Paths of a few vertices neither need memory for, nor depend on, what they might have had.
TEST(Bdpt, IsTheSameWhateverMaxDepthBeyondItsPaths) {
  const auto image = [](int maxDepth) {
    return renderText(textOf({"", kFloor + kLamp, 1, "", maxDepth}, "bdpt"), {.seed = 3}).image;
  };
  const Image deep = image(1 << 30);
  EXPECT_EQ(image(200).data(), deep.data());
  EXPECT_NE(image(1).data(), deep.data());
}

/// What light paths would bring to other pixels is then left to the paths of each pixel itself.
TEST(Bdpt, IsThatOfVolpathWhereNobodyWantsSplats) {
  const auto mean = [](const std::string& integrator, bool splats, std::uint64_t firstSeed) {
    const Construction made = constructText(textOf({"", kFloor + kLamp, 1, "", 2}, integrator));
    RunningStats means;
    RenderCounters counters;
    for (std::uint64_t seed = firstSeed; seed < firstSeed + 2000; ++seed) {
      const std::unique_ptr<Sampler> sampler = made.sampler->clone();
      SplatBuffer nobodys;
      double sum = 0;
      for (int i = 0; i < kAgreementResolution * kAgreementResolution; ++i) {
        sum += double{renderSample(*made.camera, *sampler, samplingIntegrator(made),
                                   {i % kAgreementResolution, i / kAgreementResolution},
                                   static_cast<std::int64_t>(seed), 1, seed, counters,
                                   {.splats = splats ? &nobodys : nullptr})
                          .g};
      }
      means.add(sum);
    }
    return means;
  };
  const RunningStats truth = mean("volpath", false, 1);
  const ZTest without = zTest(mean("bdpt", false, 10000), truth),
              withSplats = zTest(mean("bdpt", true, 10000), truth);
  EXPECT_LT(std::abs(without.z()), kMaxAbsZ) << without;
  EXPECT_TRUE(without.sees(.03)) << without;
  EXPECT_LT(withSplats.mean, .97 * truth.mean()) << "control: splats are a part of the light";
}

/// Smooth normals of the floor that lean away from the wall. Where a surface faces light but its normal does
/// not, light samples find that, and scattered rays never do: what comes from the wall is missing from the
/// images of `path` and `volpath`, as in PBRT-v3. Paths from both ends find it, and so do photons, where the
/// camera sees such a surface.
TEST(Bdpt, SeesBeyondTheHorizonOfShadingNormalsAsPhotonsDo) {
  const std::string leaning =
      "Material \"matte\" \"rgb Kd\" [ .8 .8 .8 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 "
      "] "
      "\"point P\" [ -2 -2 0 2 -2 0 2 2 0 -2 2 0 ] \"normal N\" [ 0 -1 .3 0 -1 .3 0 -1 .3 0 -1 .3 ]\n"
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 1.5 0 2 1.5 0 2 1.5 3 -2 "
      "1.5 3 ]\nLightSource \"point\" \"point from\" [ -.6 .2 2 ] \"rgb I\" [ 5 5 5 ]\n";
  // The lowest row, which sees the floor alone.
  const auto means = [&](const std::string& integrator, int depth, const std::string& parameters = "") {
    std::string text = textOf({"", leaning, depth == 1 ? 4096 : 512, "", depth}, integrator);
    text.insert(text.find("\"image\"") + 7, " \"float cropwindow\" [ 0 1 .8 1 ]");
    text.insert(text.find("\nLookAt"), parameters);
    RunningStats all;
    for (std::uint64_t seed = 1; seed <= 16; ++seed)
      all.add(imageMean(renderText(text, {.seed = seed}).image, 1));
    return all;
  };
  const ZTest direct = zTest(means("bdpt", 1), means("volpath", 1));
  EXPECT_LT(std::abs(direct.z()), kMaxAbsZ) << direct;
  EXPECT_TRUE(direct.sees()) << direct;
  const RunningStats bdpt = means("bdpt", 2);
  const ZTest photons =
      zTest(means("sppm", 2,
                  " \"integer photonsperiteration\" 20000 \"integer iterations\" 64 \"float "
                  "radius\" .1"),
            bdpt);
  EXPECT_LT(std::abs(photons.z()), kMaxAbsZ) << photons;
  EXPECT_TRUE(photons.sees(.1)) << photons;
  const ZTest paths = zTest(means("volpath", 2), bdpt);
  EXPECT_LT(paths.mean, .7 * bdpt.mean()) << paths;
  std::printf("beyond the horizon: bdpt %.4f, sppm %.4f, volpath %.4f\n", bdpt.mean(), photons.mean,
              paths.mean);
}

TEST(Bdpt, TakesTheSameBitsForAnyThreadsAndTiles) {
  const std::string text =
      "Film \"image\" \"integer xresolution\" 37 \"integer yresolution\" 29 \"float cropwindow\" [ .1 .95 0 "
      ".9 ]\n"
      "PixelFilter \"mitchell\"\nSampler \"halton\" \"integer pixelsamples\" 4\n"
      "Integrator \"bdpt\" \"integer maxdepth\" 5\nLookAt 0 -4 1.6  0 0 .9  0 0 1\nCamera "
      "\"perspective\"\nWorldBegin\n" +
      kFloor + kBall + kLamp + inBox(gridMedium("\"string bounds\" \"progressive\" ")) + "WorldEnd\n";
  const Rendered one = renderText(text, {.seed = 9, .threads = 1, .tileSize = 16});
  ASSERT_GT(imageMean(one.image), .05);
  for (const RenderSettings& settings : {RenderSettings{9, 3, 16, {}}, RenderSettings{9, 3, 7, {}}}) {
    const Rendered other = renderText(text, settings);
    EXPECT_EQ(one.image.data(), other.image.data())
        << settings.threads << " threads, tiles of " << settings.tileSize;
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
  }
}

}  // namespace
}  // namespace pbrtmedia::test
