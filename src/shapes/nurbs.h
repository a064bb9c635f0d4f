// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "shapes/triangle_mesh.h"

namespace pbrtmedia {

/// A tensor-product NURBS patch (`nurbs`), scene-language reference 13.8.
struct NurbsParams {
  int nu = 0, nv = 0;                 ///< control points, >= order
  int uorder = 0, vorder = 0;         ///< degree + 1, >= 2
  std::vector<float> uknots, vknots;  ///< nu + uorder, nv + vorder values, not decreasing
  std::optional<float> u0 = {}, u1 = {}, v0 = {},
                       v1 = {};         ///< part to use; default the valid range knot[order - 1] ... knot[n]
  std::vector<Point3f> P = {};          ///< nu * nv points, u fastest, or
  std::vector<float> Pw = {};           ///< 4 * nu * nv homogeneous coordinates (x, y, z already times w)
  static constexpr int kVertices = 30;  ///< per direction of the mesh
};

/// The patch as a 30 x 30 vertex mesh in object space with normals dp/du x dp/dv and uv = the parameter
/// values. Give the result to TriangleMesh. Throws std::invalid_argument, naming parameter, what was found
/// and what was expected.
TriangleMesh::Params tessellateNurbs(const NurbsParams& params);

}  // namespace pbrtmedia
