// SPDX-License-Identifier: BSD-2-Clause
#include "media/emission/emission_distance.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {
namespace {

/// 1 - exp(-depth), to rounding.
double absorbedOf(double depth) {
  if (depth > 0x1p-5) return -std::expm1(-depth);
  // Most cells of a thin medium: the series up to depth^7.
  const double x = depth;
  return x * (1 - x / 2 * (1 - x / 3 * (1 - x / 4 * (1 - x / 5 * (1 - x / 6 * (1 - x / 7))))));
}

/// What an interval absorbs of light that crosses it; a length may be infinite where sigma is not 0.
EmissionSampler::Channels absorbedOn(const EmissionSampler::Channels& sigmaT, double length) {
  const auto absorbed = [&](double sigma) { return sigma > 0 ? absorbedOf(sigma * length) : 0.0; };
  const double first = absorbed(sigmaT[0]);
  return {first, sigmaT[1] == sigmaT[0] ? first : absorbed(sigmaT[1]),
          sigmaT[2] == sigmaT[0] ? first : absorbed(sigmaT[2])};
}

/// Inverts it: x in [0, length] with density proportional to exp(-sigma x).
double attenuatedDistance(double sigma, double length, double u) {
  const double x = sigma > 0 ? -std::log1p(u * std::expm1(-sigma * length)) / sigma : u * length;
  return std::clamp(x, 0.0, length);
}

/// How much a law falls over an interval of optical depth; 0 where that is so little that its digits are
/// lost, but -g' is then as good as constant.
double fallOver(const AnyLaw& law, double depth, double length) {
  constexpr double kLeast = 1e-9;
  const double before = transmittanceOf(law, depth),
               difference = before - transmittanceOf(law, depth + length);
  return difference > kLeast * before ? difference : 0;
}

double sum(const EmissionSampler::Channels& c) { return c[0] + c[1] + c[2]; }

}  // namespace

void EmissionSampler::add(double sEnter, double sExit, const Channels& emission, const Channels& sigmaT,
                          double tag) {
  if (!(sExit > sEnter)) return;
  const double length = sExit - sEnter;
  const Channels throughBefore = through_, depthBefore = depth_;
  Channels weights{};
  if (law_ != nullptr) {
    weights = collidedUnderLaw(sigmaT, length);
    for (std::size_t c = 0; c < 3; ++c) weights[c] = emission[c] > 0 ? emission[c] * weights[c] : 0;
  } else {
    const Channels absorbed = absorbedOn(sigmaT, length);
    for (std::size_t c = 0; c < 3; ++c) {
      // The integral of exp(-sigma x) over the interval.
      if (emission[c] > 0) {
        weights[c] = emission[c] * through_[c] * (sigmaT[c] > 0 ? absorbed[c] / sigmaT[c] : length);
      }
      through_[c] *= 1 - absorbed[c];
    }
  }
  const double attenuated = sum(weights), emitted = share_ > 0 ? sum(emission) * length : 0;
  const double weight = defensive_ ? emitted : attenuated, before = defensive_ ? totalEmitted_ : total_;
  total_ += attenuated;
  totalEmitted_ += emitted;
  if (!(weight > 0)) return;
  // The first to weigh anything is chosen without a random number.
  if (hasChosen_ && rng_.uniformDouble() * (before + weight) >= weight) return;
  hasChosen_ = true;
  sEnter_ = sEnter;
  sExit_ = sExit;
  tag_ = tag;
  emission_ = emission;
  sigmaT_ = sigmaT;
  throughBefore_ = throughBefore;
  depthBefore_ = depthBefore;
  weight_ = weights;
}

EmissionSampler::Channels EmissionSampler::collidedUnderLaw(const Channels& sigmaT, double length) {
  Channels collided{};
  for (std::size_t c = 0; c < 3; ++c) {
    if (c > 0 && sigmaT[c] == sigmaT[c - 1] && depth_[c] == depth_[c - 1]) {
      collided[c] = collided[c - 1];
    } else {
      const double difference = fallOver(*law_, depth_[c], sigmaT[c] * length);
      collided[c] = difference > 0 ? difference / sigmaT[c]
                                   : collisionDensityOf(*law_, depth_[c] + sigmaT[c] * length / 2) * length;
    }
  }
  for (std::size_t c = 0; c < 3; ++c) depth_[c] += sigmaT[c] * length;
  return collided;
}

double EmissionSampler::offsetUnderLaw(std::size_t channel, double length) {
  const double depth = depthBefore_[channel], sigma = sigmaT_[channel], u = rng_.uniformDouble();
  const double difference = fallOver(*law_, depth, sigma * length);
  if (!(difference > 0)) return u * length;
  const double reached = depthReachedOf(*law_, transmittanceOf(*law_, depth) - u * difference);
  return std::clamp((reached - depth) / sigma, 0.0, length);
}

double EmissionSampler::densityAt(double offset) const {
  double attenuated = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(emission_[c] > 0)) continue;
    attenuated +=
        emission_[c] * (law_ != nullptr ? collisionDensityOf(*law_, depthBefore_[c] + sigmaT_[c] * offset)
                                        : throughBefore_[c] * std::exp(-sigmaT_[c] * offset));
  }
  double density = total_ > 0 ? (1 - share_) * attenuated / total_ : 0;
  if (share_ > 0 && totalEmitted_ > 0) density += share_ * sum(emission_) / totalEmitted_;
  return density;
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
    offset = law_ != nullptr ? offsetUnderLaw(channel, length)
                             : attenuatedDistance(sigmaT_[channel], length, rng_.uniformDouble());
  }
  const double pdf = densityAt(offset);
  if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
  return Distance{sEnter_ + offset, pdf, tag_};
}

}  // namespace pbrtmedia
