// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "materials/material.h"
#include "materials/subsurface_table.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// The boundary of a subsurface material. Textures are borrowed; only the bump map may be null.
struct SubsurfaceBoundary {
  const RgbTexture* kr = nullptr;            ///< default 1
  const RgbTexture* kt = nullptr;            ///< default 1
  const FloatTexture* uRoughness = nullptr;  ///< default 0
  const FloatTexture* vRoughness = nullptr;  ///< default 0; both 0: perfectly smooth
  bool remapRoughness = true;
  const FloatTexture* bumpMap = nullptr;  ///< displacement along the normal, world units
};

/// What is behind it by coefficients, [1/length] after `scale`.
struct SubsurfaceCoefficients {
  const RgbTexture* sigmaA = nullptr;
  const RgbTexture* sigmaS = nullptr;
  float scale = 1;
};

/// The same by the colour that is seen and the mean free path, a world length after `scale`.
struct SubsurfaceColour {
  const RgbTexture* kd = nullptr;
  const RgbTexture* meanFreePath = nullptr;
  float scale = 1;
};

/// A dielectric boundary, smooth or rough, below which light is scattered until it comes out elsewhere
/// (PBRT's "subsurface" and "kdsubsurface").
class SubsurfaceMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture. The index is that of the table.
  SubsurfaceMaterial(const SubsurfaceBoundary& boundary, const SubsurfaceCoefficients& inside,
                     std::shared_ptr<const SubsurfaceTable> table);
  SubsurfaceMaterial(const SubsurfaceBoundary& boundary, const SubsurfaceColour& inside,
                     std::shared_ptr<const SubsurfaceTable> table);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;
  bool hasBssrdf() const override { return true; }
  std::optional<Bssrdf> bssrdf(const SurfaceInteraction& si) const override;

 private:
  void requireTextures(std::string_view name) const;

  SubsurfaceBoundary boundary_;
  std::optional<SubsurfaceCoefficients> coefficients_;
  std::optional<SubsurfaceColour> colour_;  ///< one of the two
  std::shared_ptr<const SubsurfaceTable> table_;
};

}  // namespace pbrtmedia
