// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "fields/density_line.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "freeflight/flight_traits.h"
#include "freeflight/inverted_depth.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Regular tracking: the optical depth is added up piece by piece, exactly (two-point Gauss-Legendre on a
/// cubic), and inverted within the piece where the flight ends, by bisected Newton steps on the cubic's
/// integral.
///
/// Bias and variance of the weights: none in grey media; at most N in chromatic ones. Cost: two look-ups per
/// crossed piece, four more in the last.
struct RegularFlight {
  static constexpr std::string_view kName = "regular";

  FlightTraits traits() const {
    return {
        .summary = "the exact optical depth, piece by piece, inverted where the flight ends",
        .source = "Amanatides & Woo 1987 for the walk; Gauss-Legendre and Newton's method for the inversion",
        .useWhen = "truth is wanted, or lines cross few voxels",
        .control = EstimatorTraits::Control::Unused,
        .laws = LawSet::all(),
        .needsPieces = true,
        .unitWeights = true};
  }

  template <PiecewiseCubicLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, SampleStream& stream) const {
    FlightSample<N> flight{.weight = query.importance};
    if (!(maxOf(query.sigmaT) > 0)) return flight;
    const InvertedDepth<N> inverted(query, stream);
    double column = 0;
    line.walkPieces([&](double a, double b) {
      constexpr double kGauss = 0.57735026918962576451;  // 1/sqrt(3)
      const double half = (b - a) / 2, middle = a + half;
      const auto at = [&](double t) {
        ++flight.tally.lookups;
        return static_cast<double>(line.density(middle + t * half));
      };
      const double piece = half * (at(-kGauss) + at(kGauss));
      if (!(column + piece > inverted.column())) {
        column += piece;
        return true;
      }
      flight.collided = true;
      const Cubic cubic(at(-.9), at(-.3), at(.3), at(.9));
      flight.s = middle + half * cubic.integralReaches((inverted.column() - column) / half, piece / half);
      return false;
    });
    flight.weight = flight.collided ? inverted.collidedAt(inverted.column()) : inverted.passedAt(column);
    return flight;
  }

 private:
  /// The cubic through values at -0.9, -0.3, 0.3 and 0.9 on [-1, 1].
  class Cubic {
   public:
    Cubic(double v0, double v1, double v2, double v3) {
      // Even and odd parts: a + b t^2 through (.3, .9), t (c + d t^2) likewise.
      const double evenInner = (v1 + v2) / 2, evenOuter = (v0 + v3) / 2;
      const double oddInner = (v2 - v1) / .6, oddOuter = (v3 - v0) / 1.8;
      c_ = {0, 0, (evenOuter - evenInner) / .72, (oddOuter - oddInner) / .72};
      c_[0] = evenInner - .09 * c_[2];
      c_[1] = oddInner - .09 * c_[3];
    }
    /// t in [-1, 1] where the integral from -1 reaches `target`, 0 <= target < whole. The density is >= 0, so
    /// the integral rises; Newton steps that leave the bracket are replaced by bisection.
    double integralReaches(double target, double whole) const {
      double lo = -1, hi = 1, t = whole > 0 ? 2 * target / whole - 1 : 0;
      for (int step = 0; step < 60 && hi - lo > 1e-14; ++step) {
        const double excess = integral(t) - target;
        (excess > 0 ? hi : lo) = t;
        if (std::abs(excess) <= 1e-15 * whole) break;
        const double slope = value(t), next = slope > 0 ? t - excess / slope : lo;
        t = next > lo && next < hi ? next : (lo + hi) / 2;
      }
      return t;
    }

   private:
    double value(double t) const { return c_[0] + t * (c_[1] + t * (c_[2] + t * c_[3])); }
    double primitive(double t) const {
      return t * (c_[0] + t * (c_[1] / 2 + t * (c_[2] / 3 + t * c_[3] / 4)));
    }
    double integral(double t) const { return primitive(t) - primitive(-1); }

    std::array<double, 4> c_;
  };
};

}  // namespace pbrtmedia
