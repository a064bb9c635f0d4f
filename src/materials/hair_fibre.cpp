// SPDX-License-Identifier: BSD-2-Clause
#include "materials/hair_fibre.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "base/math.h"
#include "materials/fresnel.h"

namespace pbrtmedia {
namespace {

constexpr float power(float x, int n) {
  float result = 1;
  for (; n > 0; n /= 2, x *= x) result *= n % 2 != 0 ? x : 1;
  return result;
}

/// log of the modified Bessel function I0; the series until it has all digits, else the expansion at
/// infinity.
float logBesselI0(float x) {
  constexpr float kSeries = 12;
  if (x > kSeries) {
    const float r = 1 / (8 * x);
    return x + std::log1p(r * (1 + r * (4.5f + 37.5f * r))) - 0.5f * std::log(2 * kPi * x);
  }
  const float q = 0.25f * x * x;
  float term = 1, sum = 1;
  for (int i = 1; term > 1e-8f * sum; ++i) {
    term *= q / static_cast<float>(i * i);
    sum += term;
  }
  return std::log(sum);
}

/// Longitudinal density around the mirror direction, normalised over cosθi dθi: d'Eon et al. 2011, "An
/// Energy-Conserving Hair Reflectance Model", Eq. (7), in a form that does not overflow.
float longitudinal(float sinI, float cosI, float sinO, float cosO, float variance) {
  const float a = cosI * cosO / variance, b = sinI * sinO / variance, c = 1 / variance;
  return std::exp(logBesselI0(a) - b - c) / (variance * -std::expm1(-2 * c));
}

/// The logistic distribution cut off at ±π.
float logistic(float x, float scale) {
  const float e = std::exp(-std::abs(x) / scale);
  return e / (scale * sqr(1 + e));
}
float logisticCdf(float x, float scale) { return 1 / (1 + std::exp(-x / scale)); }
float trimmedLogistic(float x, float scale) {
  return logistic(x, scale) / (logisticCdf(kPi, scale) - logisticCdf(-kPi, scale));
}
float sampleTrimmedLogistic(float u, float scale) {
  const float lo = logisticCdf(-kPi, scale);
  const float at = lo + u * (logisticCdf(kPi, scale) - lo);
  return std::clamp(-scale * std::log(1 / at - 1), -kPi, kPi);
}

float wrapped(float angle) { return std::remainder(angle, 2 * kPi); }

/// Two numbers from every second bit of one, each of half its digits.
std::array<float, 2> split(float u) {
  const auto bits = static_cast<std::uint32_t>(static_cast<double>(u) * 0x1p24);
  std::array<std::uint32_t, 2> half{};
  for (unsigned i = 0; i < 12; ++i) {
    half[0] |= (bits >> (2 * i + 1) & 1u) << i;
    half[1] |= (bits >> (2 * i) & 1u) << i;
  }
  // In the middle of the steps that the digits leave.
  return {(static_cast<float>(half[0]) + 0.5f) * 0x1p-12f, (static_cast<float>(half[1]) + 0.5f) * 0x1p-12f};
}

}  // namespace

/// What depends on wo alone.
struct HairFibre::View {
  float phi;
  std::array<float, kLobes> sinTheta, cosTheta;  ///< of wo, tilted as the scales make each lobe see it
  std::array<float, kLobes> variance;
  std::array<float, kLobes - 1> turn;  ///< change of the azimuth along the smooth path
  std::array<Rgb, kLobes> attenuation;
  std::array<float, kLobes> choice;  ///< probability of each lobe, as its mean attenuation
};

HairFibre::HairFibre(const HairParams& p)
    : h_(std::clamp(p.h, -1.0f, 1.0f)), eta_(p.eta), sigmaA_(p.sigmaA), sinTilt_(std::sin(radians(p.alpha))) {
  const float m = std::clamp(p.betaM, kMinRoughness, 1.0f), n = std::clamp(p.betaN, kMinRoughness, 1.0f);
  // The fits of Chiang et al., which make steps of roughness look even.
  variance_ = sqr(0.726f * m + 0.812f * m * m + 3.7f * power(m, 20));
  constexpr float kRootPiOver8 = 0.626657069f;
  scale_ = kRootPiOver8 * (0.265f * n + 1.194f * n * n + 5.372f * power(n, 22));
}

HairFibre::View HairFibre::viewFrom(Vector3f wo) const {
  View v;
  const float sinO = std::clamp(wo.x, -1.0f, 1.0f), cosO = safeSqrt(1 - sqr(sinO));
  v.phi = std::atan2(wo.z, wo.y);
  const float sin1 = sinTilt_, cos1 = safeSqrt(1 - sqr(sin1));
  const float sin2 = 2 * sin1 * cos1, cos2 = sqr(cos1) - sqr(sin1);
  const float sin4 = 2 * sin2 * cos2, cos4 = sqr(cos2) - sqr(sin2);
  const std::array<float, kLobes> sinOf{-sin2, sin1, sin4, 0}, cosOf{cos2, cos1, cos4, 1};
  for (std::size_t p = 0; p < kLobes; ++p) {
    v.sinTheta[p] = sinO * cosOf[p] + cosO * sinOf[p];
    v.cosTheta[p] = std::abs(cosO * cosOf[p] - sinO * sinOf[p]);
  }
  v.variance = {variance_, 0.25f * variance_, 4 * variance_, 4 * variance_};

  // The path through the cross-section, with the index that inclined light sees (Bravais).
  const float cosT = safeSqrt(1 - sqr(sinO / eta_));
  const float inclined = safeSqrt(sqr(eta_) - sqr(sinO)) / cosO;
  const float across = inclined > 0 ? h_ / inclined : std::copysign(1.0f, h_);  // grazing where it bends away
  const float sinGammaT = std::clamp(across, -1.0f, 1.0f), cosGammaT = safeSqrt(1 - sqr(sinGammaT));
  const float gammaO = std::asin(h_), gammaT = std::asin(sinGammaT);
  for (std::size_t p = 0; p < v.turn.size(); ++p) {
    const auto n = static_cast<float>(p);
    v.turn[p] = 2 * n * gammaT - 2 * gammaO + n * kPi;
  }

  const float reflected = fresnelDielectric(cosO * safeSqrt(1 - sqr(h_)), 1, eta_);
  const float way = cosT > 0 ? 2 * cosGammaT / cosT : 0;
  const Rgb through(std::exp(-sigmaA_.r * way), std::exp(-sigmaA_.g * way), std::exp(-sigmaA_.b * way));
  v.attenuation[0] = Rgb(reflected);
  v.attenuation[1] = sqr(1 - reflected) * through;
  v.attenuation[2] = v.attenuation[1] * through * reflected;
  for (std::size_t c = 0; c < 3; ++c) {
    const float again = through[c] * reflected;
    v.attenuation[3][c] = again < 1 ? v.attenuation[2][c] * again / (1 - again) : 0;
  }
  float sum = 0;
  for (std::size_t p = 0; p < kLobes; ++p) sum += v.choice[p] = v.attenuation[p].average();
  for (float& choice : v.choice) choice = sum > 0 ? choice / sum : 1.0f / kLobes;
  return v;
}

Rgb HairFibre::f(Vector3f wo, Vector3f wi) const {
  const View v = viewFrom(wo);
  const float sinI = std::clamp(wi.x, -1.0f, 1.0f), cosI = safeSqrt(1 - sqr(sinI));
  const float phi = std::atan2(wi.z, wi.y) - v.phi;
  Rgb sum;
  for (std::size_t p = 0; p < kLobes; ++p) {
    const float azimuthal = p < v.turn.size() ? trimmedLogistic(wrapped(phi - v.turn[p]), scale_) : kInv2Pi;
    sum += v.attenuation[p] *
           (longitudinal(sinI, cosI, v.sinTheta[p], v.cosTheta[p], v.variance[p]) * azimuthal);
  }
  return wi.z != 0 ? sum / std::abs(wi.z) : Rgb();
}

float HairFibre::pdf(Vector3f wo, Vector3f wi) const {
  const View v = viewFrom(wo);
  const float sinI = std::clamp(wi.x, -1.0f, 1.0f), cosI = safeSqrt(1 - sqr(sinI));
  const float phi = std::atan2(wi.z, wi.y) - v.phi;
  float sum = 0;
  for (std::size_t p = 0; p < kLobes; ++p) {
    const float azimuthal = p < v.turn.size() ? trimmedLogistic(wrapped(phi - v.turn[p]), scale_) : kInv2Pi;
    sum += v.choice[p] * longitudinal(sinI, cosI, v.sinTheta[p], v.cosTheta[p], v.variance[p]) * azimuthal;
  }
  return sum;
}

LobeSample HairFibre::sample(Vector3f wo, Point2f u) const {
  const View v = viewFrom(wo);
  const std::array<float, 2> first = split(u.x), second = split(u.y);
  std::size_t p = 0;
  float rest = first[0];
  while (p + 1 < kLobes && rest >= v.choice[p]) rest -= v.choice[p++];

  // Longitudinally as d'Eon, Marschner & Hanika 2013, "Importance Sampling for Physically-Based Hair Fiber
  // Models": a direction around the mirrored one, whose azimuth is then forgotten.
  const float cosine = std::max(
      -1.0f, 1 + v.variance[p] * std::log(second[0] + (1 - second[0]) * std::exp(-2 / v.variance[p])));
  const float sine = safeSqrt(1 - sqr(cosine));
  const float sinI =
      std::clamp(-cosine * v.sinTheta[p] + sine * std::cos(2 * kPi * second[1]) * v.cosTheta[p], -1.0f, 1.0f);
  const float cosI = safeSqrt(1 - sqr(sinI));
  const float turn =
      p < v.turn.size() ? v.turn[p] + sampleTrimmedLogistic(first[1], scale_) : 2 * kPi * first[1];
  const float phi = v.phi + turn;
  const Vector3f wi{sinI, cosI * std::cos(phi), cosI * std::sin(phi)};
  return {f(wo, wi), wi, pdf(wo, wi), kFlags};
}

Rgb StrandAdjoint::f(Vector3f wo, Vector3f wi) const {
  const float across = std::hypot(wo.y, wo.z) * std::abs(wi.z);
  if (!(across > 0)) return {};
  return law.f(wi, wo) * (std::abs(wo.z) * std::hypot(wi.y, wi.z) / across);
}

LobeSample StrandAdjoint::sample(Vector3f wo, Point2f u) const {
  LobeSample s = law.sample(wo, u);
  if (s.pdf > 0) s.f = f(wo, s.wi);
  return s;
}

Rgb hairAbsorption(float eumelanin, float pheomelanin) {
  // d'Eon et al. 2011.
  return eumelanin * Rgb(0.419f, 0.697f, 1.37f) + pheomelanin * Rgb(0.187f, 0.4f, 1.05f);
}

Rgb hairAbsorption(Rgb colour, float betaN) {
  // The fit of Chiang et al.
  const float b = betaN;
  const float fit = 5.969f + b * (-0.215f + b * (2.532f + b * (-10.73f + b * (5.574f + b * 0.245f))));
  Rgb sigmaA;
  for (std::size_t c = 0; c < 3; ++c) sigmaA[c] = sqr(std::log(std::max(colour[c], 1e-6f)) / fit);
  return sigmaA;
}

}  // namespace pbrtmedia
