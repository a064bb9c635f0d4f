// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission_distance.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {
namespace {

/// The integral of exp(-sigma x) over [0, length]; a length may be infinite where sigma is not 0.
double attenuatedLength(double sigma, double length) {
  return sigma > 0 ? -std::expm1(-sigma * length) / sigma : length;
}

/// Inverts it: x in [0, length] with density proportional to exp(-sigma x).
double attenuatedDistance(double sigma, double length, double u) {
  const double x = sigma > 0 ? -std::log1p(u * std::expm1(-sigma * length)) / sigma : u * length;
  return std::clamp(x, 0.0, length);
}

double sum(const EmissionProfile::Channels& c) { return c[0] + c[1] + c[2]; }

}  // namespace

EmissionProfile::Step EmissionProfile::advance(double sEnter, double sExit, const Channels& emission,
                                               const Channels& sigmaT) {
  const double length = sExit - sEnter;
  Step step{{}, depth_, 0, 0};
  for (std::size_t c = 0; c < 3; ++c) {
    if (emission[c] > 0) {
      step.weight[c] = emission[c] * std::exp(-depth_[c]) * attenuatedLength(sigmaT[c], length);
    }
    if (sigmaT[c] > 0) depth_[c] += sigmaT[c] * length;
  }
  step.attenuated = sum(step.weight);
  step.emitted = share_ > 0 ? sum(emission) * length : 0;
  total_ += step.attenuated;
  totalEmitted_ += step.emitted;
  return step;
}

double EmissionProfile::densityIn(const Channels& emission, const Channels& sigmaT,
                                  const Channels& depthBefore, double offset) const {
  double attenuated = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (emission[c] > 0) attenuated += emission[c] * std::exp(-depthBefore[c] - sigmaT[c] * offset);
  }
  double density = total_ > 0 ? (1 - share_) * attenuated / total_ : 0;
  if (share_ > 0 && totalEmitted_ > 0) density += share_ * sum(emission) / totalEmitted_;
  return density;
}

void EmissionSampler::add(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT) {
  if (!(sExit > sEnter)) return;
  const Step step = advance(sEnter, sExit, emission, sigmaT);
  const double weight = defensive_ ? step.emitted : step.attenuated;
  if (!(weight > 0)) return;
  const double before = (defensive_ ? totalEmitted() : total()) - weight;
  // The first to weigh anything is chosen without a random number.
  if (hasChosen_ && rng_.uniformDouble() * (before + weight) >= weight) return;
  hasChosen_ = true;
  sEnter_ = sEnter;
  sExit_ = sExit;
  emission_ = emission;
  sigmaT_ = sigmaT;
  depthBefore_ = step.depthBefore;
  weight_ = step.weight;
}

std::optional<EmissionSampler::Distance> EmissionSampler::distance() {
  if (!hasChosen_) return std::nullopt;
  const double length = sExit_ - sEnter_;
  double offset;
  if (defensive_) {
    offset = rng_.uniformDouble() * length;
  } else {
    double u = rng_.uniformDouble() * sum(weight_);
    std::size_t channel = 0;
    while (channel < 2 && u >= weight_[channel]) u -= weight_[channel++];
    while (!(weight_[channel] > 0)) --channel;  // rounding of the sum past the last that weighs anything
    offset = attenuatedDistance(sigmaT_[channel], length, rng_.uniformDouble());
  }
  const double pdf = densityIn(emission_, sigmaT_, depthBefore_, offset);
  if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
  return Distance{sEnter_ + offset, pdf};
}

void EmissionDensity::add(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT) {
  if (!(sExit > sEnter)) return;
  const Step step = advance(sEnter, sExit, emission, sigmaT);
  if (!(s_ >= sEnter && s_ <= sExit) || offset_ >= 0) return;
  offset_ = s_ - sEnter;
  emission_ = emission;
  sigmaT_ = sigmaT;
  depthBefore_ = step.depthBefore;
}

double EmissionDensity::pdf() const {
  return offset_ >= 0 ? densityIn(emission_, sigmaT_, depthBefore_, offset_) : 0;
}

}  // namespace pbrtmedia
