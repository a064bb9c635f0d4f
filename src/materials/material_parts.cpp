// SPDX-License-Identifier: BSD-2-Clause
#include "materials/material_parts.h"

#include <stdexcept>
#include <string>

namespace pbrtmedia {

void requireTexture(const void* texture, std::string_view material, std::string_view parameter) {
  if (texture != nullptr) return;
  throw std::invalid_argument("material \"" + std::string(material) + "\": no texture for \"" +
                              std::string(parameter) + "\"");
}

bool isAlwaysBlack(const RgbTexture& texture) {
  const auto* constant = dynamic_cast<const ConstantTexture<Rgb>*>(&texture);
  return constant != nullptr && reflectanceAt(*constant, SurfaceInteraction{}).isBlack();
}

}  // namespace pbrtmedia
