// SPDX-License-Identifier: BSD-2-Clause
// Every construct that PBRT-v3 renders in spite of a mistake is rendered as there, with a warning that is an
// error with --strict. The table is in corpus.h.
#include "render/corpus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "support/compare_images.h"
#include "support/render_scene.h"
#include "support/source_dir.h"

namespace pbrtmedia::test {
namespace {

constexpr int kSeeds = 8;

std::string identifier(std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '-' || c == ' '; }, '_');
  return name;
}

// ---- Scenes of our own --------------------------------------------------------------------------------

std::string wholeText(const CorpusScene& scene) {
  const std::string film =
      "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16 \"string filename\" "
      "\"unused.exr\"\n"
      "Sampler \"random\" \"integer pixelsamples\" " +
      std::to_string(scene.samples) + "\n";
  if (scene.text.find("WorldBegin") != scene.text.npos) return film + scene.text;
  return film + kCamera + scene.text + "\nWorldEnd\n";
}

class Corpus : public testing::TestWithParam<CorpusScene> {};

TEST_P(Corpus, ShowsWhatPbrtShows) {
  const std::string text = wholeText(GetParam());
  std::vector<Image> images;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed)
    images.push_back(renderText(text, {.seed = seed}).image);
  for (const ExpectedBlock& block : GetParam().blocks) {
    for (std::size_t c = 0; c < 3; ++c) {
      RunningStats means;
      for (const Image& image : images) {
        double sum = 0;
        for (int y = 4 * block.y; y < 4 * block.y + 4; ++y) {
          for (int x = 4 * block.x; x < 4 * block.x + 4; ++x) sum += image.at(x, y, c);
        }
        means.add(sum / 16);
      }
      const ZTest test = zTest(means, block.rgb[c], 1);
      // Where nothing is random, what is left is the rounding of pixels to float.
      const double rounding = 1e-6 * std::abs(block.rgb[c]);
      EXPECT_TRUE(std::abs(test.mean - test.truth) <= rounding || std::abs(test.z()) < kMaxAbsZ)
          << "block (" << block.x << ", " << block.y << "), channel " << c << ": " << test;
    }
  }
}

TEST_P(Corpus, SaysSoAndIsRefusedWhenStrict) {
  const std::string text = wholeText(GetParam());
  for (const bool strict : {false, true}) {
    Diagnostics diagnostics;
    diagnostics.strict = strict;
    std::vector<SceneDescription> worlds = parseText(text, "test.pbrt", ".", diagnostics);
    if (!diagnostics.hasErrors() && worlds.size() == 1) {
      ConstructOptions options;
      options.outfile = "unused.exr";
      construct(worlds.front(), options, diagnostics);
    }
    if (GetParam().said.empty()) {
      EXPECT_FALSE(diagnostics.hasErrors()) << diagnostics.format();
      continue;
    }
    const bool found =
        std::any_of(diagnostics.all().begin(), diagnostics.all().end(), [&](const Diagnostic& d) {
          return d.severity == (strict ? Severity::Error : Severity::Warning) &&
                 d.message.find(GetParam().said) != d.message.npos &&
                 d.message.find("--strict") != d.message.npos && d.location.line > 0;
        });
    EXPECT_TRUE(found) << (strict ? "strict: " : "") << diagnostics.format();
    EXPECT_EQ(diagnostics.hasErrors(), strict) << diagnostics.format();
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Corpus, testing::ValuesIn(corpus()),
                         [](const auto& value) { return identifier(value.param.name); });

// ---- Scenes that PBRT-v3 rendered ----------------------------------------------------------------------

std::filesystem::path caseFolder() { return test::sourceDir() / ".." / "shared" / "cases"; }

constexpr double kMaxMeanDifference = 0.005;  // of the reference's mean, as in parity_test.cpp
/// The references have about the noise of our mean image: what both explain is twice that.
constexpr double kNoises = 2.0 / kSeeds;
constexpr double kMaxNoiseRatio = 2;  // squared distance of reference and mean image over what noise explains

Image referenceOf(const std::string& name) { return readImage(caseFolder() / "reference" / (name + ".exr")); }
std::filesystem::path sceneOf(const std::string& name) { return caseFolder() / (name + ".pbrt"); }

/// Compares means, and pixels by the noise that is left in both; `pixelsToo`: these must agree, else differ.
void expectSameUpToNoise(const std::string& name, bool pixelsToo) {
  const Image reference = referenceOf(name);
  std::vector<Image> images;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    images.push_back(renderFile(sceneOf(name), {.seed = seed}).image);
  }
  ASSERT_EQ(images[0].width(), reference.width());
  ASSERT_EQ(images[0].height(), reference.height());

  for (std::size_t c = 0; c < 3; ++c) {
    RunningStats means;
    for (const Image& image : images) means.add(imageMean(image, c));
    const double error = std::sqrt(means.variance() * kNoises), pbrt = imageMean(reference, c);
    std::printf("%-28s channel %zu: mean %.6f, PBRT-v3 %.6f, standard error %.6f\n", name.c_str(), c,
                means.mean(), pbrt, error);
    EXPECT_LE(std::abs(means.mean() - pbrt), kMaxMeanDifference * pbrt + 3 * error);
  }
  const PixelDistance distance = pixelDistance(images, reference, kNoises);
  std::printf("%-28s squared distance %.3f of the noise\n", name.c_str(),
              distance.squared / distance.variance);
  if (pixelsToo) {
    EXPECT_LT(distance.squared, kMaxNoiseRatio * distance.variance);
  } else {
    EXPECT_GT(distance.squared, kMaxNoiseRatio * distance.variance)
        << "the difference is gone: so must be its mention";
  }
}

