// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/position_lights.h"

#include <array>
#include <bit>
#include <cmath>

#include "base/hash.h"
#include "lighting/light_importance.h"
#include "lighting/light_selector.h"

namespace pbrtmedia {
namespace {

constexpr double kLeastSolidAngle = 1e-3;  // sr: of spot lights that are hardly open

/// Whether distances of density p proportional to 1/r² give less noise than collisions in a medium of this
/// extinction sigma. The second moments of the two estimates of the integral of sigma T / r² are as
/// sigma² T² / (p r⁴) to sigma T / r⁴, integrated, and with distances t drawn from p itself as the sums of
/// sigma T² and T p. A distance always costs a shadow ray, a collision only when there is one.
bool isQuieter(const Equiangular& distances, double tMin, double sigma) {
  constexpr int kPoints = 8;
  constexpr double kCost = 1.5;
  double stretch = 0, collisions = 0;
  distances.forEven(kPoints, [&](double t) {
    const double transmittance = std::exp(-sigma * (t - tMin));
    stretch += sigma * transmittance * transmittance;
    collisions += transmittance * distances.pdf(t);
  });
  return kCost * stretch < collisions;
}

auto importanceOn(const PositionLights::Stretch& stretch) {
  return [o = Vec3d(stretch.ray.o), d = Vec3d(stretch.ray.d), &stretch](const LightTree::Node& node) {
    return importanceAlong(o, d, stretch.tMin, stretch.tMax, node);
  };
}

auto importanceFor(Point3f p) {
  return [at = LightReceiver(p)](const LightTree::Node& node) { return importanceAt(at, node); };
}

/// `u` with more digits, which a long way down a tree needs; they follow from both numbers.
double refine(float u, float v) {
  const std::uint64_t hash = hashCombine(std::bit_cast<std::uint32_t>(u), std::bit_cast<std::uint32_t>(v));
  return static_cast<double>(u) + static_cast<double>(hash >> 40) * 0x1p-48;
}

}  // namespace

PositionLights::PositionLights(const std::vector<const Light*>& lights) : slots_(lights.size(), kNoSlot) {
  double sum = 0;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const std::optional<Point3f> position = lights[i]->deltaPosition();
    if (!position) continue;
    slots_[i] = static_cast<std::uint32_t>(lights_.size());
    const double power = lights[i]->power().luminance();
    lights_.push_back({i, lights[i], Vec3d(*position), std::isfinite(power) && power > 0 ? power : 0});
    sum += lights_.back().power;
  }
  if (lights_.empty()) return;
  const double average = sum > 0 ? sum / static_cast<double>(lights_.size()) : 1;
  for (Entry& e : lights_) e.power = std::max(e.power / average, kSmallestShare);
  if (weighsEach()) return;
  std::vector<LightTree::Source> sources;
  for (const Entry& e : lights_) {
    const LightExtent extent = e.source->extent().value_or(LightExtent{});
    LightExtent here = extent;
    here.bounds = {Point3f(e.position), Point3f(e.position)};
    sources.push_back({here, e.power / std::max(static_cast<double>(extent.solidAngle), kLeastSolidAngle)});
  }
  tree_ = LightTree(sources);
}

std::optional<Equiangular> PositionLights::over(const Entry& e, const Stretch& stretch) {
  const Vec3d o(stretch.ray.o), d(stretch.ray.d);
  double tMin = stretch.tMin, tMax = stretch.tMax;
  e.source->clipToLit(o, d, tMin, tMax);
  std::optional<Equiangular> distances = Equiangular::over(o, d, tMin, tMax, e.position);
  if (distances && stretch.extinction && !isQuieter(*distances, stretch.tMin, *stretch.extinction)) return {};
  return distances;
}

std::optional<StretchSample> PositionLights::sample(const Stretch& stretch, float u, float v) const {
  if (lights_.empty()) return std::nullopt;
  const auto at = [&](const Entry& e, const Equiangular& distances,
                      double probability) -> std::optional<StretchSample> {
    const double t = distances.sample(double{v});
    const double pdf = probability * distances.pdf(t);
    if (!(pdf > 0) || !std::isfinite(pdf)) return std::nullopt;
    return StretchSample{e.light, t, pdf};
  };
  if (!weighsEach()) {
    const LightTree::Choice c = tree_.choose(0, refine(u, v), importanceOn(stretch));
    const Entry& e = lights_[c.source];
    const std::optional<Equiangular> distances = over(e, stretch);
    return distances ? at(e, *distances, c.probability) : std::nullopt;
  }
  if (lights_.size() == 1) {
    const std::optional<Equiangular> only = over(lights_[0], stretch);
    const bool isLit = only && lights_[0].power * only->strength() > 0;
    return isLit ? at(lights_[0], *only, 1) : std::nullopt;
  }
  std::array<std::optional<Equiangular>, kMostWeighed> distances;
  std::array<double, kMostWeighed> weights{};
  double sum = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    distances[i] = over(lights_[i], stretch);
    if (distances[i]) sum += weights[i] = lights_[i].power * distances[i]->strength();
  }
  if (!(sum > 0)) return std::nullopt;
  double rest = double{u} * sum;
  std::size_t last = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    if (!(weights[i] > 0)) continue;
    last = i;
    if (rest < weights[i]) break;
    rest -= weights[i];
  }
  return at(lights_[last], *distances[last], weights[last] / sum);
}

double PositionLights::pdf(std::size_t light, const Stretch& stretch, double t) const {
  const std::size_t slot = slots_[light];
  const std::optional<Equiangular> own = over(lights_[slot], stretch);
  if (!own) return 0;
  const double atDistance = own->pdf(t);
  if (!(atDistance > 0) || lights_.size() == 1) return atDistance;
  if (!weighsEach()) return tree_.probability(0, slot, importanceOn(stretch)) * atDistance;
  double sum = 0;
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const std::optional<Equiangular> distances = i == slot ? own : over(lights_[i], stretch);
    if (distances) sum += lights_[i].power * distances->strength();
  }
  return sum > 0 ? lights_[slot].power * own->strength() / sum * atDistance : 0;
}

double PositionLights::strengthAt(const Entry& e, Point3f p) {
  // A point on the light itself is so near that floats cannot tell how near.
  constexpr double kTiny = 1e-60;
  return e.power / std::max(lengthSquared(Vec3d(p) - e.position), kTiny);
}

PositionLights::Choice PositionLights::choose(Point3f p, float u) const {
  if (lights_.size() == 1) return {lights_[0].light, 1};
  if (!weighsEach()) {
    const LightTree::Choice c = tree_.choose(0, refine(u, p.x), importanceFor(p));
    return {lights_[c.source].light, c.probability};
  }
  double sum = 0;
  for (const Entry& e : lights_) sum += strengthAt(e, p);
  double rest = double{u} * sum;
  std::size_t chosen = 0;
  for (; chosen + 1 < lights_.size(); ++chosen) {
    const double strength = strengthAt(lights_[chosen], p);
    if (rest < strength) break;
    rest -= strength;
  }
  return {lights_[chosen].light, strengthAt(lights_[chosen], p) / sum};
}

double PositionLights::probability(Point3f p, std::size_t light) const {
  if (lights_.size() == 1) return 1;
  const std::size_t slot = slots_[light];
  if (!weighsEach()) return tree_.probability(0, slot, importanceFor(p));
  double sum = 0;
  for (const Entry& e : lights_) sum += strengthAt(e, p);
  return strengthAt(lights_[slot], p) / sum;
}

}  // namespace pbrtmedia
