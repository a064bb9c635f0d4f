// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "singlescattering/equiangular_sampling.h"
#include "singlescattering/explored_stretch.h"

namespace pbrtmedia {

/// Distances of EquiangularSampling, a Cauchy distribution about the light, with the transmittance to them by
/// a walk along the explored stretch. Szirmay-Kalos et al. 2017, section 4.3.
struct SourceDrivenSampling {
  static constexpr std::string_view kName = "source-driven";

  MediumLightSamplingTraits traits() const {
    return {.summary =
                "the distances of `equiangular`, and the transmittance to them by a random walk under "
                "a control that neighbouring pixels explore together",
            .source = "Szirmay-Kalos et al. 2017, section 4.3; Kulla & Fajardo 2012",
            .useWhen = "lights are in or near media whose bounds are not known"};
  }

  template <class Visit>
  void sample(const ExploredStretch& stretch, Point2f u, Rng& rng, RenderCounters& counters,
              Visit&& visit) const {
    std::optional<StretchSample> sample = EquiangularSampling().sample(stretch.lit, u);
    if (!sample) return;
    ExploredWalk walk(stretch, stretch.rate, rng, counters);
    sample->walked = {walk.transmittanceTo(sample->t), 1 / sample->pdf, std::nullopt};
    visit(*sample);
  }
};

}  // namespace pbrtmedia
