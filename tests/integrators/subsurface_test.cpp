// SPDX-License-Identifier: BSD-2-Clause
// Light that goes below surfaces, in `path` and `volpath`.
#include <gtest/gtest.h>

#include <numbers>

#include "materials/bssrdf.h"
#include "materials/disney.h"
#include "materials/fresnel.h"
#include "materials/mix.h"
#include "materials/subsurface.h"
#include "support/function_line.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// Materials and the textures they are made of.
class SubsurfaceKit : public SceneKit {
 public:
  const RgbTexture* rgb(Rgb value) { return builder.own(std::make_unique<ConstantTexture<Rgb>>(value)); }
  const FloatTexture* number(float value) {
    return builder.own(std::make_unique<ConstantTexture<float>>(value));
  }
  /// By colour and mean free path.
  const Material* subsurface(Rgb kd, float path, float roughness = 0) {
    const FloatTexture* rough = number(roughness);
    const SubsurfaceBoundary boundary{.kr = rgb(Rgb(1)),
                                      .kt = rgb(Rgb(1)),
                                      .uRoughness = rough,
                                      .vRoughness = rough,
                                      .remapRoughness = false};
    return builder.own(std::make_unique<SubsurfaceMaterial>(
        boundary, SubsurfaceColour{rgb(kd), rgb(Rgb(path))}, std::make_shared<SubsurfaceTable>(0.0f, kEta)));
  }
  static constexpr float kEta = 1.33f;
};

constexpr double kLost = 0.0015;  ///< beyond Bssrdf::kBeyondReach, and the polynomials

/// Radiance under a sky of 1 of a plane that scatters all light in the plane itself: what the boundary
/// reflects, and what of the rest comes out.
double underSky(double albedo, float cosine, float eta = SubsurfaceKit::kEta) {
  const auto reflected = static_cast<double>(fresnelDielectric(cosine, 1, eta));
  return reflected + (1 - reflected) * albedo;
}

TEST(Subsurface, APlaneReturnsItsColour) {
  for (const float kd : {0.3f, 0.8f}) {
    for (const bool volpath : {false, true}) {
      SubsurfaceKit kit;
      kit.builder.addPrimitive({.shape = kit.square(0, 100), .material = kit.subsurface(Rgb(kd), 0.1f)});
      kit.sky(1);
      const auto scene = kit.finish();
      const Ray ray = rayOf({0.3f, 0, 1}, {-0.3f, 0, -1});
      const auto integrator = volpath ? makeVolPath(*scene) : makePath(*scene);
      const Estimates e = estimate(*integrator, ray, 1 << 16);
      const double truth = underSky(static_cast<double>(kd), -ray.d.z);
      EXPECT_NEAR(e.red.mean(), truth, kLost + kMaxAbsZ * e.red.standardError()) << kd << volpath;
      EXPECT_LT(kMaxAbsZ * e.red.standardError(), 0.02) << "a percent or two must be seen";
    }
  }
}

TEST(Subsurface, WhatAbsorbsNothingReturnsAll) {
  for (const float roughness : {0.0f, 0.3f}) {
    SubsurfaceKit kit;
    kit.builder.addPrimitive(
        {.shape = kit.square(0, 1000), .material = kit.subsurface(Rgb(1), 0.01f, roughness)});
    kit.sky(1);
    const auto scene = kit.finish();
    const Estimates e = estimate(*makePath(*scene), rayOf({0.3f, 0, 1}, {-0.3f, 0, -1}), 1 << 16);
    // Facets lose what they shadow from each other.
    const double least = roughness > 0 ? 0.9 : 1 - 0.005;
    EXPECT_LT(e.red.mean(), 1 + 0.002 + kMaxAbsZ * e.red.standardError());
    EXPECT_GT(e.red.mean(), least - kMaxAbsZ * e.red.standardError());
  }
}

