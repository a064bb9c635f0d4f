// SPDX-License-Identifier: BSD-2-Clause
// The estimator of a medium for which nobody named one.
#include "media/tracking_choice.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "media/field_kernel.h"
#include "media/grid_medium.h"
#include "media/procedural_medium.h"
#include "support/grids.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia {
namespace {

std::string chosen(const TrackingFacts& facts) { return std::string(nameOf(chooseEstimator(facts))); }

/// A thin grid of many voxels with loose bounds.
TrackingFacts thinGrid() {
  return {.lines = {.pieces = 60, .column = 2, .lowerShare = .1, .meanShare = .3},
          .sigmaT = 1,
          .provenBounds = true,
          .batchedLookups = true};
}

TEST(TrackingChoice, FollowsWhatLinesMeet) {
  EXPECT_EQ(chosen(thinGrid()), "debiased-ray-marching");
  TrackingFacts thick = thinGrid();
  thick.sigmaT = 10;
  EXPECT_EQ(chosen(thick), "ratio");
  TrackingFacts spiky = thinGrid();
  spiky.lines.meanShare = .01;
  EXPECT_EQ(chosen(spiky), "ratio");
  TrackingFacts slow = thinGrid();
  slow.batchedLookups = false;
  EXPECT_EQ(chosen(slow), "ratio");
  TrackingFacts coarse = thick;
  coarse.lines.pieces = 8;
  EXPECT_EQ(chosen(coarse), "regular");
  TrackingFacts constant = coarse;
  constant.lines.lowerShare = .9;
  EXPECT_EQ(chosen(constant), "residual-ratio");
}

TEST(TrackingChoice, SparesNoLookUpWhereTransmittanceIsAllTheNoise) {
  for (TrackingFacts facts : {thinGrid(), TrackingFacts{.lines = {.lowerShare = .9}, .provenBounds = true}}) {
    facts.onlyAbsorbs = true;
    EXPECT_EQ(chosen(facts), "telescoping-ray-marching");
    facts.lines.pieces = 8;
    EXPECT_NE(chosen(facts), "telescoping-ray-marching") << "what is exact is no better";
  }
}

TEST(TrackingChoice, TrustsNoBoundThatNobodyProved) {
  for (TrackingFacts facts : {thinGrid(), TrackingFacts{.lines = {.pieces = 2, .lowerShare = 1}}}) {
    facts.provenBounds = false;
    EXPECT_EQ(chosen(facts), "ratio");
    EXPECT_GT(std::get<RatioTracking>(chooseEstimator(facts).held().variant).rouletteThreshold, 0);
  }
}

std::unique_ptr<Medium> mediumOf(const GridField::Params& grid, float sigmaT, float albedo = .5f) {
  GridMediumParams params;
  params.sigmaA = Rgb((1 - albedo) * sigmaT);
  params.sigmaS = Rgb(albedo * sigmaT);
  params.grid = grid;
  return makeGridMedium(params, Transform());
}

void expectDescribed(const Medium& medium, const std::string& estimator) {
  EXPECT_NE(medium.describe().find("estimator " + estimator + " (auto)"), std::string::npos)
      << medium.describe();
}

/// Densities around 1/2.
GridField::Params roughGrid(int n) {
  Rng rng(1);
  return test::gridOf(n, n, n, GridBorder::Zero, [&](int, int, int) { return rng.uniform(); });
}

TEST(TrackingChoice, IsMadeFromTheMediumsOwnStatistics) {
  expectDescribed(*mediumOf(test::constantGrid(1, GridBorder::Clamp), 1), "residual-ratio");
  expectDescribed(*mediumOf(test::constantGrid(64, GridBorder::Clamp), 1), "residual-ratio");
  expectDescribed(*mediumOf(roughGrid(4), 1), "regular");
  expectDescribed(*mediumOf(roughGrid(48), 1), "debiased-ray-marching");
  expectDescribed(*mediumOf(roughGrid(48), 100), "ratio");
  for (const float sigmaT : {1.0f, 100.0f}) {
    expectDescribed(*mediumOf(roughGrid(48), sigmaT, 0), "telescoping-ray-marching");
    expectDescribed(*mediumOf(roughGrid(4), sigmaT, 0), "regular");
  }
}

TEST(LineStatistics, AreTheIntegralsOverTheChords) {
  // In a constant medium both bounds are the density; the mean chord of these lines is that of the unit cube.
  const auto of = [](const Transform& worldFromMedium) {
    GridField grid(test::constantGrid(16, GridBorder::Clamp), worldFromMedium);
    FieldBounds bounds = FieldBounds::proven(grid.superVoxels({}));
    return lineStatistics(FieldKernel<GridField>(std::move(grid), std::move(bounds)));
  };
  const LineStatistics lines = of(Transform());
  EXPECT_NEAR(lines.lowerShare, 1, 1e-6);
  EXPECT_NEAR(lines.meanShare, 1, 1e-6);
  EXPECT_GT(lines.column, .5);
  EXPECT_LT(lines.column, std::sqrt(3.0));
  EXPECT_GT(lines.pieces, 8);
  EXPECT_LT(lines.pieces, 3 * 18);
  // Twice as large, the same lines are twice as long.
  EXPECT_NEAR(of(Transform::scale(2, 2, 2)).column, 2 * lines.column, 1e-5 * lines.column);
}

}  // namespace
}  // namespace pbrtmedia
