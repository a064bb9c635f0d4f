// SPDX-License-Identifier: BSD-2-Clause
// Which medium is a ray in? Cameras inside media, overlaps, nesting, instances, through whole scenes.
#include <gtest/gtest.h>

#include <cmath>

#include "support/dimming.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr const char* kFromBelow = "";
constexpr const char* kFromAbove = "LookAt 0 0 20  0 0 0  0 1 0";

/// The environment through the world's boxes along z, looking up from z = 0 or down from z = 20.
Rendered seenThrough(const std::string& view, const std::string& world) {
  return renderText(pencil(8, 4, "\"volpath\"", view) + "WorldBegin\n" + kWhiteEnvironment + world +
                    "WorldEnd\n");
}

TEST(Overlap, AddedMediaDimARayAlikeFromBothEnds) {
  // a: [1, 4], b: [3, 6]: they overlap in [3, 4].
  const std::string world = absorbing("a", 0.3, "\"string overlap\" \"add\"") +
                            absorbing("b", 0.2, "\"string overlap\" \"add\"") +
                            mediumBox("a", {-1, -1, 1}, {1, 1, 4}) + mediumBox("b", {-1, -1, 3}, {1, 1, 6});
  for (const char* view : {kFromBelow, kFromAbove}) {
    EXPECT_TRUE(dimsTo(seenThrough(view, world).image, 0.3 * 3 + 0.2 * 3)) << view;
  }
}

TEST(Overlap, OfMediaWithPrioritiesOnlyTheHighestCounts) {
  const std::string world = absorbing("a", 0.3, "\"integer priority\" 1") +
                            absorbing("b", 0.2, "\"integer priority\" 2") +
                            mediumBox("a", {-1, -1, 1}, {1, 1, 4}) + mediumBox("b", {-1, -1, 3}, {1, 1, 6});
  for (const char* view : {kFromBelow, kFromAbove}) {
    EXPECT_TRUE(dimsTo(seenThrough(view, world).image, 0.3 * 2 + 0.2 * 3)) << view;
  }
}

TEST(Overlap, IsDiagnosedUnderTheBoundaryRule) {
  const std::string world = absorbing("a", 0.3) + absorbing("b", 0.2) +
                            mediumBox("a", {-1, -1, 1}, {1, 1, 4}) + mediumBox("b", {-1, -1, 3}, {1, 1, 6});
  const Rendered r =
      renderText(pencil(2, 16, "\"volpath\"") + "WorldBegin\n" + kWhiteEnvironment + world + "WorldEnd\n");
  EXPECT_GT(r.result.counters.mediumMismatches, 0u);
  ASSERT_FALSE(r.result.mismatches.empty());
  EXPECT_NE(r.result.mismatches.front().toString().find("\"a\""), std::string::npos)
      << r.result.mismatches.front().toString();
}

TEST(Nesting, OfBoundariesThatNameBothSidesHasNoMismatch) {
  const std::string world = absorbing("outer", 0.2) + absorbing("inner", 0.7) +
                            mediumBox("outer", {-1, -1, 1}, {1, 1, 7}) +
                            "AttributeBegin\nMaterial \"none\"\nMediumInterface \"inner\" \"outer\"\n" +
                            boxMesh({-0.5, -0.5, 3}, {0.5, 0.5, 4}) + "AttributeEnd\n";
  for (const char* view : {kFromBelow, kFromAbove}) {
    const Rendered r = seenThrough(view, world);
    EXPECT_TRUE(dimsTo(r.image, 0.2 * 5 + 0.7)) << view;
    EXPECT_EQ(r.result.counters.mediumMismatches, 0u);
  }
}

