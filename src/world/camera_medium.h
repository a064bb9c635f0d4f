// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "world/medium_state.h"
#include "world/scene.h"

namespace pbrtmedia {

/// The media camera rays start in. Immutable, thread-safe.
class CameraMedium {
 public:
  CameraMedium() = default;  ///< vacuum, whatever the geometry says
  /// `origin`: world position of the camera, `time`: of the middle of the shutter interval.
  /// `given`: the scene's explicit camera medium (null pointer: explicitly vacuum); nullopt: found by
  /// geometry, from the boundaries that surround `origin` in several fixed directions. A given medium is used
  /// as it is, under the rules Add and Priority in addition to what geometry finds; where a boundary all
  /// around the camera contradicts it, `warnings()` says so and names both.
  CameraMedium(const Scene& scene, Point3f origin, float time,
               std::optional<const Medium*> given = std::nullopt);

  const MediumState& state() const { return state_; }
  /// Where `state` was found by geometry; rays that start elsewhere may start in other media
  /// (MediaTopology::stateOf). Nothing: camera rays start in it wherever they do.
  std::optional<Point3f> origin() const { return origin_; }
  /// World position of the camera for which `state` holds.
  Point3f place() const { return place_; }
  /// The explicit medium, null when there is none.
  const Medium* given() const { return given_.value_or(nullptr); }
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  MediumState state_;
  Point3f place_;
  std::optional<Point3f> origin_;
  std::optional<const Medium*> given_;
  std::vector<std::string> warnings_;
};

}  // namespace pbrtmedia
