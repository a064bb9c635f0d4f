// SPDX-License-Identifier: BSD-2-Clause
// A white furnace around every material: how much of what it scatters comes back from equal light all around.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "materials/fourier.h"
#include "materials/fourier_sample.h"
#include "materials/material_test_support.h"
#include "materials/matte.h"
#include "materials/mirror.h"
#include "materials/mix.h"

namespace pbrtmedia {
namespace {

using namespace test;  // constants by the dozen

/// A material of white parameters, and how much it may return: all of it (at least 1) where nothing absorbs.
struct FurnaceCase {
  std::string name;
  std::shared_ptr<const Material> material;
  double least = 0, most = 1;
  /// Importance, which refraction does not scale, so that what is counted is energy; hair, whose lobes have a
  /// direction, is white for radiance.
  TransportMode mode = TransportMode::Importance;
};
void PrintTo(const FurnaceCase& c, std::ostream* os) { *os << c.name; }

DisneyParams whiteDisney() {
  DisneyParams p;
  p.color = &kWhite;
  p.eta = &kGlassIndex;
  p.roughness = &kSomewhat;
  p.scatterDistance = &kBlack;
  p.metallic = p.specularTint = p.anisotropic = p.sheen = p.sheenTint = p.clearcoat = p.specTrans =
      p.flatness = p.diffTrans = &kZero;
  p.clearcoatGloss = &kOne;
  return p;
}

std::vector<FurnaceCase> furnaceCases() {
  static const MatteMaterial white({.kd = &kWhite, .sigma = &kZero});
  static const MirrorMaterial mirror({.kr = &kWhite});
  std::vector<FurnaceCase> cases;
  const auto add = [&](const std::string& name, std::shared_ptr<const Material> material, double least,
                       double most) {
    cases.push_back({name, std::move(material), least, most});
  };
  add("Matte", std::make_shared<MatteMaterial>(MatteParams{.kd = &kWhite, .sigma = &kZero}), 1, 1);
  add("OrenNayar", std::make_shared<MatteMaterial>(MatteParams{.kd = &kWhite, .sigma = &kThirty}), .6, 1);
  add("Mirror", std::make_shared<MirrorMaterial>(MirrorParams{.kr = &kWhite}), 1, 1);
  add("Plastic",
      std::make_shared<PlasticMaterial>(PlasticParams{.kd = &kHalf, .ks = &kHalf, .roughness = &kTenth}), .4,
      1);
  add("Metal", std::make_shared<MetalMaterial>(metalParams()), .1, 1);
  add("Substrate", std::make_shared<SubstrateMaterial>(substrateParams()), .4, 1);
  TranslucentParams translucent = translucentParams();
  translucent.kd = &kHalf;
  translucent.ks = &kHalf;
  add("Translucent", std::make_shared<TranslucentMaterial>(translucent), .4, 1);
  add("Glass", std::make_shared<GlassMaterial>(glassParams()), 1, 1);
  GlassParams rough = glassParams();
  rough.uRoughness = rough.vRoughness = &kTenth;
  add("RoughGlass", std::make_shared<GlassMaterial>(rough), .5, 1);
  UberParams uber = uberParams();
  uber.kr = uber.kt = &kQuarter;
  add("Uber", std::make_shared<UberMaterial>(uber), .4, 1);
  HairMaterialParams hair = hairParams();
  hair.color = nullptr;
  hair.sigmaA = &kBlack;
  add("Hair", std::make_shared<HairMaterial>(hair), 1, 1);
  cases.back().mode = TransportMode::Radiance;
  add("Subsurface", subsurfaceMaterial(), .5, 1);
  // As white as their files.
  const auto fourier = [&](const std::string& name, const std::string& file, double least, double most) {
    add("Fourier" + name,
        std::make_shared<FourierMaterial>(std::make_shared<FourierTable>(FourierTable::parse(file, name)),
                                          nullptr),
        least, most);
  };
  const FourierSample lambert{
      .eta = 1, .cosines = fourierCosines(8, true), .reflectance = 1, .transmittance = 0};
  FourierSample halfThrough = lambert;
  halfThrough.reflectance = halfThrough.transmittance = .5f;
  fourier("Lambert", lambert.bytes(), 1, 1);
  fourier("LambertOnBothSides", halfThrough.bytes(), 1, 1);
  fourier("Mirror", FourierMirror{}.bytes(fourierCosines(24, true)), .6, 1);
  add("Mix", std::make_shared<MixMaterial>(white, mirror, kHalf), 1, 1);
  const auto disney = [&](const std::string& name, double least, double most, auto... parts) {
    DisneyParams p = whiteDisney();
    (parts(p), ...);
    add("Disney" + name, std::make_shared<DisneyMaterial>(p), least, most);
  };
  const auto metallic = [](DisneyParams& p) { p.metallic = &kOne; };
  const auto sheen = [](DisneyParams& p) { p.sheen = &kOne; };
  const auto coat = [](DisneyParams& p) { p.clearcoat = &kOne; };
  const auto glass = [](DisneyParams& p) { p.specTrans = &kOne; };
  const auto below = [](DisneyParams& p) { p.scatterDistance = &kWhite; };
  const auto thin = [](DisneyParams& p) { p.isThin = true; };
  const auto flat = [](DisneyParams& p) { p.flatness = &kOne; };
  const auto through = [](DisneyParams& p) { p.diffTrans = &kOne; };
  const auto anisotropic = [](DisneyParams& p) { p.anisotropic = &kSomewhat; };
  const auto halfway = [](DisneyParams& p) { p.metallic = p.specTrans = &kSomewhat; };
  // Its parts do not share their energy, as in PBRT-v3: diffuse light comes on top of what is reflected, most
  // at grazing angles, and the formula for what is flat is brighter than white there.
  disney("Diffuse", .9, 1.2);
  disney("Metallic", .6, 1, metallic);
  disney("Anisotropic", .6, 1, metallic, anisotropic);
  disney("Sheen", .6, 1.28, sheen);
  disney("Clearcoat", .6, 1.23, coat);
  disney("Glass", .6, 1, glass);
  disney("Subsurface", .6, 1.03, below);
  disney("Thin", .6, 1.2, thin);
  disney("ThinFlat", .6, 1.75, thin, flat);
  disney("ThinThrough", .6, 1.42, thin, through);
  disney("ThinGlass", .6, 1, thin, glass);
  disney("Everything", .6, 1, sheen, coat, halfway, anisotropic);
  return cases;
}

class WhiteFurnace : public testing::TestWithParam<FurnaceCase> {};
INSTANTIATE_TEST_SUITE_P(All, WhiteFurnace, testing::ValuesIn(furnaceCases()),
                         [](const auto& tested) { return tested.param.name; });

RunningStats returned(const FurnaceCase& furnace, Vector3f wo, std::uint64_t seed) {
  SurfaceInteraction si = flatSurface();
  si.wo = wo;
  const Bsdf bsdf = furnace.material->bsdf(si, furnace.mode, /*mergeSpecular=*/true);
  Rng rng(seed);
  RunningStats stats;
  for (int i = 0; i < 40000; ++i) {
    const float x = rng.uniform(), y = rng.uniform();
    const BsdfSample s = bsdf.sample(wo, {x, y});
    stats.add(s.pdf > 0 ? double{s.f.g * absDot(s.wi, bsdf.shadingNormal()) / s.pdf} : 0.0);
  }
  return stats;
}

TEST_P(WhiteFurnace, ReturnsNoMoreThanItGets) {
  std::uint64_t seed = 40;
  for (const double degrees : {5.0, 45.0, 75.0, 88.0}) {
    const RunningStats albedo = returned(GetParam(), polar(degrees, 40), seed++);
    const double noise = kMaxAbsZ * albedo.standardError() + 1e-5;
    std::printf("%-20s %2.0f degrees: %.4f +- %.4f\n", GetParam().name.c_str(), degrees, albedo.mean(),
                albedo.standardError());
    EXPECT_LT(albedo.mean(), GetParam().most + noise) << degrees;
    EXPECT_GT(albedo.mean(), GetParam().least - noise) << degrees;
    EXPECT_LT(noise, .05) << degrees << ": it would not be seen";
    // Negative control: a tenth more is seen where all of it comes back.
    if (GetParam().least == GetParam().most) {
      EXPECT_GT(1.1 * albedo.mean(), GetParam().most + noise);
    }
  }
}

}  // namespace
}  // namespace pbrtmedia
