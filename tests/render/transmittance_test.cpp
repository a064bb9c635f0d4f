// SPDX-License-Identifier: BSD-2-Clause
// Beer-Lambert through whole renders: each answer is exp(-optical depth), whatever stores the medium.
#include <gtest/gtest.h>

#include <cmath>

#include "support/dimming.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

const Vec3d kLow{-1, -1, 1}, kHigh{1, 1, 2};  // a box of thickness 1 along z

class ConstantMedium : public testing::TestWithParam<Storage> {};

constexpr double kLadder[] = {1e-6, 1e-3, 0.1, 1, 5, 20, 50, 87, 88, 104, 1e3};

TEST_P(ConstantMedium, TransmitsTheEnvironmentByBeerLambert) {
  for (const double tau : kLadder) {
    const Rendered r = renderText(pencil(8, 4, "\"volpath\"") + "WorldBegin\n" + kWhiteEnvironment +
                                  constantMedium(GetParam(), tau, 0, 0, kLow, kHigh) +
                                  mediumBox("m", kLow, kHigh) + "WorldEnd\n");
    EXPECT_TRUE(dimsTo(r.image, tau));
  }
}

TEST_P(ConstantMedium, ShadowsAFloorByBeerLambert) {
  // A matte floor (Kd 1/2) at z = 0 seen from between it and the slab; a distant light of irradiance pi comes
  // through the slab at 60 degrees, so its path there is twice the thickness.
  for (const double tau : kLadder) {
    const std::string scene =
        pencil(4, 4, "\"volpath\" \"integer maxdepth\" 1", "LookAt 0 0 0.5  0 0 0  0 1 0") + "WorldBegin\n" +
        "LightSource \"distant\" \"point from\" [ 1.7320508075688772 0 1 ] \"point to\" [ 0 0 0 ] "
        "\"rgb L\" [ 3.14159265 3.14159265 3.14159265 ]\n" +
        constantMedium(GetParam(), tau / 2, 0, 0, {-1, -9, 1}, {9, 9, 2}) +
        mediumBox("m", {-1, -9, 1}, {9, 9, 2}) +
        "Material \"matte\" \"rgb Kd\" [ 0.5 0.5 0.5 ]\n"
        "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -9 -9 0  9 -9 0  9 9 0  -9 "
        "9 0 ]\n"
        "WorldEnd\n";
    const double unshadowed = 0.25;  // Kd/pi * pi * cos 60
    EXPECT_TRUE(dimsTo(renderText(scene, {.seed = 3}).image, tau, unshadowed));
  }
}

TEST_P(ConstantMedium, DimsASensorInsideASphere) {
  // Nothing says that the camera stands in the medium: geometry does.
  const std::string scene =
      "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 8\n"
      "Sampler \"random\" \"integer pixelsamples\" 16\nIntegrator \"volpath\"\nCamera "
      "\"environment\"\nWorldBegin\n" +
      kWhiteEnvironment + constantMedium(GetParam(), 0.8, 0, 0, {-2, -2, -2}, {2, 2, 2}) +
      "Material \"none\"\nMediumInterface \"m\" \"\"\nShape \"sphere\" \"float radius\" 1.5\nWorldEnd\n";
  EXPECT_TRUE(dimsTo(renderText(scene).image, 0.8 * 1.5));
}

TEST_P(ConstantMedium, IsSeamlessBetweenTwoSlabsThatShareAFace) {
  const std::string scene = pencil(8, 64, "\"volpath\"", "", 0.9) + "WorldBegin\n" + kWhiteEnvironment +
                            constantMedium(GetParam(), 1, 0, 0, {-1, -1, 1}, {1, 1, 2}, "a") +
                            constantMedium(GetParam(), 2, 0, 0, {-1, -1, 2}, {1, 1, 3}, "b") +
                            mediumBox("a", {-1, -1, 1}, {1, 1, 2}) + mediumBox("b", {-1, -1, 2}, {1, 1, 3}) +
                            "WorldEnd\n";
  EXPECT_TRUE(dimsTo(renderText(scene).image, 3));
}

