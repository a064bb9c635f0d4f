// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/query.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "accelerators/few_shapes.h"
#include "accelerators/triangle_pair.h"

namespace pbrtmedia {
namespace {

bool precedes(const PrimitiveId& a, const PrimitiveId& b) {
  return std::tie(a.instance, a.geometry, a.primitive) < std::tie(b.instance, b.geometry, b.primitive);
}

/// Relative to the coordinates: hits farther than this from an end of the ray are not looked at by
/// `TrianglePair::deniesHit`. Only a saving of time: the rule is right for any distance.
constexpr double kNearAnEnd = 1e-2;
/// Relative to the coordinates: how far apart along the ray two triangles are hit when it goes through a
/// common corner, and how far from it or from a common edge, within Embree's tolerance of an ulp.
constexpr double kSameCrossing = 1e-5, kOnEdge = 1e-6;
/// Relative to the coordinates: what is nearer to a silhouette edge than this misses it. Embree's tolerance
/// is an ulp, of each triangle on its own: the one may be hit where the other is not.
constexpr double kOnSilhouette = 4 * 0x1p-24;
/// Hits whose least barycentric weight is more than this are not looked at, nor meshes of more triangles.
constexpr float kNearEdge = 1e-3f;
constexpr std::size_t kMostTriangles = 4096;
/// Relative to the coordinates: rounding of a point and of its way into the space of an instance.
constexpr double kPointRounding = 4 * 0x1p-24;

}  // namespace

Query::Query(const Ray& ray, float tMin, const Exclusions& exclusions, bool shadowRay, std::uint32_t blocker)
    : ray_(ray), tMin_(tMin), exclusions_(exclusions), shadowRay_(shadowRay), blocker_(blocker) {
  rtcInitIntersectContext(&context_.embree);
  context_.embree.filter = filterTriangle;
  context_.query = this;
}

void Query::run(const Accelerator::Impl& accelerator) {
  const double largest = double{std::max(maxComponent(abs(ray_.o)), maxComponent(abs(ray_.d)))};
  if (!(largest <= accelerator.largestRay)) return;
  // The far end is inclusive here, that of rays is not.
  float tMax = std::isfinite(ray_.tMax) ? std::nextafter(ray_.tMax, -kInfinity) : ray_.tMax;
  if (best_.id.isValid()) tMax = std::min(tMax, best_.t);
  if (!(tMin_ <= tMax)) return;
  if (accelerator.few) return meet(*accelerator.few, tMax);
  RTCRayHit r{};
  r.ray.org_x = ray_.o.x;
  r.ray.org_y = ray_.o.y;
  r.ray.org_z = ray_.o.z;
  r.ray.dir_x = ray_.d.x;
  r.ray.dir_y = ray_.d.y;
  r.ray.dir_z = ray_.d.z;
  r.ray.tnear = tMin_;
  r.ray.tfar = tMax;
  r.ray.mask = 0xffffffffu;
  r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  if (shadowRay_) {
    rtcOccluded1(accelerator.scene, &context_.embree, &r.ray);
  } else {
    rtcIntersect1(accelerator.scene, &context_.embree, &r);
  }
}

void Query::meet(const FewShapes& few, float tMax) {
  const FewShapes::Line line(ray_);
  const auto end = [&] { return best_.id.isValid() ? std::min(tMax, best_.t) : tMax; };
  for (const FewShapes::Item& item : few.items()) {
    const GeometryRecord& record = item.record();
    if (!item.mayMeet(line, tMin_, end())) continue;
    if (record.user) {
      Ray ray = ray_;
      ray.tMax = end();
      hitUser(record, 0, ray, tMin_);
    } else {
      item.visitCrossings(line, tMin_, end, [&](const FewShapes::Crossing& at) {
        hitTriangle(record, {at.t, {instance(), record.number, at.primitive}, at.uv}, line.o, line.d);
      });
    }
    if (shadowRay_ && best_.id.isValid()) return;
  }
}

std::uint32_t Query::instance() const {
  return animatedInstance_ != PrimitiveId::kNone ? animatedInstance_ : context_.embree.instID[0];
}

bool Query::isExcluded(const PrimitiveId& id) const {
  return std::ranges::any_of(exclusions_.entries(), [&](const auto& entry) { return entry.id == id; });
}

bool Query::isLeftOut(const GeometryRecord& record, const RayHit& hit, Vec3d direction) const {
  if (isExcluded(hit.id)) return true;
  bool isAdjacent = false;
  for (const Exclusions::Entry& entry : exclusions_.entries()) {
    if (entry.id.instance != hit.id.instance) continue;
    const GeometryRecord& other = *record.owner->records[entry.id.geometry];
    if (!other.isTriangles()) continue;
    const TrianglePair pair{other.corners(entry.id.primitive), record.corners(hit.id.primitive), direction};
    const double between = std::abs(double{hit.t} - entry.t) * maxComponent(abs(direction));
    if (entry.t <= 0 || entry.t >= ray_.tMax) {
      if (between <= kNearAnEnd * pair.scale && pair.deniesHit(entry.t > 0)) return true;
      if (onlyAdjacent_ && pair.isAdjacent()) isAdjacent = true;
    } else if (pair.isOneCrossing(hit.uv, kOnEdge * (pair.scale + hit.t * length(direction)),
                                  between <= kSameCrossing * pair.scale)) {
      return true;
    }
  }
  return onlyAdjacent_ && !isAdjacent;
}

std::optional<Query::BorderStart> Query::borderStart(const Accelerator::Impl& world,
                                                     const Exclusions::Entry& entry) const {
  const GeometryRecord* instance =
      entry.id.instance == PrimitiveId::kNone ? nullptr : world.records[entry.id.instance].get();
  const Accelerator::Impl& owner = instance ? *instance->object : world;
  const GeometryRecord& record = *owner.records[entry.id.geometry];
  if (!record.isTriangles()) return std::nullopt;
  auto corners = record.corners(entry.id.primitive);
  if (instance) {
    const Transform worldFromObject = instance->worldFromObject.at(ray_.time);
    for (Vec3d& corner : corners) corner = worldFromObject.point(corner);
  }
  const Vec3d o(ray_.o);
  const double rounding = kPointRounding * std::max(maxComponent(abs(o)), maxComponent(abs(corners[0])));
  const Vec3d normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
  Vec3d inward{};
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d edge = corners[(i + 1) % 3] - corners[i], across = cross(normal, edge);
    const double inside = dot(o - corners[i], across);
    // Nearly always: `across` is no longer than the sum of its parts.
    if (inside > 2 * rounding * (std::abs(across.x) + std::abs(across.y) + std::abs(across.z))) continue;
    const double size = length(across);
    if (size > 0 && inside <= rounding * size) inward += across / size;
  }
  if (inward == Vec3d{}) return std::nullopt;
  // Into the triangle, and a little to the side to which the ray goes.
  const Vec3d unit = normalize(normal), inPlane = o - dot(o - corners[0], unit) * unit;
  const double side = dot(unit, Vec3d(ray_.d)) < 0 ? -1 : 1;
  return BorderStart{Point3f(inPlane + 2 * rounding * (inward + 0.25 * side * unit)), rounding};
}

