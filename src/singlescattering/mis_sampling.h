// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "singlescattering/equiangular_sampling.h"

namespace pbrtmedia {

/// Distances of EquiangularSampling and collisions, by the balance heuristic (Veach & Guibas 1995). The
/// density of null-collision flights is not known; the control that takes its place is a function of the
/// position, so that the weights of both still sum to one.
struct MisSampling {
  static constexpr std::string_view kName = "mis";

  MediumLightSamplingTraits traits() const {
    return {.summary = "both `equiangular` and `collision`, combined by the balance heuristic",
            .source = "Kulla & Fajardo 2012, section 4.1; Veach & Guibas 1995",
            .useWhen = "one stretch has thin parts near a light and dense ones far from it"};
  }

  std::optional<StretchSample> sample(const LitStretch& stretch, Point2f u) const {
    return EquiangularSampling().sample(stretch, u);
  }
  double weight(const StretchSample& sample, const CollisionDensity& collisions) const {
    return 1 / (sample.pdf + collisions());
  }
  double collisionShare(const LitStretch& stretch, std::size_t light, double t,
                        const CollisionDensity& collisions) const {
    const double onStretch = stretch.lights.pdf(light, EquiangularSampling::wholeOf(stretch), t);
    if (!(onStretch > 0)) return 1;
    const double collision = collisions();
    return collision / (collision + onStretch);
  }
};

}  // namespace pbrtmedia
