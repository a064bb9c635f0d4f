// SPDX-License-Identifier: BSD-2-Clause
// The scenes of our own: each can be rendered as it stands, and is in the gallery.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

const std::filesystem::path kSource = PBRT_MEDIA_SOURCE_DIR;

std::vector<std::string> exampleScenes() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(kSource / "scenes")) {
    if (file.path().extension() == ".pbrt") names.push_back(file.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class ExampleScene : public testing::TestWithParam<std::string> {};

TEST_P(ExampleScene, IsRenderedAsItStands) {
#ifndef PBRT_MEDIA_HAS_NANOVDB
  if (GetParam() == "nanovdb") GTEST_SKIP() << "built without NanoVDB";
#endif
  Diagnostics diagnostics;
  const std::vector<std::filesystem::path> files = {kSource / "scenes" / (GetParam() + ".pbrt")};
  std::vector<SceneDescription> worlds = parseFiles(files, diagnostics);
  ASSERT_EQ(worlds.size(), 1u) << diagnostics.format();
  const Construction scene = constructDescription(worlds.front(), {}, diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  ASSERT_FALSE(scene.scene->media().empty());

  const std::unique_ptr<Sampler> sampler = scene.sampler->clone();
  RenderCounters counters;
  RunningStats luminances;
  const Bounds2i pixels = scene.film->pixelBounds();
  constexpr int kEach = 12;  // pixels of a row and of a column
  for (int i = 0; i < kEach * kEach; ++i) {
    const Point2i pixel{pixels.min.x + (2 * (i % kEach) + 1) * (pixels.max.x - pixels.min.x) / (2 * kEach),
                        pixels.min.y + (2 * (i / kEach) + 1) * (pixels.max.y - pixels.min.y) / (2 * kEach)};
    const Rgb radiance =
        renderSample(*scene.camera, *sampler, *scene.integrator, pixel, 0, 1, /*seed=*/0, counters);
    luminances.add(static_cast<double>(radiance.luminance()));
  }
  EXPECT_GT(luminances.mean(), 0);
  EXPECT_GT(luminances.variance(), 0) << "a picture shows something";
  EXPECT_GT(counters.mediumScatterings, 0u) << "its medium is in view";
  EXPECT_EQ(counters.droppedTotal(), 0u);
  EXPECT_EQ(counters.mediumMismatches, 0u);
}

TEST_P(ExampleScene, IsInTheGallery) {
  std::ifstream in(kSource / "docs" / "gallery.md");
  const std::string gallery{std::istreambuf_iterator<char>(in), {}};
  EXPECT_NE(gallery.find("(../scenes/" + GetParam() + ".pbrt)"), std::string::npos);
  EXPECT_NE(gallery.find("(images/" + GetParam() + ".png)"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_regular_file(kSource / "docs" / "images" / (GetParam() + ".png")));
}

INSTANTIATE_TEST_SUITE_P(All, ExampleScene, testing::ValuesIn(exampleScenes()),
                         [](const auto& value) { return value.param; });

}  // namespace
}  // namespace pbrtmedia::test
