// SPDX-License-Identifier: BSD-2-Clause
#include "film/pixel_sums.h"

#include "film/layer_sums.h"

namespace pbrtmedia {

void developPixel(const PixelParts& pixel, const LayerSet& layers, const SplatPaths& paths,
                  const Development& development, float* out) {
  const WeightedSums& s = pixel.colour;
  const SplatSum splats = paths.mean(pixel.splats);
  const auto mean = [&](double sum) { return s.weight != 0 ? sum / s.weight : 0; };
  out[0] = development.value(mean(s.r) + splats.r);
  out[1] = development.value(mean(s.g) + splats.g);
  out[2] = development.value(mean(s.b) + splats.b);
  if (layers.isEmpty()) return;
  developLayers(layers, pixel.layers, s, paths.varianceOfMean(pixel.splats, pixel.splatSquares), development,
                out + 3);
}

void OtherSums::append(const PixelParts& pixel, std::vector<double>& others) const {
  others.insert(others.end(), pixel.layers.begin(), pixel.layers.end());
  const auto add = [&](const SplatSum& s) { others.insert(others.end(), {s.r, s.g, s.b}); };
  if (!hasSplats_) return;
  add(pixel.splats);
  if (hasSquares_) add(pixel.splatSquares);
}

PixelParts OtherSums::parts(const WeightedSums& colour, std::span<const double> others) const {
  PixelParts pixel{colour, others.first(layers_)};
  const auto at = [&](std::size_t first) {
    return SplatSum{others[first], others[first + 1], others[first + 2]};
  };
  if (!hasSplats_) return pixel;
  pixel.splats = at(layers_);
  if (hasSquares_) pixel.splatSquares = at(layers_ + 3);
  return pixel;
}

}  // namespace pbrtmedia
