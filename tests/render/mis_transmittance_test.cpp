// SPDX-License-Identifier: BSD-2-Clause
// Weights between light samples and scattered directions that know the transmittance change noise only.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr int kResolution = 3;

struct Seen {
  RunningStats samples;
  RenderCounters counters;
};

/// All samples of all pixels, their mean over the channels.
Seen render(const std::string& text, std::int64_t samples, std::uint64_t seed) {
  const Construction made = constructText(text);
  const std::unique_ptr<Sampler> sampler = made.sampler->clone();
  Seen seen;
  for (int y = 0; y < kResolution; ++y) {
    for (int x = 0; x < kResolution; ++x) {
      for (std::int64_t i = 0; i < samples; ++i) {
        seen.samples.add(double{renderSample(*made.camera, *sampler, samplingIntegrator(made), {x, y}, i,
                                             samples, seed, seen.counters)
                                    .average()});
      }
    }
  }
  return seen;
}

/// A floor under uneven dark smoke, in colours if asked, and what shines through it.
std::string scene(const std::string& mistransmittance, const std::string& world, const std::string& estimator,
                  int maxDepth = 8, const std::string& sigmaA = "[ 3 3 3 ]") {
  const std::string medium =
      "MakeNamedMedium \"smoke\" \"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer ny\" 2 "
      "\"integer nz\" 2 \"string border\" \"clamp\" \"point p0\" [ -4 -4 -.5 ] \"point p1\" [ 4 4 .5 ] "
      "\"float density\" [ 1 .2 .6 1 .1 1 .4 1 ] \"rgb sigma_s\" [ .2 .2 .2 ] \"rgb sigma_a\" " +
      sigmaA + " \"float g\" .5 \"string transmittance\" \"" + estimator + "\"\n";
  return pencil(kResolution, 16,
                "\"volpath\" \"integer maxdepth\" " + std::to_string(maxDepth) +
                    " \"string mistransmittance\" \"" + mistransmittance + "\"",
                "LookAt .1 0 -.8  .1 0 -2  0 1 0", .3) +
         "WorldBegin\n" + medium + mediumBox("smoke", {-4, -4, -.5}, {4, 4, .5}) + world + "WorldEnd\n";
}

/// A square that faces both ways.
std::string square(double halfWidth, double z) {
  std::ostringstream os;
  const double r = halfWidth;
  os << "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ " << -r << ' ' << -r << ' '
     << z << "  " << r << ' ' << -r << ' ' << z << "  " << r << ' ' << r << ' ' << z << "  " << -r << ' ' << r
     << ' ' << z << " ]\n";
  return os.str();
}

const std::string kFloor = "Material \"matte\"\n" + square(3, -1.2);
const std::string kMetal = "Material \"metal\" \"float roughness\" .05\n" + square(3, -1.2);
const std::string kWindow =
    "AttributeBegin\nMaterial \"matte\" \"rgb Kd\" [ 0 0 0 ]\nAreaLightSource \"diffuse\" \"rgb L\" [ 9 9 9 "
    "] "
    "\"bool twosided\" \"true\"\n" +
    square(1.5, .8) + "AttributeEnd\n";
/// In the smoke, and seen through.
const std::string kInside =
    "AttributeBegin\nMaterial \"none\"\nAreaLightSource \"diffuse\" \"rgb L\" [ 3 3 3 ]\nMediumInterface "
    "\"smoke\" \"smoke\"\nShape \"sphere\" \"float radius\" .3\nAttributeEnd\n";
const std::string kPoint = "LightSource \"point\" \"point from\" [ .5 .2 1 ] \"rgb I\" [ 6 6 6 ]\n";

