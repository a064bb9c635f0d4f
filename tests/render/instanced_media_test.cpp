// SPDX-License-Identifier: BSD-2-Clause
// Where media of instances are: those defined outside of an object stay there, as in PBRT-v3; those defined
// in it move with it.
#include <gtest/gtest.h>

#include <cmath>

#include "support/dimming.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// Extinction `sigma` in the unit cube of the current space, centred in x and y.
std::string cube(const std::string& name, double sigma, const std::string& extra = "") {
  std::ostringstream os;
  os << "MakeNamedMedium \"" << name
     << "\" \"string type\" \"heterogeneous\" \"string border\" \"clamp\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb "
        "sigma_a\" [ "
     << sigma << ' ' << sigma << ' ' << sigma
     << " ] \"point p0\" [ -.5 -.5 0 ] \"point p1\" [ .5 .5 1 ] \"float density\" [ 1 ] " << extra << '\n';
  return os.str();
}
std::string block(const std::string& content) { return "AttributeBegin\n" + content + "AttributeEnd\n"; }
std::string object(const std::string& name, const std::string& content) {
  return "ObjectBegin \"" + name + "\"\n" + content + "ObjectEnd\n";
}
std::string instance(const std::string& name, const std::string& place = "") {
  return block(place + "ObjectInstance \"" + name + "\"\n");
}
/// A boundary around [z0, z1].
std::string shell(const std::string& medium, double z0, double z1) {
  return mediumBox(medium, {-0.9, -0.9, z0}, {0.9, 0.9, z1});
}

/// Along +z from the origin, light is dimmed by exactly exp(-depth).
void expectDepth(const std::string& world, double depth, const std::string& what) {
  const Rendered r =
      renderText(pencil(2, 4, "\"volpath\"") + "WorldBegin\n" + kWhiteEnvironment + world + "WorldEnd\n");
  EXPECT_TRUE(dimsTo(r.image, depth)) << what << '\n' << world;
  EXPECT_EQ(r.result.counters.mediumMismatches, 0u) << what;
}

TEST(MediaOfInstances, DefinedOutsideStayWhereTheyWereDefined) {
  const std::string at2 = block("Translate 0 0 2\n" + cube("m", 0.5));  // in [2, 3]
  expectDepth(at2 + object("o", shell("m", 0, 1)) + instance("o", "Translate 0 0 1\nScale 1 1 5\n"), 0.5,
              "scaled");
  expectDepth(at2 + object("o", shell("m", 0, 1)) + instance("o", "Translate 0 0 2.25\n"), 0.375,
              "overlapping");
  expectDepth(at2 + object("o", shell("m", 0, 1)) + instance("o", "Translate 0 0 5\n"), 0, "elsewhere");
  expectDepth(at2 + object("o", shell("m", 0, 1)) + instance("o", "Translate 0 0 1.5\n") +
                  instance("o", "Translate 0 0 2.75\n"),
              0.5 * 0.75, "two");
  expectDepth(at2 + object("i", shell("m", 0, 1)) + object("o", instance("i", "Scale 1 1 4\n")) +
                  instance("o", "Translate 0 0 1.5\n"),
              0.5, "nested");
  expectDepth(at2 + "MediumInterface \"m\" \"\"\nMaterial \"none\"\n" +
                  object("o", boxMesh({-0.9, -0.9, 0}, {0.9, 0.9, 1})) +
                  instance("o", "Translate 0 0 1\nScale 1 1 5\n"),
              0.5, "MediumInterface outside");
}

TEST(MediaOfInstances, DefinedInsideMoveWithTheObject) {
  const std::string o = object("o", cube("m", 0.5) + shell("m", 0, 1));
  expectDepth(o + instance("o", "Translate 0 0 4\n"), 0.5, "moved");
  expectDepth(o + instance("o", "Translate 0 0 4\nScale 1 1 2\n"), 1, "scaled: per world length");
  expectDepth(o + instance("o", "Translate 0 0 4\n") + instance("o", "Translate 0 0 7\nRotate 180 0 1 0\n"),
              1, "two");
  expectDepth(o + object("p", instance("o", "Translate 0 0 1\n") + instance("o", "Translate 0 0 3\n")) +
                  instance("p", "Translate 0 0 5\nScale 1 1 2\n"),
              2, "nested");
  expectDepth(object("o", "Translate 0 0 1\n" + cube("m", 0.5) + "Scale 1 1 2\n" + shell("m", -1, 2)) +
                  instance("o", "Translate 0 0 3\n"),
              0.5, "under a transformation of its own");
}