bool Query::crossesNeighbourAtStart(const Accelerator::Impl& world) {
  if (tMin_ > 0) return false;
  for (const Exclusions::Entry& entry : exclusions_.entries()) {
    if (entry.t > 0) continue;
    const auto start = borderStart(world, entry);
    if (!start) continue;
    // Far enough for all but the most grazing neighbours; those are met by the ray itself, or missed.
    const float reach = static_cast<float>(256 * start->rounding / length(Vec3d(ray_.d)));
    const Exclusions onlyStart(entry.id, 0);
    Query query({.o = start->inside, .d = ray_.d, .tMax = std::min(reach, ray_.tMax), .time = ray_.time}, 0,
                onlyStart, shadowRay_, blocker_);
    query.onlyAdjacent_ = true;
    query.run(world);
    if (!query.best_.id.isValid() || isExcluded(query.best_.id)) continue;
    best_ = query.best_;
    const Vec3d d(ray_.d), shift = Vec3d(start->inside) - Vec3d(ray_.o);
    best_.t = std::max(0.0f, static_cast<float>(best_.t + dot(shift, d) / dot(d, d)));
    return true;
  }
  return false;
}

bool Query::take(const GeometryRecord& record, const RayHit& hit) {
  if (!(hit.t >= tMin_ && hit.t < ray_.tMax)) return false;
  const bool isTie = best_.id.isValid() && hit.t == best_.t;
  if (isTie && !precedes(hit.id, best_.id)) return false;
  if (record.filter && !record.filter->accepts(hit, shadowRay_ && !isBlocker(hit.id))) return false;
  best_ = hit;
  return true;
}

bool Query::grazesSilhouette(const GeometryRecord& record, const RayHit& hit, Vec3d origin,
                             Vec3d direction) const {
  const std::array<float, 3> weights{1 - hit.uv.x - hit.uv.y, hit.uv.x, hit.uv.y};
  if (std::ranges::min(weights) > kNearEdge || record.triangles.indices.size() > kMostTriangles) return false;
  const auto corners = record.corners(hit.id.primitive);
  for (std::size_t own = 0; own < 3; ++own) {
    if (weights[own] > kNearEdge) continue;
    const SilhouetteEdge edge{corners[(own + 1) % 3], corners[(own + 2) % 3], origin, direction};
    if (!(edge.distance() <= kOnSilhouette * edge.scale())) continue;
    bool hasNeighbour = false, turnsAway = true;
    for (std::uint32_t i = 0; turnsAway && i < record.triangles.indices.size(); ++i) {
      if (i == hit.id.primitive) continue;
      const auto apex = edge.apexOf(record.corners(i));
      if (!apex) continue;
      if (isExcluded({hit.id.instance, hit.id.geometry, i})) return false;  // the ray is on the mesh already
      hasNeighbour = true;
      turnsAway = edge.side(*apex) * edge.side(corners[own]) > 0;
    }
    if (hasNeighbour && turnsAway) return true;
  }
  return false;
}

