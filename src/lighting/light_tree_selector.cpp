// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_tree_selector.h"

#include <glog/logging.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

#include "base/built_parts.h"
#include "base/hash.h"
#include "lighting/light_importance.h"
#include "lighting/light_trials.h"
#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

/// Luminances, none of them 0.
std::vector<double> powersOf(std::span<const Illuminant* const> lights) {
  std::vector<double> powers;
  double sum = 0;
  for (const Illuminant* light : lights) {
    const auto power = static_cast<double>(light->power().luminance());
    powers.push_back(std::isfinite(power) ? std::max(power, 0.0) : 0);
    sum += powers.back();
  }
  const double average = sum > 0 ? sum / static_cast<double>(powers.size()) : 1;
  for (double& power : powers) power = std::max(power / average, kSmallestShare);
  return powers;
}

/// A uniform number of double precision, which a long way down a tree needs; from the point too, so that a
/// pattern of `u` is no pattern of lights.
double refine(float u, Point3f p) {
  const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
  const std::uint64_t hash = hashCombine(bits(u), bits(p.x), bits(p.y), bits(p.z));
  return static_cast<double>(u) + static_cast<double>(hash >> 40) * 0x1p-48;
}

}  // namespace

LightTreeSelector::LightTreeSelector(std::span<const Illuminant* const> lights, const Bounds3f& sceneBounds,
                                     bool learns)
    : clusterOf_(lights.size()), slotOf_(lights.size()), learns_(learns) {
  CHECK(!lights.empty()) << "a selector needs a light to select";
  countBuilt(Part::LightDistributions);
  const std::vector<double> powers = powersOf(lights);
  std::vector<std::uint32_t> near, far;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const std::optional<LightExtent> extent = lights[i]->extent();
    const bool hasPlace =
        extent && !extent->isInfinitelyFar() && isFinite(extent->bounds.min) && isFinite(extent->bounds.max);
    (hasPlace ? near : far).push_back(i);
    hasOthers_ = hasOthers_ || !lights[i]->isUniformInfinite();
  }
  const double radius = BoundingSphere(sceneBounds.isEmpty() ? Bounds3f{{}, {}} : sceneBounds).radius();
  addFarLights(lights, powers, std::move(far), std::numbers::pi * radius * radius);
  addTree(lights, powers, near);
  double sum = 0;
  for (const Cluster& c : clusters_) sum += c.share;
  for (Cluster& c : clusters_) c.share /= sum;
}

void LightTreeSelector::addFarLights(std::span<const Illuminant* const> lights,
                                     std::span<const double> powers, std::vector<std::uint32_t> far,
                                     double area) {
  std::ranges::stable_sort(far, [&](std::uint32_t a, std::uint32_t b) { return powers[a] > powers[b]; });
  const auto irradianceOf = [&](double power) { return area > 0 ? power / area : power; };
  const std::size_t alone = far.size() <= kMostFar + 1 ? far.size() : kMostFar;
  for (std::size_t i = 0; i < alone; ++i) {
    const std::uint32_t light = far[i];
    const std::optional<LightExtent> extent = lights[light]->extent();
    Cluster c{.light = light, .irradiance = irradianceOf(powers[light]), .share = powers[light]};
    if (extent && extent->isInfinitelyFar() && extent->spread == 0) c.toLight = -extent->axis;
    c.isUniform = lights[light]->isUniformInfinite();
    clusterOf_[light] = static_cast<std::uint32_t>(clusters_.size());
    clusters_.push_back(c);
  }
  if (alone == far.size()) return;
  Cluster c;
  std::vector<float> weights;
  for (std::size_t i = alone; i < far.size(); ++i) {
    const std::uint32_t light = far[i];
    clusterOf_[light] = static_cast<std::uint32_t>(clusters_.size());
    slotOf_[light] = static_cast<std::uint32_t>(restLights_.size());
    restLights_.push_back(light);
    weights.push_back(static_cast<float>(powers[light]));
    c.share += powers[light];
  }
  c.irradiance = irradianceOf(c.share);
  rest_ = Distribution1D(weights);
  clusters_.push_back(c);
}

void LightTreeSelector::addTree(std::span<const Illuminant* const> lights, std::span<const double> powers,
                                std::span<const std::uint32_t> near) {
  if (near.empty()) return;
  std::vector<LightTree::Source> sources;
  for (const std::uint32_t light : near) {
    slotOf_[light] = static_cast<std::uint32_t>(sources.size());
    nearLights_.push_back(light);
    const LightExtent extent = *lights[light]->extent();
    const double angle = std::max(static_cast<double>(extent.solidAngle), 1e-3);
    sources.push_back({extent, powers[light] / angle});
  }
  tree_ = LightTree(sources);
  // Opened where most light is.
  std::vector<std::uint32_t> parts{0};
  while (parts.size() < kMostParts) {
    const auto value = [&](std::uint32_t i) {
      return tree_.node(i).isLeaf() ? 0.0f : tree_.node(i).intensity;
    };
    const auto largest = std::ranges::max_element(
        parts, [&](std::uint32_t a, std::uint32_t b) { return value(a) < value(b); });
    if (!(value(*largest) > 0)) break;
    const std::uint32_t opened = *largest;
    *largest = opened + 1;
    parts.push_back(tree_.node(opened).right);
  }
  std::vector<std::uint32_t> partOf(tree_.nodeCount(), kNone);
  for (const std::uint32_t part : parts) {
    partOf[part] = static_cast<std::uint32_t>(clusters_.size());
    clusters_.push_back({.node = part});
  }
  for (std::uint32_t i = 1; i < partOf.size(); ++i) {
    if (partOf[i] == kNone) partOf[i] = partOf[tree_.node(i).parent];
  }
  for (const std::uint32_t light : near) {
    clusterOf_[light] = partOf[tree_.leafOf(slotOf_[light])];
    clusters_[clusterOf_[light]].share += powers[light];
  }
}

