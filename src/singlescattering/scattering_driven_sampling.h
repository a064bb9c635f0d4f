// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "singlescattering/explored_stretch.h"
#include "singlescattering/sampling_traits.h"
#include "singlescattering/scattering_distances.h"
#include "singlescattering/stretch_sample.h"

namespace pbrtmedia {

/// Distances by the extinction and transmittance of the main part, which can be inverted, with the
/// transmittance to them by a walk. Szirmay-Kalos et al. 2017, section 4.3.
struct ScatteringDrivenSampling {
  static constexpr std::string_view kName = "scattering-driven";

  MediumLightSamplingTraits traits() const {
    return {.summary =
                "on every stretch a distance by extinction times transmittance of a control that "
                "neighbouring pixels explore together",
            .source = "Szirmay-Kalos et al. 2017, section 4.3",
            .useWhen = "lights are far from a medium that is seen as a whole",
            .followsLights = false};
  }

  template <class Visit>
  void sample(const ExploredStretch& stretch, Point2f u, Rng& rng, RenderCounters& counters,
              Visit&& visit) const {
    const ScatteringDistances distances(stretch.mainPart);
    const double t = distances.sample(double{u.y});
    const auto light = stretch.lit.lights.choose(pointOf(stretch.lit.media, t), u.x);
    const double pdf = distances.pdf(t) * light.probability;
    ExploredWalk walk(stretch, stretch.rate, rng, counters);
    visit(StretchSample{light.light, t, pdf,
                        StretchSample::Walked{walk.transmittanceTo(t), 1 / pdf, std::nullopt}});
  }
};

}  // namespace pbrtmedia
