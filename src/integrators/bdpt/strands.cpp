// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/strands.h"

#include <algorithm>
#include <vector>

#include "shapes/curves.h"

namespace pbrtmedia {

bool isStrand(const Primitive& primitive) { return dynamic_cast<const Curves*>(primitive.shape) != nullptr; }

bool hasStrands(const Scene& scene) {
  const auto groups = scene.primitiveGroups();
  return std::ranges::any_of(groups, [](const std::vector<const Primitive*>& group) {
    return std::ranges::any_of(group, [](const Primitive* p) { return isStrand(*p); });
  });
}

}  // namespace pbrtmedia
