// SPDX-License-Identifier: BSD-2-Clause
#include "world/boundary_closure.h"

#include <cmath>
#include <map>
#include <span>
#include <utility>

#include "shapes/shape.h"
#include "textures/texture.h"
#include "world/edge_balance.h"

namespace pbrtmedia {
namespace {

/// Six times the volume under a surface, seen from the origin, by the divergence theorem; its edges if it is
/// a mesh. Those of surfaces that close one another add up.
struct Extent {
  double volume = 0;
  EdgeBalance edges;
  bool isMesh = true;

  void add(const Extent& o) {
    volume += o.volume;
    edges.add(o.edges);
    isMesh = isMesh && o.isMesh;
  }
};

/// The triangles turned so that their normals are those of the surface.
Extent extentOf(const Shape& shape, const TriangleBuffers& triangles) {
  Extent extent;
  for (std::uint32_t i = 0; i < triangles.indices.size(); ++i) {
    const auto& corner = triangles.indices[i];
    const Point3f a = triangles.positions[corner[0]];
    Point3f b = triangles.positions[corner[1]], c = triangles.positions[corner[2]];
    const Vec3d area = cross(Vec3d(b) - Vec3d(a), Vec3d(c) - Vec3d(a));
    if (lengthSquared(area) == 0 && (a == b || b == c || c == a)) continue;  // a line: no surface
    const double sign = dot(area, Vec3d(shape.sample(i, Point2f(0.25f, 0.25f)).n)) < 0 ? -1 : 1;
    if (sign < 0) std::swap(b, c);
    extent.edges.addTriangle(a, b, c);
    extent.volume += sign * dot(area, Vec3d(a));
  }
  return extent;
}

/// Of a curved shape, up to the error of a few samples, which does not touch the sign on convex ones.
Extent sampledExtent(const Shape& shape) {
  constexpr int kSamples = 16;
  const Point3f centre = shape.bounds().centre();
  Extent extent;
  extent.isMesh = false;
  for (int i = 0; i < kSamples; ++i) {
    const float u = (static_cast<float>(i) + 0.5f) / kSamples;
    const ShapeSample s = shape.sample(0, Point2f(u, i % 2 == 0 ? 0.25f : 0.75f));
    extent.volume += 2 * shape.area(0) / kSamples * dot(Vec3d(s.p) - Vec3d(centre), Vec3d(s.n));
  }
  return extent;
}

/// Whether shapes that may close one another point to where they come from, seen from the middle of all.
bool facesMiddle(const std::vector<std::pair<const Primitive*, BoundaryFault>>& parts) {
  constexpr int kSamples = 16;
  Bounds3f all;
  for (const auto& part : parts) all.expand(part.first->shape->bounds());
  const Point3f middle = all.centre();
  double volume = 0, most = 0;
  for (const auto& part : parts) {
    const Shape& shape = *part.first->shape;
    const int samples = shape.primitiveCount() > 1 ? 1 : kSamples;  // anywhere on a triangle it is the same
    for (std::uint32_t i = 0; i < shape.primitiveCount(); ++i) {
      for (int k = 0; k < samples; ++k) {
        const float u = (static_cast<float>(k) + 0.5f) / static_cast<float>(samples);
        const ShapeSample s = shape.sample(i, Point2f(u, k % 2 == 0 ? 0.25f : 0.75f));
        const double share = shape.area(i) / samples * dot(Vec3d(s.p) - Vec3d(middle), Vec3d(s.n));
        volume += share;
        most += std::abs(share);
      }
    }
  }
  return volume < -0.5 * most;
}

/// Nothing when closed and facing outward.
std::optional<BoundaryFault> faultOf(const Extent& extent, bool isClosed) {
  if (!isClosed) return BoundaryFault::Open;
  if (extent.isMesh && !extent.edges.isOriented()) return BoundaryFault::Disagrees;
  if (!(extent.volume > 0)) return BoundaryFault::FacesInward;
  return std::nullopt;
}

bool mayHaveHoles(const Primitive& p) {
  return p.alpha && !dynamic_cast<const ConstantTexture<float>*>(p.alpha);
}

bool isThere(const Primitive& p) {
  const auto* const constant = dynamic_cast<const ConstantTexture<float>*>(p.alpha);
  return !constant || constant->evaluate({}) != 0;
}

}  // namespace

/// Boundaries that are placed together.
class BoundaryClosure::Group {
 public:
  using Faults = std::unordered_map<const Primitive*, BoundaryFault>;
  explicit Group(Faults& faults) : faults_(faults) {}

  /// False when `boundary` alone makes its inside medium one that is not confined.
  bool add(const Primitive& boundary) {
    if (mayHaveHoles(boundary)) {
      faults_[&boundary] = BoundaryFault::MayHaveHoles;
      return false;
    }
    const Shape::Geometry geometry = boundary.shape->geometry();
    const auto* const triangles = std::get_if<TriangleBuffers>(&geometry);
    const Extent extent = triangles ? extentOf(*boundary.shape, *triangles) : sampledExtent(*boundary.shape);
    const bool isClosed = triangles ? extent.edges.isClosed() : boundary.shape->isClosed();
    const auto fault = pbrtmedia::faultOf(extent, isClosed);
    if (fault == BoundaryFault::Open || fault == BoundaryFault::Disagrees) {
      Patchwork& patchwork = patchworks_[{boundary.media.inside, boundary.media.outside}];
      patchwork.extent.add(extent);
      patchwork.parts.emplace_back(&boundary, *fault);
      return true;
    }
    if (fault) faults_[&boundary] = *fault;
    return !fault;
  }
  /// `lose(medium)` for media whose patches do not close.
  template <class Lose>
  void finish(const Lose& lose) {
    for (const auto& [media, patchwork] : patchworks_) {
      const Extent& all = patchwork.extent;
      const auto fault = pbrtmedia::faultOf(all, all.isMesh && all.edges.isClosed());
      if (!fault) continue;
      lose(media.first);
      if (!all.isMesh && patchwork.parts.size() > 1) {
        if (!facesMiddle(patchwork.parts)) continue;  // curved shapes: they may close
        for (const auto& part : patchwork.parts) faults_[part.first] = BoundaryFault::FacesInward;
        continue;
      }
      for (const auto& [part, own] : patchwork.parts) {
        faults_[part] = *fault == BoundaryFault::Open ? own : *fault;
      }
    }
  }

 private:
  struct Patchwork {
    Extent extent;
    std::vector<std::pair<const Primitive*, BoundaryFault>> parts;
  };
  Faults& faults_;
  std::map<std::pair<const Medium*, const Medium*>, Patchwork> patchworks_;
};

BoundaryClosure::BoundaryClosure(const std::vector<std::vector<const Primitive*>>& groups) {
  std::unordered_set<const Medium*> free;
  for (const auto& primitives : groups) {
    Group group(faults_);
    for (const Primitive* p : primitives) {
      if (p->media.same() || !isThere(*p)) continue;
      if (p->media.inside) confined_.insert(p->media.inside);
      free.insert(p->media.outside);
      if (!group.add(*p)) free.insert(p->media.inside);
    }
    group.finish([&](const Medium* medium) { free.insert(medium); });
  }
  for (const Medium* m : free) confined_.erase(m);
}

std::optional<BoundaryFault> BoundaryClosure::faultOf(const Primitive& boundary) const {
  const auto found = faults_.find(&boundary);
  if (found == faults_.end()) return std::nullopt;
  return found->second;
}

}  // namespace pbrtmedia
