// SPDX-License-Identifier: BSD-2-Clause
// The image depends on scene and seed, bit for bit.
#include <gtest/gtest.h>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// Surfaces, a map-free sky, a small light and smoke, with a wide filter: everything that shares state.
std::string busyScene(const std::string& sampler) {
  return "Film \"image\" \"integer xresolution\" 45 \"integer yresolution\" 37 \"float cropwindow\" [ 0.1 "
         "0.95 0 0.9 ]\n"
         "PixelFilter \"mitchell\"\nSampler \"" +
         sampler + "\"\n" +
         "Integrator \"volpath\" \"integer maxdepth\" 6\nLookAt 0 1 -7  0 0 0  0 1 0\n"
         "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.02 \"float focaldistance\" "
         "7\nWorldBegin\n" +
         kWhiteEnvironment +
         "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 9 8 7 ]\nTranslate 1 3 -1\n"
         "Shape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n" +
         constantMedium(Storage::OneVoxel, 0.2, 1.5, 0.4, {-1, -1, -1}, {1, 1, 1}) +
         mediumBox("m", {-1, -1, -1}, {1, 1, 1}) +
         "Material \"plastic\"\nTranslate 0 -1 0\nRotate -90 1 0 0\nShape \"disk\" \"float radius\" "
         "4\nWorldEnd\n";
}

class Determinism : public testing::TestWithParam<const char*> {};

TEST_P(Determinism, HoldsOverThreadsTilesAndRuns) {
  const std::string scene = busyScene(GetParam());
  const Rendered one = renderText(scene, {.seed = 9, .threads = 1, .tileSize = 16});
  ASSERT_GT(imageMean(one.image), 0.05);
  for (const RenderSettings& settings : {RenderSettings{9, 1, 16, {}}, RenderSettings{9, 2, 16, {}},
                                         RenderSettings{9, 5, 16, {}}, RenderSettings{9, 2, 7, {}}}) {
    const Rendered other = renderText(scene, settings);
    EXPECT_EQ(one.image.data(), other.image.data())
        << settings.threads << " threads, tiles of " << settings.tileSize;
    EXPECT_EQ(one.result.counters.densityLookups, other.result.counters.densityLookups);
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
  }
}

TEST_P(Determinism, AnotherSeedGivesAnotherImage) {
  const std::string scene = busyScene(GetParam());
  EXPECT_NE(renderText(scene, {.seed = 9}).image.data(), renderText(scene, {.seed = 10}).image.data());
}

TEST(DeterminismOfPhotons, HoldsOverThreadsAndTiles) {
  std::string scene = busyScene("random");
  const std::string volpath = "\"volpath\" \"integer maxdepth\" 6";
  scene.replace(scene.find(volpath), volpath.size(),
                "\"sppm\" \"integer maxdepth\" 6 \"integer iterations\" 3 \"float radius\" .3");
  const Rendered one = renderText(scene, {.seed = 9, .threads = 1, .tileSize = 16});
  ASSERT_GT(imageMean(one.image), 0.05);
  for (const RenderSettings& settings : {RenderSettings{9, 2, 16, {}}, RenderSettings{9, 5, 7, {}}}) {
    const Rendered other = renderText(scene, settings);
    EXPECT_EQ(one.image.data(), other.image.data()) << settings.threads << " threads";
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
  }
  EXPECT_NE(one.image.data(), renderText(scene, {.seed = 10}).image.data());
}

/// Whoever asks first finds the explorers of a block of pixels.
TEST(DeterminismOfSharedExplorers, HoldsOverThreadsTilesCropsAndSingleSamples) {
  std::string scene = busyScene("random");
  const std::string depth = "\"integer maxdepth\" 6";
  scene.replace(scene.find(depth), depth.size(), "\"string mediumlightsampling\" \"source-scattering-mis\"");
  const std::string constant = constantMedium(Storage::OneVoxel, 0.2, 1.5, 0.4, {-1, -1, -1}, {1, 1, 1});
  scene.replace(
      scene.find(constant), constant.size(),
      "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 "
      "1 ] "
      "\"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 3 \"float density\" [ 0 1 2 .5  1 3 0 1  2 0 1 4 ] "
      "\"rgb sigma_a\" [ .2 .1 .3 ] \"rgb sigma_s\" [ .8 .9 .7 ]\n");
  scene.insert(scene.find("AttributeBegin"), "LightSource \"point\" \"point from\" [ .2 .3 -.4 ]\n");
  const Rendered one = renderText(scene, {.seed = 9, .threads = 1, .tileSize = 16, .samplesPerPixel = 2});
  ASSERT_GT(imageMean(one.image), 0.05);
  for (const RenderSettings& settings : {RenderSettings{9, 2, 16, 2}, RenderSettings{9, 5, 7, 2},
                                         RenderSettings{9, 1, 1, 2}, RenderSettings{9, 2, 3, 2}}) {
    const Rendered other = renderText(scene, settings);
    EXPECT_EQ(one.image.data(), other.image.data())
        << settings.threads << " threads, tiles of " << settings.tileSize;
  }
  const Construction made = constructText(scene, {.seed = 9, .samplesPerPixel = 2});
  const std::unique_ptr<Sampler> sampler = made.sampler->clone();
  const auto memory = samplingIntegrator(made).tileMemory(*made.camera, 9);
  ASSERT_TRUE(memory);
  RenderCounters counters;
  for (int i = 0; i < 60; ++i) {
    const Point2i pixel{20 + i % 5, 14 + i % 7};
    const auto sample = [&](TileMemory* shared) {
      return renderSample(*made.camera, *sampler, samplingIntegrator(made), pixel, i % 2, 2, 9, counters,
                          {.memory = shared});
    };
    EXPECT_EQ(sample(memory.get()), sample(nullptr)) << i;
  }
  EXPECT_GT(memory->lookups(), 0u);
  EXPECT_LT(memory->lookups(), 6u * 60u) << "several pixels share them";
  // Another seed explores elsewhere.
  const auto elsewhere = samplingIntegrator(made).tileMemory(*made.camera, 10);
  bool differs = false;
  for (int i = 0; i < 20 && !differs; ++i) {
    const auto sample = [&](TileMemory* shared) {
      return renderSample(*made.camera, *sampler, samplingIntegrator(made), {21, 15}, i, 20, 9, counters,
                          {.memory = shared});
    };
    differs = sample(memory.get()) != sample(elsewhere.get());
  }
  EXPECT_TRUE(differs);
}

INSTANTIATE_TEST_SUITE_P(AllSamplers, Determinism,
                         testing::Values("random", "stratified", "halton", "sobol", "02sequence",
                                         "maxmindist"),
                         [](const auto& value) { return std::string(value.param); });

}  // namespace
}  // namespace pbrtmedia::test
