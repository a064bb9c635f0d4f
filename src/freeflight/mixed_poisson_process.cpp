// SPDX-License-Identifier: BSD-2-Clause
#include "freeflight/mixed_poisson_process.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "transmittance/parts/gamma_variate.h"

namespace pbrtmedia {
namespace {

/// C below which gamma is 1 within rounding.
constexpr double kNoCorrelation = 1e-9;

double pinkFactor(double correlation, SampleStream& stream) {
  return correlation < kNoCorrelation ? 1 : gammaVariate(1 / (correlation * correlation), stream);
}

struct Factor {
  SampleStream& stream;

  double operator()(const ExponentialLaw&) const { return 1; }
  double operator()(const PinkNoiseLaw& law) const { return pinkFactor(law.correlation, stream); }
  double operator()(const MixtureLaw& law) const {
    return stream.uniform() < law.weight ? law.thin : law.thick;
  }
  double operator()(const DavisLaw& law) const {
    if (law.beta == 1) return pinkFactor(law.correlation, stream);
    if (law.beta == 0) return law.correlation > 0 ? std::log1p(law.correlation) / law.correlation : 1;
    return 1;  // without correlation
  }
  double operator()(const LinearLaw&) const {
    throw std::logic_error("the linear law is no mixture of exponential ones");
  }
};

/// The logarithm of a variate S > 0 with E exp(-F S) = exp(-F^beta), beta in (0, 1). Kanter 1975,
/// doi:10.1214/aop/1176996309.
double logStable(double beta, SampleStream& stream) {
  const double u = std::numbers::pi * stream.uniformAboveZero(), e = stream.exponential();
  // At u = pi the sine is tiny, as it should be, but for rounding it might be negative.
  const double sine = std::max(std::sin(u), std::numeric_limits<double>::min());
  return std::log(std::sin(beta * u)) - std::log(sine) / beta +
         (1 - beta) / beta * (std::log(std::sin((1 - beta) * u)) - std::log(e));
}

}  // namespace

double davisJump(const DavisLaw& law, double depth, SampleStream& stream) {
  const double beta = law.beta;
  const double y = std::pow(depth, beta) * std::pow(law.correlation, 1 + beta);
  // c depth^beta of the law of V, tilted.
  const double whole = beta / (1 + y), part = (1 - beta) * (y > 0 ? std::log1p(y) / y : 1);
  double tilt = y;
  if (stream.uniform() * (whole + part) >= whole) tilt = std::expm1(stream.uniform() * std::log1p(y));
  // Given E, now exponential with rate 1 + tilt, what is left is a stable variate of scale exponent *
  // depth^-beta, tilted by exp(-depth x). It is accepted with probability exp(-depth x), as a sum of so many
  // parts that each often is: Hofert 2011, doi:10.1145/2043635.2043638.
  const double exponent = stream.exponential() * (tilt / (1 + tilt));
  if (!(exponent > 0)) return 0;
  const double parts = std::max(1.0, std::ceil(exponent)), logScale = std::log(exponent / parts) / beta;
  double sum = 0;  // depth times x
  for (double n = 0; n < parts; ++n) {
    for (;;) {
      const double x = std::exp(logScale + logStable(beta, stream));
      if (stream.uniform() >= std::exp(-x)) continue;
      sum += x;
      break;
    }
  }
  return sum / depth;
}

MixedPoissonProcess::MixedPoissonProcess(const AnyLaw& law, SampleStream& stream) {
  if (const auto* davis = std::get_if<DavisLaw>(&law);
      davis != nullptr && davis->beta > 0 && davis->beta < 1 && davis->correlation >= kNoCorrelation) {
    hasJumps_ = true;
    law_ = *davis;
    rate_ = 0;
    exponent_ = stream.exponential();
    nextJump_ = law_.depthOfExponent(exponent_);
    return;
  }
  rate_ = std::visit(Factor{stream}, law);
}

double MixedPoissonProcess::next(SampleStream& stream) {
  const double step = rate_ > 0 ? stream.exponential() / rate_ : std::numeric_limits<double>::infinity();
  if (!hasJumps_) return step;
  if (depth_ + step < nextJump_ || std::isinf(nextJump_)) {
    depth_ += step;
    return step;
  }
  const double toJump = nextJump_ - depth_;
  depth_ = nextJump_;
  rate_ += davisJump(law_, depth_, stream);
  exponent_ += stream.exponential();
  nextJump_ = law_.depthOfExponent(exponent_);
  return toJump;
}

}  // namespace pbrtmedia