double LightTreeSelector::importanceOf(const Cluster& c, const LightReceiver& at) const {
  if (c.node != kNone) return importanceAt(at, tree_.node(c.node));
  if (c.toLight == Vector3f()) return c.irradiance;
  return c.irradiance * receptionFrom(at, c.toLight);
}

double LightTreeSelector::importancesAt(const LightReceiver& at, std::span<const double> factors,
                                        Weights& weights) const {
  double sum = 0;
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    const Cluster& c = clusters_[i];
    weights.of[i] = leavesOut(c, at) ? 0 : importanceOf(c, at) * (factors.empty() ? 1 : factors[i]);
    sum += weights.of[i];
  }
  return sum;
}

LightTreeSelector::Weights LightTreeSelector::weightsAt(const LightReceiver& at) const {
  Weights weights;
  const double sum = importancesAt(at, learned_.at(at.p), weights);
  double shares = 0;
  for (const Cluster& c : clusters_) shares += leavesOut(c, at) ? 0 : c.share;
  const bool isKnown = sum > 0 && std::isfinite(sum);
  const double byImportance = isKnown ? (1 - kDefensiveShare) / sum : 0;
  const double byPower = (isKnown ? kDefensiveShare : 1) / shares;
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    const Cluster& c = clusters_[i];
    const double power = leavesOut(c, at) ? 0 : byPower * c.share;
    weights.of[i] = isKnown ? byImportance * weights.of[i] + power : power;
  }
  return weights;
}

void LightTreeSelector::note(const LightReceiver& at, std::size_t light, double contribution,
                             LightTrials& trials) const {
  const std::uint32_t cluster = clusterOf_[light];
  const double moment = contribution * contribution * weightsAt(at).of[cluster];
  Weights plain;
  const double sum = importancesAt(at, {}, plain);
  if (!(moment > 0) || !std::isfinite(moment) || !(sum > 0) || !std::isfinite(sum)) return;
  if (!isFinite(at.p)) return;
  for (std::size_t i = 0; i < clusters_.size(); ++i) plain.of[i] /= sum;
  trials.add({at.p, cluster, moment, trials.isOdd()}, std::span(plain.of).first(clusters_.size()));
}

std::vector<double> LightTreeSelector::learn(const LightTrials& trials) const {
  std::vector<double> shares;
  for (const Cluster& c : clusters_) shares.push_back(c.share);
  learned_ = LearnedShares::learn(trials, {shares, kDefensiveShare});
  return learned_.state();
}

bool LightTreeSelector::recall(std::span<const double> learned) const {
  std::optional<LearnedShares> shares = LearnedShares::ofState(learned, clusters_.size());
  if (!shares) return false;
  learned_ = *std::move(shares);
  return true;
}

LightSelector::Choice LightTreeSelector::choose(const LightReceiver& at, float u) const {
  const Weights weights = weightsAt(at);
  double rest = refine(u, at.p);
  std::size_t chosen = 0;
  for (std::size_t i = 0; i < clusters_.size(); ++i) {
    if (!(weights.of[i] > 0)) continue;
    chosen = i;
    if (rest < weights.of[i]) break;
    rest -= weights.of[i];
  }
  const Cluster& c = clusters_[chosen];
  const double probability = weights.of[chosen];
  if (c.light != kNone) return {c.light, static_cast<float>(probability)};
  const double inside = std::clamp(rest / probability, 0.0, 1 - 0x1p-53);
  if (c.node == kNone) {
    const Distribution1D::Choice far = rest_.choose(std::min(static_cast<float>(inside), kOneMinusEpsilon));
    return {restLights_[far.index], static_cast<float>(probability * static_cast<double>(far.probability))};
  }
  const LightTree::Choice near =
      tree_.choose(c.node, inside, [&](const LightTree::Node& node) { return importanceAt(at, node); });
  return {nearLights_[near.source], static_cast<float>(probability * near.probability)};
}

float LightTreeSelector::probability(const LightReceiver& at, std::size_t light) const {
  const std::uint32_t number = clusterOf_[light];
  const Cluster& c = clusters_[number];
  const double cluster = weightsAt(at).of[number];
  if (c.light != kNone) return static_cast<float>(cluster);
  if (c.node == kNone)
    return static_cast<float>(cluster * static_cast<double>(rest_.probability(slotOf_[light])));
  return static_cast<float>(
      cluster * tree_.probability(c.node, slotOf_[light],
                                  [&](const LightTree::Node& node) { return importanceAt(at, node); }));
}

}  // namespace pbrtmedia
