// SPDX-License-Identifier: BSD-2-Clause
// Objects, instances, motion, media and area lights of the world block.
#include "construct/world_builder.h"

#include <algorithm>
#include <cmath>

#include "construct/probe.h"

namespace pbrtmedia::test {
namespace {

Attempt with(const std::string& world) { return attemptWorld(world); }

bool reports(const Attempt& a, const std::string& fragment) {
  return a.made && std::any_of(a.made->report.begin(), a.made->report.end(), [&](const std::string& line) {
           return line.find(fragment) != std::string::npos;
         });
}

const std::string kDisk = "Shape \"disk\" \"float radius\" 0.6 ";
std::string object(const std::string& name, const std::string& content) {
  return "ObjectBegin \"" + name + "\" " + content + " ObjectEnd ";
}
std::string instance(const std::string& name) { return "ObjectInstance \"" + name + "\" "; }
std::string homogeneous(const std::string& name) {
  return "MakeNamedMedium \"" + name + "\" \"string type\" \"homogeneous\" ";
}

TEST(ConstructWorld, AnInstanceIsTheShapeUnderBothTransformations) {
  expectSame({{object("o", "Translate 0 0 0.25 " + kDisk) + "Translate 0.5 0 0 " + instance("o"),
               "Translate 0.5 0 0.25 " + kDisk},
              {object("o", kDisk) + "Scale 2 2 2 " + instance("o"), "Shape \"disk\" \"float radius\" 1.2"}},
             with, [](const Attempt& a) {
               Numbers n;
               std::uint64_t queries = 0;
               for (const Ray& ray : probingRays())
                 n.push_back(a.made->scene->occluded(ray, 0, Exclusions{}, queries) ? 1 : 0);
               return n;
             });
}

TEST(ConstructWorld, InstancesNest) {
  const std::string nested =
      object("inner", kDisk) +
      object("outer", "Translate 0.5 0 0 " + instance("inner") + "Translate -1 0 0 " + instance("inner"));
  const std::string place = "Translate 0 0 0.5 Rotate 70 1 2 3 ";  // a turn and a shift: their order is seen
  const Attempt a = with(nested + place + instance("outer"));
  ASSERT_TRUE(a.made) << a.messages();
  const Attempt flat = with(place + "Translate 0.5 0 0 " + kDisk + "Translate -1 0 0 " + kDisk);
  std::uint64_t queries = 0;
  for (const Ray& ray : probingRays()) {
    EXPECT_EQ(a.made->scene->occluded(ray, 0, Exclusions{}, queries),
              flat.made->scene->occluded(ray, 0, Exclusions{}, queries));
  }
}

std::size_t primitiveCount(const Attempt& a) {
  std::size_t count = 0;
  for (const auto& group : a.made->scene->primitiveGroups()) count += group.size();
  return count;
}

TEST(ConstructWorld, StrandsThatStandAlikeAreOneShape) {
  const auto curve = [](int i, const std::string& more = "") {
    const std::string y = std::to_string(0.4 * i - 0.5);
    return "Shape \"curve\" \"float width\" .3 \"point P\" [ -1 " + y + " 0 -.3 " + y + " .2 .3 " + y +
           " 0 1 " + y + " 0 ] " + more;
  };
  const Attempt one = with(curve(0) + kDisk + curve(1) + curve(2));
  ASSERT_TRUE(one.made) << one.messages();
  EXPECT_EQ(primitiveCount(one), 2u);
  // Whatever stands between them, rays meet the same strands.
  const std::string other = "Translate 0 0 0 ";  // a CTM of its own
  const Attempt apart = with(curve(0) + kDisk + other + curve(1) + other + curve(2));
  EXPECT_EQ(primitiveCount(apart), 4u);
  EXPECT_EQ(surfaces(one), surfaces(apart));

  const std::string mirror = "Material \"mirror\" ",
                    fog = homogeneous("fog") + "MediumInterface \"fog\" \"fog\" ";
  for (const std::string& between : {mirror, fog, std::string("ReverseOrientation "),
                                     std::string("Scale 2 1 1 "), std::string("Material \"none\" ")}) {
    const Attempt a = with(curve(0) + between + curve(1));
    ASSERT_TRUE(a.made) << a.messages();
    EXPECT_EQ(primitiveCount(a), between.find("none") == std::string::npos ? 2u : 1u) << between;
  }
  EXPECT_EQ(primitiveCount(with(curve(0) + curve(1, "\"string type\" \"cylinder\" "))), 2u);
  EXPECT_EQ(primitiveCount(with(curve(0) + curve(1, "\"rgb Kd\" [ 1 0 0 ] "))), 2u);
  EXPECT_EQ(primitiveCount(with(object("o", curve(0) + curve(1)) + curve(2) + instance("o"))), 2u);
}

TEST(ConstructWorld, SaysThatPhotonsFindOtherCurves) {
  const auto attemptOf = [](const std::string& integrator, const std::string& material,
                            const std::string& type) {
    const std::string normals = type == "ribbon" ? " \"normal N\" [ 0 0 1 0 0 1 ]" : "";
    return attemptWorld(material + " Shape \"curve\" \"string type\" \"" + type +
                            "\" \"point P\" [ -1 0 0 -.3 0 .2 .3 0 0 1 0 0 ]" + normals,
                        {}, "Integrator \"" + integrator + "\"");
  };
  const std::string told = "curves have no thickness", matte = "Material \"matte\"",
                    hair = "Material \"hair\"";
  for (const std::string type : {"flat", "cylinder"}) {
    EXPECT_TRUE(attemptOf("sppm", matte, type).warns(told));
    EXPECT_FALSE(attemptOf("sppm", hair, type).warns(told));
    EXPECT_FALSE(attemptOf("sppm", "Material \"none\"", type).warns(told));
  }
  EXPECT_TRUE(attemptOf("sppm", matte, "ribbon").warns(told));
  EXPECT_TRUE(attemptOf("sppm", hair, "ribbon").warns(told));
  for (const std::string integrator : {"volpath", "bdpt", "mlt"}) {
    for (const std::string type : {"flat", "cylinder", "ribbon"}) {
      EXPECT_TRUE(attemptOf(integrator, matte, type).isSilent());
      EXPECT_TRUE(attemptOf(integrator, hair, type).isSilent());
    }
  }
}

TEST(ConstructWorld, InstancesAndMovingCurvesAreTheCurves) {
  const std::string curve =
      "Shape \"curve\" \"float width\" .5 \"point P\" [ -1 -.4 0 -.3 .2 .2 .3 -.2 0 1 .4 .1 ] ";
  const std::string place = "Translate .1 .2 .1 Rotate 30 1 2 1 ";
  const auto hits = [](const Attempt& a) {
    Numbers n;
    std::uint64_t queries = 0;
    for (const Ray& ray : probingRays()) {
      const auto hit = a.made->scene->closest(ray, 0, Exclusions{}, queries);
      n.push_back(hit ? 1 : 0);
      if (!hit) continue;
      const SurfaceInteraction si = a.made->scene->surface(*hit, ray);
      for (const double x : {si.p.x, si.n.x, si.n.y, si.n.z, si.uv.x, si.uv.y, si.dpdu.x, si.dpdv.y}) {
        n.push_back(std::round(x * 1e3));
      }
    }
    return n;
  };
  const Numbers straight = hits(with(place + curve));
  EXPECT_GT(std::count(straight.begin(), straight.end(), 1), 20);
  EXPECT_EQ(hits(with(object("o", curve) + place + instance("o"))), straight);
  // Motion from there to elsewhere: at a quarter of the time it is a quarter of the way along.
  const Attempt moving = with("ActiveTransform EndTime Translate 2 0 0 ActiveTransform All " + curve);
  EXPECT_EQ(hits(moving), hits(with("Translate .5 0 0 " + curve)));
}

TEST(ConstructWorld, CurvesBoundNoMedia) {
  const std::string curve = "Shape \"curve\" \"point P\" [ -1 0 0 -.3 0 0 .3 0 0 1 0 0 ] ";
  const std::string media = homogeneous("a") + homogeneous("b");
  const Attempt a = with(media + "MediumInterface \"a\" \"b\" " + curve + curve);
  EXPECT_TRUE(
      a.warns("curves have no inside, so they bound no media: MediumInterface is left out for 2 curves"))
      << a.messages();
  for (const auto& group : a.made->scene->primitiveGroups()) {
    for (const Primitive* primitive : group) EXPECT_TRUE(primitive->media.same());
  }
  EXPECT_FALSE(attemptWorld(media + "MediumInterface \"a\" \"b\" " + curve, {.strict = true}).made);
  EXPECT_FALSE(with(media + "MediumInterface \"a\" \"a\" " + curve).warns("no inside"));
}

TEST(ConstructWorld, ObjectsThatAreNeverPlacedAreNotBuilt) {
  const Attempt a =
      with(object("o", homogeneous("m") + "MediumInterface \"m\" \"\" Material \"mirror\" " + kDisk) + kDisk);
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_TRUE(reports(a, "1 objects are never placed"));
  EXPECT_TRUE(reports(a, "medium \"m\": not used, left out"));
  EXPECT_TRUE(reports(a, "materials: 0 built of 1 defined"));
}

TEST(ConstructWorld, ObjectsThatMultiplyAreRefusedAndEmptyOnesCostNothing) {
  const auto doubling = [](const std::string& core, int depth) {
    std::string world = object("o0", core);
    for (int i = 1; i <= depth; ++i) {
      const std::string inner = instance("o" + std::to_string(i - 1));
      world += object("o" + std::to_string(i), inner + inner);
    }
    return world + instance("o" + std::to_string(depth));
  };
  EXPECT_TRUE(
      with(doubling(kDisk, 60))
          .failsWith("ObjectInstance \"o60\": nested objects multiply to 1152921504606846976 or more"));
  EXPECT_TRUE(
      with(doubling(kDisk, 22)).failsWith("multiply to 8388607 placed objects, expected at most 1051456"));
  EXPECT_TRUE(with(doubling("", 60)).made.has_value()) << "2^60 times nothing";
  EXPECT_TRUE(with(doubling(kDisk, 4)).made.has_value());
  std::string chain = object("o0", kDisk);
  for (int i = 1; i <= 3000; ++i)
    chain += object("o" + std::to_string(i), instance("o" + std::to_string(i - 1)));
  EXPECT_TRUE(with(chain + instance("o3000")).failsWith("nests objects 3001 deep, expected at most 1000"));
}

// ---- Motion

const std::string kMove = "ActiveTransform EndTime Translate 2 0 0 ActiveTransform All ";

/// Whether a ray along -z at x, at a time, is blocked.
bool blocked(const Attempt& a, float x, float time) {
  std::uint64_t queries = 0;
  return a.made->scene->occluded({.o = {x, 0.01f, 5}, .d = {0, 0, -1}, .tMax = kInfinity, .time = time}, 0,
                                 Exclusions{}, queries);
}

TEST(ConstructWorld, ShapesAndInstancesMove) {
  for (const std::string& world :
       {kMove + kDisk, object("o", kDisk) + kMove + instance("o"), object("o", kMove + kDisk) + instance("o"),
        object("i", kMove + kDisk) + object("o", instance("i")) + instance("o")}) {
    const Attempt a = with(world);
    ASSERT_TRUE(a.made) << a.messages();
    EXPECT_TRUE(blocked(a, 0, 0)) << world;
    EXPECT_FALSE(blocked(a, 0, 1)) << world;
    EXPECT_TRUE(blocked(a, 1, 0.5f)) << world;
    EXPECT_TRUE(blocked(a, 2, 1)) << world;
  }
  const Attempt both = with(object("o", kMove + kDisk) + "Translate 0 0 1 " + kMove + instance("o"));
  EXPECT_TRUE(blocked(both, 4, 1)) << "the motions of shape and instance add";
  EXPECT_FALSE(blocked(both, 2, 1));
}

TEST(ConstructWorld, TransformTimesBoundTheMotion) {
  const Attempt a = attemptWorld(kMove + kDisk, {}, "TransformTimes 0.5 1");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_TRUE(blocked(a, 0, 0.4f));
  EXPECT_TRUE(blocked(a, 1, 0.75f));
}

TEST(ConstructWorld, AMovingShapeTakesItsMediumAlong) {
  // A grid in [4, 5] x [0, 1]^2 of the world; the shape around it starts there.
  const std::string grid =
      "Translate 4 0 0 MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"string border\" \"clamp\" "
      "\"float density\" [ 1 ] \"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ] MediumInterface \"m\" "
      "\"\" ";
  const Attempt a = with(grid + kMove + "Translate 0.5 0.5 0.5 Shape \"sphere\"");
  ASSERT_TRUE(a.made) << a.messages();
  for (const float time : {0.0f, 0.5f, 1.0f}) {
    const float x = 4.5f + 2 * time;
    const Ray ray{.o = {x, 0.5f, 9}, .d = {0, 0, -1}, .tMax = kInfinity, .time = time};
    std::uint64_t queries = 0;
    const auto hit = a.made->scene->closest(ray, 0, Exclusions{}, queries);
    ASSERT_TRUE(hit) << time;
    ASSERT_NE(hit->placement, nullptr);
    const Segment inMedium = hit->placement->toObject({ray.o, ray.d, 0, 18}, time);
    Rng rng(1);
    RenderCounters counters;
    double sum = 0;
    constexpr int kCount = 10000;
    for (int i = 0; i < kCount; ++i)
      sum += hit->primitive->media.inside->transmittance(inMedium, rng, counters).r;
    const double truth = std::exp(-1.0);  // one unit of extinction 1; an estimate has a variance below 1/4
    EXPECT_LT(std::abs(sum / kCount - truth), 5 * 0.5 / std::sqrt(kCount)) << time;
    EXPECT_NEAR(inMedium.o.x, 4.5f, 1e-5f) << time;
  }
}

// ---- Area lights

TEST(ConstructWorld, EachTriangleOfAnEmitterIsALight) {
  const Attempt a = with(
      "AreaLightSource \"diffuse\" Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
      "\"point P\" [ 0 0 0 1 0 0 1 1 0 0 1 0 ] AreaLightSource \"\" " +
      kDisk);
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_EQ(a.made->scene->lights().size(), 3u) << "two triangles and the point light; the disk is dark";
}

TEST(ConstructWorld, AreaLightsOnMovingShapesAndInObjectsWarn) {
  const Attempt moving = with("AreaLightSource \"diffuse\" " + kMove + kDisk);
  ASSERT_TRUE(moving.warns("area lights on moving shapes are ignored")) << moving.messages();
  EXPECT_EQ(moving.made->scene->lights().size(), 1u);
  for (const auto& group : moving.made->scene->primitiveGroups()) {
    for (const Primitive* p : group) EXPECT_TRUE(p->areaLights.empty()) << "nor is it seen that they shine";
  }
  const Attempt inObject = with(object("o", "AreaLightSource \"diffuse\" " + kDisk) + instance("o"));
  ASSERT_TRUE(inObject.warns("is seen but lights nothing")) << inObject.messages();
  EXPECT_EQ(inObject.made->scene->lights().size(), 1u);
  EXPECT_TRUE(inObject.made->scene->hasVisibleEmitters());
}

// ---- Media

TEST(ConstructWorld, OnlyMediaThatSomethingUsesAreBuilt) {
  const Attempt a =
      with(homogeneous("used") + homogeneous("idle") + "MediumInterface \"used\" \"\" Shape \"sphere\"");
  ASSERT_TRUE(a.warns("medium \"idle\": no shape has it")) << a.messages();
  EXPECT_TRUE(reports(a, "medium \"idle\": not used, left out"));
  EXPECT_TRUE(reports(a, "medium \"used\": "));
  EXPECT_FALSE(reports(a, "medium \"used\": not used"));
}

TEST(ConstructWorld, BothSidesOfAShapeHaveTheirMedia) {
  const Attempt a =
      with(homogeneous("in") + homogeneous("out") + "MediumInterface \"in\" \"out\" Shape \"sphere\"");
  ASSERT_TRUE(a.made) << a.messages();
  std::uint64_t queries = 0;
  for (const Ray& ray : probingRays()) {
    const auto found = a.made->scene->closest(ray, 0, Exclusions{}, queries);
    if (!found) continue;
    EXPECT_EQ(found->primitive->media.inside->name(), "in");
    EXPECT_EQ(found->primitive->media.outside->name(), "out");
  }
  EXPECT_TRUE(a.made->scene->hasMediumBoundaries());
}

TEST(ConstructWorld, SurfacesThatChangeNothingAreLeftOut) {
  const Attempt a =
      with(homogeneous("m") + "Material \"none\" " + kDisk + "MediumInterface \"m\" Shape \"sphere\"");
  ASSERT_TRUE(a.made) << a.messages();
  EXPECT_TRUE(surfaces(a) == surfaces(with("")));
}

TEST(WorldBuilder, WhatLiesBeyondAllCoordinatesIsToldWhereItStands) {
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1e17 0 ]";
  struct Case {
    std::string world, place;
  };
  const Case cases[] = {
      {"Shape \"sphere\" \"float radius\" 1e19", "t.pbrt:2:1"},
      {"Scale 1e3 1e3 1e3\n" + mesh, "t.pbrt:3:1"},
      {"ActiveTransform EndTime Scale 1e3 1e3 1e3\n" + mesh, "t.pbrt:3:1"},
      {"ObjectBegin \"o\"\nShape \"sphere\" \"float radius\" 1e19\nObjectEnd\nObjectInstance \"o\"",
       "t.pbrt:2:1"},
      {"ObjectBegin \"o\"\n" + mesh + "\nObjectEnd\nScale 1e3 1e3 1e3\nObjectInstance \"o\"", "t.pbrt:6:1"}};
  for (const Case& c : cases) {
    const Attempt a = attemptWorld(c.world);
    ASSERT_TRUE(a.failsWith("coordinates must be finite and below 1.8e18")) << c.world << a.messages();
    EXPECT_EQ(a.find(Severity::Error, "coordinates")->location.toString(), c.place) << a.messages();
  }
}

}  // namespace
}  // namespace pbrtmedia::test
