// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/position_lights.h"

#include <gtest/gtest.h>

#include "support/many_lights.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;

/// The integral of what arrives of all lights over a line, by one light and one distance.
double oneSample(const PositionLights& lights, const test::ManyLights& table,
                 const PositionLights::Stretch& stretch, const PositionLights::Stretch& told, Rng& rng) {
  const std::optional<StretchSample> s = lights.sample(stretch, rng.uniform(), rng.uniform());
  if (!s) return 0;
  const Point3f p = stretch.ray.o + static_cast<float>(s->t) * stretch.ray.d;
  return double{table[s->light].sample(p, {}).radiance.r} / lights.pdf(s->light, told, s->t);
}

TEST(PositionLights, OneOfManyStandsForAllOfThem) {
  const test::ManyLights table(120);
  const PositionLights lights(table.lights());
  Ray ray;
  ray.o = {-9, -8, -7};
  ray.d = normalize(Vector3f{1, 1, 0.7f});
  const PositionLights::Stretch stretch{ray, 0, 25};
  double truth = 0;
  constexpr int kSteps = 100000;
  for (std::size_t i = 0; i < table.size(); ++i) {
    if (!lights.contains(i)) continue;
    for (int k = 0; k < kSteps; k += 1) {
      const Point3f p = ray.o + static_cast<float>(25 * (k + 0.5) / kSteps) * ray.d;
      truth += double{table[i].sample(p, {}).radiance.r} * 25 / kSteps;
    }
  }
  const auto test = [&](const PositionLights::Stretch& told) {
    return test::runZTest([&](Rng& rng) { return oneSample(lights, table, stretch, told, rng); }, truth, 5,
                          200000);
  };
  const test::ZTest right = test(stretch);
  EXPECT_LT(std::abs(right.z()), kMaxAbsZ) << right;
  EXPECT_TRUE(right.sees(0.05)) << right;
  const test::ZTest wrong = test({ray, -5, 25});
  EXPECT_GT(std::abs(wrong.z()), kMaxAbsZ) << wrong;
}

TEST(PositionLights, StatesTheDensityItSamplesWith) {
  const test::ManyLights table(90);
  const PositionLights lights(table.lights());
  Ray ray;
  ray.o = {3, -8, 2};
  ray.d = normalize(Vector3f{0, 1, 0.2f});
  const PositionLights::Stretch stretch{ray, 0.5, 12};
  Rng rng(4);
  int found = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto s = lights.sample(stretch, rng.uniform(), rng.uniform());
    if (!s) continue;
    ++found;
    EXPECT_NEAR(s->pdf, lights.pdf(s->light, stretch, s->t), 1e-9 * s->pdf);
  }
  EXPECT_GT(found, 300);
}

}  // namespace
}  // namespace pbrtmedia