void expectSamePixels(const std::string& name) {
  constexpr std::int64_t kSamplesOfReference = 1024;
  const Image reference = referenceOf(name);
  const Image ours = renderFile(sceneOf(name), {.samplesPerPixel = kSamplesOfReference}).image;
  ASSERT_EQ(ours.width(), reference.width());
  ASSERT_EQ(ours.height(), reference.height());
  double squaredDistance = 0;
  for (int y = 0; y < ours.height(); ++y) {
    for (int x = 0; x < ours.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        squaredDistance += std::pow(double{ours.at(x, y, c)} - reference.at(x, y, c), 2);
      }
    }
  }
  EXPECT_LT(std::sqrt(squaredDistance / (3.0 * ours.width() * ours.height())), 2e-4);  // of values up to 0.4
}

void expectFactor(const RenderedScene& scene) {
  const Image reference = referenceOf(scene.name);
  const Rendered ours = renderFile(sceneOf(scene.name));
  EXPECT_NE(ours.warnings.find(scene.said), std::string::npos) << ours.warnings;
  ASSERT_EQ(ours.image.width(), reference.width());
  ASSERT_EQ(ours.image.height(), reference.height());
  double theirs = 0, sum = 0;
  for (int y = scene.firstRow; y < scene.endRow; ++y) {
    for (int x = reference.width() / 4; x < reference.width() * 3 / 4; ++x) {
      theirs += reference.at(x, y, 1);
      sum += ours.image.at(x, y, 1);
    }
  }
  std::printf("%-28s PBRT-v3 is %.4f times as bright\n", scene.name, theirs / sum);
  EXPECT_GT(theirs / sum, scene.lowest);
  EXPECT_LT(theirs / sum, scene.highest);
}

class RenderedCase : public testing::TestWithParam<RenderedScene> {};

TEST_P(RenderedCase, IsRelatedToPbrtAsDocumented) {
  if (!std::filesystem::is_directory(caseFolder())) GTEST_SKIP() << "the cases are not beside this checkout";
  switch (GetParam().relation) {
    case Relation::UpToNoise:
      return expectSameUpToNoise(GetParam().name, true);
    case Relation::MeanOnly:
      return expectSameUpToNoise(GetParam().name, false);
    case Relation::SameSamples:
      return expectSamePixels(GetParam().name);
    case Relation::ByFactor:
      return expectFactor(GetParam());
  }
}

TEST(RenderedCases, AreAllThatThereAre) {
  if (!std::filesystem::is_directory(caseFolder())) GTEST_SKIP() << "the cases are not beside this checkout";
  std::set<std::string> references, rows;
  for (const auto& file : std::filesystem::directory_iterator(caseFolder() / "reference")) {
    if (file.path().extension() == ".exr") references.insert(file.path().stem().string());
  }
  for (const RenderedScene& scene : renderedCases()) rows.insert(scene.name);
  EXPECT_FALSE(references.empty());
  EXPECT_EQ(rows, references);
  EXPECT_EQ(rows.size(), renderedCases().size()) << "a name stands there twice";
}

INSTANTIATE_TEST_SUITE_P(Scenes, RenderedCase, testing::ValuesIn(renderedCases()),
                         [](const auto& value) { return identifier(value.param.name); });

}  // namespace
}  // namespace pbrtmedia::test
