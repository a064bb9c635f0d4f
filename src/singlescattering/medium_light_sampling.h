// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/variant_names.h"
#include "singlescattering/attenuation_driven_sampling.h"
#include "singlescattering/attenuation_driven_sir_sampling.h"
#include "singlescattering/auto_sampling.h"
#include "singlescattering/collision_sampling.h"
#include "singlescattering/equiangular_sampling.h"
#include "singlescattering/mis_sampling.h"
#include "singlescattering/scattering_driven_sampling.h"
#include "singlescattering/source_driven_sampling.h"
#include "singlescattering/source_scattering_mis_sampling.h"

namespace pbrtmedia {

/// The one list of ways to choose which points of a medium take light samples of lights that shine from one
/// point, `"string mediumlightsampling"`. A new one is its header and one word here. The first is the
/// default.
///
/// Each is a small immutable value: kName, traits(), and
///   std::optional<StretchSample> sample(const LitStretch& stretch, Point2f u) const;
///   double weight(const StretchSample& sample, const CollisionDensity& collisions) const;
///   double collisionShare(const LitStretch& stretch, std::size_t light, double t,
///                         const CollisionDensity& collisions) const;
/// A sample of a stretch counts `weight`, its share divided by its density; the light sample of a collision
/// at `t` counts `collisionShare` of itself. Where light arrives, the shares of both must sum to one.
///
/// Those that explore a stretch have instead of the three
///   void sample(const ExploredStretch& stretch, Point2f u, Rng& rng, RenderCounters& counters,
///               visit(const StretchSample&)) const;
/// which tells all samples of the stretch, StretchSample::walked included: any number, in any order. They
/// leave nothing to collisions, but all on stretches without an end.
using MediumLightSampling =
    std::variant<AutoSampling, CollisionSampling, EquiangularSampling, MisSampling, AttenuationDrivenSampling,
                 AttenuationDrivenSirSampling, SourceDrivenSampling, ScatteringDrivenSampling,
                 SourceScatteringMisSampling>;

/// Of those that explore.
template <class Sampling>
concept ExploringSampling = !requires(const Sampling& s, const LitStretch& stretch) {
  s.sample(stretch, {});
};

inline bool explores(const MediumLightSampling& sampling) {
  return std::visit([]<class Held>(const Held&) { return ExploringSampling<Held>; }, sampling);
}

inline MediumLightSamplingTraits traitsOf(const MediumLightSampling& sampling) {
  return std::visit([](const auto& held) { return held.traits(); }, sampling);
}

/// What a sample of a stretch counts: its share divided by its density.
inline double weightOf(const MediumLightSampling& sampling, const StretchSample& sample,
                       const CollisionDensity& collisions) {
  return std::visit(
      [&]<class Sampling>(const Sampling& held) {
        if constexpr (ExploringSampling<Sampling>) {
          return sample.walked->weight;
        } else {
          return held.weight(sample, collisions);
        }
      },
      sampling);
}

}  // namespace pbrtmedia
