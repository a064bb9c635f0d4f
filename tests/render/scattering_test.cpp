// SPDX-License-Identifier: BSD-2-Clause
// Scattering against closed forms: furnaces, single scattering, invisible boundaries.
#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "support/dimming.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// A 4^3 grid of random densities in [0, 6] over [-1, 1]^3.
std::string bumpyMedium(double albedo, double g) {
  Rng rng(5);
  std::ostringstream os;
  os << "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ " << 1 - albedo << ' '
     << 1 - albedo << ' ' << 1 - albedo << " ] \"rgb sigma_s\" [ " << albedo << ' ' << albedo << ' ' << albedo
     << " ] \"float g\" " << g
     << " \"integer nx\" 4 \"integer ny\" 4 \"integer nz\" 4 \"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 "
        "] "
     << "\"float density\" [ ";
  for (int i = 0; i < 64; ++i) os << 6 * rng.uniform() << ' ';
  os << "]\n";
  return os.str();
}

TEST(WhiteFurnace, IsOneInAVaryingMediumForEveryAsymmetry) {
  for (const double g : {-0.9, 0.0, 0.9}) {
    const std::string scene =
        pencil(6, 256, "\"volpath\" \"integer maxdepth\" 2000", "LookAt 0 0 -4  0 0 0  0 1 0", 1.2) +
        "WorldBegin\n" + kWhiteEnvironment + bumpyMedium(1, g) + mediumBox("m", {-1, -1, -1}, {1, 1, 1}) +
        "WorldEnd\n";
    const ZTest test = zTestOfMean(scene, 1.0);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << "g " << g << ": " << test;
    EXPECT_TRUE(test.sees()) << "g " << g << ": " << test;
  }
}

TEST(WhiteFurnace, IsOneUnderEveryLaw) {
  // Flights and transmittance know the law each in its own way; in a furnace they must agree.
  for (const std::string law : {"\"pinknoise\" \"float correlation\" 1.5", "\"davis\" \"float beta\" .5",
                                "\"linear\" \"float extent\" 4", "\"mixture\" \"float thin\" .1"}) {
    std::string medium = bumpyMedium(1, .3);
    medium.pop_back();
    const std::string scene =
        pencil(6, 256, "\"volpath\" \"integer maxdepth\" 2000", "LookAt 0 0 -4  0 0 0  0 1 0", 1.2) +
        "WorldBegin\n" + kWhiteEnvironment + medium + " \"string law\" " + law + "\n" +
        mediumBox("m", {-1, -1, -1}, {1, 1, 1}) + "WorldEnd\n";
    const ZTest test = zTestOfMean(scene, 1.0);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << law << ": " << test;
    EXPECT_TRUE(test.sees()) << law << ": " << test;
  }
}

TEST(Laws, DimWhatIsSeenThroughThem) {
  // Cubes of optical depth 2: absorbing, and scattering into the dark.
  for (const auto& [law, truth] : {std::pair<std::string, double>{"\"linear\" \"float extent\" 4", .5},
                                   {"\"pinknoise\" \"float correlation\" 1", 1 / 3.0},
                                   {"\"exponential\"", std::exp(-2)}}) {
    for (const bool scatters : {false, true}) {
      const std::string coefficients = scatters ? "\"rgb sigma_s\" [ 1 1 1 ] \"rgb sigma_a\" [ 0 0 0 ] "
                                                : "\"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" [ 1 1 1 ] ";
      // Depth 0: what passes without scattering.
      const std::string scene =
          pencil(6, 256, "\"volpath\" \"integer maxdepth\" 0", "LookAt 0 0 -4  0 0 0  0 1 0") +
          "WorldBegin\n" + kWhiteEnvironment +
          "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 "
          "\"integer nz\" 1 "
          "\"string border\" \"clamp\" \"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 ] \"float density\" "
          "1 " +
          coefficients + "\"string law\" " + law + "\n" + mediumBox("m", {-1, -1, -1}, {1, 1, 1}) +
          "WorldEnd\n";
      std::string deeper = scene;
      deeper.replace(deeper.find("maxdepth\" 0"), 11, "maxdepth\" 3");
      EXPECT_TRUE(dimsTo(renderText(scene).image, -std::log(truth))) << law;
      // An absorber's image does not depend on the depth of paths; a scatterer's gains light.
      if (scatters) {
        EXPECT_GT(imageMean(renderText(deeper).image), truth + .1) << law;
      } else {
        EXPECT_TRUE(dimsTo(renderText(deeper).image, -std::log(truth))) << law;
      }
    }
  }
}

class ConstantFurnace : public testing::TestWithParam<Storage> {};

