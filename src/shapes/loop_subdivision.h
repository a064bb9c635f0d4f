// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/triangle_mesh.h"

namespace pbrtmedia {

/// Loop subdivision surface (`loopsubdiv`), scene-language reference 13.5.
struct LoopSubdivisionParams {
  int levels = 3;            ///< 0 to kMaxLevels
  std::vector<int> indices;  ///< three per triangle, zero-based
  std::vector<Point3f> P;    ///< object space
  static constexpr int kMaxLevels = 12;
};

/// What makes `subdivideLoop` impossible: bad arrays (as TriangleMesh::validate), an edge with more than two
/// triangles or with two of the same direction, a vertex whose triangles do not form one fan, `levels` out of
/// range or too many triangles. Vertices of no triangle are allowed and dropped.
std::vector<MeshProblem> validateLoop(const LoopSubdivisionParams& params);

/// Subdivides `levels` times, moves the vertices to the limit surface and adds limit normals as N; no uv. The
/// normals point to the side from which triangles look clockwise: PBRT-v3's images show it (plastic, whose
/// two sides differ, tells), and as N they decide the orientation of the mesh. Object space: give the result
/// to TriangleMesh. Throws std::invalid_argument with the errors of `validateLoop`. Loop 1987, "Smooth
/// subdivision surfaces based on triangles"; limit masks as in Hoppe et al. 1994, doi:10.1145/192161.192233.
TriangleMesh::Params subdivideLoop(const LoopSubdivisionParams& params);

}  // namespace pbrtmedia