constexpr std::int64_t kSamples = 3000;
struct Case {
  const char* name;
  std::string world;
  const char* estimator;
  std::string sigmaA = "[ 3 3 3 ]";
  std::int64_t samples = kSamples;
};
const Case kCases[] = {{"window", kFloor + kWindow, "ratio"},
                       {"emitterInTheSmoke", kFloor + kInside + kWindow, "unbiased-ray-marching"},
                       {"sky", kMetal + kWhiteEnvironment, "ratio", "[ 3 3 3 ]", 5 * kSamples / 2},
                       {"metal", kMetal + kWindow, "two-comb-umvu"},
                       {"colours", kFloor + kWindow, "ratio", "[ 2 3 4 ]"},
                       {"splitColours", kFloor + kWindow, "ratio", "[ 1 3 5 ]"}};

class MisTransmittanceOf : public testing::TestWithParam<Case> {};

TEST_P(MisTransmittanceOf, LeavesTheImageAsItIs) {
  const Case& c = GetParam();
  const auto with = [&](const char* word, std::uint64_t seed) {
    return render(scene(word, c.world, c.estimator, 8, c.sigmaA), c.samples, seed).samples;
  };
  const RunningStats none = with("none", 1);
  for (const char* word : {"bounds", "independent"}) {
    const ZTest test = zTest(with(word, 2), none);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << word << ": " << test;
    EXPECT_TRUE(test.sees(.1)) << word << ": " << test;
  }
}
INSTANTIATE_TEST_SUITE_P(All, MisTransmittanceOf, testing::ValuesIn(kCases),
                         [](const auto& tested) { return tested.param.name; });

TEST(MisTransmittance, JointWeightsAreBiasedByThirdCumulantsOnly) {
  // Two combs of some teeth each: nothing to be seen.
  const RunningStats none =
      render(scene("bounds", kFloor + kWindow, "two-comb-umvu"), 3 * kSamples, 1).samples;
  const ZTest joint =
      zTest(render(scene("joint", kFloor + kWindow, "two-comb-umvu"), 3 * kSamples, 2).samples, none);
  EXPECT_LT(std::abs(joint.z()), kMaxAbsZ) << joint;
  EXPECT_TRUE(joint.sees(.1)) << joint;
  // Negative control: an estimator that tells no spread, and is noisy.
  const ZTest naive = zTest(render(scene("joint", kFloor + kWindow, "ratio"), 3 * kSamples, 3).samples, none);
  EXPECT_GT(std::abs(naive.z()), kMaxAbsZ) << naive;
}

TEST(MisTransmittance, SavesNoiseBehindDenseSmoke) {
  const std::string dense = "[ 6 6 6 ]";
  const RunningStats none =
      render(scene("none", kFloor + kWindow, "two-comb-umvu", 8, dense), kSamples, 1).samples;
  for (const char* word : {"bounds", "independent", "joint"}) {
    const RunningStats known =
        render(scene(word, kFloor + kWindow, "two-comb-umvu", 8, dense), kSamples, 2).samples;
    EXPECT_LT(known.variance(), .5 * none.variance()) << word;
  }
}

TEST(MisTransmittance, CostsNothingWhereNothingIsShared) {
  for (const char* word : {"bounds", "independent", "joint"}) {
    // Lights that no direction finds.
    const Seen none = render(scene("none", kFloor + kPoint, "ratio"), 50, 1),
               known = render(scene(word, kFloor + kPoint, "ratio"), 50, 1);
    EXPECT_EQ(none.samples.mean(), known.samples.mean()) << word;
    EXPECT_EQ(none.counters.densityLookups, known.counters.densityLookups) << word;
    // The last vertex looks as light samples do.
    const Seen once = render(scene("none", kFloor + kWindow, "ratio", 1), 50, 1);
    EXPECT_EQ(once.samples.mean(), render(scene(word, kFloor + kWindow, "ratio", 1), 50, 1).samples.mean())
        << word;
    // Negative control.
    EXPECT_NE(render(scene("none", kFloor + kWindow, "ratio"), 50, 1).samples.mean(),
              render(scene(word, kFloor + kWindow, "ratio"), 50, 1).samples.mean());
  }
}

}  // namespace
}  // namespace pbrtmedia::test
