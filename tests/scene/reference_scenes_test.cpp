// SPDX-License-Identifier: BSD-2-Clause
// Real PBRT-v3 scenes, where a checkout has them beside the project.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "scene/parse.h"
#include "scene/print.h"
#include "support/source_dir.h"

namespace pbrtmedia {
namespace {

std::filesystem::path folder() { return test::sourceDir() / "../shared/scenes/pbrt-v3"; }

Parsed parseScene(const std::string& name) {
  Parsed p;
  const std::filesystem::path files[] = {folder() / name};
  p.scenes = parseFiles(files, p.diagnostics);
  return p;
}

#define SKIP_WITHOUT_SCENES() \
  if (!std::filesystem::is_directory(folder())) GTEST_SKIP() << "no scenes at " << folder()

TEST(ReferenceScenes, AllParseWithoutAWord) {
  SKIP_WITHOUT_SCENES();
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() != ".pbrt") continue;
    const Parsed p = parseScene(entry.path().filename().string());
    EXPECT_EQ(p.messages(), "") << entry.path();
    EXPECT_EQ(p.scenes.size(), 1u) << entry.path();
    ++count;
  }
  EXPECT_GE(count, 10u);
}

TEST(ReferenceScenes, SmokeHasItsGridAndItsBox) {
  SKIP_WITHOUT_SCENES();
  Parsed p = parseScene("smoke.pbrt");
  SceneDescription& s = p.scene();
  ASSERT_EQ(s.media.size(), 1u);
  const Param* const density = s.media[0].params.find(ParamKind::Float, "density");
  ASSERT_NE(density, nullptr);
  EXPECT_EQ(density->size(), 100u * 100 * 40);
  const auto& values = std::get<std::vector<float>>(density->values);
  EXPECT_GT(*std::max_element(values.begin(), values.end()), 0.0f);
  const auto box =
      std::find_if(s.shapes.begin(), s.shapes.end(), [](const auto& x) { return x.type == "plymesh"; });
  ASSERT_NE(box, s.shapes.end());
  EXPECT_EQ(box->media->inside.index, 0);
  EXPECT_TRUE(s.materials.at(static_cast<std::size_t>(box->material)).isNone());
  EXPECT_EQ(s.media[0].ctm->start, box->ctm->start);
}

TEST(ReferenceScenes, SpotfogPutsTheCameraIntoTheFog) {
  SKIP_WITHOUT_SCENES();
  Parsed p = parseScene("spotfog.pbrt");
  EXPECT_EQ(p.scene().cameraMedium.name, "vol");
  EXPECT_EQ(p.scene().cameraMedium.index, 0);
  EXPECT_EQ(p.scene().lights.at(0).media->outside.index, 0);
}

TEST(ReferenceScenes, KillerooIncludesItsMeshTwice) {
  SKIP_WITHOUT_SCENES();
  Parsed p = parseScene("killeroo-simple.pbrt");
  const auto& shapes = p.scene().shapes;
  EXPECT_EQ(std::count_if(shapes.begin(), shapes.end(),
                          [](const auto& s) {
                            return s.location.file->find("geometry/killeroo.pbrt") != std::string::npos;
                          }),
            2);
}

TEST(ReferenceScenes, PrintingIsStable) {
  SKIP_WITHOUT_SCENES();
  for (const auto& entry : std::filesystem::directory_iterator(folder())) {
    if (entry.path().extension() != ".pbrt") continue;
    Diagnostics d;
    std::ostringstream once, twice;
    const std::filesystem::path files[] = {entry.path()};
    printFiles(files, once, d);
    printText(once.str(), "copy", folder(), twice, d);
    EXPECT_EQ(d.format(), "");
    EXPECT_EQ(once.str(), twice.str()) << entry.path();
  }
}

}  // namespace
}  // namespace pbrtmedia
