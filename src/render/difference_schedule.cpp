// SPDX-License-Identifier: BSD-2-Clause
#include "render/difference_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/diagnostics.h"
#include "base/geometric_levels.h"
#include "base/hash.h"
#include "base/rng.h"

namespace pbrtmedia {
namespace {

/// "diff" in ASCII: keeps the draws of levels apart from other uses of the same seed.
constexpr std::uint64_t kLevelTag = 0x64696666;

/// As a scene holds it.
double rounded(double value) { return static_cast<double>(static_cast<float>(value)); }

double unitInTheLastPlace(double value) {
  const auto size = static_cast<float>(std::abs(value));
  return static_cast<double>(std::nextafter(size, std::numeric_limits<float>::infinity())) -
         static_cast<double>(size);
}

void add(double value, double factor, std::vector<DifferenceTerm>& terms) {
  const auto found =
      std::find_if(terms.begin(), terms.end(), [&](const DifferenceTerm& t) { return t.value == value; });
  if (found == terms.end()) {
    terms.push_back({value, factor});
  } else {
    found->factor += factor;
  }
}

/// Corrections shrink like h or h^2, and the variance is least for levels as likely as their size: Eq. (18).
GeometricLevels levelsOf(DifferenceSchedule::Difference difference) {
  return GeometricLevels(difference == DifferenceSchedule::Difference::Forward ? 0.5 : 0.75);
}

}  // namespace

DifferenceSchedule::DifferenceSchedule(const Params& params) : params_(params) {
  params_.value = rounded(params.value);
  const double x = params_.value, h = params_.step, largest = std::max(std::abs(x), std::abs(x + h));
  if (!std::isfinite(rounded(x - h)) || !std::isfinite(rounded(x + h))) {
    std::ostringstream text;
    text << "a step of " << h << " from " << x << " leaves the numbers of single precision";
    throw SceneError({}, text.str());
  }
  if (rounded(x + h) == x || rounded(x - h) == x) {
    std::ostringstream text;
    text << "a step of " << h << " from " << x << " is lost in single precision; expected at least "
         << static_cast<float>(kLeastUnits * unitInTheLastPlace(largest));
    throw SceneError({}, text.str());
  }
  leastStep_ = std::min(std::abs(h), kLeastUnits * unitInTheLastPlace(largest));
  while (levels_ < kMostLevels && std::abs(stepOfLevel(levels_ + 1)) >= leastStep_) ++levels_;
}

double DifferenceSchedule::stepOfLevel(unsigned level) const {
  return std::ldexp(params_.step, -static_cast<int>(level));
}

double DifferenceSchedule::progressiveStep(std::int64_t pass) const {
  const double size = std::abs(params_.step) * std::pow(static_cast<double>(pass) + 1, -params_.decay);
  return std::copysign(std::max(size, leastStep_), params_.step);
}

void DifferenceSchedule::addQuotient(double step, double factor, std::vector<DifferenceTerm>& terms) const {
  const double x = params_.value, above = rounded(x + step),
               below = params_.difference == Difference::Forward ? x : rounded(x - step);
  const double perStep = factor / (above - below);
  add(above, perStep, terms);
  add(below, -perStep, terms);
}

void DifferenceSchedule::addCorrection(std::int64_t pass, std::vector<DifferenceTerm>& terms) const {
  const GeometricLevels all = levelsOf(params_.difference);
  Rng rng(hashCombine(params_.seed, kLevelTag, static_cast<std::uint64_t>(pass)));
  const unsigned level = all.draw(1 - rng.uniformDouble());
  if (level >= levels_) return;
  const double weight = 1 / all.probability(level);
  addQuotient(stepOfLevel(level + 1), weight, terms);
  addQuotient(stepOfLevel(level), -weight, terms);
}

std::vector<DifferenceTerm> DifferenceSchedule::terms(std::int64_t pass) const {
  std::vector<DifferenceTerm> terms;
  const bool isProgressive = params_.debias == Debias::Progressive;
  addQuotient(isProgressive ? progressiveStep(pass) : params_.step, 1, terms);
  if (params_.debias == Debias::Single) addCorrection(pass, terms);
  std::erase_if(terms, [](const DifferenceTerm& t) { return t.factor == 0; });
  return terms;
}

}  // namespace pbrtmedia
