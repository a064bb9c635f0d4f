// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/verdict.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "base/parameters.h"

namespace pbrtmedia {
namespace {

using Kind = StressVerdict::Kind;
using End = IsolatedResult::End;
using Control = EstimatorTraits::Control;

constexpr double kLogRare = -14.38;  ///< log of the two-sided probability of |z| > 5, 5.7e-7
constexpr double kFewTrials = 8;
/// One trial's share of the variance above which the variance is not known.
constexpr double kDominated = 0.2;
/// Of transmittance, relative, per unit of 1 + optical depth: densities and bounds are doubles, so what is
/// left are sums and products of many roundings.
constexpr double kRounding = 1e-12;
constexpr double kRangeRounding = 1e-9;
/// Above this depth of the control a single estimate may take seconds.
constexpr double kCostlyControl = 1e7;

/// Whether what the traits promise under a bound is promised here.
bool holdsHere(const EstimatorTraits& t, const StressSetting& s) {
  if (t.control == Control::Unused || t.control == Control::CostOnly) return true;
  return s.isBounding && !s.isBlind;
}
bool isUnbiasedHere(const EstimatorTraits& t, const StressSetting& s) {
  if (t.bias != EstimatorTraits::Bias::Unbiased) return false;
  if (t.control == Control::Unused || t.control == Control::CostOnly) return true;
  return !s.isBlind && (s.isBounding || t.control == Control::Any);
}

Judgement judgeMeanOf(const EstimatorTraits& t, const StressSetting& s, const TrialStats& stats, double z) {
  const Moments& v = stats.value;
  const double n = static_cast<double>(v.count());
  if (n < kFewTrials || std::abs(z) <= kMostAbsZ) return judgeMean(stats, z);
  const bool staysInRange = !t.mayLeaveUnitInterval && holdsHere(t, s);
  if (staysInRange && logChernoffBound(v.mean(), s.exact, n) > kLogRare) {
    return {Kind::Undecided, "values in [0, 1]: events too rare for these trials"};
  }
  const bool looksAtControl = t.control != Control::Unused && t.control != Control::CostOnly;
  if (s.depth / (looksAtControl ? std::min(s.control, 1.0) : 1.0) > std::log(n)) {
    return {Kind::Undecided, "weights spread too far for these trials"};
  }
  if (v.variance() == 0 && !std::isnan(z)) {
    // An event of probability p is missed by n trials with probability exp(-n p).
    const bool isRare = std::abs(v.mean() - s.exact) * n < -kLogRare;
    return isRare ? Judgement{Kind::Undecided, "events too rare for these trials"}
                  : Judgement{Kind::Fail, "biased: all values are equal and wrong"};
  }
  return judgeMean(stats, z);
}

}  // namespace

std::string_view nameOf(Kind kind) {
  constexpr std::string_view kNames[] = {"pass", "expected", "undecided", "skipped", "fail"};
  return kNames[static_cast<int>(kind)];
}

Judgement judgeMean(const TrialStats& stats, double z) {
  const double n = static_cast<double>(stats.value.count());
  if (n < kFewTrials) return {Kind::Undecided, "too few trials within the budget"};
  if (std::abs(z) <= kMostAbsZ) return {Kind::Pass, ""};
  if (std::isnan(z)) return {Kind::Undecided, "the variance overflows"};
  const double total = stats.value.variance() * (n - 1);
  const double share = stats.largestDeviation * stats.largestDeviation / std::max(total, 1e-300);
  if (total > 0 && share > kDominated) return {Kind::Undecided, "one trial makes most of the variance"};
  return {Kind::Fail, "biased"};
}

std::optional<Judgement> judgeEnd(const IsolatedResult& result, bool mayTakeLong, double controlDepth) {
  switch (result.end) {
    case End::NotRun:
      return Judgement{Kind::Skipped, "stopped before"};
    case End::Crashed:
    case End::Threw:
      return Judgement{Kind::Fail, result.message};
    case End::OutOfTime:
      if (mayTakeLong) {
        return Judgement{Kind::Expected, "out of time at a control of depth " + formatNumber(controlDepth)};
      }
      return Judgement{Kind::Fail, "hangs: out of processor time"};
    case End::Done:
      break;
  }
  return std::nullopt;
}

double logChernoffBound(double mean, double expected, double n) {
  const auto part = [](double a, double b) { return a > 0 ? a * std::log(a / b) : 0; };
  mean = std::clamp(mean, 0.0, 1.0);
  return std::log(2.0) - n * std::max(0.0, part(mean, expected) + part(1 - mean, 1 - expected));
}

namespace {

/// What is wrong with single values, if anything is.
std::optional<Judgement> judgeValues(const EstimatorTraits& t, const StressSetting& s,
                                     const TrialStats& stats, bool finiteVariance, StressVerdict& verdict) {
  verdict.finite = stats.nonFinite == 0 ? "yes" : "no";
  if (stats.nonFinite > 0) {
    const std::string count = std::to_string(stats.nonFinite) + " values not finite";
    if (!finiteVariance) return Judgement{Kind::Expected, count + "; the variance is infinite here"};
    if (!s.isBounding) return Judgement{Kind::Expected, count + "; weights overflow under a low control"};
    return Judgement{Kind::Fail, count};
  }
  const bool claimsRange = !t.mayLeaveUnitInterval && holdsHere(t, s);
  const bool isInRange = stats.least >= -kRangeRounding && stats.most <= 1 + kRangeRounding;
  verdict.inRange = isInRange ? "yes" : claimsRange ? "no" : "not claimed";
  if (!claimsRange || isInRange) return std::nullopt;
  return Judgement{Kind::Fail,
                   "leaves [0, 1]: " + formatNumber(stats.least) + " to " + formatNumber(stats.most)};
}

}  // namespace

StressVerdict judge(const EstimatorTraits& t, const StressSetting& s, const IsolatedResult& result) {
  StressVerdict verdict;
  verdict.finite = verdict.inRange = verdict.unbiased = "-";
  verdict.z = std::numeric_limits<double>::quiet_NaN();
  const auto conclude = [&](Kind kind, std::string reason) {
    verdict.kind = kind;
    verdict.reason = std::move(reason);
    return verdict;
  };
  const bool mayTakeLong = t.control != Control::Unused && s.controlDepth > kCostlyControl;
  if (const auto end = judgeEnd(result, mayTakeLong, s.controlDepth)) return conclude(end->kind, end->reason);
  const TrialStats& stats = result.stats;
  const Moments& v = stats.value;
  const bool finiteVariance = holdsHere(t, s) ? t.finiteVariance : t.finiteVarianceUnbounded;
  if (const auto values = judgeValues(t, s, stats, finiteVariance, verdict)) {
    return conclude(values->kind, values->reason);
  }
  // A depth known to rounding only leaves T unknown by as much.
  const double rounding = s.exact * kRounding * (1 + s.depth) + 1e-300;
  const double distance = v.mean() - s.exact;
  const double beyond = std::copysign(std::max(0.0, std::abs(distance) - rounding), distance);
  verdict.z = beyond == 0 ? 0 : beyond / v.meanError();
  if (s.isBlind && std::abs(verdict.z) > kMostAbsZ) {
    verdict.unbiased = "not claimed";
    const std::string count = std::to_string(stats.violations);
    if (stats.violations == 0) return conclude(Kind::Fail, "a bound of 0 hides density, and nobody noticed");
    return conclude(Kind::Expected, "a bound of 0 hides density; noticed " + count + " times");
  }
  if (!isUnbiasedHere(t, s)) {
    verdict.unbiased = "not claimed";
    if (t.bias == EstimatorTraits::Bias::Unbiased)
      return conclude(Kind::Expected, "needs a bounding control");
    const bool isRelative = s.exact > 0;
    const double error = isRelative ? distance / s.exact : distance;
    std::string text(nameOf(t.bias));
    text += isRelative ? ": relative error " : ": error ";
    return conclude(Kind::Pass, text + formatNumber(static_cast<double>(static_cast<float>(error))));
  }
  if (!finiteVariance) {
    verdict.unbiased = "not judged";
    const bool byControl = t.finiteVariance;
    return conclude(Kind::Expected, byControl
                                        ? "infinite variance under this control: the mean cannot be judged"
                                        : "the variance may be infinite: the mean cannot be judged");
  }
  const Judgement mean = judgeMeanOf(t, s, stats, verdict.z);
  verdict.unbiased = mean.kind == Kind::Pass ? "yes" : mean.kind == Kind::Fail ? "no" : "undecided";
  return conclude(mean.kind, mean.reason);
}

}  // namespace pbrtmedia
