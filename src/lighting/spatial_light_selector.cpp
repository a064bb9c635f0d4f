// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/spatial_light_selector.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>

#include "base/built_parts.h"
#include "base/math.h"

namespace pbrtmedia {
namespace {

constexpr int kLongestAxis = 64;  // voxels, as the scene language has it
constexpr std::size_t kMostProbes = 128, kFewestProbes = 8;
/// Light samples for one voxel beyond which probes are saved; some 10 ms on one thread.
constexpr std::size_t kSamplesPerVoxel = std::size_t{1} << 17;
/// Light samples for filling the whole grid: minutes on one thread if every voxel is ever asked for.
constexpr std::size_t kSamplesInAll = std::size_t{1} << 31;
/// Table entries of the whole grid, 12 bytes each: 200 MB if every voxel is ever asked for.
constexpr std::size_t kEntriesInAll = std::size_t{1} << 24;

/// The digits of `index` in `base`, mirrored at the point (van der Corput), in [0, 1).
float radicalInverse(unsigned base, std::size_t index) {
  double value = 0, digit = 1.0 / base;
  for (; index > 0; index /= base, digit /= base) value += digit * static_cast<double>(index % base);
  return std::min(static_cast<float>(value), kOneMinusEpsilon);
}

std::size_t probeCount(std::size_t lights) {
  return std::clamp(kSamplesPerVoxel / lights, kFewestProbes, kMostProbes);
}

std::size_t count(Point3i r) {
  return static_cast<std::size_t>(r.x) * static_cast<std::size_t>(r.y) * static_cast<std::size_t>(r.z);
}

Point3i gridOf(Vector3f diagonal, int longest) {
  const float scale = static_cast<float>(longest) / maxComponent(diagonal);
  const auto along = [&](float extent) {
    return extent > 0 ? std::clamp(static_cast<int>(std::lround(extent * scale)), 1, longest) : 1;
  };
  return {along(diagonal.x), along(diagonal.y), along(diagonal.z)};
}

Point3i chooseResolution(Vector3f diagonal, std::size_t lights) {
  const std::size_t most = std::min(kSamplesInAll / (lights * probeCount(lights)), kEntriesInAll / lights);
  int longest = kLongestAxis;
  while (longest > 1 && count(gridOf(diagonal, longest)) > most) --longest;
  return gridOf(diagonal, longest);
}

}  // namespace

SpatialLightSelector::SpatialLightSelector(std::span<const Illuminant* const> lights,
                                           const Bounds3f& sceneBounds)
    : lights_(lights.begin(), lights.end()), bounds_(sceneBounds) {
  CHECK(!lights_.empty()) << "a selector needs a light to select";
  CHECK(!bounds_.isEmpty()) << "there is no grid over nothing";
  const Vector3f diagonal = bounds_.diagonal();
  resolution_ = chooseResolution(diagonal, lights_.size());
  const auto perLength = [](int voxels, float extent) {
    return extent > 0 ? static_cast<float>(voxels) / extent : 0.0f;
  };
  voxelsPerLength_ = {perLength(resolution_.x, diagonal.x), perLength(resolution_.y, diagonal.y),
                      perLength(resolution_.z, diagonal.z)};
  voxelCount_ = count(resolution_);
  countBuilt(Part::LightDistributions);
  tables_ = std::make_unique<std::atomic<const Distribution1D*>[]>(voxelCount_);
  for (std::size_t i = 1; i <= probeCount(lights_.size()); ++i) {
    probes_.push_back({{radicalInverse(2, i), radicalInverse(3, i), radicalInverse(5, i)},
                       {radicalInverse(7, i), radicalInverse(11, i)}});
  }
}

SpatialLightSelector::~SpatialLightSelector() {
  for (std::size_t i = 0; i < voxelCount_; ++i) delete tables_[i].load(std::memory_order_relaxed);
}

std::unique_ptr<const Distribution1D> SpatialLightSelector::fill(Point3i voxel) const {
  const Vector3f diagonal = bounds_.diagonal();
  const auto place = [&](std::size_t axis, int index, float inside) {
    return bounds_.min[axis] +
           diagonal[axis] * ((static_cast<float>(index) + inside) / static_cast<float>(resolution_[axis]));
  };
  std::vector<double> arriving(lights_.size(), 0.0);
  for (const Probe& probe : probes_) {
    const Point3f p{place(0, voxel.x, probe.position.x), place(1, voxel.y, probe.position.y),
                    place(2, voxel.z, probe.position.z)};
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      const double luminance = lights_[i]->arrivingLuminance(p, probe.light);
      if (luminance > 0 && std::isfinite(luminance)) arriving[i] += luminance;
    }
  }
  double sum = 0;
  for (const double a : arriving) sum += a;
  const double average = sum / static_cast<double>(lights_.size());
  // Relative to the average, so that the weights fit a float for lights of any strength.
  std::vector<float> weights(lights_.size(), 1.0f);
  if (average > 0) {
    for (std::size_t i = 0; i < weights.size(); ++i) {
      weights[i] = static_cast<float>(std::max(arriving[i] / average, kSmallestShare));
    }
  }
  return std::make_unique<const Distribution1D>(weights);
}

const Distribution1D& SpatialLightSelector::tableAt(Point3f p) const {
  const auto along = [&](std::size_t axis) {
    const float x = (p[axis] - bounds_.min[axis]) * voxelsPerLength_[axis];
    if (!(x > 0)) return 0;  // also NaN
    const int last = resolution_[axis] - 1;
    return x < static_cast<float>(last) ? static_cast<int>(x) : last;
  };
  const Point3i voxel{along(0), along(1), along(2)};
  const std::size_t index = (static_cast<std::size_t>(voxel.z) * static_cast<std::size_t>(resolution_.y) +
                             static_cast<std::size_t>(voxel.y)) *
                                static_cast<std::size_t>(resolution_.x) +
                            static_cast<std::size_t>(voxel.x);
  std::atomic<const Distribution1D*>& slot = tables_[index];
  const Distribution1D* table = slot.load(std::memory_order_acquire);
  if (table) return *table;
  std::unique_ptr<const Distribution1D> mine = fill(voxel);
  if (slot.compare_exchange_strong(table, mine.get(), std::memory_order_acq_rel, std::memory_order_acquire)) {
    return *mine.release();
  }
  return *table;  // another thread was first: the same contents
}

LightSelector::Choice SpatialLightSelector::choose(const LightReceiver& at, float u) const {
  const Distribution1D::Choice c = tableAt(at.p).choose(u);
  return {c.index, c.probability};
}

float SpatialLightSelector::probability(const LightReceiver& at, std::size_t light) const {
  return tableAt(at.p).probability(light);
}

std::size_t SpatialLightSelector::filledVoxels() const {
  std::size_t filled = 0;
  for (std::size_t i = 0; i < voxelCount_; ++i)
    filled += tables_[i].load(std::memory_order_acquire) != nullptr;
  return filled;
}

}  // namespace pbrtmedia
