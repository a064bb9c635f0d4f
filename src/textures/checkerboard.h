// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/mapping2d.h"
#include "textures/mapping3d.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// "aamode" of the 2D checkerboard.
enum class CheckerboardFilter { ClosedForm, None };

/// Share of the second texture in a 2D checkerboard, in [0, 1]: 0 or 1 by the parity of floor(s) + floor(t),
/// or, with the closed form, its box average over the footprint; 1/2 where the footprint is wider than 2
/// checks.
float checkerboardShare(const TexCoord2& at, CheckerboardFilter filter);
/// Parity of floor(x) + floor(y) + floor(z): true when odd. Any finite numbers.
bool isOddCheck(Point3f p);

/// Unit checks of two textures over (s, t). Borrows both.
template <class T>
class Checkerboard2dTexture final : public Texture<T> {
 public:
  Checkerboard2dTexture(const Mapping2d& mapping, const Texture<T>& tex1, const Texture<T>& tex2,
                        CheckerboardFilter filter = CheckerboardFilter::ClosedForm)
      : mapping_(mapping), tex1_(&tex1), tex2_(&tex2), filter_(filter) {}
  T evaluate(const SurfaceInteraction& si) const override {
    const float share = checkerboardShare(mapPoint(mapping_, si), filter_);
    if (share == 0) return tex1_->evaluate(si);
    if (share == 1) return tex2_->evaluate(si);
    return (1 - share) * tex1_->evaluate(si) + share * tex2_->evaluate(si);
  }

 private:
  Mapping2d mapping_;
  const Texture<T>* tex1_;
  const Texture<T>* tex2_;
  CheckerboardFilter filter_;
};

/// Unit cubes of two textures; never filtered. Borrows both.
template <class T>
class Checkerboard3dTexture final : public Texture<T> {
 public:
  Checkerboard3dTexture(const Mapping3d& mapping, const Texture<T>& tex1, const Texture<T>& tex2)
      : mapping_(mapping), tex1_(&tex1), tex2_(&tex2) {}
  T evaluate(const SurfaceInteraction& si) const override {
    return (isOddCheck(mapping_(si).p) ? tex2_ : tex1_)->evaluate(si);
  }

 private:
  Mapping3d mapping_;
  const Texture<T>* tex1_;
  const Texture<T>* tex2_;
};

}  // namespace pbrtmedia
