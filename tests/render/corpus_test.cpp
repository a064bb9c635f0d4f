// SPDX-License-Identifier: BSD-2-Clause
// Every construct that PBRT-v3 renders in spite of a mistake is rendered as there, with a warning that is an
// error with --strict. The table is in corpus.h.
#include "render/corpus.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/render_scene.h"

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

std::filesystem::path caseFolder() {
  return std::filesystem::path(PBRT_MEDIA_SOURCE_DIR) / ".." / "shared" / "cases";
}

constexpr double kMaxMeanDifference = 0.005;  // of the reference's mean, as in parity_test.cpp
/// The references have about the noise of our mean image: what both explain is twice that.
constexpr double kNoises = 2.0 / kSeeds;
constexpr double kMaxNoiseRatio = 2;  // squared distance of reference and mean image over what noise explains

class RenderedCase : public testing::TestWithParam<const char*> {};

TEST_P(RenderedCase, AgreesWithPbrtUpToNoise) {
  const std::string name = GetParam();
  if (!std::filesystem::is_directory(caseFolder())) GTEST_SKIP() << "the cases are not beside this checkout";
  const Image reference = readImage(caseFolder() / "reference" / (name + ".exr"));
  std::vector<Image> images;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    images.push_back(renderFile(caseFolder() / (name + ".pbrt"), {.seed = seed}).image);
  }
  ASSERT_EQ(images[0].width(), reference.width());
  ASSERT_EQ(images[0].height(), reference.height());

  double squaredDistance = 0, variance = 0;
  std::array<RunningStats, 3> means;
  std::array<double, 3> referenceMean{};
  for (std::size_t c = 0; c < 3; ++c) {
    referenceMean[c] = imageMean(reference, c);
    for (const Image& image : images) means[c].add(imageMean(image, c));
  }
  for (int y = 0; y < reference.height(); ++y) {
    for (int x = 0; x < reference.width(); ++x) {
      for (std::size_t c = 0; c < 3; ++c) {
        RunningStats ours;
        for (const Image& image : images) ours.add(image.at(x, y, c));
        const double r = reference.at(x, y, c);
        const double halfSpacing = std::max(std::abs(r), 6e-5) * 0x1p-11;  // the reference is stored as half
        squaredDistance += (r - ours.mean()) * (r - ours.mean());
        variance += ours.variance() * kNoises + halfSpacing * halfSpacing;
      }
    }
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const double error = std::sqrt(means[c].variance() * kNoises);
    std::printf("%-28s channel %zu: mean %.6f, PBRT-v3 %.6f, standard error %.6f\n", name.c_str(), c,
                means[c].mean(), referenceMean[c], error);
    EXPECT_LE(std::abs(means[c].mean() - referenceMean[c]),
              kMaxMeanDifference * referenceMean[c] + 3 * error);
  }
  std::printf("%-28s squared distance %.3f of the noise\n", name.c_str(), squaredDistance / variance);
  if (differsInPixels(name)) {
    EXPECT_GT(squaredDistance, kMaxNoiseRatio * variance) << "the difference is gone: so must be its mention";
  } else {
    EXPECT_LT(squaredDistance, kMaxNoiseRatio * variance);
  }
}

/// With the sampler and the number of samples of the reference nothing is random: of the image rounding is
/// left.
TEST(ComparedCase, BumpsOfInstancesAreThoseOfPbrt) {
  if (!std::filesystem::is_directory(caseFolder())) GTEST_SKIP() << "the cases are not beside this checkout";
  const Image reference = readImage(caseFolder() / "reference" / "bump-of-instance.exr");
  const Image ours = renderFile(caseFolder() / "bump-of-instance.pbrt", {.samplesPerPixel = 1024}).image;
  ASSERT_EQ(ours.width(), reference.width());
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

/// Mean of rows [first, last) and columns of the middle half over that of the reference, green.
double ratioToPbrt(const std::string& name, int first, int last, std::string& warnings) {
  const Image reference = readImage(caseFolder() / "reference" / (name + ".exr"));
  const Rendered ours = renderFile(caseFolder() / (name + ".pbrt"));
  warnings = ours.warnings;
  double a = 0, b = 0;
  for (int y = first; y < last; ++y) {
    for (int x = 4; x < 12; ++x) {
      a += reference.at(x, y, 1);
      b += ours.image.at(x, y, 1);
    }
  }
  return a / b;
}

/// Where our answer stays: by how much PBRT-v3 differs.
TEST(ComparedCase, LightsInScaledSpacesDifferByTheFactorsThatAreSaid) {
  if (!std::filesystem::is_directory(caseFolder())) GTEST_SKIP() << "the cases are not beside this checkout";
  std::string warnings;
  const double sphere = ratioToPbrt("light-scaled-sphere", 4, 16, warnings);
  EXPECT_NE(warnings.find("with 64 times the area"), std::string::npos) << warnings;
  EXPECT_GT(sphere, 0.85 * 64);  // less than 64 where the larger sphere is near
  EXPECT_LT(sphere, 64);
  const double ball = ratioToPbrt("sky-scaled", 4, 12, warnings);
  EXPECT_NE(warnings.find("the transformation scales by 0.1"), std::string::npos) << warnings;
  EXPECT_GT(ball, 0.1);
  EXPECT_LT(ball, 0.15);
}

INSTANTIATE_TEST_SUITE_P(Scenes, RenderedCase, testing::ValuesIn(renderedCases()),
                         [](const auto& value) { return identifier(value.param); });

}  // namespace
}  // namespace pbrtmedia::test