TEST(CameraInMedium, FoundByGeometryEqualsTheExplicitOne) {
  const std::string head =
      "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\nSampler \"random\" "
      "\"integer pixelsamples\" 64\nIntegrator \"volpath\"\n";
  const std::string camera = "Camera \"perspective\" \"float fov\" 50\n";
  const std::string world = kWhiteEnvironment + mediumBox("fog", {-2, -2, -2}, {2, 2, 2}) + "WorldEnd\n";
  const std::string fog = absorbing("fog", 0.4);
  const Rendered found = renderText(head + camera + "WorldBegin\n" + fog + world, {.seed = 2});
  const Rendered given = renderText(head + fog + "MediumInterface \"\" \"fog\"\n" + camera +
                                        "WorldBegin\nMediumInterface \"\" \"fog\"\n" + world,
                                    {.seed = 2});
  EXPECT_LT(imageMean(found.image), 0.7);
  EXPECT_EQ(found.image.data(), given.image.data());
}

TEST(CameraInMedium, AContradictionIsWarnedAboutAndBothAreNamed) {
  const Rendered r =
      renderText(absorbing("fog", 0.4) + absorbing("smoke", 2) + "MediumInterface \"\" \"smoke\"\n" +
                 pencil(2, 1, "\"volpath\"") + "WorldBegin\n" + kWhiteEnvironment +
                 mediumBox("fog", {-2, -2, -2}, {2, 2, 2}) + "MediumInterface \"\" \"smoke\"\nWorldEnd\n");
  EXPECT_NE(r.warnings.find("fog"), std::string::npos) << r.warnings;
  EXPECT_NE(r.warnings.find("smoke"), std::string::npos) << r.warnings;
}

/// A grid with a gradient, so that its orientation shows, scattering as well.
std::string gradientGrid() {
  std::ostringstream os;
  os << "MakeNamedMedium \"grid\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ 1 1 1 ] \"rgb "
        "sigma_s\" [ 2 2 2 ] "
        "\"integer nx\" 3 \"integer ny\" 2 \"integer nz\" 2 \"point p0\" [ -0.4 -0.4 -0.4 ] \"point p1\" [ "
        "0.4 0.4 0.4 ] "
        "\"float density\" [ 0 1 3  2 0 1  4 1 0  0 0 2 ]\n";
  return os.str();
}

TEST(InstancedMedia, NinePlacementsLookLikeNineCopies) {
  const std::string head =
      "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24\nSampler \"random\" "
      "\"integer pixelsamples\" 64\nIntegrator \"volpath\" \"integer maxdepth\" 4\n"
      "LookAt 0 0 -8  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 28\nWorldBegin\n" +
      kWhiteEnvironment;
  const std::string body =
      "Material \"none\"\nMediumInterface \"grid\" \"\"\n" + boxMesh({-0.4, -0.4, -0.4}, {0.4, 0.4, 0.4});
  std::ostringstream instances, copies;
  instances << "ObjectBegin \"puff\"\n" << gradientGrid() << body << "ObjectEnd\n";
  for (int i = 0; i < 9; ++i) {
    std::ostringstream place;
    place << "Translate " << (i % 3 - 1) * 1.1 << ' ' << (i / 3 - 1) * 1.1 << " 0\nRotate " << 17 * i
          << " 1 2 3\nScale " << 0.7 + 0.05 * i << " 0.9 0.8\n";
    instances << "AttributeBegin\n" << place.str() << "ObjectInstance \"puff\"\nAttributeEnd\n";
    // A copy has a name and a grid of its own.
    std::string grid = gradientGrid(), own = body;
    const std::string name = "\"grid" + std::to_string(i) + "\"";
    grid.replace(grid.find("\"grid\""), 6, name);
    own.replace(own.find("\"grid\""), 6, name);
    copies << "AttributeBegin\n" << place.str() << grid << own << "AttributeEnd\n";
  }
  RunningStats difference;
  double mean = 0;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Image a = renderText(head + instances.str() + "WorldEnd\n", {.seed = seed}).image;
    const Image b = renderText(head + copies.str() + "WorldEnd\n", {.seed = seed + 100}).image;
    // Weighted by a ramp, so that a rotated or mirrored grid would show.
    double sum = 0;
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 24; ++x) sum += (a.at(x, y, 0) - b.at(x, y, 0)) * (1 + 0.2 * x + 0.1 * y);
    }
    difference.add(sum);
    mean += imageMean(a) / 8;
  }
  const ZTest test = zTest(difference, 0, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_LT(mean, 0.97) << "the media must be in view";
}

