// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/heightfield.h"

#include <limits>
#include <string>
#include <tuple>

#include "shapes/grid_indices.h"
#include "shapes/parameter_checks.h"

namespace pbrtmedia {

TriangleMesh::Params tessellateHeightfield(const HeightfieldParams& params) {
  const auto [nu, nv, heights] = std::tie(params.nu, params.nv, params.Pz);
  if (nu < 2) rejectParameter("nu", "at least 2 samples", nu);
  if (nv < 2) rejectParameter("nv", "at least 2 samples", nv);
  if (heights.size() != static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv)) {
    rejectParameter("Pz", std::to_string(static_cast<std::int64_t>(nu) * nv) + " numbers (nu * nv)",
                    heights.size());
  }
  if (heights.size() > std::size_t{std::numeric_limits<int>::max()}) {
    rejectParameter("Pz", "at most 2^31 - 1 numbers", heights.size());
  }
  TriangleMesh::Params mesh;
  mesh.P.reserve(heights.size());
  mesh.uv.reserve(heights.size());
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const float x = static_cast<float>(i) / static_cast<float>(nu - 1);
      const float y = static_cast<float>(j) / static_cast<float>(nv - 1);
      mesh.P.emplace_back(x, y, heights[mesh.P.size()]);
      mesh.uv.emplace_back(x, y);
    }
  }
  mesh.indices = gridIndices(nu, nv);
  return mesh;
}

}  // namespace pbrtmedia
