// SPDX-License-Identifier: BSD-2-Clause
// Surfaces with a material that coincide with boundaries of media: what passes through crosses the boundary,
// what is reflected does not, and nobody is told of a contradiction that is none.
#include <gtest/gtest.h>

#include <cmath>

#include "support/dimming.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// `content` in attributes of its own.
std::string block(const std::string& content) { return "AttributeBegin\n" + content + "AttributeEnd\n"; }
std::string surface(const std::string& material, const std::string& shape,
                    const std::string& interface = "") {
  return block("Material " + material + "\n" +
               (interface.empty() ? "" : "MediumInterface " + interface + "\n") + shape);
}
std::string boundary(const std::string& medium, const std::string& shape) {
  return surface("\"none\"", shape, '"' + medium + "\" \"\"");
}
const std::string kGlass = "\"glass\" \"float eta\" 1";  // bends and reflects nothing
const std::string kMirror = "\"mirror\" \"rgb Kr\" [ 1 1 1 ]";

/// The same in an instance under `place`; `undo` comes before the content.
std::string instanced(const std::string& content, const std::string& place, const std::string& undo) {
  static int count = 0;
  const std::string name = '"' + std::to_string(count++) + '"';
  return "ObjectBegin " + name + "\n" + undo + content + "ObjectEnd\n" +
         block(place + "ObjectInstance " + name + "\n");
}

/// Slightly off the edges that triangles have in common.
const std::string kFromBelow = "LookAt .1 .2 -1  .1 .2 0  0 1 0";
const std::string kFromAbove = "LookAt .1 .2 9  .1 .2 0  0 1 0";

/// Every pixel shows exp(-depth), and no boundary contradicts another.
void expectDepth(const std::string& world, const std::string& view, double depth, const std::string& what) {
  const Rendered r = renderText(pencil(4, 8, "\"volpath\" \"integer maxdepth\" 20", view, 2e-3) +
                                "WorldBegin\n" + kWhiteEnvironment + world + "WorldEnd\n");
  ASSERT_TRUE(dimsTo(r.image, depth)) << what << ", " << view << "\n" << world;
  EXPECT_EQ(r.result.counters.mediumMismatches, 0u) << what << ", " << view;
}

struct Rule {
  const char* name;
  std::string text;
};
const std::array<Rule, 3> kRules{
    {{"boundary", ""}, {"add", "\"string overlap\" \"add\""}, {"priority", "\"integer priority\" 2"}}};

/// Both ways through `world` under each rule; %rule% stands for it in `media`.
void expectDepthUnderAllRules(const std::string& world, double depth, const std::string& what,
                              const std::array<std::pair<const char*, double>, 3>& media) {
  for (const Rule& rule : kRules) {
    std::string definitions;
    for (const auto& [name, sigma] : media) definitions += absorbing(name, sigma, rule.text);
    for (const std::string& view : {kFromBelow, kFromAbove})
      expectDepth(definitions + world, view, depth, what + ", " + rule.name);
  }
}
const std::array<std::pair<const char*, double>, 3> kMedia{{{"a", 0.3}, {"b", 0.7}, {"c", 1.1}}};

const std::string kLower = boxMesh({-2, -2, 0}, {2, 2, 1}), kUpper = boxMesh({-2, -2, 1}, {2, 2, 3});

TEST(Touching, GlassLetsLightIntoTheFogOnIt) {
  expectDepthUnderAllRules(surface(kGlass, kLower) + boundary("a", kUpper), 0.6, "glass first", kMedia);
  expectDepthUnderAllRules(boundary("a", kUpper) + surface(kGlass, kLower), 0.6, "fog first", kMedia);
  expectDepthUnderAllRules(
      surface(kGlass, kLower) + boundary("a", kUpper) + surface(kGlass, boxMesh({-2, -2, 3}, {2, 2, 4})), 0.6,
      "glass on both sides", kMedia);
}

TEST(Touching, ASecondSurfaceMayStandForBothSides) {
  // Two fogs with glass between them that touches both.
  expectDepthUnderAllRules(boundary("a", kLower) + surface(kGlass, boxMesh({-2, -2, 1}, {2, 2, 2})) +
                               boundary("b", boxMesh({-2, -2, 2}, {2, 2, 4})),
                           0.3 + 1.4, "glass between fogs", kMedia);
  // A pane without thickness between them: three surfaces in one plane.
  const std::string pane =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 1 2 -2 1 2 2 1 -2 2 1 "
      "]\n";
  expectDepthUnderAllRules(boundary("a", kLower) + boundary("b", kUpper) + surface(kGlass, pane), 0.3 + 1.4,
                           "pane", kMedia);
  // Fog that fills the glass, and more fog on it.
  expectDepthUnderAllRules(surface(kGlass, kLower) + boundary("a", kLower) + boundary("b", kUpper), 0.3 + 1.4,
                           "filled glass", kMedia);
}

