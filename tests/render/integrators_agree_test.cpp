// SPDX-License-Identifier: BSD-2-Clause
// One list of small scenes: `bdpt` and `mlt` make the image of `volpath` pixel by pixel. Photons, whose
// kernels blur, have scenes of their own (sppm_test.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "render/agreement_scenes.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr std::uint64_t kSeed = 20261130;
constexpr std::uint64_t kSeeds = 48;

/// Of each pixel and channel, over renders of several seeds.
class Images {
 public:
  void add(const Image& image, double factor = 1) {
    for (std::size_t c = 0; c < 3; ++c) {
      double sum = 0;
      for (int y = 0; y < image.height(); ++y) {
        for (int x = 0; x < image.width(); ++x) {
          const std::size_t i = 3 * static_cast<std::size_t>(y * image.width() + x) + c;
          if (values_.size() <= i) values_.resize(i + 1);
          values_[i].add(factor * double{image.at(x, y, c)});
          sum += factor * double{image.at(x, y, c)};
        }
      }
      means_[c].add(sum / (image.width() * image.height()));
    }
  }
  const std::vector<RunningStats>& values() const { return values_; }
  const RunningStats& mean(std::size_t c) const { return means_[c]; }

 private:
  std::vector<RunningStats> values_;
  RunningStats means_[3];
};

/// The same with more light, as a control.
struct Rendering {
  Images images, brighter;
};
Rendering render(const AgreementScene& scene, const std::string& integrator, std::uint64_t firstSeed,
                 const std::string& parameters = "", std::uint64_t seeds = kSeeds) {
  const std::string text = textOf(scene, integrator, 1, parameters);
  Rendering made;
  for (std::uint64_t s = 0; s < seeds; ++s) {
    const Image image = renderText(text, {.seed = firstSeed + s}).image;
    made.images.add(image);
    made.brighter.add(image, scene.tooBright);
  }
  return made;
}

/// The largest |z| of a pixel, and of the means.
struct Distance {
  double ofPixel = 0, ofMean = 0;
};
Distance distance(const Images& a, const Images& b) {
  Distance worst;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    worst.ofPixel = std::max(worst.ofPixel, std::abs(zTest(a.values()[i], b.values()[i], kSeed).z()));
  for (std::size_t c = 0; c < 3; ++c)
    worst.ofMean = std::max(worst.ofMean, std::abs(zTest(a.mean(c), b.mean(c), kSeed).z()));
  return worst;
}

void expectSameImage(const std::string& integrator, const Rendering& made, const Images& truth) {
  const Distance apart = distance(made.images, truth), control = distance(made.brighter, truth);
  for (std::size_t c = 0; c < 3; ++c) {
    const ZTest test = zTest(made.images.mean(c), truth.mean(c), kSeed);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << integrator << ": " << test;
  }
  EXPECT_LT(apart.ofPixel, kMaxAbsZ) << integrator;
  EXPECT_GT(control.ofMean, kMaxAbsZ) << integrator << ": some more light must be seen";
  std::printf("%-8s worst pixel %.2f, mean %.2f; brighter: %.1f, mean %.1f\n", integrator.c_str(),
              apart.ofPixel, apart.ofMean, control.ofPixel, control.ofMean);
}

class IntegratorsAgree : public testing::TestWithParam<AgreementScene> {};

TEST_P(IntegratorsAgree, WithVolPathPixelByPixel) {
  const AgreementScene& scene = GetParam();
  const Images volpath = render(scene, "volpath", kSeed + 1000).images;
  expectSameImage("bdpt", render(scene, "bdpt", kSeed), volpath);
  expectSameImage("mlt",
                  render(scene, "mlt", kSeed,
                         "\"integer mutationsperpixel\" " + std::to_string(16 * scene.samples) +
                             " \"integer chains\" 40 \"integer bootstrapsamples\" " +
                             std::to_string(150 * scene.samples)),
                  volpath);
}

std::string nameOf(const testing::TestParamInfo<AgreementScene>& info) { return info.param.name; }
INSTANTIATE_TEST_SUITE_P(Scenes, IntegratorsAgree, testing::ValuesIn(agreementScenes()), nameOf);

}  // namespace
}  // namespace pbrtmedia::test
