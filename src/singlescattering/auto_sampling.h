// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>

#include "singlescattering/lit_stretch.h"
#include "singlescattering/sampling_traits.h"
#include "singlescattering/stretch_sample.h"

namespace pbrtmedia {

/// For each stretch and light either a distance on the stretch or the collision, whichever an estimate from
/// the stretch's mean extinction says is quieter (PositionLights::Stretch).
struct AutoSampling {
  static constexpr std::string_view kName = "auto";

  MediumLightSamplingTraits traits() const {
    return {.summary =
                "for each stretch of a path and each light `equiangular` or `collision`, by an estimate "
                "of their noise",
            .source = "Kulla & Fajardo 2012, section 4.1, for the distances",
            .useWhen = "always"};
  }

  std::optional<StretchSample> sample(const LitStretch& stretch, Point2f u) const {
    return stretch.lights.sample(onlyQuieter(stretch), u.x, u.y);
  }
  double weight(const StretchSample& sample, const CollisionDensity&) const { return 1 / sample.pdf; }
  double collisionShare(const LitStretch& stretch, std::size_t light, double t,
                        const CollisionDensity&) const {
    return stretch.lights.pdf(light, onlyQuieter(stretch), t) > 0 ? 0 : 1;
  }

 private:
  static PositionLights::Stretch onlyQuieter(const LitStretch& s) {
    return {s.media.ray(), s.media.tMin(), s.media.tMax(), s.extinction};
  }
};

}  // namespace pbrtmedia