TEST(Touching, GlassMayHaveAMediumItself) {
  const std::string dyed = surface(kGlass, kLower, "\"a\" \"\"");
  expectDepthUnderAllRules(dyed + boundary("b", kUpper), 0.3 + 1.4, "dyed", kMedia);
  expectDepthUnderAllRules(boundary("b", kUpper) + dyed, 0.3 + 1.4, "dyed last", kMedia);
  expectDepthUnderAllRules(dyed + surface(kGlass, kUpper, "\"b\" \"\""), 0.3 + 1.4, "two dyed", kMedia);
  expectDepthUnderAllRules(
      dyed + surface(kGlass, kUpper, "\"b\" \"\"") + boundary("c", boxMesh({-2, -2, 3}, {2, 2, 4})),
      0.3 + 1.4 + 1.1, "two dyed and fog", kMedia);
}

TEST(Touching, NestedBoundariesMayShareTheWall) {
  const std::string nested =
      boundary("a", kUpper) + surface("\"none\"", boxMesh({-1, -1, 1}, {1, 1, 2}), "\"b\" \"a\"");
  const std::string definitions = absorbing("a", 0.3) + absorbing("b", 0.7);
  for (const std::string& view : {kFromBelow, kFromAbove}) {
    expectDepth(definitions + surface(kGlass, kLower) + nested, view, 0.7 + 0.3, "nested");
    expectDepth(definitions + nested + surface(kGlass, kLower), view, 0.7 + 0.3, "nested first");
  }
}

TEST(Touching, CurvedShapesCoincideToo) {
  const std::string centre = "Translate .1 .2 3\n", sphere = centre + "Shape \"sphere\" \"float radius\" 1\n";
  const std::string cylinder =
      centre + "Rotate 90 1 0 0\nShape \"cylinder\" \"float radius\" 1 \"float zmin\" -5 \"float zmax\" 5\n";
  // At 0.05 from the axis chords are shorter by up to 0.5 percent: a thin medium.
  const std::array<std::pair<const char*, double>, 3> media{{{"a", 0.003}, {"b", 0.007}, {"c", 0.001}}};
  expectDepthUnderAllRules(surface(kGlass, sphere) + boundary("a", sphere), 0.006, "spheres", media);
  expectDepthUnderAllRules(boundary("a", cylinder) + surface(kGlass, cylinder), 0.006, "cylinders", media);
  const std::string disk = "Translate 0 0 1\nShape \"disk\" \"float radius\" 4\n";
  expectDepthUnderAllRules(surface(kGlass, disk) + boundary("a", kUpper), 0.006, "disk on triangles", media);
  expectDepthUnderAllRules(boundary("a", kUpper) + surface(kGlass, disk) + boundary("b", kLower), 0.013,
                           "disk between triangles", media);
}

TEST(Touching, InstancesCoincideWithEachOtherAndWithTheWorld) {
  const std::string place = "Translate 3 1 2\nRotate 33 1 2 3\nScale 2 2 2\n";
  const std::string undo = "Scale .5 .5 .5\nRotate -33 1 2 3\nTranslate -3 -1 -2\n";
  const std::string glass = surface(kGlass, kLower), fog = boundary("a", kUpper);
  expectDepthUnderAllRules(instanced(glass, place, undo) + fog, 0.6, "glass in an instance", kMedia);
  expectDepthUnderAllRules(glass + instanced(fog, place, undo), 0.6, "fog in an instance", kMedia);
  expectDepthUnderAllRules(
      instanced(glass, place, undo) + instanced(fog, "Translate 7 7 7\n", "Translate -7 -7 -7\n"), 0.6,
      "both in instances", kMedia);
  expectDepthUnderAllRules(instanced(glass + fog, place, undo), 0.6, "both in one instance", kMedia);
  expectDepthUnderAllRules(instanced(boundary("b", kLower), place, undo) + fog +
                               surface(kGlass, "Translate 0 0 1\nShape \"disk\" \"float radius\" 4\n"),
                           0.7 + 0.6, "three kinds", kMedia);
}

TEST(Touching, GrazingRaysSeeTheSame) {
  // Wide slabs; a ray that rises by `rise` per length has 2 / rise in the upper one.
  const std::string lower = boxMesh({-3e3, -3e3, 0}, {3e3, 3e3, 1}),
                    upper = boxMesh({-3e3, -3e3, 1}, {3e3, 3e3, 3});
  for (const double rise : {0.1, 0.02, 0.004}) {
    const double way = std::sqrt(1 + rise * rise) / rise;
    const std::array<std::pair<const char*, double>, 3> media{
        {{"a", 0.3 / way}, {"b", 0.7 / way}, {"c", 0.1}}};
    for (const Rule& rule : kRules) {
      const std::string definitions =
          absorbing("a", media[0].second, rule.text) + absorbing("b", media[1].second, rule.text);
      for (const double sign : {1.0, -1.0}) {
        std::ostringstream view;
        const double z = sign > 0 ? -1 : 5;
        view << "LookAt .1 .2 " << z << "  1.1 .23 " << z + sign * rise << "  0 1 0";
        // The sideways part of the view makes the way a little longer.
        const double longer = std::sqrt(1 + 0.03 * 0.03 + rise * rise) / std::sqrt(1 + rise * rise);
        expectDepth(definitions + surface(kGlass, lower) + boundary("a", upper), view.str(), 0.6 * longer,
                    "glass and fog");
        expectDepth(definitions + surface(kGlass, lower, "\"b\" \"\"") + boundary("a", upper), view.str(),
                    1.3 * longer, "dyed glass and fog");
      }
    }
  }
}

