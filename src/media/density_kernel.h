// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <string>
#include <utility>

#include "base/transform.h"
#include "fields/clipped_line.h"
#include "fields/closer_bounds.h"
#include "fields/field_bounds.h"
#include "freeflight/any_flight.h"
#include "freeflight/flight_query.h"
#include "freeflight/flight_sample.h"
#include "transmittance/any_estimator.h"
#include "transmittance/estimate.h"
#include "transmittance/paired_estimate.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// A density field with its bounds, as a medium sees it: all that must know the concrete field is behind one
/// virtual call per segment, and static inside (media/field_kernel.h). Look-ups are told in the tallies that
/// come back. Immutable while a pass is rendered, thread-safe.
class DensityKernel {
 public:
  virtual ~DensityKernel() = default;
  DensityKernel(const DensityKernel&) = delete;
  DensityKernel& operator=(const DensityKernel&) = delete;

  const FieldBounds& bounds() const { return bounds_; }
  const SuperVoxels& superVoxels() const { return bounds_.inForce(); }
  const AffineMap& localFromWorld() const { return localFromWorld_; }
  const Transform& worldFromLocal() const { return worldFromLocal_; }

  /// The part of a segment that may meet density; nothing when there is none.
  std::optional<ClippedLine> clip(const Segment& segment) const {
    return ClippedLine::clip(localFromWorld_, superVoxels(), segment);
  }

  virtual Estimate<1> estimate(const ClippedLine& line, const Channels<1>& sigmaT,
                               const AnyEstimator& estimator, SampleStream& stream) const = 0;
  virtual Estimate<3> estimate(const ClippedLine& line, const Channels<3>& sigmaT,
                               const AnyEstimator& estimator, SampleStream& stream) const = 0;
  /// Only where the estimator's traits say tellsSpread.
  virtual PairedEstimate<1> paired(const ClippedLine& line, const Channels<1>& sigmaT,
                                   const AnyEstimator& estimator, SampleStream& stream) const = 0;
  virtual PairedEstimate<3> paired(const ClippedLine& line, const Channels<3>& sigmaT,
                                   const AnyEstimator& estimator, SampleStream& stream) const = 0;
  virtual FlightSample<1> fly(const ClippedLine& line, const FlightQuery<1>& query, const AnyFlight& flights,
                              SampleStream& stream) const = 0;
  virtual FlightSample<3> fly(const ClippedLine& line, const FlightQuery<3>& query, const AnyFlight& flights,
                              SampleStream& stream) const = 0;

  // One look-up each, which the caller counts.
  virtual float density(const ClippedLine& line, double s) const = 0;
  /// At a local point inside the occupied box.
  virtual float density(Vec3d local) const = 0;
  /// The field's own density, not cut to learned bounds; nothing is learned of it.
  virtual float uncutDensity(Vec3d local) const = 0;

  /// The bounds along a line, closer ones where it asks for them (ClippedLine::refineAbove).
  virtual void walk(const ClippedLine& line, const AnyVisit& visit) const = 0;

  /// Whether the density is a cubic on pieces of a line that are known (PiecewiseCubicLine).
  virtual bool hasPieces() const = 0;
  /// Pieces of a line, counted up to `most`; call only if `hasPieces`.
  virtual int countPieces(const ClippedLine& line, int most) const = 0;
  /// Whether many look-ups on a line cost less than as many single ones.
  virtual bool hasBatches() const = 0;

  /// For --verbose.
  virtual std::string describe() const = 0;
  /// What was wrong with densities so far; empty: nothing.
  virtual std::string complaint() const = 0;
  /// Of field and bounds.
  virtual std::size_t bytes() const = 0;

 protected:
  DensityKernel(FieldBounds bounds, const AffineMap& localFromWorld, const Transform& worldFromLocal)
      : bounds_(std::move(bounds)), localFromWorld_(localFromWorld), worldFromLocal_(worldFromLocal) {}

 private:
  FieldBounds bounds_;
  AffineMap localFromWorld_;
  Transform worldFromLocal_;
};

}  // namespace pbrtmedia
