// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "textures/mapping2d.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// True inside one of the randomly present, randomly shifted dots of radius 0.35, at most one per unit cell.
bool isInsideDot(Point2f st);

/// Polka dots of two textures. As in PBRT-v3 the names are exchanged: `inside` is shown *outside* the dots.
/// Borrows both.
template <class T>
class DotsTexture final : public Texture<T> {
 public:
  DotsTexture(const Mapping2d& mapping, const Texture<T>& inside, const Texture<T>& outside)
      : mapping_(mapping), inside_(&inside), outside_(&outside) {}
  T evaluate(const SurfaceInteraction& si) const override {
    return (isInsideDot(mapPoint(mapping_, si).st) ? outside_ : inside_)->evaluate(si);
  }

 private:
  Mapping2d mapping_;
  const Texture<T>* inside_;
  const Texture<T>* outside_;
};

}  // namespace pbrtmedia
