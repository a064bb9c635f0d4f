// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "shapes/triangle_mesh.h"

namespace pbrtmedia {

/// Heights over a grid on [0, 1]² (`heightfield`), scene-language reference 13.7.
struct HeightfieldParams {
  int nu = 0, nv = 0;     ///< samples along x and y, >= 2
  std::vector<float> Pz;  ///< nu * nv heights, x fastest, finite
};

/// The triangles of the field in object space: uv = (x, y), no normals, front on the +z side. Give the result
/// to TriangleMesh. Throws std::invalid_argument, naming parameter, what was found and what was expected.
TriangleMesh::Params tessellateHeightfield(const HeightfieldParams& params);

}  // namespace pbrtmedia