TEST(MediaOfInstances, BelongToTheObjectOfTheirDefinition) {
  // The shapes of another object, and of the world, see it where it was defined: in [0, 1] of the world
  // there.
  const std::string o = object("o", "Translate 0 0 2\n" + cube("m", 0.5) + shell("m", 0, 1));
  expectDepth(o + shell("m", 1, 4), 0.5, "in the world");
  expectDepth(o + object("p", shell("m", 0, 1)) + instance("p", "Scale 1 1 9\n"), 0.5, "in another object");
  expectDepth(o + object("p", instance("o", "Translate 0 0 5\n") + shell("m", 0, 1)) +
                  instance("p", "Translate 0 0 1.5\n"),
              0.5 + 0.25, "beside an instance of the object");
}

TEST(MediaOfInstances, TakeTheDefinitionThatHoldsAtTheShape) {
  const std::string first = cube("m", 0.25);  // in [0, 1]
  const std::string inside =
      object("o", shell("m", 0, 1) + "Translate 0 0 2\n" + cube("m", 0.5) + shell("m", 0, 1));
  // In [6, 7] the medium is that of the world, which is not there, in [8, 9] that of the object.
  expectDepth(first + inside + instance("o", "Translate 0 0 6\n"), 0.5, "redefined inside");
  expectDepth(first + object("o", shell("m", 0, 1)) + block("Translate 0 0 3\n" + cube("m", 0.5)) +
                  instance("o", "Translate 0 0 .5\n") + shell("m", 2, 5),
              0.125 + 0.5, "redefined after");
}

/// The mean over the shutter.
void expectMean(const std::string& world, double truth, const std::string& what) {
  const ZTest test = zTestOfMean(
      pencil(4, 64, "\"volpath\"") + "WorldBegin\n" + kWhiteEnvironment + world + "WorldEnd\n", truth);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << what << ": " << test;
}

TEST(MediaOfInstances, OfMovingOnesStayOrMove) {
  const std::string place =
      "Translate 0 0 2\nActiveTransform EndTime\nTranslate 0 0 2\nActiveTransform All\n";
  // The boundary runs from [2, 3] to [4, 5]; the medium stays in [2, 3].
  expectMean(block("Translate 0 0 2\n" + cube("m", 1)) + object("o", shell("m", 0, 1)) + instance("o", place),
             0.5 * (1 - std::exp(-1)) + 0.5, "stays");
  expectDepth(object("o", cube("m", 1) + shell("m", 0, 1)) + instance("o", place), 1, "moves");
}

TEST(MediaOfInstances, OverlapAsCopiesDo) {
  for (const std::string rule : {"\"string overlap\" \"add\"", "\"integer priority\" 1"}) {
    const std::string media = block("Translate 0 0 2\nScale 1 1 4\n" + cube("m", 0.5, rule));
    const std::string copies = media + shell("m", 2, 4) + shell("m", 3, 5);
    const std::string instances = media + object("o", shell("m", 0, 2)) + instance("o", "Translate 0 0 2\n") +
                                  instance("o", "Translate 0 0 3\n");
    const double depth = rule.find("add") != rule.npos ? 2 : 1.5;
    expectDepth(copies, depth, "copies");
    expectDepth(instances, depth, "instances");
  }
}

TEST(MediaOfInstances, WallsMayBeInstancesEach) {
  for (const std::string rule : {"", "\"string overlap\" \"add\""}) {
    const std::string wall =
        "Material \"none\"\nMediumInterface \"m\" \"\"\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 "
        "2 3 ] "
        "\"point P\" [ -1 -1 1  1 -1 1  1 1 1  -1 1 1 ]\n";
    std::string world =
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" [ "
        ".5 .5 .5 ] " +
        rule + "\n" + object("wall", wall);
    for (const char* turn : {"", "Rotate 180 1 0 0\n", "Rotate 90 1 0 0\n", "Rotate 270 1 0 0\n",
                             "Rotate 90 0 1 0\n", "Rotate 270 0 1 0\n"}) {
      world += instance("wall", std::string("Translate .1 .2 4\n") + turn);
    }
    expectDepth(world, 1, "six walls");
  }
}

