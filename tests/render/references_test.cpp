// SPDX-License-Identifier: BSD-2-Clause
// Small scenes of our own against images that we rendered of them with many samples
// (scripts/make_references.sh): what no closed form tells of whole pictures, and what needs nothing beside
// the checkout. Where PBRT-v3's images of the same scenes are there, the references are compared with them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "image/resample.h"
#include "support/compare_images.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr int kSeeds = 16;
constexpr double kReferenceSamples = 8192;  ///< of scripts/make_references.sh, per pixel
constexpr double kSeen = 0.0125;            ///< of the mean: a difference of this size must be seen
/// The squared distance of the images over what noise explains.
constexpr double kMaxNoiseRatio = 1.5;

std::filesystem::path folder() { return test::sourceDir() / "tests" / "references"; }

std::vector<std::string> scenes() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(folder())) {
    if (file.path().extension() == ".pbrt") names.push_back(file.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Image referenceOf(const std::string& name) { return readImage(folder() / (name + ".exr")); }

class References : public testing::TestWithParam<std::string> {};

TEST_P(References, AreRenderedAgainUpToNoise) {
  const Image reference = referenceOf(GetParam());
  std::vector<Image> images;
  double samples = 0;  // per pixel
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    Rendered r = renderFile(folder() / (GetParam() + ".pbrt"), {.seed = seed});
    samples = static_cast<double>(r.result.samplesTaken) / (1.0 * r.image.width() * r.image.height());
    images.push_back(std::move(r.image));
  }
  ASSERT_EQ(images[0].width(), reference.width());
  ASSERT_EQ(images[0].height(), reference.height());
  const double noises =
      1.0 / kSeeds + samples / kReferenceSamples;  // of one render, ours and the reference's
  const MeanDistance mean = meanDistance(images, reference);
  const PixelDistance distance = pixelDistance(images, reference, noises);
  std::printf(
      "%-12s mean difference %+.4f %% (standard error %.4f %%), dim part %+.4f %% (%.4f %%), squared "
      "distance %.3f of the noise\n",
      GetParam().c_str(), 100 * mean.difference, 100 * mean.standardError, 100 * mean.dimDifference,
      100 * mean.dimError, distance.squared / distance.variance);
  const double both = std::sqrt(noises * kSeeds);  // error of the difference over that of our mean
  const double rounding = 1e-5;                    // of all pixels of the reference to half numbers
  EXPECT_LT(std::abs(mean.difference), kMaxAbsZ * both * mean.standardError + rounding);
  EXPECT_LT(std::abs(mean.dimDifference), kMaxAbsZ * both * mean.dimError + rounding);
  EXPECT_LT(kMaxAbsZ * both * mean.dimError, kSeen) << "too few samples";
  EXPECT_LT(distance.squared, kMaxNoiseRatio * distance.variance);
}

INSTANTIATE_TEST_SUITE_P(Scenes, References, testing::ValuesIn(scenes()), [](const auto& value) {
  std::string name = value.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(ReferenceImages, EachBelongsToASceneAndIsSmall) {
  const std::vector<std::string> names = scenes();
  const std::set<std::string> known(names.begin(), names.end());
  std::uintmax_t size = 0;
  for (const auto& file : std::filesystem::directory_iterator(folder())) {
    size += file.file_size();
    EXPECT_TRUE(known.count(file.path().stem().string())) << file.path();
  }
  EXPECT_GE(known.size(), 9u);
  EXPECT_LT(size, 1'000'000u);
}

TEST(ReferenceImages, AreMadeByTheScript) {
  for (const std::string& name : scenes()) {
    EXPECT_EQ(referenceOf(name).metadata.at("command"),
              "pbrt --quiet --spp 8192 --seed 1000 --outfile " + name + ".exr " + name + ".pbrt");
  }
}

/// The scenes that PBRT-v3 rendered as well, in more pixels.
struct Twin {
  const char *ours, *theirs;
  double rootMeanSquare;  ///< of the mean; the noise of theirs, and of one also another pixel filter
};
constexpr Twin kTwins[] = {{"room", "own-path-room", .03},
                           {"spot-fog", "spotfog", .05},
                           {"hyperboloid", "own-hyperboloid", .03},
                           {"balls", "depth-of-field", .01}};

TEST(ReferenceImages, AreWhatPbrtRenders) {
  const auto pbrt = pbrtSceneFolder();
  if (!pbrt) GTEST_SKIP() << "the PBRT-v3 scenes are not beside this checkout";
  for (const Twin& twin : kTwins) {
    const Image ours = referenceOf(twin.ours);
    const Image theirs = resize(readImage(*pbrt / "reference" / (std::string(twin.theirs) + ".exr")),
                                ours.width(), ours.height(), ResizeFilter::Box);
    const MeanDistance mean = meanDistance(std::span(&ours, 1), theirs);
    double squared = 0, sum = 0;
    for (int y = 0; y < ours.height(); ++y) {
      for (int x = 0; x < ours.width(); ++x) {
        const double a = static_cast<double>(ours.rgb(x, y).average()),
                     b = static_cast<double>(theirs.rgb(x, y).average());
        squared += (a - b) * (a - b);
        sum += b;
      }
    }
    const double n = 1.0 * ours.width() * ours.height(), rms = std::sqrt(squared / n) / (sum / n);
    std::printf("%-12s mean difference %+.4f %%, dim part %+.4f %%, root mean square %.3f %% of the mean\n",
                twin.ours, 100 * mean.difference, 100 * mean.dimDifference, 100 * rms);
    EXPECT_LT(std::abs(mean.difference), .005) << twin.ours;
    EXPECT_LT(std::abs(mean.dimDifference), .005) << twin.ours;
    EXPECT_LT(rms, twin.rootMeanSquare) << twin.ours;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
