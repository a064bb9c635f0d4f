// SPDX-License-Identifier: BSD-2-Clause
#include "materials/subsurface_table.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/built_parts.h"
#include "base/math.h"
#include "materials/catmull_rom.h"
#include "materials/fresnel.h"
#include "materials/subsurface_exit.h"

namespace pbrtmedia {
namespace {

constexpr double kInvFourPi = 0.25 * std::numbers::inv_pi;

// The grid of the table, scene-language reference 15.2.
constexpr std::size_t kAlbedos = 100, kRadii = 64;
constexpr float kFirstRadius = 0.0025f, kRadiusFactor = 1.2f;
constexpr double kAlbedoSpread = 8;
constexpr int kDepths = 100;  ///< of the beam, in equal steps of what is scattered

/// Depth along the beam up to which a share of (i + 1/2) / kDepths is scattered, for an extinction of 1.
double depthOf(int i) { return -std::log1p(-(i + 0.5) / kDepths); }

/// Light that scatters once, per single-scattering albedo. It leaves at the critical distance or further.
double singleScattering(double g, double eta, double r) {
  const double nearest = r * std::sqrt(std::max(0.0, eta * eta - 1));
  double sum = 0;
  for (int i = 0; i < kDepths; ++i) {
    const double t = nearest + depthOf(i), d = std::sqrt(r * r + t * t), cosine = t / d;
    const double denominator = 1 + g * g + 2 * g * cosine;
    const double phase = kInvFourPi * (1 - g * g) / (denominator * std::sqrt(denominator));
    const double through =
        1 - static_cast<double>(fresnelDielectric(static_cast<float>(-cosine), 1, static_cast<float>(eta)));
    sum += std::exp(-(d + nearest)) / (d * d) * phase * through * cosine;
  }
  return sum / kDepths;
}

/// Light that scatters more often: dipoles along the beam, with Grosjean's coefficient of diffusion.
class MultipleScattering {
 public:
  MultipleScattering(double albedo, double g, double eta) {
    const double reducedScattering = albedo * (1 - g), absorption = 1 - albedo;
    extinction_ = absorption + reducedScattering;
    reducedAlbedo_ = reducedScattering / extinction_;
    diffusion_ = (2 * absorption + reducedScattering) / (3 * extinction_ * extinction_);
    decay_ = std::sqrt(absorption / diffusion_);
    const double m1 = fresnelMoment1(eta), m2 = fresnelMoment2(eta);
    plane_ = -2 * diffusion_ * (1 + 3 * m2) / (1 - 2 * m1);
    ofFluence_ = 0.25 * (1 - 2 * m1);
    ofFlux_ = 0.5 * (1 - 3 * m2);
  }
  double at(double r) const {
    if (!(reducedAlbedo_ > 0)) return 0;
    double sum = 0;
    for (int i = 0; i < kDepths; ++i) {
      const double real = depthOf(i) / extinction_, image = -real + 2 * plane_;
      const double dr = std::sqrt(r * r + real * real), dv = std::sqrt(r * r + image * image);
      const double er = std::exp(-decay_ * dr), ev = std::exp(-decay_ * dv);
      const double fluence = kInvFourPi / diffusion_ * (er / dr - ev / dv);
      const double flux = kInvFourPi * (real * (1 + decay_ * dr) * er / (dr * dr * dr) -
                                        image * (1 + decay_ * dv) * ev / (dv * dv * dv));
      // Near the beam dipoles are too bright; the empirical correction of the paper.
      const double correction = -std::expm1(-2 * extinction_ * (dr + real));
      sum += correction * (fluence * ofFluence_ + flux * ofFlux_);
    }
    return reducedAlbedo_ * reducedAlbedo_ * sum / kDepths;
  }

