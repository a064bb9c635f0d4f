// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/photon_kernel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "integrators/sppm/kernel_schedule.h"
#include "support/function_line.h"

namespace pbrtmedia {
namespace {

using test::simpson;

constexpr KernelShape kShapes[] = {KernelShape::Uniform, KernelShape::Cone, KernelShape::Quadratic,
                                   KernelShape::Quartic};
constexpr double kAlpha = 2.0 / 3;

/// A number in [0, 1) for which level n >= 1 is taken.
double sampleOf(double n) { return 1 - .5 * (std::pow(n, kAlpha - 1) + std::pow(n + 1, kAlpha - 1)); }
KernelSchedule scheduleOf(Debias debias) { return KernelSchedule({.debias = debias, .alpha = kAlpha}); }

/// The mean of f(distance) under a kernel of first radius 1.
template <int kDimensions, class F>
double meanUnder(KernelShape shape, const KernelSizes& sizes, const F& f) {
  const PhotonKernel<kDimensions> kernel(shape, 1, sizes);
  const auto radius = [](double size) { return std::pow(size, 1.0 / kDimensions); };
  const double whole = radius(sizes.base);
  std::vector<double> ends = {0, whole};
  if (sizes.correction) {
    ends.push_back(radius(sizes.correction->size));
    ends.push_back(radius(sizes.correction->size * std::exp(sizes.correction->logRatio)));
  }
  std::sort(ends.begin(), ends.end());
  double sum = 0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    // Off the ends by what distances of single precision cannot tell.
    const double a = ends[i - 1] + 1e-7, b = ends[i] - 1e-7;
    if (!(a < b)) continue;
    sum += simpson(
        [&](double d) {
          return f(d) * kernel(static_cast<float>(d * d)) * kDimensions * std::pow(d, kDimensions - 1);
        },
        a, b, 2000);
  }
  return sum / std::pow(whole, kDimensions);
}

template <int kDimensions>
void expectKernelsOfIntegralOne() {
  for (const KernelShape shape : kShapes) {
    const auto one = [](double) { return 1.0; };
    EXPECT_NEAR((meanUnder<kDimensions>(shape, {}, one)), 1, 1e-5);
    EXPECT_NEAR((meanUnder<kDimensions>(shape, {.base = .3}, one)), 1, 1e-5);
    for (const double level : {1., 2., 7., 60.}) {
      for (const Debias debias : {Debias::Single, Debias::ProgressiveUnbiased}) {
        const KernelSizes sizes = scheduleOf(debias).of(4, sampleOf(level)).sizes;
        ASSERT_TRUE(sizes.correction);
        EXPECT_NEAR((meanUnder<kDimensions>(shape, sizes, one)), 1, 2e-3)
            << kDimensions << ' ' << static_cast<int>(shape) << ' ' << level;
      }
    }
  }
}

TEST(PhotonKernel, HasTheIntegralOneWithAndWithoutACorrection) {
  expectKernelsOfIntegralOne<2>();
  expectKernelsOfIntegralOne<3>();
}

/// Mean squared distances, that is biases, are of known sizes: r² / 2 and 3 r² / 5 evenly, 3 r² / 10 and 2 r²
/// / 5 under a cone.
TEST(PhotonKernel, HasTheBiasOfItsShape) {
  const auto squared = [](double d) { return d * d; };
  EXPECT_NEAR((meanUnder<2>(KernelShape::Uniform, {}, squared)), .5, 1e-5);
  EXPECT_NEAR((meanUnder<3>(KernelShape::Uniform, {}, squared)), .6, 1e-5);
  EXPECT_NEAR((meanUnder<2>(KernelShape::Cone, {}, squared)), .3, 1e-5);
  EXPECT_NEAR((meanUnder<3>(KernelShape::Cone, {}, squared)), .4, 1e-5);
  EXPECT_NEAR((meanUnder<2>(KernelShape::Quadratic, {}, squared)), 1. / 3, 1e-5);
  EXPECT_NEAR((meanUnder<2>(KernelShape::Quartic, {}, squared)), .25, 1e-5);
}

/// A power of 10 over the lower hemisphere, one above a plane, measured at its foot: 10 / (2 pi).
TEST(PhotonKernel, SeesAPointLightOnAPlaneAsItIsPublished) {
  const auto density = [](double r) {
    return [r](double d) { return 10 / (2 * std::numbers::pi * std::pow(1 + r * r * d * d, 1.5)); };
  };
  EXPECT_NEAR((meanUnder<2>(KernelShape::Cone, {}, density(.125))), 1.580462, 2e-6);
}

/// Corrections, each as often as it is taken, make up for the difference of all kernels.
TEST(PhotonKernel, CorrectionsTelescope) {
  const auto squared = [](double d) { return d * d; };
  constexpr int kLevels = 40;
  for (const KernelShape shape : kShapes) {
    for (const Debias debias : {Debias::Single, Debias::ProgressiveUnbiased}) {
      for (const std::int64_t iteration : {0, 1, 9}) {
        const double before = debias == Debias::Single ? 0 : static_cast<double>(iteration);
        double corrected = 0, probability = 0;
        for (int n = 1; n <= kLevels; ++n) {
          const KernelSchedule::Step step = scheduleOf(debias).of(iteration, sampleOf(n));
          EXPECT_DOUBLE_EQ(step.sizes.base, std::pow(before + 1, kAlpha - 1));
          const double p = step.sizes.correction->probability;
          probability += p;
          corrected += p * (meanUnder<2>(shape, step.sizes, squared) -
                            meanUnder<2>(shape, {.base = step.sizes.base}, squared));
        }
        EXPECT_NEAR(probability, 1 - std::pow(kLevels + 1, kAlpha - 1), 1e-12);
        const double first = meanUnder<2>(shape, {.base = std::pow(before + 1, kAlpha - 1)}, squared),
                     last =
                         meanUnder<2>(shape, {.base = std::pow(before + kLevels + 1, kAlpha - 1)}, squared);
        EXPECT_NEAR(first + corrected, last, 1e-3 * first) << static_cast<int>(shape) << ' ' << iteration;
        EXPECT_LT(last, .75 * first);
      }
    }
  }
}

/// Differences over their probability converge: for a cone to 3 (1 - 3 x / 2) over the squared size.
TEST(PhotonKernel, IsExactForLevelsWithoutEnd) {
  for (const double level : {1e6, 1e12}) {
    const KernelSizes sizes = scheduleOf(Debias::Single).of(0, sampleOf(level)).sizes;
    const double size = sizes.correction->size, x = .3, distance = x * std::sqrt(size);
    const DiscKernel kernel(KernelShape::Cone, 1, sizes);
    const double base = 3 * (1 - distance), found = kernel(static_cast<float>(distance * distance)) - base;
    const double limit = 3 * (1 - 1.5 * x) / (size * size);
    EXPECT_NEAR(found, limit, 1e-4 * limit) << level;
  }
  for (const double u : {1 - 0x1p-30, 1 - 0x1p-53}) {  // beyond all that are told apart
    const KernelSizes sizes = scheduleOf(Debias::Single).of(0, u).sizes;
    EXPECT_NEAR(sizes.correction->size, 1 - u, 1e-6 * (1 - u));
    EXPECT_GT(sizes.correction->probability, 0);
    EXPECT_TRUE(std::isfinite(DiscKernel(KernelShape::Quartic, 1, sizes)(0)));
    EXPECT_TRUE(std::isfinite(
        KernelSchedule({.debias = Debias::Single, .alpha = .999}).of(0, u).sizes.correction->probability));
  }
}

TEST(KernelSchedule, TakesLevelsAsOftenAsItSays) {
  constexpr int kSteps = 1 << 20;
  std::vector<int> counts(8);
  for (int i = 0; i < kSteps; ++i) {
    const KernelSizes sizes = scheduleOf(Debias::Single).of(3, (i + .5) / kSteps).sizes;
    const double level = std::pow(sizes.correction->size, 1 / (kAlpha - 1));
    if (level < 7.5) ++counts[static_cast<std::size_t>(std::lround(level))];
  }
  for (std::size_t n = 1; n < counts.size(); ++n) {
    const KernelSchedule::Step step = scheduleOf(Debias::Single).of(3, sampleOf(static_cast<double>(n)));
    EXPECT_NEAR(static_cast<double>(counts[n]) / kSteps, step.sizes.correction->probability, 2. / kSteps);
    EXPECT_NEAR(step.photons, std::pow(static_cast<double>(n) + 1, 1 - 1.001 * kAlpha), 1e-9);
  }
}

TEST(KernelSchedule, OfProgressiveRadiiShrinksByItself) {
  for (const std::int64_t iteration : {0, 1, 99}) {
    const KernelSchedule::Step step = scheduleOf(Debias::Progressive).of(iteration, .9);
    EXPECT_DOUBLE_EQ(step.sizes.base, std::pow(iteration + 1, -1. / 3));
    EXPECT_FALSE(step.sizes.correction);
    EXPECT_EQ(step.photons, 1);
    EXPECT_EQ(scheduleOf(Debias::None).of(iteration, .9).sizes.base, 1);
  }
}

}  // namespace
}  // namespace pbrtmedia
