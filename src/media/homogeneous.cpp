// SPDX-License-Identifier: BSD-2-Clause
#include "media/homogeneous.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "base/built_parts.h"
#include "freeflight/inverted_depth.h"
#include "media/coefficients.h"
#include "media/emission/box_emission.h"
#include "media/emission/emission_distance.h"
#include "media/rgb_channels.h"
#include "spectrum/magnitudes.h"

namespace pbrtmedia {
namespace {

/// sigma * distance; nothing is absorbed where sigma is 0, however far.
double opticalDepth(float sigma, double distance) {
  return sigma > 0 ? static_cast<double>(sigma) * distance : 0.0;
}

}  // namespace

HomogeneousMedium::HomogeneousMedium(Params params)
    : Medium(std::move(params.name), params.overlap),
      sigmaS_(params.sigmaS),
      sigmaT_(params.sigmaA + params.sigmaS),
      emission_(params.sigmaA * params.le),
      phase_(makePhaseFunction(params.phase)),
      grey_(sigmaT_.isGrey()) {
  checkCoefficients(params.sigmaA, params.sigmaS, name());
  checkEmission(params.le, emission_, name());
  countBuilt(Part::Media);
  if (!grey_) countBuilt(Part::ChromaticMedia);
  albedo_ = albedoOf(sigmaS_, sigmaT_);
}

Rgb HomogeneousMedium::transmittance(const Segment& segment, PixelStream, RenderCounters&) const {
  const double distance = segment.length();
  const auto through = [&](float sigma) {
    return static_cast<float>(std::exp(-opticalDepth(sigma, distance)));
  };
  return grey_ ? Rgb(through(sigmaT_.r)) : Rgb(through(sigmaT_.r), through(sigmaT_.g), through(sigmaT_.b));
}

FreeFlight HomogeneousMedium::sampleFreeFlight(const Segment& segment, Rgb throughput, PixelStream random,
                                               RenderCounters& counters) const {
  // A medium of nothing takes no random number: its boundaries leave the image as it is, bit for bit.
  if (sigmaT_.isBlack()) return {};
  // What only absorbs dims: its collisions would end paths and nothing else.
  if (sigmaS_.isBlack()) return {false, 0, transmittance(segment, random, counters)};
  return grey_ ? fly(segment, FlightQuery<1>{{sigmaT_.r}}, SampleStream(random.rng()))
               : fly(segment,
                     FlightQuery<3>{.sigmaT = channelsOf(sigmaT_),
                                    .importance = importanceOf(channelsOf(throughput))},
                     SampleStream(random.rng()));
}

template <std::size_t N>
FreeFlight HomogeneousMedium::fly(const Segment& segment, const FlightQuery<N>& query,
                                  SampleStream stream) const {
  const InvertedDepth<N> inverted(query, stream);
  const double length = segment.length(), distance = inverted.column();
  if (!(distance < length)) return {false, 0, toRgb(withoutImportance(query, inverted.passedAt(length)))};
  return {true, segment.tMin + distance,
          toRgb(withoutImportance(query, inverted.collidedAt(distance))) * albedo_};
}

FlightControl HomogeneousMedium::flightControl(const Segment& segment) const {
  FlightControl control{{}, sigmaT_};
  for (std::size_t c = 0; c < 3; ++c) {
    control.depth[c] = static_cast<float>(opticalDepth(sigmaT_[c], segment.length()));
  }
  return control;
}

ScatteringProposal HomogeneousMedium::proposeScattering(const Segment& segment, Rgb throughput,
                                                        PixelStream random, RenderCounters& counters) const {
  ScatteringProposal proposal{.passed = transmittance(segment, random, counters), .sigmaS = sigmaS_};
  for (std::size_t c = 0; c < 3; ++c) {
    proposal.scattered +=
        std::abs(double{throughput[c]}) * double{albedo_[c]} * (1 - double{proposal.passed[c]});
  }
  EmissionSampler sampler(0, random.rng());
  sampler.add(0, segment.length(), channelsOf(magnitudes(throughput) * sigmaS_), channelsOf(sigmaT_));
  if (const auto distance = sampler.distance()) {
    proposal.t = segment.tMin + distance->s;
    proposal.pdf = distance->pdf;
  }
  return proposal;
}

EmissionSamples HomogeneousMedium::sampleEmission(const Segment& segment, PixelStream random,
                                                  RenderCounters& counters) const {
  EmissionSamples samples;
  EmissionSampler sampler(0, random.rng());
  sampler.add(0, segment.length(), channelsOf(emission_), channelsOf(sigmaT_));
  const auto distance = sampler.distance();
  if (!distance) return samples;
  // From the distance itself: far from the segment's origin t is coarser than the way light goes.
  const Rgb through = transmittance({segment.o, segment.d, 0, distance->s}, random, counters);
  samples.add(segment.tMin + distance->s, through * emission_ * static_cast<float>(1 / distance->pdf));
  return samples;
}

std::unique_ptr<const EmissionVolume> HomogeneousMedium::emissionVolume(const Bounds3f& boundary) const {
  if (!isEmissive() || boundary.isEmpty()) return nullptr;
  return BoxEmission::over(boundary, emission_, sigmaT_);
}

Bounds3f HomogeneousMedium::bounds() const {
  return {{-kInfinity, -kInfinity, -kInfinity}, {kInfinity, kInfinity, kInfinity}};
}

std::string HomogeneousMedium::describe() const {
  std::ostringstream text;
  text << "homogeneous, sigma_t " << sigmaT_ << ", exact transmittance, " << (grey_ ? 1 : 3)
       << (grey_ ? " channel" : " channels") << ", phase function " << phase_->typeName();
  if (isEmissive()) text << ", emits " << emission_ << " per length";
  return text.str();
}

}  // namespace pbrtmedia
