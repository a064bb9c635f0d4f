// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What an image can tell besides its colour (docs/layers.md has their definitions).
enum class Layer : std::size_t {
  Variance,
  Samples,
  Seconds,
  Lookups,
  Alpha,
  Depth,
  Normal,
  Albedo,
  Position,
  Transmittance,
  MediumDepth,
  Emission,
  Direct,
  Indirect,
  Surface,
  Medium,
  kCount
};
inline constexpr std::size_t kLayerCount = static_cast<std::size_t>(Layer::kCount);

/// Some of all layers, by Layer.
using LayerMask = std::bitset<kLayerCount>;
inline LayerMask maskOf(std::initializer_list<Layer> layers) {
  LayerMask mask;
  for (const Layer layer : layers) mask.set(static_cast<std::size_t>(layer));
  return mask;
}

/// How a pixel's value comes from those of samples.
enum class LayerKind {
  Mean,      ///< under the filter, as colour does
  Radiance,  ///< the same, of a part of the colour: what is done to colours is done to it
  Weighted,  ///< the same, of those samples that have a value: each says how much its own counts
  Total,     ///< the sum over the samples that lie in the pixel, whatever the filter
  Variance   ///< of the pixel's colour; samples need not say anything
};

/// How a layer is called, and its channels in an image: one or three; the others are empty.
struct LayerInfo {
  std::string_view name;
  LayerKind kind;
  std::array<std::string_view, 3> channels;

  constexpr std::size_t channelCount() const { return channels[1].empty() ? 1 : 3; }
  /// Numbers that a sample has for it.
  constexpr std::size_t sampleSize() const {
    if (kind == LayerKind::Variance) return 0;
    return channelCount() + (kind == LayerKind::Weighted ? 1 : 0);
  }
  /// Sums that a pixel has for it.
  constexpr std::size_t sumCount() const { return kind == LayerKind::Variance ? 8 : sampleSize(); }
};

/// In the order of Layer.
inline constexpr std::array<LayerInfo, kLayerCount> kLayers = {
    {{"variance", LayerKind::Variance, {"variance.R", "variance.G", "variance.B"}},
     {"samples", LayerKind::Total, {"samples"}},
     {"seconds", LayerKind::Total, {"seconds"}},
     {"lookups", LayerKind::Total, {"lookups"}},
     {"alpha", LayerKind::Mean, {"A"}},
     {"depth", LayerKind::Weighted, {"Z"}},
     {"normal", LayerKind::Weighted, {"N.X", "N.Y", "N.Z"}},
     {"albedo", LayerKind::Mean, {"albedo.R", "albedo.G", "albedo.B"}},
     {"position", LayerKind::Weighted, {"P.X", "P.Y", "P.Z"}},
     {"transmittance", LayerKind::Mean, {"transmittance.R", "transmittance.G", "transmittance.B"}},
     {"mediumdepth", LayerKind::Weighted, {"mediumdepth.Z"}},
     {"emission", LayerKind::Radiance, {"emission.R", "emission.G", "emission.B"}},
     {"direct", LayerKind::Radiance, {"direct.R", "direct.G", "direct.B"}},
     {"indirect", LayerKind::Radiance, {"indirect.R", "indirect.G", "indirect.B"}},
     {"surface", LayerKind::Radiance, {"surface.R", "surface.G", "surface.B"}},
     {"medium", LayerKind::Radiance, {"medium.R", "medium.G", "medium.B"}}}};

constexpr const LayerInfo& infoOf(Layer layer) { return kLayers[static_cast<std::size_t>(layer)]; }

/// Nothing for a name that no layer has.
std::optional<Layer> layerOfName(std::string_view name);
/// All names, in the order of Layer; of those in a mask.
std::vector<std::string_view> layerNames(const LayerMask& mask = LayerMask().set());

/// The layers that a film was asked for, and where their numbers lie among those of all of them: channels of
/// the image, numbers of a sample, and sums of a pixel.
class LayerSet {
 public:
  LayerSet() { first_.fill(kNone); }
  explicit LayerSet(const LayerMask& mask);

  bool isEmpty() const { return layers_.empty(); }
  bool has(Layer layer) const { return first_[static_cast<std::size_t>(layer)] != kNone; }
  /// In the order of Layer, which is that of channels, numbers and sums.
  const std::vector<Layer>& layers() const { return layers_; }
  const std::vector<std::string>& channelNames() const { return names_; }
  std::size_t channelCount() const { return names_.size(); }
  std::size_t sampleSize() const { return sampleSize_; }
  std::size_t sumCount() const { return sumCount_; }
  /// "alpha,depth"
  std::string text() const;
  /// Of a sample's numbers; nothing for a layer that was not asked for, or samples have nothing to say of.
  std::optional<std::size_t> firstNumber(Layer layer) const {
    const std::size_t first = first_[static_cast<std::size_t>(layer)];
    return first == kNone || infoOf(layer).sampleSize() == 0 ? std::nullopt : std::optional(first);
  }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};
  std::vector<Layer> layers_;
  std::array<std::size_t, kLayerCount> first_{};
  std::vector<std::string> names_;
  std::size_t sampleSize_ = 0, sumCount_ = 0;
};

/// Where one sample puts its values of the layers; they are 0 until then. What nobody asked for is dropped.
class LayerSample {
 public:
  LayerSample() = default;
  /// `values`: LayerSet::sampleSize of them. Both must outlive the object.
  LayerSample(const LayerSet& set, float* values) : set_(&set), values_(values) {}

  bool isWanted() const { return set_ != nullptr; }
  bool wants(Layer layer) const { return set_ != nullptr && set_->has(layer); }
  void set(Layer layer, float value) const {
    if (float* const at = find(layer)) at[0] = value;
  }
  void set(Layer layer, Rgb value) const { put(find(layer), value.r, value.g, value.b); }
  /// Of the kind Weighted.
  void set(Layer layer, float value, float weight) const {
    float* const at = find(layer);
    if (!at) return;
    at[0] = value;
    at[1] = weight;
  }
  void set(Layer layer, Vector3f value, float weight) const {
    float* const at = find(layer);
    put(at, value.x, value.y, value.z);
    if (at) at[3] = weight;
  }
  /// What was done to the sample's radiance since it was set.
  void scaleRadiance(float factor) const;
  /// The sample is black and empty: all but totals become 0.
  void drop() const;

 private:
  float* find(Layer layer) const {
    if (set_ == nullptr) return nullptr;
    const auto first = set_->firstNumber(layer);
    return first ? values_ + *first : nullptr;
  }
  static void put(float* at, float a, float b, float c) {
    if (!at) return;
    at[0] = a;
    at[1] = b;
    at[2] = c;
  }

  const LayerSet* set_ = nullptr;
  float* values_ = nullptr;
};

}  // namespace pbrtmedia
