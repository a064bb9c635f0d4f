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

INSTANTIATE_TEST_SUITE_P(AllSamplers, Determinism,
                         testing::Values("random", "stratified", "halton", "sobol", "02sequence",
                                         "maxmindist"),
                         [](const auto& value) { return std::string(value.param); });

}  // namespace
}  // namespace pbrtmedia::test
