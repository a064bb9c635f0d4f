// SPDX-License-Identifier: BSD-2-Clause
#include "film/sample_pass.h"

#include <glog/logging.h>

#include <algorithm>

namespace pbrtmedia {

SamplePass::SamplePass(Bounds2i sampleBounds, int samplesPerPixel, const LayerSet& layers,
                       std::int64_t firstIndex)
    : bounds_(sampleBounds), samples_(samplesPerPixel), firstIndex_(firstIndex), layers_(layers) {
  CHECK_GT(samplesPerPixel, 0);
  data_.resize(static_cast<std::size_t>(bounds_.area()) * static_cast<std::size_t>(samples_));
  layerData_.resize(data_.size() * layers_.sampleSize());
}

void SamplePass::clear() {
  std::fill(data_.begin(), data_.end(), Sample{});
  std::fill(layerData_.begin(), layerData_.end(), 0.0f);
}

// One plane for each sample index: the order in which the film reads them.
std::size_t SamplePass::index(Point2i pixel, int sample) const {
  const auto width = static_cast<std::size_t>(bounds_.width()),
             height = static_cast<std::size_t>(bounds_.height());
  const auto x = static_cast<std::size_t>(pixel.x - bounds_.min.x),
             y = static_cast<std::size_t>(pixel.y - bounds_.min.y);
  return (static_cast<std::size_t>(sample) * height + y) * width + x;
}

}  // namespace pbrtmedia
