// SPDX-License-Identifier: BSD-2-Clause
#include "materials/bump_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "base/math.h"
#include "materials/bsdf_test_support.h"
#include "materials/matte.h"
#include "materials/mix.h"

namespace pbrtmedia {
namespace {

using test::flatSurface;

class FunctionTexture final : public FloatTexture {
 public:
  explicit FunctionTexture(std::function<float(const SurfaceInteraction&)> f) : f_(std::move(f)) {}
  float evaluate(const SurfaceInteraction& si) const override { return f_(si); }

 private:
  std::function<float(const SurfaceInteraction&)> f_;
};

void expectNear(Vector3f a, Vector3f b, float tolerance = 1e-4f) {
  EXPECT_NEAR(distance(a, b), 0, tolerance) << a << b;
}

TEST(BumpMap, TiltsThePlaneByTheSlopeOfTheHeight) {
  const FunctionTexture slope([](const SurfaceInteraction& si) { return 0.5f * si.uv.x - 0.25f * si.uv.y; });
  SurfaceInteraction si = flatSurface();
  applyBumpMap(&slope, si);
  expectNear(si.shading.n, normalize(Vector3f{-0.5f, 0.25f, 1}));
  expectNear(si.shading.dpdu, {1, 0, 0.5f}, 1e-3f);
  expectNear(si.shading.dpdv, {0, 1, -0.25f}, 1e-3f);
  EXPECT_EQ(si.n, Normal3f(0, 0, 1));  // the geometry stays
}

TEST(BumpMap, CanBeAFunctionOfThePoint) {
  const FunctionTexture slope([](const SurfaceInteraction& si) { return 0.5f * si.p.x; });
  SurfaceInteraction si = flatSurface();
  si.shading.dpdu = si.dpdu = {4, 0, 0};  // u runs over 4 units
  applyBumpMap(&slope, si);
  expectNear(si.shading.n, normalize(Vector3f{-0.5f, 0, 1}));
}

TEST(BumpMap, StepsHalfThePixelFootprint) {
  float farthest = 0;
  const FunctionTexture probe([&](const SurfaceInteraction& si) {
    farthest = std::max(farthest, si.uv.x);
    return si.uv.x * si.uv.x;
  });
  SurfaceInteraction si = flatSurface();
  si.dudx = -0.25f;
  si.dudy = 0.5f;
  applyBumpMap(&probe, si);
  EXPECT_EQ(farthest, 0.375f);
  expectNear(si.shading.n, normalize(Vector3f{-0.375f, 0, 1}));  // (0.375² - 0) / 0.375
  farthest = 0;
  SurfaceInteraction unknown = flatSurface();
  applyBumpMap(&probe, unknown);
  EXPECT_EQ(farthest, 0.0005f);
}

TEST(BumpMap, TakesEachSlopeOverItsOwnStep) {
  const FunctionTexture slope([](const SurfaceInteraction& si) { return 0.5f * si.uv.x - 0.25f * si.uv.y; });
  SurfaceInteraction si = flatSurface();
  si.dudx = 0.5f;
  si.dvdy = 0.125f;
  applyBumpMap(&slope, si);
  expectNear(si.shading.n, normalize(Vector3f{-0.5f, 0.25f, 1}));
}

TEST(BumpMap, ScalesTangentsOfACurvedSurfaceByTheDisplacementItself) {
  // A sphere of radius 2 at its pole: dn/du = dp/du / 2. Raised by 1 everywhere it is a sphere of radius 3.
  const FunctionTexture raised([](const SurfaceInteraction&) { return 1.0f; });
  SurfaceInteraction si = flatSurface();
  si.shading.dndu = {0.5f, 0, 0};
  si.shading.dndv = {0, 0.5f, 0};
  applyBumpMap(&raised, si);
  expectNear(si.shading.n, {0, 0, 1});
  expectNear(si.shading.dpdu, {1.5f, 0, 0});
  expectNear(si.shading.dpdv, {0, 1.5f, 0});
}

TEST(BumpMap, KeepsTheNormalOnTheGeometricSide) {
  // The normal points away from dp/du x dp/dv, as with ReverseOrientation: height counts along the normal.
  const FunctionTexture slope([](const SurfaceInteraction& si) { return 0.5f * si.uv.x; });
  SurfaceInteraction si = flatSurface();
  si.n = si.shading.n = {0, 0, -1};
  applyBumpMap(&slope, si);
  expectNear(si.shading.n, normalize(Vector3f{-0.5f, 0, -1}));
}

TEST(BumpMap, ChangesNothingWithoutATextureOrWithADegenerateOne) {
  const SurfaceInteraction before = flatSurface();
  SurfaceInteraction si = before;
  applyBumpMap(nullptr, si);
  EXPECT_EQ(si.shading.n, before.shading.n);
  const FunctionTexture bad([](const SurfaceInteraction&) { return std::nanf(""); });
  applyBumpMap(&bad, si);
  EXPECT_EQ(si.shading.n, before.shading.n);
  EXPECT_EQ(si.shading.dpdu, before.shading.dpdu);
}

TEST(BumpMap, ReachesTheBsdfOfAMaterialAndOnlyThatOfTheFirstInAMix) {
  const FunctionTexture toX([](const SurfaceInteraction& si) { return si.uv.x; });
  const FunctionTexture toY([](const SurfaceInteraction& si) { return si.uv.y; });
  const ConstantTexture<Rgb> half(Rgb(0.5f));
  const ConstantTexture<float> zero(0);
  const MatteMaterial first({.kd = &half, .sigma = &zero, .bumpMap = &toX});
  const MatteMaterial second({.kd = &half, .sigma = &zero, .bumpMap = &toY});
  SurfaceInteraction si = flatSurface();
  expectNear(first.bsdf(si, TransportMode::Radiance, true).shadingNormal(), normalize(Vector3f{-1, 0, 1}));
  expectNear(si.shading.n, normalize(Vector3f{-1, 0, 1}));
  SurfaceInteraction mixed = flatSurface();
  expectNear(MixMaterial(first, second, half).bsdf(mixed, TransportMode::Radiance, true).shadingNormal(),
             normalize(Vector3f{-1, 0, 1}));
}

}  // namespace
}  // namespace pbrtmedia
