// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

#include "materials/bsdf.h"
#include "materials/microfacet.h"
#include "textures/texture.h"

// What several materials do with their textures.

namespace pbrtmedia {

/// Throws std::invalid_argument naming material and parameter when `texture` is null.
void requireTexture(const void* texture, std::string_view material, std::string_view parameter);

/// True for a constant that is black after clamping: its lobe is never made.
bool isAlwaysBlack(const RgbTexture& texture);
/// Whether it is a constant of this value.
bool isAlways(const FloatTexture& texture, float value);

/// The value clamped at 0 but not at 1.
inline Rgb reflectanceAt(const RgbTexture& texture, const SurfaceInteraction& si) {
  return texture.evaluate(si).nonNegative();
}

inline TrowbridgeReitz distributionAt(float uRoughness, float vRoughness, bool remap) {
  if (!remap) return {uRoughness, vRoughness};
  const float alphaU = TrowbridgeReitz::alphaFromRoughness(uRoughness);
  return {alphaU, vRoughness == uRoughness ? alphaU : TrowbridgeReitz::alphaFromRoughness(vRoughness)};
}

/// A boundary between vacuum and a dielectric.
struct Dielectric {
  Rgb kr, kt;
  float eta;  ///< index behind the normal
  float uRoughness, vRoughness;
  bool remapRoughness;
};

/// Adds the lobes of such a boundary: smooth where both roughnesses are 0, then one lobe if `mergeSpecular`.
/// `marks`: flags that what transmits gets.
void addDielectric(Bsdf& bsdf, const Dielectric& of, TransportMode mode, bool mergeSpecular,
                   BsdfFlags marks = BsdfFlags::None);

}  // namespace pbrtmedia
