// SPDX-License-Identifier: BSD-2-Clause
// What each integrator makes of media: `volpath` renders them, against closed forms; `path`, `directlighting`
// and `whitted` see the same scene as if there were none, along camera rays, shadow rays and specular chains.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr double kSigmaA = .8, kLe = 3, kLight = 5;

struct IntegratorCase {
  const char* name;
  bool rendersMedia;
  friend std::ostream& operator<<(std::ostream& os, const IntegratorCase& c) { return os << c.name; }
};

class MediaIn : public testing::TestWithParam<IntegratorCase> {
 protected:
  /// The image is `truth` all over: up to the noise of absorption where media are rendered, else to rounding.
  /// A warning says so if they are not.
  void expectSeen(double truth, const std::string& view, const std::string& world) const {
    std::ostringstream gas;
    gas << "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" "
           "[ "
        << kSigmaA << ' ' << kSigmaA << ' ' << kSigmaA << " ] ";
    const Rendered r = renderText(pencil(16, 64, '"' + std::string(GetParam().name) + '"', view) +
                                      "WorldBegin\n" + gas.str() + world + "WorldEnd\n",
                                  {.seed = 1});
    EXPECT_EQ(r.warnings.find("does not render participating media") == std::string::npos,
              GetParam().rendersMedia)
        << r.warnings;
    RunningStats pixels;
    for (int i = 0; i < 256; ++i) pixels.add(static_cast<double>(r.image.at(i % 16, i / 16, 0)));
    EXPECT_NEAR(pixels.mean(), truth, 1e-4 * truth + kMaxAbsZ * pixels.standardError());
    EXPECT_LE(kMaxAbsZ * pixels.standardError(), (GetParam().rendersMedia ? kVisible : 5e-5) * truth);
  }
  /// Transmittance of this length of gas, as the integrator has it.
  double through(double length) const { return GetParam().rendersMedia ? std::exp(-kSigmaA * length) : 1; }
};

const std::string kAlongZ = "LookAt .3 .4 -5  .3 .4 0  0 1 0";
const std::string kEmission = "\"rgb Le\" [ 3 3 3 ]\n";
const std::string kGlowingWall =
    "AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 5 5 5 ] \"bool twosided\" \"true\"\n"
    "Material \"matte\" \"rgb Kd\" [ 0 0 0 ] Translate 0 0 4 Shape \"disk\" \"float radius\" "
    "3\nAttributeEnd\n";
const std::string kSlab = mediumBox("m", {-2, -2, 0}, {2, 2, 1.5});

TEST_P(MediaIn, AWallIsSeenThroughAnAbsorbingSlab) {
  expectSeen(kLight * through(1.5), kAlongZ, kGlowingWall + kSlab);
}

TEST_P(MediaIn, ASlabAddsWhatItEmits) {
  const double own = kLe * (1 - through(1.5));
  expectSeen(kLight * through(1.5) + own, kAlongZ, kEmission + kGlowingWall + kSlab);
  expectSeen(own, kAlongZ, kEmission + kSlab + "LightSource \"point\" \"rgb I\" [ 1 1 1 ]\n");
}

TEST_P(MediaIn, BothAreSeenInAMirror) {
  // From between mirror and slab toward the mirror: what is behind the camera.
  const std::string mirror =
      "AttributeBegin Material \"mirror\" \"rgb Kr\" [ .5 .5 .5 ] Translate 0 0 -8 Shape \"disk\" \"float "
      "radius\" 3\nAttributeEnd\n";
  expectSeen(.5 * (kLight * through(1.5) + kLe * (1 - through(1.5))), "LookAt .3 .4 -5  .3 .4 -8  0 1 0",
             kEmission + kGlowingWall + kSlab + mirror);
}

TEST_P(MediaIn, ShadowRaysAreDimmed) {
  // A point light straight above a white floor, and the slab between them; seen from beside the slab.
  const std::string world =
      "LightSource \"point\" \"point from\" [ 0 0 6 ] \"rgb I\" [ 100 100 100 ]\n"
      "AttributeBegin Material \"matte\" \"rgb Kd\" [ .5 .5 .5 ] Translate 0 0 -1 Shape \"disk\" \"float "
      "radius\" "
      "9\nAttributeEnd\n";
  const double unshadowed = .5 / std::numbers::pi * 100 / 49;
  expectSeen(unshadowed * through(1.5), "LookAt 3 0 -.5  0 0 -1  0 0 1", world + kSlab);
}

TEST_P(MediaIn, AnOpaqueBallHidesTheWall) {
  // Negative control: what has a material blocks in every integrator.
  const std::string ball =
      "AttributeBegin Material \"matte\" \"rgb Kd\" [ 0 0 0 ] Translate .3 .4 .75 Shape \"sphere\" \"float "
      "radius\" "
      ".5\nAttributeEnd\n";
  expectSeen(0, kAlongZ, kGlowingWall + kSlab + ball);
}

INSTANTIATE_TEST_SUITE_P(Integrators, MediaIn,
                         testing::Values(IntegratorCase{"volpath", true}, IntegratorCase{"path", false},
                                         IntegratorCase{"directlighting", false},
                                         IntegratorCase{"whitted", false}),
                         [](const auto& value) { return std::string(value.param.name); });

}  // namespace
}  // namespace pbrtmedia::test