TEST(Subsurface, ADisneyPlaneReturnsItsColourToo) {
  SubsurfaceKit kit;
  const FloatTexture *zero = kit.number(0), *one = kit.number(1);
  const auto disney = [&](float distance) {
    return kit.builder.own(
        std::make_unique<DisneyMaterial>(DisneyParams{.color = kit.rgb(Rgb(0.6f)),
                                                      .metallic = zero,
                                                      .eta = kit.number(1.5f),
                                                      .roughness = zero,
                                                      .specularTint = zero,
                                                      .anisotropic = zero,
                                                      .sheen = zero,
                                                      .sheenTint = zero,
                                                      .clearcoat = zero,
                                                      .clearcoatGloss = one,
                                                      .specTrans = zero,
                                                      .scatterDistance = kit.rgb(Rgb(distance)),
                                                      .flatness = zero,
                                                      .diffTrans = one}));
  };
  kit.builder.addPrimitive({.shape = kit.square(0, 100), .material = disney(0.2f)});
  kit.sky(1);
  const auto scene = kit.finish();
  const Ray ray = rayOf({0.3f, 0, 1}, {-0.3f, 0, -1});
  const Estimates e = estimate(*makePath(*scene), ray, 1 << 16);
  // Its reflection is one of very small facets: that of the boundary.
  EXPECT_NEAR(e.red.mean(), underSky(0.6, -ray.d.z, 1.5f), kLost + 1e-3 + kMaxAbsZ * e.red.standardError());
}

/// Of a thin slab light comes out on both sides: a probe through both takes one of its hits, for both.
TEST(Subsurface, AThinSlabReturnsWhatComesOutOfItsOtherSideToo) {
  constexpr float kThickness = 0.05f;
  SubsurfaceKit kit;
  const Material* material = kit.subsurface(Rgb(0.5f), 0.1f);
  kit.builder.addPrimitive(
      {.shape = kit.box({-100, -100, -kThickness}, {100, 100, 0}), .material = material});
  kit.sky(1);
  const auto scene = kit.finish();
  const Ray ray = rayOf({0.3f, 0, 1}, {-0.3f, 0, -1});
  std::uint64_t queries = 0;
  SurfaceInteraction si = scene->surface(*scene->closest(ray, 0, {}, queries), ray);
  const Bssrdf bssrdf = material->bssrdf(si).value();
  const auto beyond = [&](double nearest) {
    return simpson(
        [&](double r) {
          return 2 * std::numbers::pi * r * static_cast<double>(bssrdf.radial(static_cast<float>(r)).r);
        },
        nearest, static_cast<double>(bssrdf.reach(0)));
  };
  const double otherSide = beyond(static_cast<double>(kThickness));
  EXPECT_GT(otherSide, 0.1);
  const Estimates e = estimate(*makePath(*scene, {.maxDepth = 1}), ray, 1 << 17);
  const double truth = underSky(beyond(0) + otherSide, -ray.d.z);
  EXPECT_NEAR(e.red.mean(), truth, kLost + kMaxAbsZ * e.red.standardError());
  EXPECT_LT(kMaxAbsZ * e.red.standardError(), 0.1 * otherSide);
}

TEST(Subsurface, LightSpreadsAsItsProfileTells) {
  // A wall stands on the plane. The lamp before it lights what is behind it through the plane alone.
  SubsurfaceKit kit;
  const Material* material = kit.subsurface(Rgb(0.9f), 1.0f);
  kit.builder.addPrimitive({.shape = kit.square(0, 100), .material = material});
  kit.builder.addPrimitive(
      {.shape = kit.quad({0, -50, -1}, {0, 50, -1}, {0, 50, 50}, {0, -50, 50}), .material = kit.black()});
  kit.pointLight({-1, 0, 1}, 10);
  const auto scene = kit.finish();
  const auto at = [&](float x) {
    return estimate(*makePath(*scene, {.maxDepth = 1}), rayOf({x, 0, 1}, {0, 0, -1}), 1 << 14).red;
  };
  const RunningStats close = at(0.2f), far = at(3);
  EXPECT_GT(close.mean(), far.mean() + kMaxAbsZ * std::hypot(close.standardError(), far.standardError()));
  EXPECT_GT(far.mean(), kMaxAbsZ * far.standardError());
}

