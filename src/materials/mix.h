// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// amount · material1 + (1 - amount) · material2 per channel: amount 1 shows the *first* material (the mix
/// texture is the other way round). Only material1's bump map, index and BSSRDF survive; material2's lobes
/// are evaluated in material1's frame, and what they let below the surface goes on by material1's BSSRDF.
class MixMaterial final : public Material {
 public:
  /// Borrows all three. Throws std::invalid_argument when a point could have more than Bsdf::kMaxLobes lobes.
  MixMaterial(const Material& material1, const Material& material2, const RgbTexture& amount);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override { return material1_->maxLobes() + material2_->maxLobes(); }
  bool hasBssrdf() const override { return material1_->hasBssrdf(); }
  std::optional<Bssrdf> bssrdf(const SurfaceInteraction& si) const override;

 private:
  const Material* material1_;
  const Material* material2_;
  const RgbTexture* amount_;
};

}  // namespace pbrtmedia
