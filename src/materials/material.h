// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "materials/bsdf.h"
#include "shapes/surface_interaction.h"

namespace pbrtmedia {

/// Turns a surface point into a BSDF. Immutable, thread-safe. "No material" is a null pointer, not a class.
class Material {
 public:
  virtual ~Material() = default;
  /// Applies the bump map (changes `si.shading`) and returns the lobes. `mergeSpecular`: smooth glass is one
  /// lobe that picks reflection or transmission (path, volpath); false: two lobes (whitted, directlighting).
  /// `mode`: whether what is asked for is scattered radiance or importance.
  virtual Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const = 0;
  /// No point of the surface has more lobes; mixes past Bsdf::kMaxLobes are refused when they are built.
  virtual std::size_t maxLobes() const = 0;
};

}  // namespace pbrtmedia