TEST(NestedInstances, EqualTheFlatScene) {
  const std::string head =
      "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nSampler \"halton\" "
      "\"integer pixelsamples\" 16\nIntegrator \"path\"\nLookAt 0 0 -9  0 0 0  0 1 0\n"
      "Camera \"perspective\" \"float fov\" 35\nWorldBegin\n" +
      kWhiteEnvironment + "LightSource \"point\" \"point from\" [ 3 3 -4 ] \"rgb I\" [ 9 9 9 ]\n";
  const std::string nested =
      head +
      "ObjectBegin \"ball\"\nShape \"sphere\" \"float radius\" 0.5\nObjectEnd\n"
      "ObjectBegin \"pair\"\nTranslate 1 0 0\nObjectInstance \"ball\"\nTranslate -2 0 0\n"
      "ObjectInstance \"ball\"\nObjectEnd\n"
      "AttributeBegin\nTranslate 0 1 0\nObjectInstance \"pair\"\nAttributeEnd\n"
      "AttributeBegin\nTranslate 0 -1 0\nRotate 30 0 0 1\nObjectInstance \"pair\"\nAttributeEnd\n"
      "WorldEnd\n";
  std::string flat = head;
  for (const char* place : {"Translate 0 1 0\n", "Translate 0 -1 0\nRotate 30 0 0 1\n"}) {
    for (const char* offset : {"Translate 1 0 0\n", "Translate -1 0 0\n"}) {
      flat += std::string("AttributeBegin\n") + place + offset +
              "Shape \"sphere\" \"float radius\" 0.5\nAttributeEnd\n";
    }
  }
  const Image a = renderText(nested, {.seed = 1}).image,
              b = renderText(flat + "WorldEnd\n", {.seed = 1}).image;
  double worst = 0, mean = 0;
  for (std::size_t i = 0; i < a.data().size(); ++i) {
    worst = std::max(worst, static_cast<double>(std::abs(a.data()[i] - b.data()[i])));
    mean += std::abs(a.data()[i] - b.data()[i]) / static_cast<double>(a.data().size());
  }
  EXPECT_LT(mean, 2e-3) << "only silhouettes may differ, by rounding; worst " << worst;
}

TEST(Scale, SameMeansWhenTheSceneIsScaledAndSigmaInversely) {
  for (const double s : {1e-6, 1e-3, 1e3, 1e6}) {
    std::ostringstream world;
    world << "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ " << 0.2 / s << ' '
          << 0.2 / s << ' ' << 0.2 / s << " ] \"rgb sigma_s\" [ " << 0.8 / s << ' ' << 0.8 / s << ' '
          << 0.8 / s << " ]\n"
          << mediumBox("m", Vec3d{-1, -1, 1} * s, Vec3d{1, 1, 2} * s);
    const std::string tail = kWhiteEnvironment + world.str() + "WorldEnd\n";
    const std::string unit =
        "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0.2 0.2 0.2 ] "
        "\"rgb sigma_s\" [ 0.8 0.8 0.8 ]\n" +
        mediumBox("m", {-1, -1, 1}, {1, 1, 2}) + kWhiteEnvironment + "WorldEnd\n";
    RunningStats scaled, reference;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
      scaled.add(imageMean(
          renderText(pencil(6, 128, "\"volpath\"", "", 1e-3 * s) + "WorldBegin\n" + tail, {.seed = seed})
              .image));
      reference.add(imageMean(
          renderText(pencil(6, 128, "\"volpath\"") + "WorldBegin\n" + unit, {.seed = seed + 50}).image));
    }
    const ZTest test = zTest(scaled, reference);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "scale " << s << ": " << test;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
