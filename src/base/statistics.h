// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "base/vec.h"

namespace pbrtmedia {

/// Why a sample was kept off the film.
enum class DropCause { NotANumber, Infinite, Negative, kCount };

/// A density above its bound, with the ray that found it.
struct BoundViolation {
  std::string_view medium;  ///< lives as long as the medium
  Point3f o;                ///< the ray: o + t d, in the space where the medium was defined
  Vector3f d;
  double t = 0, density = 0, bound = 0;
};

/// Event counts of one thread or of a whole render. Every member is a plain sum, so totals do not depend on
/// scheduling. Passed by reference down the call tree; there is no global counter.
struct RenderCounters {
  std::uint64_t cameraSamples = 0;
  std::uint64_t rays = 0;            ///< closest-hit queries
  std::uint64_t shadowRays = 0;      ///< visibility and transmittance queries
  std::uint64_t densityLookups = 0;  ///< evaluations of a density field: the cost axis of every plot
  std::uint64_t nullCollisions = 0;  ///< tentative collisions that were null
  std::uint64_t mediumScatterings = 0;
  std::uint64_t surfaceScatterings = 0;
  std::uint64_t boundViolations = 0;   ///< density above its bound
  double worstBoundRatio = 0;          ///< largest density / bound seen in a violation
  std::uint64_t cappedEstimates = 0;   ///< transmittances that a limit on look-ups cut short
  std::uint64_t stuckPaths = 0;        ///< ended: free flights too short for coordinates to tell
  std::uint64_t mediumMismatches = 0;  ///< crossings where a boundary contradicts the ray's current medium
  std::uint64_t boundaryRepairs = 0;   ///< scatter points that rounding had put beyond their boundary
  std::array<std::uint64_t, static_cast<std::size_t>(DropCause::kCount)> dropped{};
  /// The first violation since this was last emptied: an example, no count, and left out by `add`.
  std::optional<BoundViolation> violation;

  std::uint64_t droppedTotal() const {
    std::uint64_t sum = 0;
    for (const std::uint64_t n : dropped) sum += n;
    return sum;
  }
  void add(const RenderCounters& o) {
    cameraSamples += o.cameraSamples;
    rays += o.rays;
    shadowRays += o.shadowRays;
    densityLookups += o.densityLookups;
    nullCollisions += o.nullCollisions;
    mediumScatterings += o.mediumScatterings;
    surfaceScatterings += o.surfaceScatterings;
    boundViolations += o.boundViolations;
    if (o.worstBoundRatio > worstBoundRatio) worstBoundRatio = o.worstBoundRatio;
    cappedEstimates += o.cappedEstimates;
    stuckPaths += o.stuckPaths;
    mediumMismatches += o.mediumMismatches;
    boundaryRepairs += o.boundaryRepairs;
    for (std::size_t i = 0; i < dropped.size(); ++i) dropped[i] += o.dropped[i];
  }
};

}  // namespace pbrtmedia
