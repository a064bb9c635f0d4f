// SPDX-License-Identifier: BSD-2-Clause
#include "world/alpha_filter.h"

#include "shapes/shape.h"
#include "shapes/surface_interaction.h"
#include "textures/texture.h"

namespace pbrtmedia {

AlphaFilter::AlphaFilter(const Primitive& primitive) : primitive_(primitive) {
  const Shape::Geometry geometry = primitive.shape->geometry();
  if (const auto* triangles = std::get_if<TriangleBuffers>(&geometry)) triangles_ = *triangles;
}

SurfaceInteraction AlphaFilter::pointAt(const RayHit& hit) const {
  SurfaceInteraction si;
  si.uv = primitive_.shape->uvAt(hit);
  si.primitive = hit.id;
  if (triangles_) {
    const auto& corners = triangles_->indices[hit.id.primitive];
    const Point3f a = triangles_->positions[corners[0]];
    si.p = a + hit.uv.x * (triangles_->positions[corners[1]] - a) +
           hit.uv.y * (triangles_->positions[corners[2]] - a);
  }
  return si;
}

bool AlphaFilter::accepts(const RayHit& hit, bool shadowRay) const {
  if (shadowRay && !primitive_.material) return false;
  const bool testsShadow = shadowRay && primitive_.shadowAlpha;
  if (!primitive_.alpha && !testsShadow) return true;
  const SurfaceInteraction si = pointAt(hit);
  if (primitive_.alpha && primitive_.alpha->evaluate(si) == 0) return false;
  return !testsShadow || primitive_.shadowAlpha->evaluate(si) != 0;
}

}  // namespace pbrtmedia
