// SPDX-License-Identifier: BSD-2-Clause
#include "world/boundary_closure.h"

#include <gtest/gtest.h>

#include <array>

#include "shapes/cylinder.h"
#include "shapes/disk.h"
#include "shapes/quadric.h"
#include "support/scene_kit.h"
#include "world/edge_balance.h"
#include "world/media_faults.h"

namespace pbrtmedia {
namespace {

using test::SceneKit;

/// One value left of x = 0 and another one right of it.
class Cut final : public FloatTexture {
 public:
  float evaluate(const SurfaceInteraction& si) const override { return si.p.x < 0 ? 0.0f : 1.0f; }
};

/// The six squares of the unit cube at x; `flipped` of them, the first ones, face inward.
std::vector<const Shape*> squares(SceneKit& kit, float x, int flipped = 0) {
  const std::vector<std::array<Point3f, 4>> faces{
      {{{x, 0, 1}, {x + 1, 0, 1}, {x + 1, 1, 1}, {x, 1, 1}}},
      {{{x, 0, 0}, {x, 1, 0}, {x + 1, 1, 0}, {x + 1, 0, 0}}},
      {{{x, 0, 0}, {x + 1, 0, 0}, {x + 1, 0, 1}, {x, 0, 1}}},
      {{{x + 1, 0, 0}, {x + 1, 1, 0}, {x + 1, 1, 1}, {x + 1, 0, 1}}},
      {{{x + 1, 1, 0}, {x, 1, 0}, {x, 1, 1}, {x + 1, 1, 1}}},
      {{{x, 1, 0}, {x, 0, 0}, {x, 0, 1}, {x, 1, 1}}}};
  std::vector<const Shape*> made;
  for (const auto& [a, b, c, d] : faces) {
    made.push_back(flipped-- > 0 ? kit.quad(d, c, b, a) : kit.quad(a, b, c, d));
  }
  return made;
}

/// A scene with one medium "m" inside of `shapes`; its closure, and the fault of the first shape.
struct Judged {
  bool isConfined;
  std::optional<BoundaryFault> fault;
};
Judged judge(SceneKit& kit, const std::vector<const Shape*>& shapes, const FloatTexture* alpha = nullptr,
             const FloatTexture* shadowAlpha = nullptr) {
  const Medium* m = kit.fog("m", Rgb(1), Rgb(0));
  for (const Shape* shape : shapes) {
    kit.builder.addPrimitive(
        {.shape = shape, .media = {m, nullptr}, .alpha = alpha, .shadowAlpha = shadowAlpha});
  }
  const auto scene = kit.finish();
  return {scene->boundaries().isConfined(m), scene->boundaries().faultOf(*scene->primitiveGroups()[0][0])};
}

TEST(BoundaryClosure, KnowsClosedBoundaries) {
  for (int i = 0; i < 5; ++i) {
    SceneKit kit;
    const std::vector<std::vector<const Shape*>> closed{
        {kit.box({0, 0, 0}, {1, 1, 1})},
        {kit.sphere({3, 0, 0}, 1)},
        squares(kit, 5),
        {kit.box({0, 0, 0}, {1, 1, 1}, Transform::scale(1, 1, -1))},
        {kit.box({1e4f, 0, 0}, {1e4f + 1, 1, 1})}};
    const Judged judged = judge(kit, closed[static_cast<std::size_t>(i)]);
    EXPECT_TRUE(judged.isConfined) << i;
    EXPECT_FALSE(judged.fault) << i;
  }
}

TEST(BoundaryClosure, TellsWhatIsWrongWithOthers) {
  const auto fault = [](const auto& shapesOf) {
    SceneKit kit;
    const Judged judged = judge(kit, shapesOf(kit));
    EXPECT_FALSE(judged.isConfined);
    return judged.fault;
  };
  using Shapes = std::vector<const Shape*>;
  EXPECT_EQ(fault([](SceneKit& k) {
              return Shapes{k.sphere({0, 0, 0}, 1, /*reverse=*/true)};
            }),
            BoundaryFault::FacesInward);
  EXPECT_EQ(fault([](SceneKit& k) { return squares(k, 0, 6); }), BoundaryFault::FacesInward);
  EXPECT_EQ(fault([](SceneKit& k) { return squares(k, 0, 1); }), BoundaryFault::Disagrees);
  EXPECT_EQ(fault([](SceneKit& k) { return Shapes{k.square(0, 1)}; }), BoundaryFault::Open);
  EXPECT_EQ(fault([](SceneKit& k) {
              Shapes five = squares(k, 0);
              five.pop_back();
              return five;
            }),
            BoundaryFault::Open);
}

TEST(BoundaryClosure, TellsWhereSeveralCurvedShapesFaceInward) {
  // A can: a cylinder between two disks, far from the origin.
  const auto fault = [](bool side, bool bottom, bool top) {
    SceneKit kit;
    const auto place = [&](bool reverse) {
      return ShapePlacement{Transform::translate({100, 50, -30}) * Transform::scale(2, 1, 1), reverse};
    };
    const std::vector<const Shape*> can{
        kit.builder.own(std::make_unique<Cylinder>(Cylinder::Params{}, place(side))),
        kit.builder.own(std::make_unique<Disk>(Disk::Params{.height = -1}, place(bottom))),
        kit.builder.own(std::make_unique<Disk>(Disk::Params{.height = 1}, place(top)))};
    return judge(kit, can).fault;
  };
  EXPECT_EQ(fault(false, true, false), std::nullopt);
  EXPECT_EQ(fault(true, false, true), BoundaryFault::FacesInward);
  EXPECT_EQ(fault(false, false, false), std::nullopt) << "one that is wrong is not told from what is meant";
}

TEST(BoundaryClosure, TakesAlphaAsHoles) {
  const auto judgeBox = [](std::unique_ptr<FloatTexture> alpha,
                           std::unique_ptr<FloatTexture> shadow = nullptr) {
    SceneKit kit;
    const FloatTexture* a = alpha ? kit.builder.own(std::move(alpha)) : nullptr;
    const FloatTexture* s = shadow ? kit.builder.own(std::move(shadow)) : nullptr;
    return judge(kit, {kit.box({0, 0, 0}, {1, 1, 1})}, a, s);
  };
  const auto constant = [](float value) { return std::make_unique<ConstantTexture<float>>(value); };
  EXPECT_TRUE(judgeBox(constant(0.5f)).isConfined) << "only 0 cuts";
  EXPECT_TRUE(judgeBox(nullptr, constant(0)).isConfined) << "shadowalpha is for yes/no shadow rays";
  EXPECT_FALSE(judgeBox(constant(0)).isConfined) << "nothing is there";
  const Judged cut = judgeBox(std::make_unique<Cut>());
  EXPECT_FALSE(cut.isConfined);
  EXPECT_EQ(cut.fault, BoundaryFault::MayHaveHoles);
}

TEST(BoundaryClosure, WhatIsCutAwayClosesNothing) {
  SceneKit kit;
  const Medium* m = kit.fog("m", Rgb(1), Rgb(0));
  const FloatTexture* none = kit.builder.own(std::make_unique<ConstantTexture<float>>(0.0f));
  const auto faces = squares(kit, 0);
  for (std::size_t i = 0; i < 6; ++i) {
    kit.builder.addPrimitive({.shape = faces[i], .media = {m, nullptr}, .alpha = i == 0 ? none : nullptr});
  }
  const auto scene = kit.finish();
  EXPECT_FALSE(scene->boundaries().isConfined(m));
  EXPECT_EQ(scene->boundaries().faultOf(*scene->primitiveGroups()[0][1]), BoundaryFault::Open);
}

TEST(BoundaryClosure, DoesNotAccuseCurvedShapesThatMayCloseOneAnother) {
  SceneKit kit;
  const Medium* m = kit.fog("m", Rgb(1), Rgb(0));
  Sphere::Params upper, lower;
  upper.zmin = 0;
  lower.zmax = 0;
  for (const Sphere::Params& half : {upper, lower}) {
    kit.builder.addPrimitive(
        {.shape = kit.builder.own(std::make_unique<Sphere>(half, ShapePlacement{})), .media = {m, nullptr}});
  }
  const auto scene = kit.finish();
  EXPECT_FALSE(scene->boundaries().isConfined(m));
  EXPECT_FALSE(scene->boundaries().hasFaults());
}

TEST(EdgeBalance, AddsUpOverParts) {
  const std::array<Point3f, 4> p{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  EdgeBalance a, b, wrong;
  a.addTriangle(p[0], p[2], p[1]);
  a.addTriangle(p[0], p[1], p[3]);
  EXPECT_FALSE(a.isClosed());
  b.addTriangle(p[1], p[2], p[3]);
  wrong.addTriangle(p[2], p[1], p[3]);
  for (EdgeBalance* part : {&b, &wrong}) part->addTriangle({-0.0f, 0, 0}, p[3], p[2]);
  b.add(a);
  wrong.add(a);
  EXPECT_TRUE(b.isClosed());
  EXPECT_TRUE(b.isOriented());
  EXPECT_TRUE(wrong.isClosed());
  EXPECT_FALSE(wrong.isOriented());
}

// ---- What is told ---------------------------------------------------------------------------------------

TEST(FaultyBoundaries, AreToldOnlyWhereNothingExplainsThem) {
  const auto count = [](bool inWater, bool isCamera) {
    SceneKit kit;
    const Medium* water = kit.fog("water", Rgb(1), Rgb(0));
    // A bubble whose normals face inward.
    kit.builder.addPrimitive(
        {.shape = kit.sphere({0, 0, 0}, 1, /*reverse=*/true), .media = {water, nullptr}});
    if (inWater)
      kit.builder.addPrimitive({.shape = kit.box({-5, -5, -5}, {5, 5, 5}), .media = {water, nullptr}});
    const auto scene = kit.finish();
    const CameraMedium camera(*scene, {30, 40, 50}, 0,
                              isCamera ? std::optional<const Medium*>(water) : std::nullopt);
    return findFaultyBoundaries(*scene, camera).size();
  };
  EXPECT_EQ(count(false, false), 1u);
  EXPECT_EQ(count(true, false), 0u) << "a bubble";
  EXPECT_EQ(count(false, true), 0u);
}

TEST(FaultyBoundaries, OpenOnesNeedRaysThatEscape) {
  const auto count = [](bool hasFloor) {
    SceneKit kit;
    const Medium* m = kit.fog("m", Rgb(1), Rgb(0));
    auto faces = squares(kit, 0);
    faces.erase(faces.begin() + 1);  // the bottom
    for (const Shape* face : faces) kit.builder.addPrimitive({.shape = face, .media = {m, nullptr}});
    if (hasFloor) kit.builder.addPrimitive({.shape = kit.square(0, 5), .material = kit.black()});
    const auto scene = kit.finish();
    const auto faulty = findFaultyBoundaries(*scene, CameraMedium(*scene, {30, 40, 50}, 0));
    for (const FaultyBoundary& f : faulty)
      EXPECT_NE(f.message.find("\"m\" it is open"), f.message.npos) << f.message;
    return faulty.size();
  };
  EXPECT_EQ(count(false), 5u);
  EXPECT_EQ(count(true), 0u);
}

}  // namespace
}  // namespace pbrtmedia
