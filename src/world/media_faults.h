// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "world/camera_medium.h"

namespace pbrtmedia {

/// What a boundary's fault means for the image and what to do about it, for messages that name the boundary:
/// "as the boundary of medium "fog" it faces inward: ...".
std::string describeFault(const Primitive& boundary, BoundaryFault fault);

/// A boundary that is not the surface of its inside medium, so that rays are in that medium where it should
/// not be, and what is to be said of it.
struct FaultyBoundary {
  const Primitive* boundary;
  std::string message;
};
/// Boundaries with a fault that nothing else in the scene explains. Where a closed one faces inward, and the
/// medium on its far side is neither the camera's nor named by another boundary; where faces disagree; where
/// an open one has rays on its inner side that meet no further surface (some fixed rays are tried).
std::vector<FaultyBoundary> findFaultyBoundaries(const Scene& scene, const CameraMedium& camera);

/// Media with densities in a box that no boundary with the medium inside comes near, and that the camera is
/// not in: nobody sees them.
std::vector<const Medium*> findUnreachedMedia(const Scene& scene, const CameraMedium& camera);

}  // namespace pbrtmedia
