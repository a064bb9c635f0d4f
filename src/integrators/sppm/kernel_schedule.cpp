// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/kernel_schedule.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {
namespace {

/// Levels beyond are one as good as the other: differences over their probability have converged.
constexpr double kMostLevel = 1e15;

}  // namespace

KernelSchedule::Step KernelSchedule::of(std::int64_t iteration, double u) const {
  Step step;
  if (params_.debias == Debias::None) return step;
  const double exponent = params_.alpha - 1;
  const double before = params_.debias == Debias::Single ? 0 : static_cast<double>(iteration);
  step.sizes.base = std::pow(before + 1, exponent);
  if (params_.debias == Debias::Progressive) return step;

  const double tail = 1 - u;  // Pr{level or beyond} is at least this
  const double asked = std::floor(std::pow(tail, 1 / exponent));
  const double level = std::clamp(asked, 1.0, kMostLevel), number = before + level;
  const bool isLast = level == kMostLevel;
  const double reaching = isLast ? tail : std::pow(level, exponent);
  step.sizes.correction = {.size = isLast ? tail : std::pow(number, exponent),
                           .logRatio = exponent * std::log1p(1 / number),
                           .probability = -reaching * std::expm1(exponent * std::log1p(1 / level))};
  step.photons = std::max(1.0, std::pow(asked + 1, 1 - params_.c * params_.alpha));
  return step;
}

}  // namespace pbrtmedia