INSTANTIATE_TEST_SUITE_P(AllStorages, ConstantMedium,
                         testing::Values(Storage::Homogeneous, Storage::OneVoxel, Storage::Grid64),
                         [](const auto& value) {
                           return value.param == Storage::Homogeneous ? "Homogeneous"
                                  : value.param == Storage::OneVoxel  ? "OneVoxel"
                                                                      : "Grid64";
                         });

TEST(GridBorder, FadesOverTheOuterHalfVoxelByDefault) {
  // Ones on n^3 samples with sigma L = 2: tau = 2 (1 - 1/(4n)) along the central axis.
  for (const int n : {1, 2, 3, 8}) {
    std::ostringstream os;
    os << pencil(8, 4, "\"volpath\"", "", 1e-7) << "WorldBegin\n"
       << kWhiteEnvironment
       << "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ 2 2 2 ] "
       << "\"rgb sigma_s\" [ 0 0 0 ] \"integer nx\" " << n << " \"integer ny\" " << n << " \"integer nz\" "
       << n << " \"point p0\" [ -0.5 -0.5 1 ] \"point p1\" [ 0.5 0.5 2 ] \"float density\" [ ";
    for (int i = 0; i < n * n * n; ++i) os << "1 ";
    os << "]\n" << mediumBox("m", {-0.5, -0.5, 1}, {0.5, 0.5, 2}) << "WorldEnd\n";
    EXPECT_TRUE(dimsTo(renderText(os.str()).image, 2 * (1 - 1 / (4.0 * n)))) << "n " << n;
  }
}

TEST(GridBorder, TestSeesTheDifferenceToTheClampedRule) {
  // Negative control: the clamped rule has tau = 2.
  const std::string scene = pencil(8, 4, "\"volpath\"", "", 1e-7) + "WorldBegin\n" + kWhiteEnvironment +
                            constantMedium(Storage::OneVoxel, 2, 0, 0, {-0.5, -0.5, 1}, {0.5, 0.5, 2}) +
                            mediumBox("m", {-0.5, -0.5, 1}, {0.5, 0.5, 2}) + "WorldEnd\n";
  EXPECT_FALSE(dimsTo(renderText(scene).image, 2 * (1 - 1 / 4.0)));
}

TEST(TrilinearCell, WithOneHotCornerHasTheClosedFormAlongEdgeAndDiagonals) {
  // 2^3 samples at the corners of [0.5, 1.5]^3, one of them 1; sigma 3. The boundary is a thin prism that
  // starts at the hot corner and ends at the far end of the edge or diagonal, so nothing else counts.
  struct Case {
    const char* name;
    Vec3d direction;
    double depth;
  };
  const Case cases[] = {{"edge", {1, 0, 0}, 0.5},
                        {"face diagonal", {1, 1, 0}, std::sqrt(2.0) / 3},
                        {"body diagonal", {1, 1, 1}, std::sqrt(3.0) / 4}};
  for (const Case& c : cases) {
    const double l = length(c.direction);
    const Vec3d from = Vec3d{0.5, 0.5, 0.5} - c.direction * 4.0, to = Vec3d{0.5, 0.5, 0.5};
    std::ostringstream view, prism;
    view.precision(17);
    view << "LookAt " << from.x << ' ' << from.y << ' ' << from.z << "  " << to.x << ' ' << to.y << ' '
         << to.z << "  0.1 0.2 1";
    // Camera space: +z forward; the prism reaches from the corner at z = 4 l to z = 5 l.
    prism << "AttributeBegin\nCoordSysTransform \"camera\"\nMaterial \"none\"\nMediumInterface \"m\" \"\"\n"
          << boxMesh({-0.01, -0.01, 4 * l}, {0.01, 0.01, 5 * l}) << "AttributeEnd\n";
    const std::string scene =
        pencil(8, 4, "\"volpath\"", view.str(), 1e-7) + "WorldBegin\n" + kWhiteEnvironment +
        "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ 3 3 3 ] "
        "\"rgb sigma_s\" [ 0 0 0 ] \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 "
        "\"point p0\" [ 0 0 0 ] \"point p1\" [ 2 2 2 ] \"float density\" [ 1 0 0 0 0 0 0 0 ]\n" +
        prism.str() + "WorldEnd\n";
    EXPECT_TRUE(dimsTo(renderText(scene).image, 3 * c.depth)) << c.name;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
