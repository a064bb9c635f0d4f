// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "film/layers.h"
#include "image/splat_sums.h"
#include "image/weighted_sums.h"

namespace pbrtmedia {

/// All sums of one pixel. Sums of parts of a render's samples add up to those of all.
struct PixelParts {
  WeightedSums colour;
  std::span<const double> layers;  ///< LayerSet::sumCount of them
  SplatSum splats{};
  SplatSum splatSquares{};  ///< of what each light path brings; 0 without Layer::Variance
};

/// A pixel as it is shown: R, G, B and the channels of the layers go to `out`. Its colour is the mean of
/// samples plus that of splats. `paths`: those that all splats are of.
void developPixel(const PixelParts& pixel, const LayerSet& layers, const SplatPaths& paths,
                  const Development& development, float* out);

/// Where the sums besides those of the colour stand among each other, pixel by pixel, as image files keep
/// them (withSums): of layers, then of splats where there are some, then of their squares where the variance
/// is wanted.
class OtherSums {
 public:
  OtherSums(const LayerSet& layers, bool hasSplats)
      : layers_(layers.sumCount()), hasSplats_(hasSplats), hasSquares_(layers.has(Layer::Variance)) {}

  std::size_t count() const { return layers_ + (hasSplats_ ? (hasSquares_ ? 6 : 3) : 0); }
  /// Those of a pixel, behind one another.
  void append(const PixelParts& pixel, std::vector<double>& others) const;
  /// The parts of a pixel from `count` sums, which must outlive it.
  PixelParts parts(const WeightedSums& colour, std::span<const double> others) const;

 private:
  std::size_t layers_;
  bool hasSplats_, hasSquares_;
};

}  // namespace pbrtmedia
