// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "shapes/surface_interaction.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A function on surfaces. T is float or Rgb. Immutable, thread-safe.
template <class T>
class Texture {
 public:
  virtual ~Texture() = default;
  virtual T evaluate(const SurfaceInteraction& si) const = 0;
};
using FloatTexture = Texture<float>;
using RgbTexture = Texture<Rgb>;

/// The same value everywhere.
template <class T>
class ConstantTexture final : public Texture<T> {
 public:
  explicit ConstantTexture(T value) : value_(value) {}
  T evaluate(const SurfaceInteraction&) const override { return value_; }

 private:
  T value_;
};

}  // namespace pbrtmedia
