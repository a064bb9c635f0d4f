// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/texture.h"

namespace pbrtmedia {

/// tex1 · tex2. Borrows both.
template <class T>
class ScaleTexture final : public Texture<T> {
 public:
  ScaleTexture(const Texture<T>& tex1, const Texture<T>& tex2) : tex1_(&tex1), tex2_(&tex2) {}
  T evaluate(const SurfaceInteraction& si) const override {
    return tex1_->evaluate(si) * tex2_->evaluate(si);
  }

 private:
  const Texture<T>* tex1_;
  const Texture<T>* tex2_;
};

}  // namespace pbrtmedia
