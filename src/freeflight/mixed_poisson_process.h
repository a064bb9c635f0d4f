// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "transmittance/law.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The tentative collisions of a medium of law g along the optical depth of its bound: points of a Poisson
/// process whose rate is a random factor gamma with E exp(-gamma F) = g(F), which is there for every
/// completely monotone g. Given gamma the medium is exponential, so what null collisions leave of the points
/// is a process of the same kind over the true optical depth: its first point lies beyond F with probability
/// g(F), exactly, whatever the bound. Bitterli et al. 2018, doi:10.1145/3272127.3275103, have the mixture of
/// exponential laws.
///
/// Pink noise: gamma ~ Gamma(shape 1 / C^2, scale C^2), drawn first. Mixture: one of two. Davis: gamma is
/// infinitely divisible, a sum of infinitely many jumps, of which only those that collide are ever drawn.
/// With h = -log g and y = F^beta C^(1+beta),
///   - depths at which a jump collides first are a Poisson process with rate h'(F);
///   - such a jump has the density x exp(-F x) nu(x) / h'(F), nu the Levy measure of h, and collides on at
///   the
///     rate x.
/// As h'(F) = beta / (1 + y) + (1 - beta) log1p(y) / y, x nu(x) is the law of V = (c E)^(1/beta) S, where E
/// is exponential, S stable with E exp(-F S) = exp(-F^beta), and c is C^(1+beta), with probability 1 - beta
/// times a uniform number; the factor exp(-F x) tilts these. No approximation beyond rounding; both ends beta
/// = 0 (gamma = log1p(C) / C) and 1 (pink noise) have a gamma of their own.
///
/// Random numbers are drawn on the way. Cost: for Davis some Newton steps each jump, else one logarithm each
/// point.
class MixedPoissonProcess {
 public:
  /// `law`: of LawSet::mixtures().
  MixedPoissonProcess(const AnyLaw& law, SampleStream& stream);

  /// Optical depth of the bound from one point to the next; the first from 0. May be infinite.
  double next(SampleStream& stream);

 private:
  double rate_ = 1;  ///< gamma, or of Davis's jumps that have collided
  // Davis's law only.
  bool hasJumps_ = false;
  DavisLaw law_;
  double depth_ = 0, exponent_ = 0, nextJump_ = 0;  ///< nextJump_: depth at which h is exponent_
};

/// A jump of the process of `law`, 0 < beta < 1, that collides first at `depth` > 0.
double davisJump(const DavisLaw& law, double depth, SampleStream& stream);

}  // namespace pbrtmedia
