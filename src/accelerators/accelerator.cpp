// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/accelerator.h"

#include <glog/logging.h>

#include <stdexcept>

#include "accelerators/embree_device.h"
#include "accelerators/few_shapes.h"
#include "accelerators/impl.h"
#include "accelerators/query.h"
#include "base/built_parts.h"
#include "base/interruption.h"

namespace pbrtmedia {
namespace {

/// User bounds grow by this fraction of the largest coordinate: several roundings of float transforms.
constexpr float kBoundsGrowth = 0x1p-20f;

void checkExtent(const Bounds3f& b, const char* what) {
  const float largest = std::max(maxComponent(abs(b.min)), maxComponent(abs(b.max)));
  if (!b.isEmpty() && !(largest <= kLargestCoordinate)) {
    throw std::invalid_argument(std::string(what) + ": coordinates must be finite and below 1.8e18 in size");
  }
}

Bounds3f trianglesBounds(const TriangleBuffers& triangles) {
  Bounds3f b;
  for (const auto& corners : triangles.indices) {
    for (const std::uint32_t i : corners) {
      const Point3f& p = triangles.positions[i];
      if (!isFinite(p)) throw std::invalid_argument("triangles: coordinates must be finite");
      b.expand(p);
    }
  }
  return b;
}

Bounds3f grown(Bounds3f b) {
  const float largest = std::max(maxComponent(abs(b.min)), maxComponent(abs(b.max)));
  const float by = largest * kBoundsGrowth + std::numeric_limits<float>::min();
  b.min -= Vector3f{by, by, by};
  b.max += Vector3f{by, by, by};
  return b;
}

void reportBounds(const RTCBoundsFunctionArguments* args) {
  const auto& record = *static_cast<const GeometryRecord*>(args->geometryUserPtr);
  const Bounds3f b = grown(record.user ? record.user->primitiveBounds(args->primID)
                                       : record.worldFromObject.motionBounds(record.object->bounds));
  *args->bounds_o = {b.min.x, b.min.y, b.min.z, 0, b.max.x, b.max.y, b.max.z, 0};
}

RTCGeometry makeTriangles(const TriangleBuffers& triangles) {
  RTCGeometry geometry = rtcNewGeometry(embreeDevice(), RTC_GEOMETRY_TYPE_TRIANGLE);
  const auto positions = triangles.positions;
  if (triangles.paddedPositions) {
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data(), 0,
                               sizeof(Point3f), positions.size());
  } else {
    void* copy = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                         sizeof(Point3f), positions.size());
    if (!copy) {
      rtcReleaseGeometry(geometry);
      throw std::bad_alloc();
    }
    std::copy(positions.begin(), positions.end(), static_cast<Point3f*>(copy));
  }
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, triangles.indices.data(),
                             0, sizeof(triangles.indices[0]), triangles.indices.size());
  return geometry;
}

RTCGeometry makeStaticInstance(const GeometryRecord& record) {
  RTCGeometry geometry = rtcNewGeometry(embreeDevice(), RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry, record.object->scene);
  rtcSetGeometryTimeStepCount(geometry, 1);
  const Affine3f m(record.worldFromObject.start().matrix());
  const std::array<float, 12> columns{m.x.x, m.x.y, m.x.z, m.y.x, m.y.y, m.y.z,
                                      m.z.x, m.z.y, m.z.z, m.t.x, m.t.y, m.t.z};
  rtcSetGeometryTransform(geometry, 0, RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, columns.data());
  return geometry;
}

/// The largest ray that Embree can take into the space of the instance; 0: none, as it transforms in float.
double largestRayInto(const AnimatedTransform& worldFromObject) {
  constexpr double kLargestEntry = 1e12;  // with which a product of three stays a float
  const Matrix4 &m = worldFromObject.start().matrix(), &inverse = worldFromObject.start().inverseMatrix();
  double largest = double{kLargestCoordinate};
  for (std::size_t i = 0; i < 3; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      if (!(std::abs(m.m[i][j]) <= kLargestEntry) || !(std::abs(inverse.m[i][j]) <= kLargestEntry)) return 0;
      sum += std::abs(inverse.m[i][j]);
    }
    const double left = double{kLargestCoordinate} - std::abs(inverse.m[i][3]);
    if (!(left > 0)) return 0;
    if (sum > 0) largest = std::min(largest, left / sum);
  }
  return largest;
}

RTCGeometry makeUser(GeometryRecord& record) {
  RTCGeometry geometry = rtcNewGeometry(embreeDevice(), RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, record.user ? record.user->primitiveCount() : 1);
  rtcSetGeometryBoundsFunction(geometry, reportBounds, nullptr);
  if (record.object) {
    Query::setInstanceCallbacks(geometry);
  } else {
    Query::setUserCallbacks(geometry);
  }
  return geometry;
}

/// Embree asks now and then while it builds; no cancels the build.
bool goesOn(void*, double) { return interruption::requested == StopCause::None; }

}  // namespace

Accelerator::Impl::Impl() = default;
Accelerator::Impl::~Impl() {
  if (scene) rtcReleaseScene(scene);
}

