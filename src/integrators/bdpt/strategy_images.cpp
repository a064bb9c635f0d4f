// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/strategy_images.h"

#include <string>

namespace pbrtmedia {
namespace {

void appendNumber(std::string& name, const char* what, int n) {
  name += what;
  if (n < 10) name += '0';
  name += std::to_string(n);
}

}  // namespace

std::vector<SideImage> strategyImages(int maxDepth) {
  std::vector<SideImage> images;
  for (int depth = 0; depth <= maxDepth; ++depth) {
    for (int s = 0; s <= (depth == 0 ? 0 : depth + 1); ++s) {
      const int t = depth + 2 - s;
      std::string name = "bdpt";
      appendNumber(name, "_d", depth);
      appendNumber(name, "_s", s);
      appendNumber(name, "_t", t);
      images.push_back({name + ".exr", t == 1});
    }
  }
  return images;
}

}  // namespace pbrtmedia
