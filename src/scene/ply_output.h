// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <span>

#include "base/vec.h"

namespace pbrtmedia {

/// A triangle mesh to be written; `normals` and `uv` are empty or as many as `points`.
struct PlyMesh {
  std::span<const int> indices;  ///< three per triangle, each in [0, points.size())
  std::span<const Point3f> points;
  std::span<const Normal3f> normals;
  std::span<const Point2f> uv;
};

/// Writes binary little-endian PLY with properties x y z, nx ny nz, u v and faces vertex_indices. Throws
/// std::runtime_error naming the path and the reason.
void writePly(const std::filesystem::path& path, const PlyMesh& mesh);

}  // namespace pbrtmedia
