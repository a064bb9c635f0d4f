// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>

#include "singlescattering/explored_stretch.h"
#include "singlescattering/sampling_traits.h"
#include "singlescattering/stretch_sample.h"

namespace pbrtmedia {

/// At every point where a walk samples the transmittance: the look-up there tells what scatters, too.
/// Szirmay-Kalos et al. 2017, section 4.3. That the transmittance up to a point of a Poisson process is
/// independent of there being one is Slivnyak's theorem.
///
/// Deviation: the rate does not fall to nothing where the main part explains all, as light would be sampled
/// nowhere then.
struct AttenuationDrivenSampling {
  static constexpr std::string_view kName = "attenuation-driven";

  MediumLightSamplingTraits traits() const {
    return {.summary = "at all points where a random walk samples the transmittance of a stretch",
            .source = "Szirmay-Kalos et al. 2017, section 4.3",
            .useWhen = "densities are costly and shadow rays are not",
            .followsLights = false};
  }

  template <class Visit>
  void sample(const ExploredStretch& stretch, Point2f, Rng& rng, RenderCounters& counters,
              Visit&& visit) const {
    const double rate = rateOf(stretch);
    const MediaStretch& media = stretch.lit.media;
    const bool isAlone = media.state().activeCount() == 1;
    ExploredWalk walk(stretch, rate, rng, counters);
    while (const auto step = walk.next()) {
      if (step->there.sigmaS.isBlack()) continue;
      const auto light = stretch.lit.lights.choose(pointOf(media, step->t), rng.uniform());
      const double pdf = rate * light.probability;
      visit(StretchSample{light.light, step->t, pdf,
                          StretchSample::Walked{step->through, 1 / pdf,
                                                isAlone ? std::optional(step->there.sigmaS) : std::nullopt}});
    }
  }

  /// Points per length, 1/length.
  static double rateOf(const ExploredStretch& stretch) {
    return std::max(stretch.rate, kLeastPoints / stretch.mainPart.length());
  }

 private:
  static constexpr double kLeastPoints = 4;  ///< of a stretch, on average
};

}  // namespace pbrtmedia
