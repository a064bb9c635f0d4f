// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

namespace pbrtmedia {

/// Two triangles per cell of a grid of nu x nv vertices (u fastest), counter-clockwise in (u, v).
inline std::vector<int> gridIndices(int nu, int nv) {
  std::vector<int> indices;
  indices.reserve(6 * static_cast<std::size_t>(nu - 1) * static_cast<std::size_t>(nv - 1));
  for (int j = 0; j + 1 < nv; ++j) {
    for (int i = 0; i + 1 < nu; ++i) {
      const int a = j * nu + i, b = a + 1, c = a + nu, d = c + 1;
      indices.insert(indices.end(), {a, b, d, a, d, c});
    }
  }
  return indices;
}

}  // namespace pbrtmedia
