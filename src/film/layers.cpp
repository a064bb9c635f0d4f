// SPDX-License-Identifier: BSD-2-Clause
#include "film/layers.h"

#include <algorithm>

namespace pbrtmedia {

std::optional<Layer> layerOfName(std::string_view name) {
  const auto* const found =
      std::find_if(kLayers.begin(), kLayers.end(), [&](const LayerInfo& info) { return info.name == name; });
  if (found == kLayers.end()) return std::nullopt;
  return static_cast<Layer>(found - kLayers.begin());
}

std::vector<std::string_view> layerNames(const LayerMask& mask) {
  std::vector<std::string_view> names;
  for (std::size_t i = 0; i < kLayerCount; ++i) {
    if (mask.test(i)) names.push_back(kLayers[i].name);
  }
  return names;
}

LayerSet::LayerSet(const LayerMask& mask) : LayerSet() {
  for (std::size_t i = 0; i < kLayerCount; ++i) {
    if (!mask.test(i)) continue;
    const LayerInfo& info = kLayers[i];
    layers_.push_back(static_cast<Layer>(i));
    first_[i] = sampleSize_;
    for (std::size_t c = 0; c < info.channelCount(); ++c) names_.emplace_back(info.channels[c]);
    sampleSize_ += info.sampleSize();
    sumCount_ += info.sumCount();
  }
}

std::string LayerSet::text() const {
  std::string text;
  for (const Layer layer : layers_) {
    if (!text.empty()) text += ',';
    text += infoOf(layer).name;
  }
  return text;
}

void LayerSample::scaleRadiance(float factor) const {
  if (set_ == nullptr || factor == 1) return;
  for (const Layer layer : set_->layers()) {
    if (infoOf(layer).kind != LayerKind::Radiance) continue;
    float* const at = find(layer);
    for (std::size_t c = 0; c < infoOf(layer).channelCount(); ++c) at[c] *= factor;
  }
}

void LayerSample::drop() const {
  if (set_ == nullptr) return;
  for (const Layer layer : set_->layers()) {
    if (infoOf(layer).kind == LayerKind::Total) continue;
    if (float* const at = find(layer)) std::fill_n(at, infoOf(layer).sampleSize(), 0.0f);
  }
}

}  // namespace pbrtmedia
