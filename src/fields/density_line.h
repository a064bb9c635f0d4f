// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <concepts>
#include <cstddef>
#include <span>
#include <utility>

#include "fields/super_voxel.h"

namespace pbrtmedia {

/// Accepts every interval of a walk; stands for any visitor in the concepts below.
struct AnyIntervalVisitor {
  template <class Bounds>
  bool operator()(double, double, const Bounds&) const {
    return true;
  }
  bool operator()(double, double) const { return true; }
};

/// What a line answers: float in the renderer, double where answers are compared with exact ones.
template <class L>
using DensityOf = decltype(std::declval<const L&>().density(0.0));

/// A density along one segment with its bounds: all that an estimator or a sampler sees. The renderer, the
/// benchmarks and the one-dimensional tests each bring their own. Points on it are given by s, 0 <= s <=
/// length, in the unit of the segment's t.
///
/// `density(s)` is the unitless density >= 0 at s; `densities(s, out)` answers a batch of points, out[i]
/// being bit for bit density(s[i]). `walk(visit)` calls visit(sEnter, sExit, bound) with DensityBounds for
/// consecutive intervals, sEnter < sExit; the first begins at 0, each begins where the one before ends, the
/// last ends at the length, and neighbouring empty ones (upper = 0) may come as one. The walk stops when
/// visit answers false. `hasProvenBounds()` tells that the bounds follow from the data, so that nothing need
/// be looked up to trust them; otherwise a bound that leaves nothing open (upper = lower) is worth a probe.
template <class L>
concept DensityLine = requires(const L& line, double s, AnyIntervalVisitor visit,
                               std::span<const double> points, std::span<DensityOf<L>> out) {
  { line.length() } -> std::same_as<double>;
  requires std::floating_point<DensityOf<L>>;
  line.densities(points, out);
  line.walk(visit);
  { line.hasProvenBounds() } -> std::same_as<bool>;
};

/// A line that can be cut where its density stops being smooth: `walkPieces(visit)` calls visit(tEnter,
/// tExit) for consecutive pieces, on each of which the density is a polynomial of degree <= 3 in t. Stretches
/// of density 0 may be left out.
template <class L>
concept PiecewiseCubicLine = DensityLine<L> && requires(const L& line, AnyIntervalVisitor visit) {
  line.walkPieces(visit);
};

/// The scalar twin of every `densities`.
template <class L>
void densitiesOneByOne(const L& line, std::span<const double> s, std::span<DensityOf<L>> out) {
  for (std::size_t i = 0; i < s.size(); ++i) out[i] = line.density(s[i]);
}

}  // namespace pbrtmedia
