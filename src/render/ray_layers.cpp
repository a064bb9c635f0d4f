// SPDX-License-Identifier: BSD-2-Clause
#include "render/ray_layers.h"

namespace pbrtmedia {

LayerMask RayLayers::ofRadiance(bool rendersMedia) {
  const LayerMask mask = maskOf({Layer::Emission, Layer::Direct, Layer::Indirect, Layer::Surface});
  return rendersMedia ? mask | maskOf({Layer::Medium}) : mask;
}

LayerMask RayLayers::ofSurfaces() {
  return ofRadiance(/*rendersMedia=*/false) |
         maskOf({Layer::Alpha, Layer::Depth, Layer::Normal, Layer::Albedo, Layer::Position});
}

LayerMask RayLayers::ofMedia() {
  return ofSurfaces() | ofRadiance(/*rendersMedia=*/true) |
         maskOf({Layer::Transmittance, Layer::MediumDepth});
}

void RayLayers::addRadiance(Rgb value, int scatterings, Scatterer first) {
  if (scatterings == 0) {
    emission_ += value;
    return;
  }
  (scatterings == 1 ? direct_ : indirect_) += value;
  (first == Scatterer::Surface ? surface_ : medium_) += value;
}

void RayLayers::addSurface(Rgb throughput, float distance, Vector3f n, Point3f p, Rgb albedo) {
  passed_ += throughput;
  albedo_ += throughput * albedo;
  surfaceWeight_ += throughput.average();
  distance_ = distance;
  n_ = n;
  p_ = p;
}

void RayLayers::addScattering(Rgb throughput, double distance) {
  albedo_ += throughput;
  const auto weight = static_cast<double>(throughput.average());
  mediumWeight_ += weight;
  mediumDistance_ += weight * distance;
}

void RayLayers::addEscape(Rgb throughput) {
  passed_ += throughput;
  escaped_ += throughput;
}

void RayLayers::finish() const {
  out_.set(Layer::Emission, emission_);
  out_.set(Layer::Direct, direct_);
  out_.set(Layer::Indirect, indirect_);
  out_.set(Layer::Surface, surface_);
  out_.set(Layer::Medium, medium_);
  out_.set(Layer::Transmittance, passed_);
  out_.set(Layer::Alpha, 1 - escaped_.average());
  out_.set(Layer::Albedo, albedo_);
  out_.set(Layer::Depth, distance_, surfaceWeight_);
  out_.set(Layer::Normal, n_, surfaceWeight_);
  out_.set(Layer::Position, Vector3f(p_), surfaceWeight_);
  if (mediumWeight_ != 0) {
    out_.set(Layer::MediumDepth, static_cast<float>(mediumDistance_ / mediumWeight_),
             static_cast<float>(mediumWeight_));
  }
}

}  // namespace pbrtmedia
