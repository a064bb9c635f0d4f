// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_stretch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "spectrum/magnitudes.h"
#include "world/scene.h"

namespace pbrtmedia {
namespace {

/// Of flights of light: what passes weighs at most its inverse, however wrong the control is.
constexpr double kLeastProbabilityToPass = 1.0 / 16;

}  // namespace

Segment MediaStretch::segmentIn(const PlacedMedium& m) const {
  const Segment segment{ray_->o, ray_->d, tMin_, tMax_};
  return m.placement ? m.placement->toObject(segment, ray_->time) : segment;
}

Rgb MediaStretch::transmittance(PixelStream random, RenderCounters& counters) const {
  Rgb product(1.0f);
  for (std::size_t i = 0; i < state_->activeCount() && !product.isBlack(); ++i) {
    const PlacedMedium m = state_->active(i);
    product *= m.medium->transmittance(segmentIn(m), random, counters);
  }
  return product;
}

PairedTransmittance MediaStretch::pairedTransmittance(PixelStream random, RenderCounters& counters) const {
  PairedTransmittance product;
  for (std::size_t i = 0; i < state_->activeCount() && !product.isBlack(); ++i) {
    const PlacedMedium m = state_->active(i);
    product *= m.medium->pairedTransmittance(segmentIn(m), random, counters);
  }
  return product;
}

MediumFlight MediaStretch::sampleFreeFlight(Rgb throughput, PixelStream random,
                                            RenderCounters& counters) const {
  if (state_->isVacuum()) return {};
  if (state_->activeCount() > 1) return nearestOfFlights(throughput, random, counters);
  const PlacedMedium m = state_->active(0);
  const FreeFlight f = m.medium->sampleFreeFlight(segmentIn(m), throughput, random, counters);
  return {f.collided, f.t, f.weight, f.collided ? &m.medium->phase() : nullptr, 0};
}

/// Independent free flights through several media. The nearest collision counts. What another medium let
/// through up to there is told by the same flight on the shorter segment: as a flight draws its random
/// numbers on the way (Medium::sampleFreeFlight), a replay of its numbers takes the same steps and passes.
MediumFlight MediaStretch::nearestOfFlights(Rgb throughput, PixelStream random,
                                            RenderCounters& counters) const {
  struct Flight {
    PixelStream::Copy start;
    Rgb passed;
    double tEnd;
  };
  std::vector<Flight> flights;
  flights.reserve(state_->activeCount());
  MediaStretch rest = *this;  // up to the nearest collision so far
  MediumFlight nearest;
  Rgb collidedWeight(1.0f);
  std::size_t winner = state_->activeCount();
  for (std::size_t i = 0; i < state_->activeCount(); ++i) {
    const PlacedMedium m = state_->active(i);
    const PixelStream::Copy start(random);
    const FreeFlight f = m.medium->sampleFreeFlight(rest.segmentIn(m), throughput, random, counters);
    flights.push_back({start, f.weight, rest.tMax_});
    if (!f.collided) continue;
    rest.tMax_ = f.t;
    winner = i;
    collidedWeight = f.weight;
    nearest = {true, f.t, Rgb(1.0f), &m.medium->phase(), i};
  }
  for (std::size_t i = 0; i < flights.size(); ++i) {
    if (i == winner) {
      nearest.weight *= collidedWeight;
      continue;
    }
    const PlacedMedium m = state_->active(i);
    if (flights[i].tEnd != rest.tMax_) {
      const FreeFlight f =
          m.medium->sampleFreeFlight(rest.segmentIn(m), throughput, flights[i].start.stream(), counters);
      // It may collide only by rounding at the very end; then it got there all the same.
      flights[i].passed = f.collided ? Rgb(1.0f) : f.weight;
    }
    nearest.weight *= flights[i].passed;
  }
  return nearest;
}

Rgb MediaStretch::lightThrough(std::optional<std::size_t> source, PixelStream random,
                               RenderCounters& counters) const {
  Rgb product(1.0f);
  for (std::size_t i = 0; i < state_->activeCount() && !product.isBlack(); ++i) {
    const PlacedMedium m = state_->active(i);
    product *= i == source ? m.medium->collisionShare(segmentIn(m), random, counters)
                           : m.medium->transmittance(segmentIn(m), random, counters);
  }
  return product;
}

/// One of what may happen (each medium scatters, or nothing does) with about the probability that it has, at
/// a place of known density, and estimates of what gets there.
MediumFlight MediaStretch::sampleFlightOfLight(std::optional<std::size_t> source, Rgb throughput,
                                               PixelStream random, RenderCounters& counters) const {
  if (state_->isExponential()) return sampleFreeFlight(throughput, random, counters);
  std::vector<ScatteringProposal> proposals;
  proposals.reserve(state_->activeCount());
  Rgb passed = magnitudes(throughput);
  double scattered = 0;
  for (std::size_t i = 0; i < state_->activeCount(); ++i) {
    const PlacedMedium m = state_->active(i);
    ScatteringProposal& p =
        proposals.emplace_back(m.medium->proposeScattering(segmentIn(m), throughput, random, counters));
    passed *= p.passed;
    if (!(p.pdf > 0)) p.scattered = 0;
    scattered += p.scattered;
  }
  const auto passes = static_cast<double>(passed.r + passed.g + passed.b);
  const double toPass = scattered > 0 ? std::max(passes / (passes + scattered), kLeastProbabilityToPass) : 1;
  double u = random.rng().uniformDouble();
  if (u < toPass) return {.weight = lightThrough(source, random, counters) * static_cast<float>(1 / toPass)};
  u = (u - toPass) / (1 - toPass) * scattered;
  std::size_t chosen = 0, last = 0;
  for (; chosen < proposals.size() && u >= proposals[chosen].scattered; ++chosen)
    u -= proposals[chosen].scattered;
  for (std::size_t i = 0; i < proposals.size(); ++i) last = proposals[i].scattered > 0 ? i : last;
  chosen = std::min(chosen, last);  // rounding of the sum
  const ScatteringProposal& p = proposals[chosen];
  const double pdf = (1 - toPass) * p.scattered / scattered * p.pdf;
  const Rgb through = upTo(p.t).lightThrough(source, random, counters);
  return {true, p.t, p.sigmaS * through * static_cast<float>(1 / pdf),
          &state_->active(chosen).medium->phase(), chosen};
}

Rgb MediaStretch::scattering(double t, Vector3f wo, Vector3f wi, RenderCounters& counters) const {
  const MediaStretch point(*state_, *ray_, t, t);
  Rgb sum;
  for (std::size_t i = 0; i < state_->activeCount(); ++i) {
    const PlacedMedium m = state_->active(i);
    const Rgb sigmaS = m.medium->at(point.segmentIn(m).at(t), counters).sigmaS;
    if (!sigmaS.isBlack()) sum += sigmaS * m.medium->phase().evaluate(wo, wi);
  }
  return sum;
}

MediaStretch::Coefficients MediaStretch::coefficients(double t, RenderCounters& counters) const {
  const MediaStretch point(*state_, *ray_, t, t);
  Coefficients sum;
  for (std::size_t i = 0; i < state_->activeCount(); ++i) {
    const PlacedMedium m = state_->active(i);
    const MediumPoint there = m.medium->at(point.segmentIn(m).at(t), counters);
    sum.sigmaS += there.sigmaS;
    sum.sigmaT += there.sigmaT;
  }
  return sum;
}

Rgb MediaStretch::sigmaS(double t, RenderCounters& counters) const {
  return coefficients(t, counters).sigmaS;
}

FlightControl MediaStretch::control() const {
  FlightControl sum{};
  for (std::size_t i = 0; i < state_->activeCount(); ++i) {
    const PlacedMedium m = state_->active(i);
    const FlightControl control = m.medium->flightControl(segmentIn(m));
    sum.depth += control.depth;
    sum.rate += control.rate;
  }
  return sum;
}

double MediaStretch::meanExtinction() const {
  const FlightControl whole = control();
  const double length = tMax_ - tMin_;
  const auto depth = static_cast<double>(whole.depth.average());
  if (length < static_cast<double>(kInfinity)) return length > 0 ? depth / length : 0;
  const auto rate = static_cast<double>(whole.rate.average());
  return rate > 0 || !(depth > 0) ? rate : std::numeric_limits<double>::min();
}

double MediaStretch::flightDensity(double t) const {
  const auto [depth, rate] = upTo(t).control();
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    if (rate[c] > 0) sum += static_cast<double>(rate[c]) * std::exp(-static_cast<double>(depth[c]));
  }
  return sum / 3;
}

EmissionSamples MediaStretch::sampleEmission(std::size_t i, PixelStream random,
                                             RenderCounters& counters) const {
  const PlacedMedium m = state_->active(i);
  EmissionSamples found = m.medium->sampleEmission(segmentIn(m), random, counters);
  for (std::size_t s = 0; s < found.count; ++s) {
    auto& [t, radiance] = found.samples[s];
    for (std::size_t other = 0; other < state_->activeCount() && !radiance.isBlack(); ++other) {
      if (other == i) continue;
      const PlacedMedium o = state_->active(other);
      radiance *= o.medium->transmittance(upTo(t).segmentIn(o), random, counters);
    }
  }
  return found;
}

}  // namespace pbrtmedia
