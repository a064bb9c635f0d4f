// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <concepts>
#include <cstdint>

#include "fields/super_voxel.h"

namespace pbrtmedia {

/// Accepts every interval of a walk; stands for any visitor in the concepts below.
struct AnyIntervalVisitor {
  bool operator()(double, double, const SuperVoxel&) const { return true; }
  bool operator()(double, double) const { return true; }
};

/// A density along one segment with its bounds: all that an estimator or a sampler sees. The renderer, the
/// benchmarks and the one-dimensional tests each bring their own.
///
/// `density(t)` is the unitless density >= 0 at a parameter inside the segment. `walk(visit)` calls
/// visit(tEnter, tExit, bound) for consecutive intervals in order of t, tEnter < tExit; the first begins
/// where the line enters the field, each begins where the one before ends, and neighbouring empty ones (upper
/// = 0) may come as one. The walk stops when visit answers false. `kProvenBounds` tells that the bounds
/// follow from the data; otherwise a zero bound is worth a probe.
template <class L>
concept DensityLine = requires(const L& line, double t, AnyIntervalVisitor visit) {
  { line.density(t) } -> std::same_as<float>;
  line.walk(visit);
  { L::kProvenBounds } -> std::convertible_to<bool>;
};

/// A line that can be cut where its density stops being smooth: `walkPieces(visit)` calls visit(tEnter,
/// tExit) for consecutive pieces, on each of which the density is a polynomial of degree <= 3 in t. Stretches
/// of density 0 may be left out.
template <class L>
concept PiecewiseCubicLine = DensityLine<L> && requires(const L& line, AnyIntervalVisitor visit) {
  line.walkPieces(visit);
};

}  // namespace pbrtmedia
