// SPDX-License-Identifier: BSD-2-Clause
#include "materials/catmull_rom.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace pbrtmedia {
namespace {

const std::vector<float> kNodes{0, 0.5f, 0.7f, 1.5f, 2, 4};

std::vector<float> valuesOf(float (*f)(float)) {
  std::vector<float> values;
  for (const float x : kNodes) values.push_back(f(x));
  return values;
}
float at(const std::vector<float>& values, float x) {
  return splineWeights(kNodes, x)->sum([&](std::size_t i) { return values[i]; });
}

TEST(CatmullRom, GoesThroughItsNodesAndAlongLines) {
  const std::vector<float> line = valuesOf([](float x) { return 3 - 2 * x; });
  for (float x = 0; x <= 4; x += 0.125f) EXPECT_NEAR(at(line, x), 3 - 2 * x, 1e-5f) << x;
  const std::vector<float> any{1, 4, 0, 2, 2.5f, 7};
  for (std::size_t i = 0; i < kNodes.size(); ++i) EXPECT_NEAR(at(any, kNodes[i]), any[i], 1e-5f);
  EXPECT_FALSE(splineWeights(kNodes, -1e-6f));
  EXPECT_FALSE(splineWeights(kNodes, 4.0001f));
  EXPECT_FALSE(splineWeights(kNodes, std::nanf("")));
}

TEST(CatmullRom, HasTheSlopeOfItsNeighboursAtANode) {
  const std::vector<float> any{1, 4, 0, 2, 2.5f, 7};
  const float step = 1e-3f;
  EXPECT_NEAR((at(any, 1.5f + step) - at(any, 1.5f - step)) / (2 * step), (2.5f - 0) / (2 - 0.7f), 1e-2f);
}

TEST(CatmullRom, IntegratesAndInverts) {
  const std::vector<float> f = valuesOf([](float x) { return 1 + x + std::sin(x) * 0.3f; });
  std::vector<float> cumulative(f.size());
  const float whole = integrateSpline(kNodes, f, cumulative);
  double sum = 0;
  constexpr int kSteps = 40000;
  for (int i = 0; i < kSteps; ++i) {
    sum += static_cast<double>(at(f, 4 * (static_cast<float>(i) + 0.5f) / kSteps)) * 4 / kSteps;
  }
  EXPECT_NEAR(whole, sum, 1e-4);
  for (float u = 0.01f; u < 1; u += 0.07f) {
    const float x = sampleSpline(kNodes, f, cumulative, u);
    double below = 0;
    for (int i = 0; i < kSteps; ++i) {
      const float y = x * (static_cast<float>(i) + 0.5f) / kSteps;
      below += static_cast<double>(at(f, y) * x) / kSteps;
    }
    EXPECT_NEAR(below / sum, u, 1e-4) << u;
    EXPECT_NEAR(invertSpline(kNodes, f, at(f, x)), x, 1e-4f);
  }
  EXPECT_EQ(invertSpline(kNodes, f, 0), 0);
  EXPECT_EQ(invertSpline(kNodes, f, 100), 4);
}

}  // namespace
}  // namespace pbrtmedia
