// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "shapes/shape.h"

namespace pbrtmedia {

/// Something wrong with the arrays of a mesh.
struct MeshProblem {
  Severity severity;      ///< Error: no mesh can be made of it. Warning: a part is left out.
  std::string parameter;  ///< scene keyword of the array: "indices", "P", "N", "S", "uv", "faceIndices"
  std::string message;    ///< what was found, where (array index) and what was expected
};

/// Triangles over shared vertices, with optional normals, tangents, (u, v) and face numbers. Vertices are
/// stored in world space. Scene-language reference 13.1, 13.3.
///
/// Orientation: without N, (p1 - p0) x (p2 - p0) in the object space; ReverseOrientation turns it. With N,
/// the geometric normal lies on the side of the interpolated N, turned by ReverseOrientation alone. With S
/// but no N ReverseOrientation has no effect (as PBRT-v3). Sampled normals agree with those of hits.
///
/// With N or S the shading tangents are unit vectors turned by 180 degrees about the normal, as in PBRT-v3:
/// scenes with bump maps were tuned against it (PBRT-v3 issues 188, 261). For the same reason derivatives of
/// normals are those of N as given and mapped by the CTM (of no certain length), without ReverseOrientation.
class TriangleMesh final : public Shape {
 public:
  /// Object space. Only `indices` and `P` are required.
  struct Params {
    std::vector<int> indices;  ///< three per triangle, zero-based
    std::vector<Point3f> P;
    std::vector<Normal3f> N;       ///< empty or one per vertex
    std::vector<Vector3f> S;       ///< empty or one per vertex
    std::vector<Point2f> uv;       ///< empty or one per vertex; else corners get (0,0), (1,0), (1,1)
    std::vector<int> faceIndices;  ///< empty or one per triangle
  };
  /// Everything wrong with `params`: the first offender of each kind, with its array index. Warnings: a
  /// trailing incomplete triple (dropped), more uv than vertices (the rest is dropped).
  static std::vector<MeshProblem> validate(const Params& params);

  /// Throws std::invalid_argument with all error messages of `validate`. `typeName` is a literal.
  TriangleMesh(Params params, const ShapePlacement& placement, std::string_view typeName = "trianglemesh");

  std::string_view typeName() const override { return typeName_; }
  std::uint32_t primitiveCount() const override { return static_cast<std::uint32_t>(triangles_.size()); }
  Bounds3f bounds() const override { return bounds_; }
  /// Whether every edge belongs to exactly two triangles, vertices at equal positions counting as one.
  /// Computed on every call, O(n log n).
  bool isClosed() const override;
  Geometry geometry() const override;
  SurfaceInteraction interaction(const RayHit& hit, const Ray& ray) const override;
  Point2f uvAt(const RayHit& hit) const override;
  /// PBRT-v3 samples sides without ReverseOrientation where N decides, and with it where S cancels it at
  /// hits.
  bool isSampledFromBehind() const override { return isSampledFromBehind_; }
  double area(std::uint32_t primitive) const override;
  using Shape::sample;
  ShapeSample sample(std::uint32_t primitive, Point2f u) const override;

  std::size_t vertexCount() const { return positions_.size() - 1; }
  /// World-space corners.
  std::array<Point3f, 3> corners(std::uint32_t primitive) const;

 private:
  struct Weights {
    double b0, b1, b2;
  };
  Vec3d faceVector(std::uint32_t primitive) const;
  std::array<Point2f, 3> cornerUv(std::uint32_t primitive) const;
  Vec3d interpolatedNormal(std::uint32_t primitive, const Weights& b) const;
  Vec3d orientedNormal(std::uint32_t primitive, Vec3d shadingNormal) const;

  std::string_view typeName_;
  std::vector<std::array<std::uint32_t, 3>> triangles_;
  std::vector<Point3f> positions_;  ///< one more than there are vertices: room for wide loads
  std::vector<Normal3f> normals_;
  std::vector<Vector3f> tangents_;
  std::vector<Point2f> uv_;
  std::vector<std::uint32_t> faceIndices_;
  Bounds3f bounds_;
  bool reversesNormals_, isSampledFromBehind_;
  bool flipsFace_;  ///< without N: whether the world-space (p1 - p0) x (p2 - p0) is turned
};

}  // namespace pbrtmedia