 private:
  double extinction_, reducedAlbedo_, diffusion_, decay_, plane_, ofFluence_, ofFlux_;
};

}  // namespace

SubsurfaceTable::SubsurfaceTable(float g, float eta)
    : eta_(eta),
      albedos_(kAlbedos),
      radii_(kRadii),
      profile_(kAlbedos * kRadii),
      cumulative_(kAlbedos * kRadii),
      effective_(kAlbedos) {
  countBuilt(Part::SubsurfaceTables);
  for (std::size_t i = 0; i < kAlbedos; ++i) {
    const double share = static_cast<double>(i) / (kAlbedos - 1);
    albedos_[i] = static_cast<float>(std::expm1(-kAlbedoSpread * share) / std::expm1(-kAlbedoSpread));
  }
  radii_[0] = 0;
  radii_[1] = kFirstRadius;
  for (std::size_t k = 2; k < kRadii; ++k) radii_[k] = radii_[k - 1] * kRadiusFactor;
  std::array<double, kRadii> single{};
  for (std::size_t k = 1; k < kRadii; ++k) {
    single[k] =
        singleScattering(static_cast<double>(g), static_cast<double>(eta), static_cast<double>(radii_[k]));
  }
  for (std::size_t i = 0; i < kAlbedos; ++i) {
    const auto albedo = static_cast<double>(albedos_[i]);
    const MultipleScattering multiple(albedo, static_cast<double>(g), static_cast<double>(eta));
    for (std::size_t k = 1; k < kRadii; ++k) {  // at distance 0 the circle is a point
      const auto r = static_cast<double>(radii_[k]);
      const double profile = kTwoPi * r * (albedo * single[k] + multiple.at(r));
      profile_[i * kRadii + k] = static_cast<float>(std::max(0.0, profile));
    }
    const auto cumulative = std::span(cumulative_).subspan(i * kRadii, kRadii);
    effective_[i] = integrateSpline(radii_, row(profile_, i), cumulative);
    if (effective_[i] <= 1) continue;
    for (std::size_t k = 0; k < kRadii; ++k) {
      profile_[i * kRadii + k] /= effective_[i];
      cumulative[k] /= effective_[i];
    }
    effective_[i] = 1;
  }
}

std::span<const float> SubsurfaceTable::row(const std::vector<float>& of, std::size_t albedo) const {
  return std::span(of).subspan(albedo * kRadii, kRadii);
}

float SubsurfaceTable::radial(float albedo, float r) const {
  const auto ofAlbedo = splineWeights(albedos_, albedo), ofRadius = splineWeights(radii_, r);
  if (!ofAlbedo || !ofRadius) return 0;
  const auto at = [&](float radius, const SplineWeights& w) {
    return ofAlbedo->sum([&](std::size_t i) {
      return w.sum([&](std::size_t k) { return profile_[i * kRadii + k]; });
    }) / (2 * kPi * radius);
  };
  // Toward the beam the quotient is that of the spline's slope; some way into the first piece it is the same.
  constexpr float kLeast = 1e-3f * kFirstRadius;
  const float value = r > kLeast ? at(r, *ofRadius) : at(kLeast, *splineWeights(radii_, kLeast));
  return std::max(0.0f, value);
}

float SubsurfaceTable::effectiveAlbedo(float albedo) const {
  const auto w = splineWeights(albedos_, std::clamp(albedo, 0.0f, 1.0f));
  return w ? std::min(1.0f, w->sum([&](std::size_t i) { return effective_[i]; })) : 0;
}

float SubsurfaceTable::albedoOf(float effectiveAlbedo) const {
  return invertSpline(albedos_, effective_, effectiveAlbedo);
}

float SubsurfaceTable::sampleRadius(float albedo, float u) const {
  const auto w = splineWeights(albedos_, albedo);
  if (!w) return -1;
  std::array<float, kRadii> profile, cumulative;
  for (std::size_t k = 0; k < kRadii; ++k) {
    profile[k] = w->sum([&](std::size_t i) { return profile_[i * kRadii + k]; });
    cumulative[k] = w->sum([&](std::size_t i) { return cumulative_[i * kRadii + k]; });
  }
  if (!(cumulative.back() > 0)) return -1;
  return sampleSpline(radii_, profile, cumulative, u);
}

float SubsurfaceTable::pdfRadius(float albedo, float r) const {
  const float whole = effectiveAlbedo(albedo);
  return whole > 0 ? radial(albedo, r) / whole : 0;
}

Rgb TabulatedProfile::radial(float r) const {
  Rgb sum;
  for (std::size_t c = 0; c < 3; ++c) {
    sum[c] = sqr(extinction[c]) * table->radial(albedo[c], r * extinction[c]);
  }
  return sum;
}

float TabulatedProfile::sampleRadius(std::size_t channel, float u) const {
  if (!(extinction[channel] > 0)) return -1;
  const float r = table->sampleRadius(albedo[channel], u);
  return r < 0 ? r : r / extinction[channel];
}

float TabulatedProfile::pdfRadius(std::size_t channel, float r) const {
  return sqr(extinction[channel]) * table->pdfRadius(albedo[channel], r * extinction[channel]);
}

}  // namespace pbrtmedia
