// SPDX-License-Identifier: BSD-2-Clause
#include "media/homogeneous.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "media/box_emission.h"
#include "media/coefficients.h"
#include "media/emission_distance.h"

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
}

Rgb HomogeneousMedium::transmittance(const Segment& segment, Rng&, RenderCounters&) const {
  const double distance = segment.length();
  const auto through = [&](float sigma) {
    return static_cast<float>(std::exp(-opticalDepth(sigma, distance)));
  };
  return grey_ ? Rgb(through(sigmaT_.r)) : Rgb(through(sigmaT_.r), through(sigmaT_.g), through(sigmaT_.b));
}

FreeFlight HomogeneousMedium::sampleFreeFlight(const Segment& segment, Rng& rng, RenderCounters&) const {
  // A medium of nothing takes no random number: its boundaries leave the image as it is, bit for bit.
  if (sigmaT_.isBlack()) return {};
  const double length = segment.length();
  const std::size_t channel = grey_ ? 0 : rng.uniformInt(3);
  const double rate = sigmaT_[channel];
  const double flight = rate > 0 ? rng.exponential() / rate : std::numeric_limits<double>::infinity();
  const bool collided = flight < length;
  FreeFlight result;
  result.collided = collided;
  result.t = collided ? segment.tMin + flight : 0;
  if (grey_) {
    // Transmittance and density cancel; what is left is the albedo.
    if (collided) result.weight = sigmaS_ / sigmaT_.r;
    return result;
  }
  // Numerator and mean density are divided by the transmittance of the clearest channel: never 0/0.
  const double distance = collided ? flight : length;
  const double clearest = opticalDepth(sigmaT_.min(), distance);
  double numerator[3], density = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double depth = opticalDepth(sigmaT_[c], distance);
    const double relative = depth > clearest ? std::exp(clearest - depth) : 1.0;
    density += relative * (collided ? static_cast<double>(sigmaT_[c]) : 1.0) / 3;
    numerator[c] = relative * (collided ? static_cast<double>(sigmaS_[c]) : 1.0);
  }
  for (std::size_t c = 0; c < 3; ++c) result.weight[c] = static_cast<float>(numerator[c] / density);
  return result;
}

FlightControl HomogeneousMedium::flightControl(const Segment& segment) const {
  FlightControl control{{}, sigmaT_};
  for (std::size_t c = 0; c < 3; ++c) {
    control.depth[c] = static_cast<float>(opticalDepth(sigmaT_[c], segment.length()));
  }
  return control;
}

namespace {

/// One interval: the medium itself.
template <class Profile>
void addWhole(Profile& profile, Rgb emission, Rgb sigmaT, double length) {
  profile.add(0, length, {emission.r, emission.g, emission.b}, {sigmaT.r, sigmaT.g, sigmaT.b});
}

}  // namespace

EmissionDistance HomogeneousMedium::sampleEmission(const Segment& segment, Rng& rng, RenderCounters&) const {
  EmissionSampler sampler(0, rng);
  addWhole(sampler, emission_, sigmaT_, segment.length());
  const auto distance = sampler.distance();
  if (!distance) return {};
  return {segment.tMin + distance->s, distance->pdf, emission_};
}

double HomogeneousMedium::emissionDistancePdf(const Segment& segment, double t) const {
  EmissionDensity density(0, t - segment.tMin);
  addWhole(density, emission_, sigmaT_, segment.length());
  return density.pdf();
}

std::unique_ptr<const EmissionVolume> HomogeneousMedium::emissionVolume(const Bounds3f& boundary) const {
  if (!isEmissive() || boundary.isEmpty()) return nullptr;
  return BoxEmission::over(boundary, emission_);
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
