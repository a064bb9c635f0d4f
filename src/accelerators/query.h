// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <embree3/rtcore.h>

#include "accelerators/impl.h"

// Internal to the room: other rooms see accelerator.h only.

namespace pbrtmedia {

/// One ray on its way through a scene: what Embree's callbacks have to know, and the nearest hit so far.
class Query {
 public:
  /// `blocker`: Accelerator::occluded.
  Query(const Ray& ray, float tMin, const Exclusions& exclusions, bool shadowRay,
        std::uint32_t blocker = PrimitiveId::kNone);
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  /// Traverses what `accelerator` holds. Afterwards `best()` is the hit, if valid; shadow rays stop at any
  /// hit. A ray beyond the range of Embree, which ends the program at one, meets nothing.
  void run(const Accelerator::Impl& accelerator);
  const RayHit& best() const { return best_; }

  /// A ray that starts at a rounded point of an excluded triangle may start behind a neighbour that it should
  /// cross at once. True when that happened; `best()` is then the neighbour.
  bool crossesNeighbourAtStart(const Accelerator::Impl& world);

  /// Registers the callbacks of user geometry and animated instances.
  static void setUserCallbacks(RTCGeometry geometry);
  static void setInstanceCallbacks(RTCGeometry geometry);

 private:
  struct Context {
    RTCIntersectContext embree;  // must come first: Embree hands back its address
    Query* query;
  };
  static Query& of(RTCIntersectContext* context) { return *reinterpret_cast<Context*>(context)->query; }

  static void filterTriangle(const RTCFilterFunctionNArguments* args);
  static void intersectUser(const RTCIntersectFunctionNArguments* args);
  static void occludedUser(const RTCOccludedFunctionNArguments* args);
  static void intersectInstance(const RTCIntersectFunctionNArguments* args);
  static void occludedInstance(const RTCOccludedFunctionNArguments* args);

  std::uint32_t instance() const;
  /// Without a tree, up to `tMax` inclusive.
  void meet(const FewShapes& few, float tMax);
  bool hitTriangle(const GeometryRecord& record, const RayHit& hit, Vec3d origin, Vec3d direction);
  /// The candidate becomes `best_` when nothing speaks against it.
  bool take(const GeometryRecord& record, const RayHit& hit);
  bool isExcluded(const PrimitiveId& id) const;
  bool isBlocker(const PrimitiveId& id) const {
    return id.geometry == blocker_ && id.instance == PrimitiveId::kNone;
  }
  bool isLeftOut(const GeometryRecord& record, const RayHit& hit, Vec3d direction) const;
  /// Whether the ray passes within rounding of an edge behind which the mesh turns away, as seen along the
  /// ray: it then misses both triangles, rather than one of them by chance.
  bool grazesSilhouette(const GeometryRecord& record, const RayHit& hit, Vec3d origin, Vec3d direction) const;
  /// A point safely inside the triangle of `entry`, when the ray starts within rounding of its border.
  struct BorderStart {
    Point3f inside;   ///< world space
    double rounding;  ///< of the start, world length
  };
  std::optional<BorderStart> borderStart(const Accelerator::Impl& world,
                                         const Exclusions::Entry& entry) const;
  /// `ray` ends at the nearest hit so far.
  bool hitUser(const GeometryRecord& record, std::uint32_t primitive, const Ray& ray, float tMin);
  bool hitUser(const GeometryRecord& record, std::uint32_t primitive, const RTCRay& ray);
  bool hitInstance(const GeometryRecord& record);

  Ray ray_;
  float tMin_;
  const Exclusions& exclusions_;
  bool shadowRay_;
  std::uint32_t blocker_;
  bool onlyAdjacent_ = false;  ///< only neighbours of excluded triangles are hit
  std::uint32_t animatedInstance_ = PrimitiveId::kNone;
  RayHit best_;
  Context context_;
};

}  // namespace pbrtmedia
