// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "freeflight/flight_traits.h"
#include "freeflight/inverted_depth.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Ray-marched inversion: the optical depth is added up by the midpoint rule with steps of one size, and the
/// flight ends inside the step where it reaches the exponential variate, as if the density were constant
/// there. Perlin & Hoffert 1989 and most production renderers; the baseline that unbiased samplers are
/// compared with.
///
/// Biased: densities between the midpoints are not seen; the error of smooth ones falls with the square of
/// the step. Cost: one look-up a step.
struct MarchedFlight {
  static constexpr std::string_view kName = "ray-marching";

  double stepSize = 0;
  std::uint64_t steps = 64;

  static constexpr auto parameters() {
    using Self = MarchedFlight;
    return std::tuple{
        Parameter{"flightstepsize", &Self::stepSize,
                  "length of a step, in world units; 0: the line in the medium divided by flightsteps", 0,
                  1e30},
        Parameter{"flightsteps", &Self::steps, "steps of a line when flightstepsize is 0", 1, 0x1p24}};
  }
  FlightTraits traits() const {
    return {
        .summary = "the optical depth by the midpoint rule, inverted where the flight ends",
        .source = "Perlin & Hoffert 1989",
        .useWhen = "a biased baseline is wanted",
        .bias = EstimatorTraits::Bias::Consistent,
        .biasNote = "densities between the steps' midpoints are not seen; falls with the square of the step",
        .control = EstimatorTraits::Control::Unused,
        .laws = LawSet::all(),
        .unitWeights = true};
  }

  template <DensityLine Line, std::size_t N>
  FlightSample<N> operator()(const Line& line, const FlightQuery<N>& query, SampleStream& stream) const {
    FlightSample<N> flight{.weight = query.importance};
    const double length = line.length();
    if (!(maxOf(query.sigmaT) > 0) || !(length > 0)) return flight;
    const InvertedDepth<N> inverted(query, stream);
    const double step =
        stepSize > 0 ? std::max(stepSize, length * kShortest) : length / static_cast<double>(steps);
    double column = 0;
    for (double begin = 0; begin < length; begin += step) {
      const double width = std::min(step, length - begin);
      const double density = static_cast<double>(line.density(begin + width / 2));
      ++flight.tally.lookups;
      if (column + density * width > inverted.column()) {
        flight.collided = true;
        flight.s = begin + (inverted.column() - column) / density;
        flight.weight = inverted.collidedAt(inverted.column());
        return flight;
      }
      column += density * width;
    }
    flight.weight = inverted.passedAt(column);
    return flight;
  }

 private:
  static constexpr double kShortest = 0x1p-24;  ///< of the line: no hang for steps that are too fine
};

}  // namespace pbrtmedia
