// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "lights/light.h"
#include "singlescattering/explored_stretch.h"
#include "singlescattering/medium_light_sampling.h"
#include "singlescattering/position_lights.h"
#include "world/media_walk.h"
#include "world/scatter_point.h"

namespace pbrtmedia {

/// Light that media scatter once, from lights that shine from one point into the ray of a path: by samples on
/// whole stretches of the ray, which divide the work with the light samples at the path's collisions.
/// Immutable, thread-safe; borrows the lights.
class SingleScattering {
 public:
  /// `selector`: chooses among `lights` at collisions; null where there are none.
  SingleScattering(const std::vector<const Light*>& lights, const LightSelector* selector,
                   const MediumLightSampling& sampling);

  /// The stretch, if samples are to be taken on it. Media of nothing take none: their boundaries leave the
  /// image as it is, bit for bit. Nor do those of another law, whose scattering is not extinction times
  /// transmittance.
  std::optional<LitStretch> lit(const MediaStretch& media) const;

  /// The same where that has been settled: by `lit`, which gave this extinction.
  LitStretch with(const MediaStretch& media, double extinction) const { return {media, lights_, extinction}; }

  /// Tells the samples to be taken on the stretch, one by one. `u` in [0, 1)². `near`: explorers that
  /// neighbours have found on rays like this one, in order of distance; empty: none.
  template <class Visit>
  void sample(const LitStretch& stretch, Point2f u, std::span<const Explorer> near, Rng& rng,
              RenderCounters& counters, Visit&& visit) const {
    std::visit(
        [&]<class Sampling>(const Sampling& sampling) {
          if constexpr (ExploringSampling<Sampling>) {
            if (const auto explored = ExploredStretch::over(stretch, near, counters))
              sampling.sample(*explored, u, rng, counters, visit);
          } else if (const std::optional<StretchSample> sample = sampling.sample(stretch, u)) {
            visit(*sample);
          }
        },
        sampling_);
  }
  /// Whether `sample` makes use of explorers.
  bool explores() const { return onStretches_ && pbrtmedia::explores(sampling_); }
  /// What the sample says of the radiance that arrives at the stretch's start, times `throughput`. `at`: its
  /// point. `shadows`: counts shadow rays.
  Rgb radiance(const LitStretch& stretch, const StretchSample& sample, const ScatterPoint& at, Rgb throughput,
               const MediaWalk::Context& shadows, PixelStream random) const;
  /// Share of the light sample that a collision at `t` takes at its point `p`; samples of the stretch account
  /// for the rest.
  float collisionShare(const LitStretch& stretch, std::size_t light, double t, Point3f p) const;

 private:
  const std::vector<const Light*>& table_;
  const LightSelector* selector_;
  MediumLightSampling sampling_;
  PositionLights lights_;
  bool onStretches_;
};

}  // namespace pbrtmedia
