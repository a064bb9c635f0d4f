// SPDX-License-Identifier: BSD-2-Clause
// The scenes of our own: each can be rendered as it stands, and is in the gallery.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "fields/exploration.h"
#include "fields/learned_bounds.h"
#include "media/medium.h"
#include "scene/param_reader.h"
#include "support/render_scene.h"
#include "support/source_dir.h"

namespace pbrtmedia::test {
namespace {

const std::filesystem::path kSource = test::sourceDir();

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
        renderSample(*scene.camera, *sampler, samplingIntegrator(scene), pixel, 0, 1, /*seed=*/0, counters);
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

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The names X of all "images/X.png" in a text.
std::vector<std::string> picturesIn(const std::string& text) {
  static const std::regex kPicture(R"re(images/([^\s)"]+)\.png)re");
  std::vector<std::string> names;
  for (std::sregex_iterator at(text.begin(), text.end(), kPicture), end; at != end; ++at) {
    names.push_back((*at)[1]);
  }
  return names;
}

/// scripts/make_pictures.sh makes what docs/gallery.md shows, from the scene of the same name.
TEST(Pictures, AllOfThemAreMadeByTheScript) {
  const std::vector<std::string> made = picturesIn(textOf(kSource / "docs" / "gallery.md"));
  ASSERT_FALSE(made.empty());
  EXPECT_NE(textOf(kSource / "scripts" / "make_pictures.sh").find("docs/gallery.md"), std::string::npos);
  const auto isMade = [&](const std::string& name) {
    return std::find(made.begin(), made.end(), name) != made.end();
  };
  std::vector<std::filesystem::path> texts = {kSource / "README.md"};
  for (const auto& file : std::filesystem::directory_iterator(kSource / "docs")) {
    if (file.path().extension() == ".md") texts.push_back(file.path());
  }
  for (const std::filesystem::path& file : texts) {
    for (const std::string& name : picturesIn(textOf(file)))
      EXPECT_TRUE(isMade(name)) << file << ": " << name;
  }
  std::uintmax_t all = 0;
  for (const auto& file : std::filesystem::directory_iterator(kSource / "docs" / "images")) {
    EXPECT_TRUE(isMade(file.path().stem().string())) << file.path();
    EXPECT_LT(file.file_size(), 500'000u) << file.path();
    all += file.file_size();
  }
  EXPECT_LT(all, 3'000'000u);
}

/// Plots and screenshots, docs/plots: each is shown by a page.
TEST(Pictures, PlotsStandInAPage) {
  std::string texts;
  for (const auto& file : std::filesystem::directory_iterator(kSource / "docs")) {
    if (file.path().extension() == ".md") texts += textOf(file.path());
  }
  std::uintmax_t all = 0;
  for (const auto& file : std::filesystem::directory_iterator(kSource / "docs" / "plots")) {
    EXPECT_NE(texts.find("(plots/" + file.path().filename().string() + ")"), std::string::npos)
        << file.path();
    all += file.file_size();
  }
  EXPECT_GT(all, 0u);
  EXPECT_LT(all, 3'000'000u);
}

/// The ```pbrt blocks of a page, in order.
std::vector<std::string> snippetsOf(const std::string& page) {
  std::vector<std::string> snippets;
  std::istringstream lines(page);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "```pbrt") snippets.emplace_back();
    inside = line == "```pbrt" || (inside && line != "```");
    if (inside && line != "```pbrt") snippets.back() += line + '\n';
  }
  return snippets;
}

/// Whoever copies an example sees a shape: neither black, nor white, nor one colour.
TEST(DocumentedExample, ShowsAShapeAsItStands) {
  const std::vector<std::string> snippets = snippetsOf(textOf(kSource / "docs" / "scene-language.md"));
  ASSERT_GE(snippets.size(), 9u);
  for (const std::string& snippet : snippets) {
    SCOPED_TRACE(snippet);
    Diagnostics diagnostics;
    SceneDescription world = parsedWorld(snippet, kSource / "docs", diagnostics);
    ConstructOptions options;
    options.outfile = "unused.exr";
    options.quick = true;
    options.samplesPerPixel = 4;
    const std::optional<Construction> scene = construct(world, options, diagnostics);
    ASSERT_TRUE(scene) << diagnostics.format();
    const RenderResult result =
        scene->integrator->render(*scene->camera, *scene->sampler, *scene->film, RenderOptions());
    const Image image = scene->film->develop();
    RunningStats luminances;  // of pixels
    int white = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        const double luminance = image.rgb(x, y).luminance();
        luminances.add(luminance);
        white += luminance >= 1 ? 1 : 0;
      }
    }
    EXPECT_GT(luminances.mean(), 0.005);
    EXPECT_LT(luminances.mean(), 0.7);
    EXPECT_LT(white, image.width() * image.height() / 3);
    EXPECT_GT(luminances.variance(), 1e-4) << "one colour";
    EXPECT_EQ(result.counters.droppedTotal(), 0u);
  }
}

TEST_P(ExampleScene, HasAPictureOfItsOwnSize) {
  Diagnostics diagnostics;
  const std::vector<std::filesystem::path> files = {kSource / "scenes" / (GetParam() + ".pbrt")};
  std::vector<SceneDescription> worlds = parseFiles(files, diagnostics);
  ASSERT_EQ(worlds.size(), 1u) << diagnostics.format();
  const std::string png = textOf(kSource / "docs" / "images" / (GetParam() + ".png"));
  ASSERT_GT(png.size(), 24u);
  const auto sideAt = [&](std::size_t at) {  // of the header, big-endian
    int side = 0;
    for (std::size_t i = 0; i < 4; ++i) side = 256 * side + static_cast<unsigned char>(png[at + i]);
    return side;
  };
  ParamReader film(worlds.front().film, diagnostics, "film");
  EXPECT_EQ(sideAt(16), film.findInt("xresolution", 0));
  EXPECT_EQ(sideAt(20), film.findInt("yresolution", 0));
}

INSTANTIATE_TEST_SUITE_P(All, ExampleScene, testing::ValuesIn(exampleScenes()),
                         [](const auto& value) { return value.param; });

}  // namespace
}  // namespace pbrtmedia::test
