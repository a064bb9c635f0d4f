// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/bounds.h"
#include "film/layers.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// The samples of some consecutive sample indices over the film's sample bounds, before filtering. Threads
/// write disjoint entries; nothing is summed here, so nothing depends on their order.
class SamplePass {
 public:
  struct Sample {
    Point2f offset;      ///< film position minus the pixel's integer corner, in [0, 1)
    Rgb radiance;        ///< already multiplied by the camera's ray weight
    bool valid = false;  ///< false: not taken (stopped early); it then does not count at all
  };
  /// `firstIndex`: of the samples.
  SamplePass(Bounds2i sampleBounds, int samplesPerPixel, const LayerSet& layers = {},
             std::int64_t firstIndex = 0);
  Bounds2i bounds() const { return bounds_; }
  int samplesPerPixel() const { return samples_; }
  std::int64_t firstIndex() const { return firstIndex_; }
  Sample& at(Point2i pixel, int sample) { return data_[index(pixel, sample)]; }
  const Sample& at(Point2i pixel, int sample) const { return data_[index(pixel, sample)]; }
  /// Where a sample puts its layers; of no effect where there are none.
  LayerSample layersAt(Point2i pixel, int sample) {
    return layers_.isEmpty()
               ? LayerSample()
               : LayerSample(layers_, layerData_.data() + index(pixel, sample) * layers_.sampleSize());
  }
  /// Its numbers (LayerSet::sampleSize); null where there are none.
  float* layerValues(Point2i pixel, int sample) {
    return layers_.isEmpty() ? nullptr : layerData_.data() + index(pixel, sample) * layers_.sampleSize();
  }
  const float* layerValues(Point2i pixel, int sample) const {
    return layers_.isEmpty() ? nullptr : layerData_.data() + index(pixel, sample) * layers_.sampleSize();
  }
  /// Numbers of its layers that a sample has.
  std::size_t layerSize() const { return layers_.sampleSize(); }
  /// Nothing is taken of these pixels.
  void clear(const Bounds2i& pixels);
  /// Goes on with as many other samples, of which the first has this index; what is there stays.
  void setFirstIndex(std::int64_t index) { firstIndex_ = index; }

 private:
  // One plane for each sample index: the order in which the film reads them.
  std::size_t index(Point2i pixel, int sample) const {
    const auto width = static_cast<std::size_t>(bounds_.width()),
               height = static_cast<std::size_t>(bounds_.height());
    const auto x = static_cast<std::size_t>(pixel.x - bounds_.min.x),
               y = static_cast<std::size_t>(pixel.y - bounds_.min.y);
    return (static_cast<std::size_t>(sample) * height + y) * width + x;
  }
  Bounds2i bounds_;
  int samples_;
  std::int64_t firstIndex_;
  LayerSet layers_;
  std::vector<Sample> data_;
  std::vector<float> layerData_;  ///< empty without layers
};

}  // namespace pbrtmedia
