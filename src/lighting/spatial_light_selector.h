// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/distribution.h"
#include "lighting/light_selector.h"
#include "lights/illuminant.h"

namespace pbrtmedia {

/// Picks lights by the unoccluded luminance that arrives around the point, estimated once per voxel of a grid
/// over the scene from fixed points inside it; each light gets at least a thousandth of the average. Points
/// outside the grid use the nearest voxel.
///
/// A voxel is filled by the first thread that asks for it and published without locks. Its contents depend on
/// the voxel alone, so results do not depend on scheduling; two threads may fill one voxel at once, then one
/// table is dropped.
///
/// The grid has 64 voxels on the longest axis, fewer when there are so many lights that filling all voxels
/// would exceed fixed budgets of light samples and table entries.
class SpatialLightSelector final : public LightSelector {
 public:
  /// `sceneBounds`: not empty. `lights`: at least one, borrowed.
  SpatialLightSelector(std::span<const Illuminant* const> lights, const Bounds3f& sceneBounds);
  ~SpatialLightSelector() override;
  SpatialLightSelector(const SpatialLightSelector&) = delete;
  SpatialLightSelector& operator=(const SpatialLightSelector&) = delete;

  Choice choose(const LightReceiver& at, float u) const override;
  float probability(const LightReceiver& at, std::size_t light) const override;

  Point3i resolution() const { return resolution_; }
  /// Voxels filled so far.
  std::size_t filledVoxels() const;

 private:
  /// Where a light is probed: a position in the unit cube and a sample of the light.
  struct Probe {
    Point3f position;
    Point2f light;
  };
  const Distribution1D& tableAt(Point3f p) const;
  std::unique_ptr<const Distribution1D> fill(Point3i voxel) const;

  std::vector<const Illuminant*> lights_;
  Bounds3f bounds_;
  std::vector<Probe> probes_;
  Point3i resolution_;
  Vector3f voxelsPerLength_;  ///< 0 on an axis without extent
  std::size_t voxelCount_;
  std::unique_ptr<std::atomic<const Distribution1D*>[]> tables_;  ///< null until filled, x fastest
};

}  // namespace pbrtmedia
