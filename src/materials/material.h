// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "materials/bsdf.h"
#include "shapes/surface_interaction.h"

namespace pbrtmedia {

class Bssrdf;

/// What light does at a surface point: a BSDF, and for some a BSSRDF. Immutable, thread-safe. "No material"
/// is a null pointer, not a class.
class Material {
 public:
  virtual ~Material() = default;
  /// Applies the bump map (changes `si.shading`) and returns the lobes. `mergeSpecular`: smooth glass is one
  /// lobe that picks reflection or transmission (path, volpath); false: two lobes (whitted, directlighting).
  /// `mode`: whether what is asked for is scattered radiance or importance.
  virtual Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const = 0;
  /// No point of the surface has more lobes; mixes past Bsdf::kMaxLobes are refused when they are built.
  virtual std::size_t maxLobes() const = 0;

  /// Whether some point has a BSSRDF.
  virtual bool hasBssrdf() const { return false; }
  /// Where light comes out again that went through a lobe marked `BsdfFlags::Subsurface`; `si` as `bsdf` left
  /// it. Who does not ask for it takes the surface for a boundary with nothing behind it.
  virtual std::optional<Bssrdf> bssrdf(const SurfaceInteraction& si) const;
};

}  // namespace pbrtmedia
