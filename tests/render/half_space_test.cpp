// SPDX-License-Identifier: BSD-2-Clause
// Many orders of scattering against Chandrasekhar's half-space.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>

#include "support/chandrasekhar.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

TEST(HalfSpaceRadiance, HasItsTabulatedValues) {
  EXPECT_NEAR(halfSpaceRadiance(0.5, 1), 0.11523, 5e-6);
  EXPECT_NEAR(halfSpaceRadiance(0.9, 1), 0.41495, 5e-6);
  EXPECT_NEAR(halfSpaceRadiance(0.99, 1), 0.75272, 5e-6);
  EXPECT_EQ(halfSpaceRadiance(0, 0.3), 0);
}

/// A slab as thick as `sigmaT` mean free paths and wider than that each way from its middle, in a white
/// environment, seen under the cosine mu.
std::string slabScene(Storage storage, double albedo, double mu, int samples, double sigmaT = 400) {
  const double sine = std::sqrt(1 - mu * mu);
  const Vec3d a{-2, -2, 0}, b{2, 2, 1};
  std::ostringstream view;
  view.precision(17);
  view << "LookAt " << -3 * sine << " 0 " << -3 * mu << "  0 0 0  0 1 0";
  return pencil(4, samples, R"("volpath" "integer maxdepth" 100000)", view.str()) + "WorldBegin\n" +
         kWhiteEnvironment + constantMedium(storage, (1 - albedo) * sigmaT, albedo * sigmaT, 0, a, b) +
         mediumBox("m", a, b) + "WorldEnd\n";
}

class HalfSpace : public testing::TestWithParam<Storage> {};

TEST_P(HalfSpace, SendsBackWhatChandrasekharFound) {
  // The fewer scatterings a path has, the more paths there are.
  for (const auto& [albedo, samples] : {std::pair{0.5, 1500}, {0.9, 960}, {0.99, 640}}) {
    for (const double mu : {1.0, 0.4}) {
      const ZTest test =
          zTestOfMean(slabScene(GetParam(), albedo, mu, samples), halfSpaceRadiance(albedo, mu));
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ)
          << nameOf(GetParam()) << ", albedo " << albedo << ", mu " << mu << ": " << test;
      EXPECT_TRUE(test.sees()) << test;
    }
  }
}

/// Paths in a grid of ones are the same, however many there are: its super-voxels are as many, or one.
TEST(HalfSpaceScene, IsTheSamePathByPathInAGridOfManyVoxels) {
  const auto image = [](Storage storage) { return renderText(slabScene(storage, 0.9, 0.4, 16)).image; };
  const Image one = image(Storage::OneVoxel), many = image(Storage::Grid64);
  EXPECT_NEAR(imageMean(many), imageMean(one), 1e-3 * imageMean(one));
}

/// A mean free path may be far below what single precision tells of coordinates: what comes back has hardly
/// gone in. Moving scatterings off the boundary by some float spacings made all this black. The box of a grid
/// is not the boundary, but only up to the rounding of hits: so far grids are told.
TEST_P(HalfSpace, IsTheSameHoweverDense) {
  for (const double sigmaT : {4e5, 4e7, 4e10}) {
    if (GetParam() != Storage::Homogeneous && sigmaT > 4e5) continue;
    for (const double mu : {1.0, 0.4}) {
      // By the same random numbers: all lengths are scaled, so most paths are the same.
      const auto mean = [&](double extinction) {
        return imageMean(renderText(slabScene(GetParam(), 0.5, mu, 2048, extinction), {.seed = 1}).image);
      };
      EXPECT_NEAR(mean(sigmaT), mean(400), kVisible * mean(400))
          << nameOf(GetParam()) << ", sigma_t " << sigmaT << ", mu " << mu;
    }
  }
}

TEST(HalfSpaceScene, TestSeesAnAlbedoThatIsALittleWrong) {
  const ZTest test = zTestOfMean(slabScene(Storage::Homogeneous, 0.91, 1, 768), halfSpaceRadiance(0.9, 1));
  EXPECT_GT(std::abs(test.z()), kMaxAbsZ);
}

std::string testName(const testing::TestParamInfo<Storage>& info) {
  return std::array{"Homogeneous", "OneVoxel"}.at(static_cast<std::size_t>(info.param));
}
INSTANTIATE_TEST_SUITE_P(Storages, HalfSpace, testing::Values(Storage::Homogeneous, Storage::OneVoxel),
                         testName);

}  // namespace
}  // namespace pbrtmedia::test
