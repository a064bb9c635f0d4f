// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_strategy.h"

#include <glog/logging.h>

#include <algorithm>
#include <vector>

#include "base/built_parts.h"
#include "base/distribution.h"
#include "base/math.h"
#include "lighting/light_tree_selector.h"
#include "lighting/spatial_light_selector.h"

namespace pbrtmedia {
namespace {

class UniformLightSelector final : public LightSelector {
 public:
  UniformLightSelector(std::size_t count, bool leavesOut) : count_(count), leavesOut_(leavesOut) {}
  Choice choose(const LightReceiver&, float u) const override {
    const auto index = static_cast<std::size_t>(double{u} * static_cast<double>(count_));
    return {std::min(index, count_ - 1), each()};
  }
  float probability(const LightReceiver&, std::size_t) const override { return each(); }
  bool leavesOutUniformLights() const override { return leavesOut_; }

 private:
  float each() const { return 1 / static_cast<float>(count_); }
  std::size_t count_;
  bool leavesOut_;
};

class PowerLightSelector final : public LightSelector {
 public:
  explicit PowerLightSelector(std::span<const Illuminant* const> lights) {
    std::vector<float> weights;
    double sum = 0;
    for (const Illuminant* light : lights) {
      const float power = light->power().luminance();
      weights.push_back(std::isfinite(power) ? std::max(power, 0.0f) : 0);
      sum += weights.back();
    }
    const auto least = static_cast<float>(kSmallestShare * sum / static_cast<double>(weights.size()));
    for (float& w : weights) w = std::max(w, least);
    lights_ = Distribution1D(weights);
    countBuilt(Part::LightDistributions);
  }
  Choice choose(const LightReceiver&, float u) const override {
    const Distribution1D::Choice c = lights_.choose(u);
    return {c.index, c.probability};
  }
  float probability(const LightReceiver&, std::size_t light) const override {
    return lights_.probability(light);
  }

 private:
  Distribution1D lights_;
};

}  // namespace

std::optional<LightStrategy> lightStrategyOfName(std::string_view name) {
  if (name == "uniform") return LightStrategy::Uniform;
  if (name == "power") return LightStrategy::Power;
  if (name == "spatial") return LightStrategy::Spatial;
  if (name == "tree") return LightStrategy::Tree;
  if (name == "learned") return LightStrategy::Learned;
  return std::nullopt;
}

std::unique_ptr<const LightSelector> makeLightSelector(LightStrategy strategy,
                                                       std::span<const Illuminant* const> lights,
                                                       const Bounds3f& sceneBounds) {
  CHECK(!lights.empty()) << "a selector needs a light to select";
  const bool isOwn = strategy == LightStrategy::Tree || strategy == LightStrategy::Learned;
  if (strategy == LightStrategy::Uniform || lights.size() == 1)
    return std::make_unique<UniformLightSelector>(lights.size(), isOwn);
  if (isOwn) {
    return std::make_unique<LightTreeSelector>(lights, sceneBounds, strategy == LightStrategy::Learned);
  }
  if (strategy == LightStrategy::Power || sceneBounds.isEmpty()) {
    return std::make_unique<PowerLightSelector>(lights);
  }
  return std::make_unique<SpatialLightSelector>(lights, sceneBounds);
}

}  // namespace pbrtmedia
