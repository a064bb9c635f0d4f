// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/texture.h"

namespace pbrtmedia {

/// (1 - amount) tex1 + amount tex2: amount 1 shows the *second* texture (the mix material is the other way
/// round). Borrows all three.
template <class T>
class MixTexture final : public Texture<T> {
 public:
  MixTexture(const Texture<T>& tex1, const Texture<T>& tex2, const FloatTexture& amount)
      : tex1_(&tex1), tex2_(&tex2), amount_(&amount) {}
  T evaluate(const SurfaceInteraction& si) const override {
    const float amount = amount_->evaluate(si);
    return (1 - amount) * tex1_->evaluate(si) + amount * tex2_->evaluate(si);
  }

 private:
  const Texture<T>* tex1_;
  const Texture<T>* tex2_;
  const FloatTexture* amount_;
};

}  // namespace pbrtmedia
