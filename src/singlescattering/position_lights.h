// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "base/ray.h"
#include "lighting/light_tree.h"
#include "lights/light.h"
#include "singlescattering/equiangular.h"
#include "singlescattering/stretch_sample.h"

namespace pbrtmedia {

/// The lights that shine from one point (point, spot, goniometric, projection), and how a stretch of a ray
/// through media is sampled for them: a light, then a distance with density proportional to 1/r² over the
/// part of the stretch that it may reach. Kulla & Fajardo 2012, doi:10.1111/j.1467-8659.2012.03148.x.
/// Immutable, thread-safe.
class PositionLights {
 public:
  /// Indices of what follows count in `lights`, which are borrowed.
  explicit PositionLights(const std::vector<const Light*>& lights);
  bool isEmpty() const { return lights_.empty(); }
  bool contains(std::size_t light) const { return light < slots_.size() && slots_[light] != kNoSlot; }

  /// A stretch of a ray through media.
  struct Stretch {
    const Ray& ray;
    double tMin, tMax;
    /// Mean extinction, to leave out the lights that collisions would sample with less noise. Nothing: every
    /// light is sampled.
    std::optional<double> extinction = std::nullopt;
  };
  /// Nothing when no light reaches the stretch. `u`, `v` in [0, 1).
  std::optional<StretchSample> sample(const Stretch& stretch, float u, float v) const;
  /// Density of `sample` at one of these lights and a distance.
  double pdf(std::size_t light, const Stretch& stretch, double t) const;

  struct Choice {
    std::size_t light;
    double probability;
  };
  /// A light for a point, by power over the square of the distance, and where they are many also by where
  /// they shine. There is a light. `u` in [0, 1).
  Choice choose(Point3f p, float u) const;
  /// That `choose` answers with this one of its lights.
  double probability(Point3f p, std::size_t light) const;
  /// What one of these lights sends to a point, shadows left out.
  LightSample sampleAt(std::size_t light, Point3f p) const {
    return lights_[slots_[light]].source->sample(p, {});
  }

 private:
  static constexpr std::uint32_t kNoSlot = 0xffffffffu;
  /// Up to here each light is looked at on every stretch; of more, one is chosen by walking down a tree.
  static constexpr std::size_t kMostWeighed = 16;

  struct Entry {
    std::size_t light;
    const Light* source;
    Vec3d position;
    double power;
  };
  static std::optional<Equiangular> over(const Entry& e, const Stretch& stretch);
  /// How much a light is chosen for a point, up to a common factor.
  static double strengthAt(const Entry& e, Point3f p);
  bool weighsEach() const { return lights_.size() <= kMostWeighed; }

  std::vector<Entry> lights_;
  std::vector<std::uint32_t> slots_;  ///< of each light of the table
  LightTree tree_;                    ///< of more than kMostWeighed
};

}  // namespace pbrtmedia
