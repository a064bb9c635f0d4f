// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "shapes/triangle_mesh.h"

namespace pbrtmedia {

/// A PLY file as a triangle mesh, and what a user should hear about it.
struct PlyMesh {
  TriangleMesh::Params mesh;
  std::vector<std::string> notices;  ///< for warnings: polygons split or left out, ...
};

/// Reads ASCII and binary PLY of either byte order, also gzip-compressed. Scene-language reference 13.4.
///
/// Vertex: x y z; nx ny nz; u v, s t, texture_u texture_v or texture_s texture_t. Face: list `vertex_indices`
/// or `vertex_index`; scalar `face_indices`. A quad (0,1,2,3) becomes (0,1,2), (3,0,2), both with the quad's
/// face index; a larger polygon becomes a fan around its first corner (PBRT-v3 leaves it out), with a notice.
/// Faces of fewer than three corners are left out with a notice. Other elements and properties are skipped.
///
/// Throws SceneError (with the line for headers and ASCII data) when the file cannot be read, is not PLY, is
/// shorter than its header says, has no vertices or faces, or holds a number that does not fit. Counts are
/// checked against the bytes that are there before anything of that size is allocated. Corner indices are
/// left to TriangleMesh::validate.
PlyMesh readPly(const std::filesystem::path& path);
/// The same from memory; `shownName` is the file name of errors.
PlyMesh parsePly(std::string_view bytes, const std::string& shownName);

}  // namespace pbrtmedia
