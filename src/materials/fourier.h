// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "materials/fourier_table.h"
#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// A surface with a tabulated BSDF.
class FourierMaterial final : public Material {
 public:
  /// `bumpMap`: displacement along the normal, world units; borrowed, may be null.
  FourierMaterial(std::shared_ptr<const FourierTable> table, const FloatTexture* bumpMap)
      : table_(std::move(table)), bumpMap_(bumpMap) {}
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override { return 1; }

 private:
  std::shared_ptr<const FourierTable> table_;
  const FloatTexture* bumpMap_;
};

}  // namespace pbrtmedia