TEST_P(ConstantFurnace, IsOneForEveryAsymmetryInEveryStorage) {
  for (const double g : {-0.9, 0.0, 0.9}) {
    const std::string scene =
        pencil(4, 64, "\"volpath\" \"integer maxdepth\" 2000", "LookAt 0 0 -4  0 0 0  0 1 0", 1.2) +
        "WorldBegin\n" + kWhiteEnvironment + constantMedium(GetParam(), 0, 2.5, g, {-1, -1, -1}, {1, 1, 1}) +
        mediumBox("m", {-1, -1, -1}, {1, 1, 1}) + "WorldEnd\n";
    const ZTest test = zTestOfMean(scene, 1.0);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(GetParam()) << ", g " << g << ": " << test;
  }
}

TEST_P(ConstantFurnace, SingleScatteringUnderADistantLightHasItsClosedForm) {
  // Cube [-1, 1]^3, light of irradiance 1 from above (+y), horizontal rays at height y.
  const double sigmaA = 0.3, sigmaS = 0.7, sigmaT = sigmaA + sigmaS;
  for (const double y : {-0.8, 0.0, 0.6}) {
    std::ostringstream view;
    view << "LookAt 0 " << y << " -4  0 " << y << " 0  0 1 0";
    const std::string scene =
        pencil(6, 256, "\"volpath\" \"integer maxdepth\" 1", view.str()) + "WorldBegin\n" +
        "LightSource \"distant\" \"point from\" [ 0 1 0 ] \"point to\" [ 0 0 0 ] \"rgb L\" [ 1 1 1 ]\n" +
        constantMedium(GetParam(), sigmaA, sigmaS, 0, {-1, -1, -1}, {1, 1, 1}) +
        mediumBox("m", {-1, -1, -1}, {1, 1, 1}) + "WorldEnd\n";
    const double truth =
        sigmaS / (4 * M_PI * sigmaT) * std::exp(-sigmaT * (1 - y)) * (1 - std::exp(-2 * sigmaT));
    const ZTest test = zTestOfMean(scene, truth);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << nameOf(GetParam()) << ", y " << y << ": " << test;
  }
}

INSTANTIATE_TEST_SUITE_P(AllStorages, ConstantFurnace,
                         testing::Values(Storage::Homogeneous, Storage::OneVoxel, Storage::Grid64),
                         [](const auto& value) {
                           return value.param == Storage::Homogeneous ? "Homogeneous"
                                  : value.param == Storage::OneVoxel  ? "OneVoxel"
                                                                      : "Grid64";
                         });

TEST(WhiteFurnace, TestSeesAbsorption) {
  const std::string scene =
      pencil(6, 64, "\"volpath\" \"integer maxdepth\" 2000", "LookAt 0 0 -4  0 0 0  0 1 0", 1.2) +
      "WorldBegin\n" + kWhiteEnvironment + bumpyMedium(0.97, 0) + mediumBox("m", {-1, -1, -1}, {1, 1, 1}) +
      "WorldEnd\n";
  EXPECT_GT(std::abs(zTestOfMean(scene, 1.0).z()), kMaxAbsZ);
}

TEST(EmptyShells, ChangeNothingAtAll) {
  // (The spatial strategy would choose lights by a grid over all surfaces, shells included.)
  // 200 spheres without material and medium around a lit ball and a smoke box, depth limit 3, or aside: few
  // shapes are met otherwise than many, to the last digit.
  const std::string head =
      "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
      "Sampler \"halton\" \"integer pixelsamples\" 8\n"
      "Integrator \"volpath\" \"integer maxdepth\" 3 \"string lightsamplestrategy\" \"uniform\"\nLookAt 0 0 "
      "-12  0 0 0  0 1 0\nCamera \"perspective\" "
      "\"float fov\" 22\n"
      "WorldBegin\n" +
      kWhiteEnvironment + "LightSource \"point\" \"point from\" [ 3 4 -5 ] \"rgb I\" [ 20 10 5 ]\n" +
      bumpyMedium(0.8, 0.3) + mediumBox("m", {-1, -1, -1}, {1, 1, 1}) +
      "AttributeBegin\nTranslate 1.2 -0.5 0.4\nMaterial \"matte\"\nShape \"sphere\" \"float radius\" "
      "0.7\nAttributeEnd\n";
  std::ostringstream shells;
  // Pairs of spheres with an empty medium between them: boundaries that a ray must cross rightly, and nothing
  // else.
  shells << "MakeNamedMedium \"empty\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] \"rgb "
            "sigma_s\" [ 0 0 0 ]\n"
         << "Material \"none\"\n";
  for (int i = 0; i < 200; ++i) {
    shells << "MediumInterface " << (i % 2 == 0 ? "\"\" \"empty\"" : "\"empty\" \"\"")
           << "\nShape \"sphere\" \"float radius\" " << 2.5 + 0.01 * i << '\n';
  }
  const Image plain =
      renderText(head + "Translate 60 0 0\n" + shells.str() + "WorldEnd\n", {.seed = 4}).image;
  const Image shelled = renderText(head + shells.str() + "WorldEnd\n", {.seed = 4}).image;
  ASSERT_GT(imageMean(plain), 0.1);
  EXPECT_EQ(plain.data(), shelled.data());
}

}  // namespace
}  // namespace pbrtmedia::test
