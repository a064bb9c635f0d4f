// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/math.h"
#include "materials/fourier.h"
#include "materials/fourier_sample.h"
#include "materials/material_test_support.h"
#include "materials/matte.h"
#include "materials/mix.h"

namespace pbrtmedia {
namespace {

using namespace test;  // constants by the dozen

// Contract: every material that is not only specular samples its own density.

struct MaterialCase {
  std::string name;
  std::shared_ptr<const Material> material;
};
void PrintTo(const MaterialCase& c, std::ostream* os) { *os << c.name; }

std::vector<MaterialCase> materialCases() {
  static const MatteMaterial matte({.kd = &kReddish, .sigma = &kZero});
  static const TranslucentMaterial translucent(translucentParams());
  GlassParams rough = glassParams();
  rough.uRoughness = &kTenth;
  rough.vRoughness = &kFifth;
  UberParams uber = uberParams();
  uber.kr = uber.kt = uber.opacity = &kHalf;
  DisneyParams disney = disneyParams(), thin = disneyParams(), subsurface = disneyParams();
  thin.isThin = true;
  subsurface.scatterDistance = &kReddish;
  return {{"Matte", std::make_shared<MatteMaterial>(MatteParams{.kd = &kReddish, .sigma = &kThirty})},
          {"Plastic", std::make_shared<PlasticMaterial>(plasticParams())},
          {"RoughGlass", std::make_shared<GlassMaterial>(rough)},
          {"Metal", std::make_shared<MetalMaterial>(metalParams())},
          {"Substrate", std::make_shared<SubstrateMaterial>(substrateParams())},
          {"Translucent", std::make_shared<TranslucentMaterial>(translucentParams())},
          {"Uber", std::make_shared<UberMaterial>(uber)},
          {"Disney", std::make_shared<DisneyMaterial>(disney)},
          {"DisneyThin", std::make_shared<DisneyMaterial>(thin)},
          {"DisneySubsurface", std::make_shared<DisneyMaterial>(subsurface)},
          {"Subsurface", subsurfaceMaterial()},
          {"Hair", std::make_shared<HairMaterial>(hairParams())},
          {"Fourier", std::make_shared<FourierMaterial>(
                          std::make_shared<FourierTable>(FourierTable::parse(
                              FourierSample{.cosines = fourierCosines(8)}.bytes(), "t.bsdf")),
                          nullptr)},
          {"FourierMirror",
           std::make_shared<FourierMaterial>(std::make_shared<FourierTable>(FourierTable::parse(
                                                 FourierMirror{}.bytes(fourierCosines(24)), "t.bsdf")),
                                             nullptr)},
          {"Mix", std::make_shared<MixMaterial>(matte, translucent, kReddish)}};
}

class SmoothMaterial : public testing::TestWithParam<MaterialCase> {
 protected:
  /// In a frame that is not that of the world.
  static SurfaceInteraction rotatedSurface() {
    SurfaceInteraction si = flatSurface();
    si.n = si.shading.n = polar(50, 70);
    si.dpdu = si.shading.dpdu = 2.0f * polar(140, 70);
    si.dpdv = si.shading.dpdv = cross(si.n, si.dpdu);
    return si;
  }
  static std::vector<Vector3f> views(Normal3f n) {
    const Frame frame = Frame::fromZ(n);
    return {frame.toWorld(polar(10, 0)), frame.toWorld(polar(60, 200)), frame.toWorld(-polar(40, 100))};
  }
};
INSTANTIATE_TEST_SUITE_P(All, SmoothMaterial, testing::ValuesIn(materialCases()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(SmoothMaterial, SamplesItsDensity) {
  SurfaceInteraction si = rotatedSurface();
  const Bsdf bsdf = GetParam().material->bsdf(si, TransportMode::Radiance, true);
  std::uint64_t seed = 300;
  for (const Vector3f wo : views(si.n)) {
    const test::ChiSquareTest result = test::directionTest(test::viewOf(bsdf, wo), seed++);
    EXPECT_GT(result.pValue(), test::kMinPValue) << "wo " << wo << ": " << result;
  }
}

TEST_P(SmoothMaterial, IntegratesToTheSameBySamplingAndByUniformDirections) {
  SurfaceInteraction si = rotatedSurface();
  const Bsdf bsdf = GetParam().material->bsdf(si, TransportMode::Radiance, true);
  for (const Vector3f wo : views(si.n)) {
    const test::ScatteringView view = test::viewOf(bsdf, wo);
    for (const std::size_t channel : {0u, 2u}) {
      const test::ZTest z = test::zTest(test::albedoBySampling(view, channel, 15, 20000),
                                        test::albedoByUniform(view, channel, 16, 100000));
      EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << "wo " << wo << ": " << z;
    }
  }
}

TEST_P(SmoothMaterial, ScattersImportanceAsTheAdjointOfRadiance) {
  SurfaceInteraction si = rotatedSurface();
  si.shading.n = polar(65, 60);  // leans against the geometric normal
  const Bsdf radiance = GetParam().material->bsdf(si, TransportMode::Radiance, true);
  const Bsdf importance = GetParam().material->bsdf(si, TransportMode::Importance, true);
  EXPECT_EQ(importance.eta(), radiance.eta());
  Rng rng(11);
  int compared = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3f a = sampleUniformSphere({rng.uniform(), rng.uniform()}),
                   b = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const float there = importance.f(a, b).r * absDot(b, si.shading.n) * absDot(a, si.n),
                back = radiance.f(b, a).r * absDot(a, si.shading.n) * absDot(b, si.n);
    EXPECT_NEAR(there, back, 2e-4f * (there + back) + 1e-5f) << a << b;
    compared += there > 1e-3f ? 1 : 0;
  }
  EXPECT_GT(compared, 50);
}

TEST_P(SmoothMaterial, HasNoMoreLobesThanItSays) {
  SurfaceInteraction si = flatSurface();
  EXPECT_LE(GetParam().material->bsdf(si, TransportMode::Radiance, true).lobeCount(),
            GetParam().material->maxLobes());
  EXPECT_LE(GetParam().material->bsdf(si, TransportMode::Radiance, false).lobeCount(),
            GetParam().material->maxLobes());
}

}  // namespace
}  // namespace pbrtmedia