TEST(Touching, ReflectionStaysInTheFog) {
  const std::string mirror =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 1 2 -2 1 2 2 1 -2 2 1 "
      "]\n";
  const std::string disk = "Translate 0 0 1\nShape \"disk\" \"float radius\" 4\n";
  for (const std::string& shape : {mirror, disk, "ReverseOrientation\n" + disk, kLower}) {
    for (const Rule& rule : kRules) {
      for (const std::string& order :
           {surface(kMirror, shape) + boundary("a", kUpper), boundary("a", kUpper) + surface(kMirror, shape),
            boundary("b", kLower) + boundary("a", kUpper) + surface(kMirror, shape)}) {
        const std::string world = absorbing("a", 0.3, rule.text) + absorbing("b", 0.7, rule.text) + order;
        expectDepth(world, kFromAbove, 1.2, std::string("mirror, ") + rule.name);
      }
    }
    expectDepth(absorbing("a", 0.3) + surface(kMirror, shape) + boundary("a", kUpper), kFromBelow, 0,
                "from below");
  }
  const std::string ball = "Translate .1 .2 5\nShape \"sphere\" \"float radius\" 1\n";
  const std::string shell = boundary("a", "Translate .1 .2 5\nShape \"sphere\" \"float radius\" 2\n") +
                            surface("\"none\"", ball, "\"\" \"a\"");
  // Off the axis rays leave sideways, by a way in the shell that is longer by less than 2 percent.
  const std::string definition = absorbing("a", 1e-4);
  expectDepth(definition + shell + surface(kMirror, ball), kFromBelow, 2e-4, "mirror ball");
}

/// 2 E3(tau): what an even sky shows of itself, cosine-weighted, behind a slab.
double cosineMean(double tau) {
  double sum = 0;
  constexpr int kSteps = 100000;
  for (int i = 0; i < kSteps; ++i) {
    const double mu = (i + 0.5) / kSteps;
    sum += 2 * mu * std::exp(-tau / mu) / kSteps;
  }
  return sum;
}

TEST(Touching, DiffuseSurfacesSeeTheFogOnTheRightSide) {
  const std::string lower = boxMesh({-3e3, -3e3, 0}, {3e3, 3e3, 1}),
                    upper = boxMesh({-3e3, -3e3, 1}, {3e3, 3e3, 3});
  const std::string disk = "Translate 0 0 1\nShape \"disk\" \"float radius\" 3000\n";
  const std::string matte = "\"matte\" \"rgb Kd\" [ 1 1 1 ]";
  const std::string translucent =
      "\"translucent\" \"rgb Kd\" [ 1 1 1 ] \"rgb Ks\" [ 0 0 0 ] \"rgb reflect\" [ 0 0 0 ] \"rgb transmit\" "
      "[ 1 1 1 ]";
  for (const Rule& rule : kRules) {
    const std::string media = absorbing("a", 0.3, rule.text) + absorbing("b", 0.2, rule.text);
    const auto mean = [&](const std::string& world, const std::string& view, double truth) {
      const ZTest test = zTestOfMean(pencil(4, 64, "\"volpath\" \"integer maxdepth\" 3", view) +
                                         "WorldBegin\n" + kWhiteEnvironment + media + world + "WorldEnd\n",
                                     truth);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << rule.name << ", " << view << ": " << test;
    };
    for (const std::string& shape : {lower, disk}) {
      mean(surface(matte, shape) + boundary("a", upper), kFromAbove, std::exp(-0.6) * cosineMean(0.6));
    }
    mean(surface(translucent, disk) + boundary("a", upper), kFromBelow, cosineMean(0.6));
    mean(surface(translucent, disk) + boundary("a", upper) + boundary("b", lower), kFromAbove,
         std::exp(-0.6) * cosineMean(0.2));
  }
}

TEST(Touching, LightsShineThroughThePlaneTheyTouch) {
  // A point light under glass, seen by a matte floor above fog: shadow rays from a surface that touches fog.
  const std::string floor =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -9 -9 1 9 -9 1 9 9 1 -9 9 1 "
      "]\n";
  const std::string light = "LightSource \"point\" \"rgb I\" [ 1 1 1 ] \"point from\" [ .1 .2 6 ]\n";
  const Rendered r =
      renderText(pencil(4, 8, "\"volpath\"", kFromAbove) + "WorldBegin\n" + light + absorbing("a", 0.3) +
                 surface("\"matte\" \"rgb Kd\" [ 1 1 1 ]", floor) + boundary("a", kUpper) + "WorldEnd\n");
  const double expected = std::exp(-1.2) / (M_PI * 25);
  for (const float value : r.image.data()) EXPECT_NEAR(value, expected, 1e-4 * expected);
  EXPECT_EQ(r.result.counters.mediumMismatches, 0u);
}

}  // namespace
}  // namespace pbrtmedia::test
