// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <span>
#include <vector>

#include "shapes/cubic_bezier.h"
#include "shapes/shape.h"

namespace pbrtmedia {

enum class CurveType : std::uint8_t { Flat, Ribbon, Cylinder };
/// Whether strands have no side of their own (SurfaceInteraction::turnsToRays).
constexpr bool turnsToRays(CurveType type) { return type != CurveType::Ribbon; }

/// Strands: thin surfaces along cubic curves, any number of strands of one type under one CTM. Scene-language
/// reference 13.6.
///
/// As in PBRT-v3 a strand has no thickness. A ray hits where it passes its spine, in object space, within
/// half the width (of a ribbon: times the cosine between its normal and the ray), and the hit lies on the ray
/// beside the spine. u runs along each segment, v across the width; dp/du is that of the spine, dp/dv lies
/// across the ray (flat), across the normal (ribbon), or is turned about the spine by 90 degrees at v = 0 to
/// -90 at v = 1 (cylinder). The normal is dp/du x dp/dv, which in the middle of flat and cylinder leads on
/// along the ray, and derivatives of it are 0.
///
/// What PBRT-v3 gets wrong is not copied: of several hits on a strand the nearest counts, the hit lies at its
/// t under scaling CTMs as well, and normals that are equal at the ends of a ribbon's segment interpolate.
///
/// A ray that starts on a strand, or has crossed it, leaves out where the strand is within two widths of
/// that point across its own direction. (PBRT-v3 starts such rays two widths away, beyond whatever is there.)
class Curves final : public Shape, public UserGeometry {
 public:
  /// One cubic, object space.
  struct Segment {
    std::array<Point3f, 4> p;
    float width0, width1;  ///< whole widths at the ends, linear between
    std::uint32_t strand;  ///< segments of one strand have one number
  };
  struct Params {
    CurveType type = CurveType::Flat;
    /// Each segment stands as 2^splitDepth pieces in the ray-tracing structure: speed and memory only. Less
    /// where there are many segments.
    int splitDepth = 3;
    std::vector<Segment> segments;
    std::vector<std::array<Normal3f, 2>> normals;  ///< of a ribbon: unit, at the ends of each segment

    /// Adds a strand. `normals`: of a ribbon, one more than there are segments, of any length. Throws
    /// std::invalid_argument, naming the parameter, for numbers that are not finite, widths below 0, points
    /// that make no curve, a number of normals that does not fit, and normals of length 0.
    void addStrand(std::span<const Point3f> points, int degree, CurveBasis basis, float width0, float width1,
                   std::span<const Normal3f> strandNormals = {});
    /// Adds the strands of `other`, of the same type.
    void append(const Params& other);
  };
  static constexpr int kMaxSplitDepth = 10;
  /// A segment that no ray can hit: a point, or of width 0.
  static bool isEmpty(const Segment& segment);

  /// `params.segments` must not be empty.
  Curves(Params params, const ShapePlacement& placement);
  std::string_view typeName() const override { return "curve"; }
  std::uint32_t primitiveCount() const override;
  Bounds3f bounds() const override;
  bool isClosed() const override { return false; }
  Geometry geometry() const override { return static_cast<const UserGeometry*>(this); }
  SurfaceInteraction interaction(const RayHit& hit, const Ray& ray) const override;
  Point2f uvAt(const RayHit& hit) const override { return hit.uv; }
  /// Of the side that a ray across the strand sees.
  double area(std::uint32_t primitive) const override;
  /// Nothing usable: which part of a strand faces a point depends on the point. PBRT-v3 ends here.
  ShapeSample sample(std::uint32_t primitive, Point2f u) const override;
  using Shape::sample;

  Bounds3f primitiveBounds(std::uint32_t primitive) const override;
  std::optional<Root> intersect(std::uint32_t primitive, const Ray& ray, double tMin, double tMax,
                                std::span<const float> excludedT) const override;
  bool continues(std::uint32_t a, std::uint32_t b) const override {
    return segmentOf(a).strand == segmentOf(b).strand;
  }
  int splitDepth() const { return splitDepth_; }

 private:
  struct Piece {
    CubicBezier curve;
    double u0, u1;
  };
  const Segment& segmentOf(std::uint32_t primitive) const { return segments_[primitive >> splitDepth_]; }
  Piece piece(std::uint32_t primitive) const;
  /// World, around curves of that object-space width.
  Bounds3f boundsOf(const CubicBezier& curve, double width) const;
  /// Interpolated, unit at the ends.
  Vec3d ribbonNormal(std::uint32_t primitive, double u) const;
  /// Width at u for a ray with unit direction `d`.
  double seenWidth(std::uint32_t primitive, double u, Vec3d d) const;

  CurveType type_;
  int splitDepth_;
  std::vector<Segment> segments_;
  std::vector<std::array<Normal3f, 2>> normals_;
  Transform worldFromObject_, objectFromWorld_;
  bool flips_;
  Vec3d worldReach_;  ///< half the size of the box around an object-space box of half the size 1
  Bounds3f bounds_;
};

}  // namespace pbrtmedia
