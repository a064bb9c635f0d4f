// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/reciprocal_verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "base/parameters.h"

namespace pbrtmedia {
namespace {

using Kind = StressVerdict::Kind;
using Bias = EstimatorTraits::Bias;
using Control = EstimatorTraits::Control;

/// Of 1/F, relative: sums and quotients of many roundings.
constexpr double kReciprocalRounding = 1e-12;
/// So many expected events are all missed with the two-sided probability of |z| > 5.
constexpr double kMissedEvents = 14.38;
/// Points of the quadrature in a stretch at least, and on the line.
constexpr int kLeastPoints = 256, kPoints = 1 << 16;

/// Calls visit(sEnter, sExit, points) for stretches of the line, each without jumps if those are known.
template <class Visit>
void forStretches(const CanonicalLine& line, double sEnter, double sExit, Visit&& visit) {
  if (!line.isPiecewiseCubic()) {
    const double share = (sExit - sEnter) / line.length();
    visit(sEnter, sExit, std::max(kLeastPoints, static_cast<int>(share * kPoints)));
    return;
  }
  line.stretch(sEnter, sExit).walkPieces([&](double a, double b) {
    visit(sEnter + a, sEnter + b, kLeastPoints);
    return true;
  });
}

/// Whether nothing can be said of the mean here, and why.
std::optional<std::string> outOfDomain(const ReciprocalTraits& t, const ReciprocalSetting& s) {
  if (t.needsPositiveDensity && !s.isPositive) return "the density is 0 somewhere, where it has no mean";
  if (t.control == Control::Bounding && !s.isBounding) return "needs a bounding control";
  if (t.control == Control::Any && !s.isBounding && !(s.absolute < 1)) {
    return "out of its domain: E abs(1 - density / control) = " +
           formatNumber(std::round(s.absolute * 100) / 100);
  }
  return std::nullopt;
}

bool hasFiniteVariance(const ReciprocalTraits& t, const ReciprocalSetting& s) {
  if (s.isBounding && t.finiteVariance) return true;
  return t.control == Control::Unused ? t.finiteVariance : s.square < t.seriesLimit;
}

/// Where F is 0.
Judgement judgeNothing(const TrialStats& stats, const ReciprocalSetting& s) {
  if (stats.value.count() == 0) return {Kind::Pass, "infinite, as it is"};
  return s.isEmptyUnderControl
             ? Judgement{Kind::Expected, "F is 0 under a control that is not, which no series can tell"}
             : Judgement{Kind::Fail, "finite, where 1/F is not"};
}

}  // namespace

ReciprocalSetting reciprocalSettingOf(const CanonicalLine& line, double sigmaT) {
  const double depth = sigmaT * line.integral(), alpha = line.upperIntegral();
  ReciprocalSetting setting;
  setting.exact = depth > 0 ? 1 / depth : std::numeric_limits<double>::infinity();
  const double integral = line.integral();
  setting.controlOverF = integral > 0 ? alpha / integral : std::numeric_limits<double>::infinity();
  setting.isEmptyUnderControl = !(integral > 0) && alpha > 0;
  setting.isBounding = line.setup().control >= 1;
  setting.isPositive = line.function().range().min > 0;
  if (!(alpha > 0)) return setting;
  line.walk([&](double sEnter, double sExit, const DensityBounds<double>& bound) {
    if (!(bound.upper > 0)) return true;
    forStretches(line, sEnter, sExit, [&](double a, double b, int points) {
      const double share = (b - a) / points / alpha * bound.upper;
      for (int i = 0; i < points; ++i) {
        const double r = 1 - line.density(a + (i + .5) / points * (b - a)) / bound.upper;
        setting.absolute += share * std::abs(r);
        setting.square += share * r * r;
      }
    });
    return true;
  });
  return setting;
}

StressVerdict judgeReciprocal(const ReciprocalTraits& t, const ReciprocalSetting& s,
                              const IsolatedResult& result) {
  StressVerdict verdict;
  verdict.finite = verdict.inRange = verdict.unbiased = "-";
  verdict.z = std::numeric_limits<double>::quiet_NaN();
  const auto conclude = [&](Kind kind, std::string reason) {
    verdict.kind = kind;
    verdict.reason = std::move(reason);
    return verdict;
  };
  if (const auto end = judgeEnd(result, false, 0)) return conclude(end->kind, end->reason);
  const TrialStats& stats = result.stats;
  verdict.finite = stats.nonFinite == 0 ? "yes" : "no";
  if (!std::isfinite(s.exact)) {
    const Judgement nothing = judgeNothing(stats, s);
    return conclude(nothing.kind, nothing.reason);
  }
  const std::string violations = std::to_string(stats.violations);
  if (s.isBlind && (t.control != Control::Unused || stats.nonFinite > 0)) {
    verdict.unbiased = "not claimed";
    if (stats.violations == 0) return conclude(Kind::Fail, "a bound of 0 hides density, and nobody noticed");
    return conclude(Kind::Expected, "a bound of 0 hides density; noticed " + violations + " times");
  }
  if (const auto why = outOfDomain(t, s)) {
    verdict.unbiased = "not claimed";
    return conclude(Kind::Expected, *why);
  }
  if (stats.nonFinite > 0) {
    return conclude(Kind::Fail, std::to_string(stats.nonFinite) + " values not finite");
  }
  const double distance = stats.value.mean() - s.exact;
  const double beyond =
      std::copysign(std::max(0.0, std::abs(distance) - kReciprocalRounding * s.exact), distance);
  verdict.z = beyond == 0 ? 0 : beyond / stats.value.meanError();
  if (t.bias != Bias::Unbiased) {
    verdict.unbiased = "not claimed";
    std::string text(nameOf(t.bias));
    text += ": relative error ";
    return conclude(Kind::Pass,
                    text + formatNumber(static_cast<double>(static_cast<float>(distance / s.exact))));
  }
  if (!hasFiniteVariance(t, s)) {
    verdict.unbiased = "not judged";
    return conclude(Kind::Expected, "the variance may be infinite: the mean cannot be judged");
  }
  // Values that are all equal, a little off: a series that may go on, with as little probability, and never
  // did.
  const double expected = std::abs(distance) / s.exact * static_cast<double>(stats.value.count());
  const bool isRare =
      std::abs(verdict.z) > kMostAbsZ && stats.value.variance() == 0 && expected < kMissedEvents;
  const Judgement mean =
      isRare ? Judgement{Kind::Undecided, "events too rare for these trials"} : judgeMean(stats, verdict.z);
  verdict.unbiased = mean.kind == Kind::Pass ? "yes" : mean.kind == Kind::Fail ? "no" : "undecided";
  return conclude(mean.kind, mean.reason);
}

}  // namespace pbrtmedia