GeometryRecord& Accelerator::Impl::add(const HitFilter* filter) {
  CHECK(!isBuilt) << "nothing can be added to a built accelerator";
  auto record = std::make_unique<GeometryRecord>();
  record->owner = this;
  record->number = static_cast<std::uint32_t>(records.size());
  record->filter = filter;
  records.push_back(std::move(record));
  return *records.back();
}

void Accelerator::Impl::attach(GeometryRecord& record) {
  if (record.object && !record.object->scene) return;                   // instance of nothing
  if (!record.object && !record.user && !record.isTriangles()) return;  // mesh without triangles
  if (record.user && record.user->primitiveCount() == 0) return;
  constexpr double kNoScene = 1e12;  // coordinates of no scene; a float there has steps of 65536
  bool isStaticInstance = false;
  if (record.object && !record.worldFromObject.isAnimated()) {
    const double largest = largestRayInto(record.worldFromObject);
    isStaticInstance = largest >= kNoScene;
    if (isStaticInstance) largestRay = std::min(largestRay, largest);
  }
  RTCGeometry geometry = isStaticInstance       ? makeStaticInstance(record)
                         : record.isTriangles() ? makeTriangles(record.triangles)
                                                : makeUser(record);
  rtcSetGeometryUserData(geometry, &record);
  rtcCommitGeometry(geometry);
  if (!scene) {
    scene = rtcNewScene(embreeDevice());
    rtcSetSceneFlags(
        scene, static_cast<RTCSceneFlags>(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION));
    rtcSetSceneProgressMonitorFunction(scene, goesOn, nullptr);
  }
  rtcAttachGeometryByID(scene, geometry, record.number);
  rtcReleaseGeometry(geometry);
}

Accelerator::Accelerator() : impl_(std::make_unique<Impl>()) {}
Accelerator::~Accelerator() = default;
Accelerator::Accelerator(Accelerator&&) noexcept = default;
Accelerator& Accelerator::operator=(Accelerator&&) noexcept = default;

std::uint32_t Accelerator::addTriangles(TriangleBuffers triangles, const HitFilter* filter) {
  const Bounds3f b = trianglesBounds(triangles);
  checkExtent(b, "triangles");
  GeometryRecord& record = impl_->add(filter);
  record.triangles = triangles;
  impl_->bounds.expand(b);
  return record.number;
}

std::uint32_t Accelerator::addUser(const UserGeometry& geometry, const HitFilter* filter) {
  Bounds3f b;
  for (std::uint32_t i = 0; i < geometry.primitiveCount(); ++i) b.expand(geometry.primitiveBounds(i));
  checkExtent(b, "shape");
  GeometryRecord& record = impl_->add(filter);
  record.user = &geometry;
  impl_->bounds.expand(b);
  return record.number;
}

std::uint32_t Accelerator::addInstance(const Accelerator& object, const AnimatedTransform& worldFromObject) {
  CHECK(object.impl_->isBuilt) << "an instance needs a built accelerator";
  CHECK(!object.impl_->holdsInstances) << "instances do not nest";
  if (worldFromObject.start().isSingular() || worldFromObject.end().isSingular()) {
    throw std::invalid_argument("instance: the transform is singular");
  }
  const Bounds3f b = object.isEmpty() ? Bounds3f{} : worldFromObject.motionBounds(object.impl_->bounds);
  checkExtent(b, "instance");
  GeometryRecord& record = impl_->add(nullptr);
  record.object = object.impl_.get();
  record.worldFromObject = worldFromObject;
  impl_->holdsInstances = true;
  impl_->bounds.expand(b);
  return record.number;
}

void Accelerator::build() {
  CHECK(!impl_->isBuilt) << "an accelerator is built once";
  impl_->isBuilt = true;
  if (impl_->bounds.isEmpty()) return;
  impl_->bytes = measureBuild([this] {
    for (const auto& record : impl_->records) {
      leaveIfStopped();
      impl_->attach(*record);
    }
    if (!impl_->scene) return;
    countBuilt(Part::RayTrees);
    rtcCommitScene(impl_->scene);
  });
  impl_->few = FewShapes::of(impl_->records);
}

std::optional<RayHit> Accelerator::intersect(const Ray& ray, float tMin, const Exclusions& exclusions) const {
  if (!impl_->scene || !isFinite(ray.o) || !isFinite(ray.d)) return std::nullopt;
  Query query(ray, tMin, exclusions, /*shadowRay=*/false);
  if (!query.crossesNeighbourAtStart(*impl_)) query.run(*impl_);
  if (!query.best().id.isValid()) return std::nullopt;
  return query.best();
}

bool Accelerator::occluded(const Ray& ray, float tMin, const Exclusions& exclusions,
                           std::uint32_t blocker) const {
  if (!impl_->scene || !isFinite(ray.o) || !isFinite(ray.d)) return false;
  Query query(ray, tMin, exclusions, /*shadowRay=*/true, blocker);
  if (!query.crossesNeighbourAtStart(*impl_)) query.run(*impl_);
  return query.best().id.isValid();
}

Bounds3f Accelerator::bounds() const { return impl_->bounds; }
bool Accelerator::isEmpty() const { return impl_->bounds.isEmpty(); }
std::size_t Accelerator::memoryBytes() const { return impl_->bytes; }

}  // namespace pbrtmedia