TEST(Subsurface, LightComesOutOfTheSameMaterialOnly) {
  // Two halves of a plane, of like materials: what goes into the one does not come out of the other.
  const auto lit = [](bool isOne) {
    SubsurfaceKit kit;
    const Material* left = kit.subsurface(Rgb(0.9f), 1.0f);
    const Material* right = isOne ? left : kit.subsurface(Rgb(0.9f), 1.0f);
    kit.builder.addPrimitive(
        {.shape = kit.quad({-50, -50, 0}, {0, -50, 0}, {0, 50, 0}, {-50, 50, 0}), .material = left});
    kit.builder.addPrimitive(
        {.shape = kit.quad({0, -50, 0}, {50, -50, 0}, {50, 50, 0}, {0, 50, 0}), .material = right});
    kit.builder.addPrimitive(
        {.shape = kit.quad({0, -50, -1}, {0, 50, -1}, {0, 50, 50}, {0, -50, 50}), .material = kit.black()});
    kit.pointLight({-1, 0, 1}, 10);
    const auto scene = kit.finish();
    return estimate(*makePath(*scene, {.maxDepth = 1}), rayOf({0.5f, 0, 1}, {0, 0, -1}), 1 << 12).red.mean();
  };
  EXPECT_GT(lit(true), 0);
  EXPECT_EQ(lit(false), 0);
}

TEST(Subsurface, AMixSendsOutWhatItsFirstMaterialLetIn) {
  SubsurfaceKit kit;
  const Material* mix = kit.builder.own(std::make_unique<MixMaterial>(
      *kit.subsurface(Rgb(0.8f), 0.1f), *kit.matte(0.2f), *kit.rgb(Rgb(0.25f))));
  kit.builder.addPrimitive({.shape = kit.square(0, 100), .material = mix});
  kit.sky(1);
  const auto scene = kit.finish();
  const Ray ray = rayOf({0.3f, 0, 1}, {-0.3f, 0, -1});
  const Estimates e = estimate(*makePath(*scene), ray, 1 << 16);
  EXPECT_NEAR(e.red.mean(), 0.25 * underSky(0.8, -ray.d.z) + 0.75 * 0.2,
              kLost + kMaxAbsZ * e.red.standardError());
}

TEST(Subsurface, AMixOfTwoReturnsTheColourOfTheFirst) {
  SubsurfaceKit kit;
  const Material* mix = kit.builder.own(std::make_unique<MixMaterial>(
      *kit.subsurface(Rgb(0.8f), 0.1f), *kit.subsurface(Rgb(0.3f), 0.05f), *kit.rgb(Rgb(0.25f))));
  kit.builder.addPrimitive({.shape = kit.square(0, 100), .material = mix});
  kit.sky(1);
  const auto scene = kit.finish();
  const Ray ray = rayOf({0.3f, 0, 1}, {-0.3f, 0, -1});
  const Estimates e = estimate(*makePath(*scene), ray, 1 << 16);
  EXPECT_NEAR(e.red.mean(), underSky(0.8, -ray.d.z), kLost + kMaxAbsZ * e.red.standardError());
}

TEST(Subsurface, MediaOutsideStayWhereTheyAre) {
  // A sphere in fog that absorbs: light goes below its surface and out again, and the fog is there on both
  // ways.
  const auto seen = [](float sigmaA) {
    SubsurfaceKit kit;
    const Medium* fog = sigmaA > 0 ? kit.fog("fog", Rgb(sigmaA), Rgb(0)) : nullptr;
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 3), .media = {.inside = fog}});
    kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1),
                              .material = kit.subsurface(Rgb(0.5f), 0.001f),
                              .media = {.inside = nullptr, .outside = fog}});
    kit.sky(1);
    const auto scene = kit.finish();
    const Estimates e =
        estimate(*makeVolPath(*scene, {.maxDepth = 1}), rayOf({0, 0, 5}, {0, 0, -1}), 1 << 15);
    EXPECT_EQ(e.counters.mediumMismatches, 0u);
    return e.red;
  };
  const RunningStats clear = seen(0), foggy = seen(0.2f);
  // On the way in exp(-0.4); on the way out, from the point the ray meets, between 2 and √8 long.
  EXPECT_LT(foggy.mean(), clear.mean() * std::exp(-0.2 * 4) + kMaxAbsZ * foggy.standardError());
  EXPECT_GT(foggy.mean(),
            clear.mean() * std::exp(-0.2 * (2 + std::sqrt(8.0))) - kMaxAbsZ * foggy.standardError());
}

}  // namespace
}  // namespace pbrtmedia
