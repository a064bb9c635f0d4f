// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "accelerators/impl.h"
#include "base/bounds.h"

// Internal to the room: other rooms see accelerator.h only.

namespace pbrtmedia {

/// A structure of so few primitives that a ray is sooner told about each of them than led through a tree, as
/// where one box holds a medium. Everything is computed in double, so that distances are those of the
/// stored corners, rounded once; neighbours agree exactly on which side of their common edge a line passes.
/// Of a convex mesh only two facets are in question.
class FewShapes {
 public:
  /// A line, with what is asked of it more than once.
  struct Line {
    explicit Line(const Ray& ray) : o(ray.o), d(ray.d), inverse{1 / d.x, 1 / d.y, 1 / d.z} {}
    Vec3d o, d, inverse;
  };
  /// Where a line meets a triangle.
  struct Crossing {
    float t;
    std::uint32_t primitive;
    Point2f uv;  ///< as in RayHit
  };

  /// What one record holds.
  class Item {
   public:
    explicit Item(const GeometryRecord& record);
    const GeometryRecord& record() const { return *record_; }
    /// How many planes a line is asked about; 1 for geometry that intersects itself.
    std::size_t cost() const {
      return isConvex() ? facets_.size() : std::max<std::size_t>(triangles_.size(), 1);
    }
    /// False only if the line meets nothing of it at tMin <= t <= tMax.
    bool mayMeet(const Line& line, float tMin, float tMax) const;
    /// Calls visit(crossing) for triangles met at tMin <= t <= tMax(), which may fall meanwhile; perhaps
    /// twice for one.
    template <class TMax, class Visit>
    void visitCrossings(const Line& line, float tMin, const TMax& tMax, const Visit& visit) const {
      if (isConvex() && visitConvex(line, tMin, tMax, visit)) return;
      for (const Triangle& triangle : triangles_) {
        if (const auto crossing = cross(line, triangle, tMin, tMax())) visit(*crossing);
      }
    }

   private:
    /// A value that changes evenly: dot(gradient, p) + offset.
    struct Even {
      Vec3d gradient;
      double offset;
      static Even from(Vec3d zero, Vec3d gradient) { return {gradient, -dot(gradient, zero)}; }
      double at(Vec3d p) const { return dot(gradient, p) + offset; }
    };
    struct Triangle {
      std::uint32_t primitive;
      std::array<Vec3d, 3> corners;
      Even height;         ///< above its plane, in any unit
      Even second, third;  ///< barycentric weights of these corners
      Triangle(std::uint32_t number, const std::array<Vec3d, 3>& c);
    };
    /// Triangles in one plane up to rounding.
    struct Facet {
      Vec3d n;                 ///< unit
      double offset;           ///< of the points of the plane along n
      std::size_t first, end;  ///< in `triangles_`
      bool isTiled;            ///< no point of it is on two of its triangles, but for their edges
      bool isExact;            ///< across an axis, and all its corners in it
      double heightOf(Vec3d p) const { return dot(n, p) - offset; }
    };
    /// Between two parallel facets of a convex mesh, or behind one.
    struct Slab {
      Vec3d n;
      std::array<double, 2> offset;      ///< low, high; infinite where there is no facet
      std::array<std::size_t, 2> facet;  ///< there, by number
      bool isExact;
    };
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
    bool isConvex() const { return !slabs_.empty(); }
    void addFacets(std::vector<Triangle> triangles);
    bool isTiled(const Facet& facet) const;
    bool isExact(const Facet& facet) const;
    /// Nothing is added where the mesh is not convex, or thin.
    void addSlabs();
    template <class TMax, class Visit>
    bool visitConvex(const Line& line, float tMin, const TMax& tMax, const Visit& visit) const;
    static std::optional<Crossing> cross(const Line& line, const Triangle& triangle, float tMin, float tMax);

    const GeometryRecord* record_;
    Bounds3d box_;
    double size_;                      ///< largest coordinate
    std::vector<Triangle> triangles_;  ///< facet by facet
    std::vector<Facet> facets_;
    std::vector<Slab> slabs_;  ///< of a convex mesh
  };

  /// Null where there are too many, or instances among them.
  static std::unique_ptr<const FewShapes> of(std::span<const std::unique_ptr<GeometryRecord>> records);
  const std::vector<Item>& items() const { return items_; }

