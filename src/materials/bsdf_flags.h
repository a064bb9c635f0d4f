// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

namespace pbrtmedia {

/// What a lobe does; a set of bits. Every lobe has one of reflection/transmission (a merged Fresnel lobe has
/// both) and one of diffuse/glossy/specular.
enum class BsdfFlags : std::uint8_t {
  None = 0,
  Reflection = 1,
  Transmission = 2,
  Diffuse = 4,
  Glossy = 8,
  Specular = 16,
  /// Of a transmission, beside the others: what it lets through is scattered below the surface
  /// (Material::bssrdf). Has no part in matching.
  Subsurface = 32,
  All = 31,
  AllDiffuse = 7,
  AllButSpecular = 15
};
constexpr BsdfFlags operator|(BsdfFlags a, BsdfFlags b) {
  return static_cast<BsdfFlags>(static_cast<std::uint8_t>(a) | static_cast<std::uint8_t>(b));
}
constexpr BsdfFlags operator&(BsdfFlags a, BsdfFlags b) {
  return static_cast<BsdfFlags>(static_cast<std::uint8_t>(a) & static_cast<std::uint8_t>(b));
}
constexpr BsdfFlags without(BsdfFlags a, BsdfFlags b) {
  return static_cast<BsdfFlags>(static_cast<std::uint8_t>(a) & ~static_cast<std::uint8_t>(b));
}
constexpr bool any(BsdfFlags f) { return f != BsdfFlags::None; }
/// True when all bits of the lobe but Subsurface are among `allowed`: PBRT's matching rule.
constexpr bool matches(BsdfFlags lobe, BsdfFlags allowed) {
  return (lobe & (allowed | BsdfFlags::Subsurface)) == lobe;
}

}  // namespace pbrtmedia
