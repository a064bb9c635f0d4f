// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/material.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// Textures are borrowed; only the bump map may be null.
struct DisneyParams {
  const RgbTexture* color = nullptr;             ///< default 0.5
  const FloatTexture* metallic = nullptr;        ///< default 0
  const FloatTexture* eta = nullptr;             ///< index behind the normal, > 0; default 1.5
  const FloatTexture* roughness = nullptr;       ///< default 0.5
  const FloatTexture* specularTint = nullptr;    ///< default 0
  const FloatTexture* anisotropic = nullptr;     ///< default 0
  const FloatTexture* sheen = nullptr;           ///< default 0
  const FloatTexture* sheenTint = nullptr;       ///< default 0.5
  const FloatTexture* clearcoat = nullptr;       ///< default 0
  const FloatTexture* clearcoatGloss = nullptr;  ///< default 1
  const FloatTexture* specTrans = nullptr;       ///< default 0
  const RgbTexture* scatterDistance = nullptr;   ///< world length; default 0: diffuse on the spot
  bool isThin = false;                           ///< a sheet: light goes through without a change of its side
  const FloatTexture* flatness = nullptr;        ///< thin only; default 0
  const FloatTexture* diffTrans = nullptr;       ///< thin only, in [0, 2]; default 1
  const FloatTexture* bumpMap = nullptr;         ///< displacement along the normal, world units
};

/// Disney's principled material, lobes of disney_lobes.h. Its parts do not share their energy: a white one
/// may return more than it gets at grazing angles.
class DisneyMaterial final : public Material {
 public:
  /// Throws std::invalid_argument for a missing texture.
  explicit DisneyMaterial(const DisneyParams& params);
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool mergeSpecular) const override;
  std::size_t maxLobes() const override;
  bool hasBssrdf() const override;
  std::optional<Bssrdf> bssrdf(const SurfaceInteraction& si) const override;

 private:
  struct Point;
  Point pointAt(const SurfaceInteraction& si) const;
  void addDiffuse(const Point& at, const SurfaceInteraction& si, TransportMode mode, Bsdf& bsdf) const;
  void addGlossy(const Point& at, const SurfaceInteraction& si, TransportMode mode, Bsdf& bsdf) const;

  DisneyParams params_;
};

}  // namespace pbrtmedia