void Query::filterTriangle(const RTCFilterFunctionNArguments* args) {
  Query& query = of(args->context);
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  RTCRayN* ray = args->ray;
  RTCHitN* at = args->hit;
  const RayHit hit{.t = RTCRayN_tfar(ray, 1, 0),
                   .id = {query.instance(), record.number, RTCHitN_primID(at, 1, 0)},
                   .uv = {RTCHitN_u(at, 1, 0), RTCHitN_v(at, 1, 0)}};
  const Vec3d direction(RTCRayN_dir_x(ray, 1, 0), RTCRayN_dir_y(ray, 1, 0), RTCRayN_dir_z(ray, 1, 0));
  const Vec3d origin(RTCRayN_org_x(ray, 1, 0), RTCRayN_org_y(ray, 1, 0), RTCRayN_org_z(ray, 1, 0));
  if (!query.hitTriangle(record, hit, origin, direction)) args->valid[0] = 0;
}

bool Query::hitTriangle(const GeometryRecord& record, const RayHit& hit, Vec3d origin, Vec3d direction) {
  if (!exclusions_.isEmpty() && isLeftOut(record, hit, direction)) return false;
  return !grazesSilhouette(record, hit, origin, direction) && take(record, hit);
}

bool Query::hitUser(const GeometryRecord& record, std::uint32_t primitive, const RTCRay& from) {
  return hitUser(record, primitive,
                 {.o = {from.org_x, from.org_y, from.org_z},
                  .d = {from.dir_x, from.dir_y, from.dir_z},
                  .tMax = from.tfar,
                  .time = ray_.time},
                 from.tnear);
}

bool Query::hitUser(const GeometryRecord& record, std::uint32_t primitive, const Ray& ray, float tMin) {
  if (onlyAdjacent_) return false;
  const PrimitiveId id{instance(), record.number, primitive};
  // Room for the roots a filter rejects, which are then left out as well.
  std::array<float, Exclusions::kCapacity + 16> excludedT;
  std::size_t count = 0;
  for (const auto& entry : exclusions_.entries()) {
    const bool isOfGeometry = entry.id.instance == id.instance && entry.id.geometry == id.geometry;
    if (isOfGeometry && record.user->continues(entry.id.primitive, primitive)) excludedT[count++] = entry.t;
  }
  while (true) {
    const auto root = record.user->intersect(primitive, ray, tMin, ray.tMax, {excludedT.data(), count});
    if (!root) return false;
    const RayHit hit{.t = static_cast<float>(root->t), .id = id, .uv = root->uv};
    if (take(record, hit)) return true;
    if (!record.filter || count == excludedT.size()) return false;
    excludedT[count++] = hit.t;
  }
}

bool Query::hitInstance(const GeometryRecord& record) {
  const Transform worldFromObject = record.worldFromObject.at(ray_.time);
  if (worldFromObject.isSingular()) return false;
  Query inner(worldFromObject.inverse().ray(ray_), tMin_, exclusions_, shadowRay_);
  inner.onlyAdjacent_ = onlyAdjacent_;
  inner.animatedInstance_ = record.number;
  inner.best_ = best_;
  inner.run(*record.object);
  if (inner.best_.id == best_.id && inner.best_.t == best_.t) return false;
  best_ = inner.best_;
  return true;
}

namespace {

void report(RTCRayHit& out, const RayHit& hit) {
  out.ray.tfar = hit.t;
  out.hit.u = hit.uv.x;
  out.hit.v = hit.uv.y;
  out.hit.primID = hit.id.primitive;
  out.hit.geomID = hit.id.geometry;
  out.hit.instID[0] = hit.id.instance;
}

}  // namespace

void Query::intersectUser(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& query = of(args->context);
  auto& rayHit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  if (query.hitUser(record, args->primID, rayHit.ray)) report(rayHit, query.best_);
}

void Query::occludedUser(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  if (of(args->context).hitUser(record, args->primID, ray)) ray.tfar = -kInfinity;
}

void Query::intersectInstance(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  Query& query = of(args->context);
  auto& rayHit = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  if (query.hitInstance(record)) report(rayHit, query.best_);
}

void Query::occludedInstance(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  if (of(args->context).hitInstance(record)) ray.tfar = -kInfinity;
}

void Query::setUserCallbacks(RTCGeometry geometry) {
  rtcSetGeometryIntersectFunction(geometry, intersectUser);
  rtcSetGeometryOccludedFunction(geometry, occludedUser);
}

void Query::setInstanceCallbacks(RTCGeometry geometry) {
  rtcSetGeometryIntersectFunction(geometry, intersectInstance);
  rtcSetGeometryOccludedFunction(geometry, occludedInstance);
}

}  // namespace pbrtmedia