 private:
  std::vector<Item> items_;
};

inline bool FewShapes::Item::mayMeet(const Line& line, float tMin, float tMax) const {
  if (isConvex()) return true;           // answered as soon as this
  constexpr double kRounding = 0x1p-21;  // of t, relative
  double enter = tMin - kRounding * std::abs(double{tMin}), exit = tMax + kRounding * std::abs(double{tMax});
  for (std::size_t i = 0; i < 3; ++i) {
    if (line.d[i] == 0) {
      if (line.o[i] < box_.min[i] || line.o[i] > box_.max[i]) return false;
      continue;
    }
    const double a = (box_.min[i] - line.o[i]) * line.inverse[i],
                 b = (box_.max[i] - line.o[i]) * line.inverse[i];
    enter = std::max(enter, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return enter <= exit;
}

inline std::optional<FewShapes::Crossing> FewShapes::Item::cross(const Line& line, const Triangle& triangle,
                                                                 float tMin, float tMax) {
  const double across = dot(triangle.height.gradient, line.d);
  if (across == 0) return std::nullopt;
  const auto t = static_cast<float>(-triangle.height.at(line.o) / across);
  if (!(t >= tMin && t <= tMax)) return std::nullopt;
  // Six times the volumes between the line and the edges: exactly opposite for the two directions of an edge.
  const Vec3d a = triangle.corners[0] - line.o, b = triangle.corners[1] - line.o,
              c = triangle.corners[2] - line.o;
  const double ofA = dot(pbrtmedia::cross(b, c), line.d), ofB = dot(pbrtmedia::cross(c, a), line.d),
               ofC = dot(pbrtmedia::cross(a, b), line.d);
  const bool isInside = (ofA >= 0 && ofB >= 0 && ofC >= 0) || (ofA <= 0 && ofB <= 0 && ofC <= 0);
  const double sum = ofA + ofB + ofC;
  if (!isInside || sum == 0) return std::nullopt;
  return Crossing{t, triangle.primitive, {static_cast<float>(ofB / sum), static_cast<float>(ofC / sum)}};
}

/// A line enters a convex mesh through the last of the planes that it passes inward, and leaves it through
/// the first of those that it passes outward. False: it comes too near to an edge or grazes a facet too much
/// for that to be sure.
template <class TMax, class Visit>
bool FewShapes::Item::visitConvex(const Line& line, float tMin, const TMax& tMax, const Visit& visit) const {
  constexpr double kSure = 1e-4;      // of lengths, relative
  constexpr double kGrazing = 2e-2;   // slope under which corners that are not quite in a plane matter
  constexpr double kInterior = 1e-3;  // least barycentric weight of what is away from edges
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const double speed = maxComponent(abs(line.d)), size = size_ + maxComponent(abs(line.o));
  double enter = -kInfinite, exit = kInfinite;
  std::size_t in = kNone, out = kNone;
  for (const Slab& slab : slabs_) {
    const double across = dot(slab.n, line.d), place = dot(slab.n, line.o);
    if (!slab.isExact && std::abs(across) < kGrazing * speed) return false;
    if (across == 0) {
      if (place < slab.offset[0] - kSure * size || place > slab.offset[1] + kSure * size) return true;
      continue;
    }
    const double inverse = 1 / across;
    const std::size_t near = across < 0 ? 1 : 0, far = 1 - near;
    const double tNear = (slab.offset[near] - place) * inverse, tFar = (slab.offset[far] - place) * inverse;
    if (tNear > enter) {
      enter = tNear;
      in = slab.facet[near];
    }
    if (tFar < exit) {
      exit = tFar;
      out = slab.facet[far];
    }
  }
  const double reach = (in != kNone ? std::abs(enter) : 0) + (out != kNone ? std::abs(exit) : 0),
               slack = kSure * (size / speed + reach);
  if (enter > exit + slack || exit < double{tMin} - slack) return true;
  if (enter > exit - slack) return false;
  for (const auto& [t, number] : {std::pair(enter, in), std::pair(exit, out)}) {
    if (number == kNone || t < double{tMin} - slack || t > double{tMax()} + slack) continue;
    const Facet& facet = facets_[number];
    if (!facet.isTiled) return false;
    const Vec3d p = line.o + t * line.d;
    bool isSure = false;
    for (std::size_t i = facet.first; i < facet.end && !isSure; ++i) {
      const Triangle& triangle = triangles_[i];
      const double v = triangle.second.at(p), w = triangle.third.at(p);
      if (!(std::min({1 - v - w, v, w}) > kInterior)) continue;
      isSure = true;
      const double own =
          facet.isExact ? t : -triangle.height.at(line.o) / dot(triangle.height.gradient, line.d);
      const auto rounded = static_cast<float>(own);
      if (rounded >= tMin && rounded <= tMax())
        visit(Crossing{rounded, triangle.primitive, {static_cast<float>(v), static_cast<float>(w)}});
    }
    if (!isSure) return false;
  }
  return true;
}

}  // namespace pbrtmedia
