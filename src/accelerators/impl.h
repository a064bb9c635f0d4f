// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <embree3/rtcore.h>

#include <memory>
#include <vector>

#include "accelerators/accelerator.h"

// Internal to the room: other rooms see accelerator.h only.

namespace pbrtmedia {

/// One thing that was added, whichever kind. Embree geometries carry a pointer to it.
struct GeometryRecord {
  const Accelerator::Impl* owner = nullptr;
  std::uint32_t number = 0;
  const HitFilter* filter = nullptr;

  TriangleBuffers triangles;                  ///< empty: not triangles
  const UserGeometry* user = nullptr;         ///< null: not user geometry
  const Accelerator::Impl* object = nullptr;  ///< null: not an instance
  AnimatedTransform worldFromObject;          ///< of an instance

  bool isTriangles() const { return !triangles.indices.empty(); }
  std::array<Vec3d, 3> corners(std::uint32_t primitive) const {
    const auto& corner = triangles.indices[primitive];
    return {Vec3d(triangles.positions[corner[0]]), Vec3d(triangles.positions[corner[1]]),
            Vec3d(triangles.positions[corner[2]])};
  }
};

/// Embree leaves out primitives beyond this without a word, and takes rays beyond it for none.
constexpr float kLargestCoordinate = 1.8e18f;

class FewShapes;

struct Accelerator::Impl {
  std::vector<std::unique_ptr<GeometryRecord>> records;
  Bounds3f bounds;
  /// Rays whose origin or direction is beyond it would leave Embree's range in one of its spaces.
  double largestRay = double{kLargestCoordinate};
  bool holdsInstances = false;
  bool isBuilt = false;
  RTCScene scene = nullptr;              ///< null: nothing to hit
  std::unique_ptr<const FewShapes> few;  ///< all there is to hit; null: more than that
  std::size_t bytes = 0;

  Impl();
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl();
  GeometryRecord& add(const HitFilter* filter);
  void attach(GeometryRecord& record);
};

}  // namespace pbrtmedia
