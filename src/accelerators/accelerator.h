// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "base/animated_transform.h"
#include "base/bounds.h"
#include "base/ray.h"
#include "base/statistics.h"

namespace pbrtmedia {

/// Names one primitive of one placement: geometry and primitive inside an accelerator, and the instance
/// through which it was reached (kNone: placed directly).
struct PrimitiveId {
  static constexpr std::uint32_t kNone = 0xffffffffu;
  std::uint32_t instance = kNone, geometry = kNone, primitive = kNone;
  bool operator==(const PrimitiveId&) const = default;
  bool isValid() const { return geometry != kNone; }
};

/// Primitives a ray must not report, because it starts on them, ends on them, or has crossed them already.
/// A flat primitive is left out altogether; of a curved one only the root nearest to `t`.
class Exclusions {
 public:
  struct Entry {
    PrimitiveId id;
    float t;  ///< where on this ray the hit to be left out lies (0: the ray starts there)
  };
  static constexpr std::size_t kCapacity = 16;

  Exclusions() {}
  explicit Exclusions(PrimitiveId id, float t = 0) { add(id, t); }
  /// Copies are made for every ray, mostly of one entry or none: only what is there is copied.
  Exclusions(const Exclusions& o) { *this = o; }
  Exclusions& operator=(const Exclusions& o) {
    count_ = o.count_;
    for (std::size_t i = 0; i < count_; ++i) std::construct_at(&entries_[i], o.entries_[i]);
    return *this;
  }
  /// False when full (the entry was not taken): the caller must then advance tMin past t.
  bool add(PrimitiveId id, float t) {
    if (!id.isValid()) return true;
    if (count_ == kCapacity) return false;
    std::construct_at(&entries_[count_++], Entry{id, t});
    return true;
  }
  /// Forgets entries with t below `t`: hits there are behind tMin already.
  void dropBefore(float t) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (entries_[i].t >= t) entries_[kept++] = entries_[i];
    }
    count_ = kept;
  }
  std::span<const Entry> entries() const { return {entries_.data(), count_}; }
  bool isEmpty() const { return count_ == 0; }

 private:
  union {  // nothing is written before it is needed
    std::array<Entry, kCapacity> entries_;
  };
  std::size_t count_ = 0;
};

/// A hit as the accelerator knows it.
struct RayHit {
  float t = kInfinity;
  PrimitiveId id;
  /// Triangles: barycentric weights of the second and third vertex. User geometry: whatever two numbers it
  /// reported.
  Point2f uv;
};

/// Vertices (definition space = world space of the CTM) and corner indices. Borrowed: must outlive the
/// accelerator.
struct TriangleBuffers {
  std::span<const Point3f> positions;
  std::span<const std::array<std::uint32_t, 3>> indices;
  /// True when 4 more bytes behind the last position may be read; otherwise the positions are copied.
  bool paddedPositions = false;
};

/// Geometry that intersects itself, in double: any number of primitives. Implementations are immutable and
/// thread-safe.
class UserGeometry {
 public:
  virtual ~UserGeometry() = default;
  /// The same on every call.
  virtual std::uint32_t primitiveCount() const = 0;
  /// World (definition-space) bounds, conservative. `primitive` < primitiveCount().
  virtual Bounds3f primitiveBounds(std::uint32_t primitive) const = 0;
  struct Root {
    double t;
    Point2f uv;
  };
  /// The nearest accepted root of one primitive with tMin <= float(t) <= tMax. `excludedT`: for each value,
  /// the geometric root nearest to it is skipped (before clipping by zmin, phimax, ...), which is how a ray
  /// leaves the surface it starts on.
  virtual std::optional<Root> intersect(std::uint32_t primitive, const Ray& ray, double tMin, double tMax,
                                        std::span<const float> excludedT) const = 0;
  /// Whether two primitives are parts of one surface: what a ray starts on or has crossed on `a` is among the
  /// `excludedT` of `b`.
  virtual bool continues(std::uint32_t a, std::uint32_t b) const { return a == b; }
};

/// Decides whether a hit counts (alpha, shadowalpha). Thread-safe.
class HitFilter {
 public:
  virtual ~HitFilter() = default;
  virtual bool accepts(const RayHit& hit, bool shadowRay) const = 0;
};

/// Ray intersection over everything added: few shapes one by one, more through Embree in robust mode. Built
/// once, then immutable and thread-safe. Nothing added: no structure is built, every query misses at once.
class Accelerator {
 public:
  Accelerator();
  ~Accelerator();
  Accelerator(Accelerator&&) noexcept;
  Accelerator& operator=(Accelerator&&) noexcept;

  // Each returns the geometry (or instance) number used in PrimitiveId, counting from 0 in order of addition.
  // Geometries and instances share one numbering.
  std::uint32_t addTriangles(TriangleBuffers triangles, const HitFilter* filter = nullptr);
  std::uint32_t addUser(const UserGeometry& geometry, const HitFilter* filter = nullptr);
  /// Places a built accelerator (which must hold no instances). Animated placements are exact at every time.
  std::uint32_t addInstance(const Accelerator& object, const AnimatedTransform& worldFromObject);
  void build();

  /// Closest hit with tMin <= t < ray.tMax (t in float) of what is not excluded. Of several hits at one t the
  /// smallest (instance, geometry, primitive) is reported, so the answer does not depend on how the structure
  /// was built; the others are found by asking again with tMin = t and the reported one excluded.
  ///
  /// A ray that starts on a triangle (excluded, t = 0) or ends on one (excluded, t >= ray.tMax) is not
  /// stopped there by a neighbour that the rounding of its end point put in the way: near such an end, on
  /// which side of a plane the ray is follows from the triangle it lies on. Rays with NaN or infinite origin
  /// or direction miss.
  std::optional<RayHit> intersect(const Ray& ray, float tMin, const Exclusions& exclusions) const;
  /// Whether `intersect` would report a hit (with the filters of shadow rays). `blocker`: number of a
  /// geometry placed directly that blocks wherever `intersect` hits it, whatever its filter says of shadow
  /// rays.
  bool occluded(const Ray& ray, float tMin, const Exclusions& exclusions,
                std::uint32_t blocker = PrimitiveId::kNone) const;
  /// Bounds of everything added (over all times).
  Bounds3f bounds() const;
  bool isEmpty() const;
  /// Bytes the ray-tracing library holds for this structure, as it reports them.
  std::size_t memoryBytes() const;

  struct Impl;  ///< known inside the room only

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace pbrtmedia
