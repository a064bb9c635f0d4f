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

void SamplePass::clear(const Bounds2i& pixels) {
  const auto width = static_cast<std::size_t>(pixels.width());
  for (int s = 0; s < samples_ && width > 0; ++s) {
    for (int y = pixels.min.y; y < pixels.max.y; ++y) {
      const std::size_t first = index({pixels.min.x, y}, s);
      std::fill_n(data_.begin() + static_cast<std::ptrdiff_t>(first), width, Sample{});
      std::fill_n(layerData_.begin() + static_cast<std::ptrdiff_t>(first * layers_.sampleSize()),
                  width * layers_.sampleSize(), 0.0f);
    }
  }
}

}  // namespace pbrtmedia