/// A grid that scatters, glows or both; its orientation shows.
std::string gradient(const std::string& extra) {
  return "MakeNamedMedium \"smoke\" \"string type\" \"heterogeneous\" \"point p0\" [ -3 -2 -1 ] \"point p1\" "
         "[ 3 2 1 ] "
         "\"rgb sigma_a\" [ .2 .1 .1 ] \"rgb sigma_s\" [ .4 .4 .5 ] \"integer nx\" 2 \"integer ny\" 2 "
         "\"integer nz\" 2 "
         "\"float density\" [ 1 .2 .1 2 1 3 .5 1 ] " +
         extra + "\n";
}
const std::string kView =
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nSampler \"random\" \"integer "
    "pixelsamples\" "
    "16\nIntegrator \"volpath\" \"integer maxdepth\" 8\nLookAt 0 1 -12 0 0 0 0 1 0\nCamera \"perspective\" "
    "\"float "
    "fov\" 40\nWorldBegin\n";
const std::string kFloor =
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -9 -2.5 -9 9 -2.5 -9 9 -2.5 9 "
    "-9 -2.5 9 "
    "]\n";

/// Means over the image, weighted so that a turned grid would show, agree; so do plain ones, up to `share`.
void expectSameImage(const std::string& a, const std::string& b, double share) {
  RunningStats difference;
  double sum = 0, sumOfDifferences = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Image imageA = renderText(a, {.seed = seed}).image,
                imageB = renderText(b, {.seed = seed + 50}).image;
    double weighted = 0;
    for (int y = 0; y < 16; ++y) {
      for (int x = 0; x < 16; ++x)
        weighted += (imageA.at(x, y, 0) - imageB.at(x, y, 0)) * (1 + 0.2 * x + 0.1 * y);
    }
    difference.add(weighted);
    sum += imageMean(imageA);
    sumOfDifferences += imageMean(imageA) - imageMean(imageB);
  }
  const ZTest test = zTest(difference, 0, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_LT(std::abs(sumOfDifferences), share * sum);
}

TEST(MediaOfInstances, DefinedOutsideLookAsWithoutInstance) {
  const std::string unitBox =
      "Material \"none\"\nMediumInterface \"smoke\" \"\"\n" + boxMesh({-.5, -.5, -.5}, {.5, .5, .5});
  const std::string place = "Scale 6 4 2\n";
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [ .6 .7 .8 ]\n";
  const std::string direct = kView + sky + gradient("") + block(place + unitBox) + kFloor + "WorldEnd\n";
  const std::string placed =
      kView + sky + gradient("") + object("box", unitBox) + instance("box", place) + kFloor + "WorldEnd\n";
  expectSameImage(direct, placed, 0.01);
}

TEST(MediaOfInstances, ThatGlowAreTheSameLight) {
  // The only light is the medium; the floor is lit by it through light samples.
  const std::string half =
      "Material \"none\"\nMediumInterface \"smoke\" \"\"\n" + boxMesh({-1.5, -2, -1}, {1.5, 2, 1});
  const std::string left = "Translate -1.5 0 0\n", right = "Translate 1.5 0 0\n";
  const std::string glow = gradient("\"rgb Le\" [ 3 2 1 ]");
  const std::string direct = kView + glow + block(left + half) + block(right + half) + kFloor + "WorldEnd\n";
  const std::string placed = kView + glow + object("half", half) + instance("half", left) +
                             instance("half", right) + kFloor + "WorldEnd\n";
  EXPECT_GT(imageMean(renderText(direct).image), 0.1);
  EXPECT_EQ(constructText(placed).scene->illuminants().size(), 1u) << "one medium, one light";
  expectSameImage(direct, placed, 0.02);
  // Defined inside, and of homogeneous ones, every placement is a light.
  EXPECT_EQ(constructText(kView + object("half", glow + half) + instance("half", left) +
                          instance("half", right) + "WorldEnd\n")
                .scene->illuminants()
                .size(),
            2u);
  const std::string neon = "MakeNamedMedium \"smoke\" \"string type\" \"homogeneous\" \"rgb Le\" [ 1 1 1 ]\n";
  EXPECT_EQ(constructText(kView + neon + object("half", half) + instance("half", left) +
                          instance("half", right) + "WorldEnd\n")
                .scene->illuminants()
                .size(),
            2u);
}

}  // namespace
}  // namespace pbrtmedia::test
