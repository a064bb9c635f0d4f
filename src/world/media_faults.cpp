// SPDX-License-Identifier: BSD-2-Clause
#include "world/media_faults.h"

#include <algorithm>
#include <unordered_set>

#include "base/rng.h"
#include "base/warp.h"
#include "media/medium.h"
#include "shapes/shape.h"
#include "world/line_walk.h"

namespace pbrtmedia {
namespace {

/// Rays that are tried from the inner side of an open boundary.
constexpr int kTrials = 64;

std::string quoted(const Medium* medium) { return medium ? '"' + medium->name() + '"' : "vacuum"; }

/// Whether the medium lies around something for a reason: another boundary names it.
bool isExplained(const Scene& scene, const Medium* medium) {
  for (const auto& group : scene.primitiveGroups()) {
    for (const Primitive* p : group) {
      if (p->media.same()) continue;
      if (p->media.outside == medium) return true;
      if (p->media.inside == medium && scene.boundaries().faultOf(*p) != BoundaryFault::FacesInward)
        return true;
    }
  }
  return false;
}

/// How many of the trial rays from the inner side of a boundary meet nothing further.
int countEscapes(const Scene& scene, const Primitive& boundary, const Placement* placement) {
  Rng rng(hashCombine(boundary.shape->primitiveCount()));
  int escapes = 0;
  for (int i = 0; i < kTrials; ++i) {
    const auto primitive = std::min(
        static_cast<std::uint32_t>(rng.uniform() * static_cast<float>(boundary.shape->primitiveCount())),
        boundary.shape->primitiveCount() - 1);
    const ShapeSample s = boundary.shape->sample(primitive, Point2f(rng.uniform(), rng.uniform()));
    const Vector3f anywhere = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const Vector3f inward = dot(anywhere, s.n) > 0 ? -anywhere : anywhere;
    Ray ray;
    ray.o = s.p;
    ray.d = inward;
    if (placement) {
      ray = placement->worldFromObject(0).ray(ray);
      ray.d = normalize(ray.d);
    }
    // Away from the surface by more than the rounding of the point.
    const float scale = maxComponent(abs(ray.o)) + maxComponent(scene.bounds().diagonal());
    LineWalk walk(scene, ray, Exclusions{});
    std::uint64_t queries = 0;
    std::optional<SceneHit> hit = walk.next(queries);
    while (hit && hit->primitive == &boundary && hit->t() < 1e-5f * scale) hit = walk.next(queries);
    if (!hit) ++escapes;
  }
  return escapes;
}

/// Calls `visit(primitive, placement)` for every boundary as often as it is placed.
template <class Visit>
void forEachBoundary(const Scene& scene, const Visit& visit) {
  auto groups = scene.primitiveGroups();
  for (auto& group : groups) std::erase_if(group, [](const Primitive* p) { return p->media.same(); });
  for (const Primitive* p : groups[0]) visit(*p, nullptr);
  for (const Placement& placement : scene.placements()) {
    for (const Primitive* p : groups[1 + placement.object()]) visit(*p, &placement);
  }
}

/// The box of a boundary in the space in which its inside medium was defined.
Bounds3f boundsInMedium(const Primitive& p, const Placement* placement) {
  const Bounds3f own = p.shape->bounds();
  if (!placement) return own;
  return p.media.insideMoves ? placement->mediaFromObject().bounds(own) : placement->worldBounds(own);
}

bool overlap(const Bounds3f& a, const Bounds3f& b) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (a.max[i] < b.min[i] || b.max[i] < a.min[i]) return false;
  }
  return true;
}

bool isBounded(const Bounds3f& b) { return !b.isEmpty() && maxComponent(b.diagonal()) < kInfinity; }

}  // namespace

std::string describeFault(const Primitive& boundary, BoundaryFault fault) {
  const std::string medium = "as the boundary of medium " + quoted(boundary.media.inside);
  switch (fault) {
    case BoundaryFault::FacesInward:
      return medium + " it faces inward: the medium is outside of it, without end, and " +
             quoted(boundary.media.outside) +
             " is inside; ReverseOrientation before the shape (or none, if there is one) turns it";
    case BoundaryFault::Disagrees:
      return medium +
             " it has faces that point inward and faces that point outward, so that rays that pass through "
             "one of "
             "each take the medium along or lose it; reverse the order of the vertices of the wrong ones";
    case BoundaryFault::Open:
      return medium +
             " it is open: rays that pass by its border take the medium along or enter it unnoticed; close "
             "it, by "
             "further shapes with the same MediumInterface if need be";
    case BoundaryFault::MayHaveHoles:
      break;
  }
  return medium +
         " it has holes where its alpha is 0, and a hole is no boundary: behind it the medium goes on; give "
         "the "
         "boundary to a shape without alpha";
}

std::vector<FaultyBoundary> findFaultyBoundaries(const Scene& scene, const CameraMedium& camera) {
  std::vector<FaultyBoundary> faulty;
  if (!scene.boundaries().hasFaults()) return faulty;
  std::unordered_set<const Primitive*> seen;
  forEachBoundary(scene, [&](const Primitive& p, const Placement* placement) {
    const auto fault = scene.boundaries().faultOf(p);
    if (!fault || *fault == BoundaryFault::MayHaveHoles || !p.media.inside || !seen.insert(&p).second) return;
    if (camera.given() == p.media.inside) return;
    if (*fault == BoundaryFault::FacesInward && isExplained(scene, p.media.inside)) return;
    std::string message = describeFault(p, *fault);
    if (*fault == BoundaryFault::Open) {
      const int escapes = countEscapes(scene, p, placement);
      if (escapes == 0) return;
      message += " (" + std::to_string(escapes) + " of " + std::to_string(kTrials) +
                 " rays from its inner side meet no further surface)";
    }
    faulty.push_back({&p, std::move(message)});
  });
  return faulty;
}

std::vector<const Medium*> findUnreachedMedia(const Scene& scene, const CameraMedium& camera) {
  std::unordered_set<const Medium*> named, reached;
  for (std::size_t i = 0; i < camera.state().activeCount(); ++i)
    reached.insert(camera.state().active(i).medium);
  forEachBoundary(scene, [&](const Primitive& p, const Placement* placement) {
    reached.insert(p.media.outside);
    const Medium* const inside = p.media.inside;
    if (!inside || reached.count(inside) > 0) return;
    named.insert(inside);
    const Bounds3f box = inside->bounds();
    if (!isBounded(box) || overlap(box, boundsInMedium(p, placement))) reached.insert(inside);
  });
  std::vector<const Medium*> unreached;
  for (const Medium* medium : scene.media()) {
    if (named.count(medium) > 0 && reached.count(medium) == 0) unreached.push_back(medium);
  }
  return unreached;
}

}  // namespace pbrtmedia
