// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>

#include "materials/bssrdf.h"
#include "world/scene.h"

namespace pbrtmedia {

/// Where light that went below a surface comes out of it.
struct SubsurfaceEmergence {
  SceneHit hit;
  SurfaceInteraction si;
  Rgb weight;  ///< radial part over the density of the point
};

/// A point where light comes out that went in at `entry`, on surfaces of the same `material` (object):
/// King et al. 2013, "BSSRDF Importance Sampling". A line is drawn at a sampled distance along the normal or
/// a tangent of the entry, through the sphere that holds all but Bssrdf::kBeyondReach of the light (the rest
/// is lost), and one of its hits is taken. All ways to find a point weigh by their sum. Nothing: none was
/// found. `uWay` chooses line and hit. `queries`: a counter of rays.
std::optional<SubsurfaceEmergence> sampleEmergence(const Scene& scene, const Bssrdf& bssrdf,
                                                   const SurfaceInteraction& entry, float time,
                                                   const Material& material, float uWay, Point2f u,
                                                   std::uint64_t& queries);

}  // namespace pbrtmedia
