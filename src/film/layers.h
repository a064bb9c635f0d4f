// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What samples can tell besides their radiance.
enum class Layer : std::size_t {
  Lookups,  ///< density look-ups of the sample
  kCount
};

/// How a layer is called, and its channels in an image.
struct LayerInfo {
  std::string_view name;
  std::array<std::string_view, 3> channels;  ///< one or three; the others are empty
  std::size_t channelCount() const { return channels[1].empty() ? 1 : 3; }
};

/// In the order of Layer.
inline constexpr std::array<LayerInfo, static_cast<std::size_t>(Layer::kCount)> kLayers = {
    {{"lookups", {"lookups"}}}};

/// The layers that a film was asked for, and where their channels lie among those of all of them.
class LayerSet {
 public:
  LayerSet() { first_.fill(kNone); }
  /// Once for each layer.
  void add(Layer layer) {
    first_[static_cast<std::size_t>(layer)] = names_.size();
    const LayerInfo& info = kLayers[static_cast<std::size_t>(layer)];
    for (std::size_t c = 0; c < info.channelCount(); ++c) names_.emplace_back(info.channels[c]);
  }
  bool isEmpty() const { return names_.empty(); }
  std::size_t channelCount() const { return names_.size(); }
  const std::vector<std::string>& channelNames() const { return names_; }
  /// Nothing for a layer that was not asked for.
  std::optional<std::size_t> firstChannel(Layer layer) const {
    const std::size_t first = first_[static_cast<std::size_t>(layer)];
    return first == kNone ? std::nullopt : std::optional(first);
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  std::array<std::size_t, static_cast<std::size_t>(Layer::kCount)> first_{};
  std::vector<std::string> names_;
};

/// Where one sample puts its values of the layers; they are 0 until then. What nobody asked for is dropped.
class LayerSample {
 public:
  LayerSample() = default;
  /// `values`: LayerSet::channelCount of them. Both must outlive the object.
  LayerSample(const LayerSet& set, float* values) : set_(&set), values_(values) {}

  bool wants(Layer layer) const { return set_ != nullptr && set_->firstChannel(layer).has_value(); }
  void set(Layer layer, float value) const {
    if (set_ == nullptr) return;
    if (const auto first = set_->firstChannel(layer)) values_[*first] = value;
  }
  void set(Layer layer, Rgb value) const {
    if (set_ == nullptr) return;
    const auto first = set_->firstChannel(layer);
    if (!first) return;
    values_[*first] = value.r;
    values_[*first + 1] = value.g;
    values_[*first + 2] = value.b;
  }

 private:
  const LayerSet* set_ = nullptr;
  float* values_ = nullptr;
};

}  // namespace pbrtmedia
