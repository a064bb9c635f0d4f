// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "singlescattering/attenuation_driven_sampling.h"

namespace pbrtmedia {

/// One of the points of AttenuationDrivenSampling, chosen by what each would scatter were there no shadow:
/// sampling importance resampling (Talbot, Cline & Egbert 2005; Szirmay-Kalos et al. 2017, section 4.3).
struct AttenuationDrivenSirSampling {
  static constexpr std::string_view kName = "attenuation-driven-sir";

  MediumLightSamplingTraits traits() const {
    return {.summary =
                "at one of the points of `attenuation-driven`, chosen by what each would scatter were "
                "there no shadow",
            .source = "Szirmay-Kalos et al. 2017, section 4.3; Talbot, Cline & Egbert 2005",
            .useWhen = "as `attenuation-driven`, but shadow rays are costly, too",
            .followsLights = false};
  }

  template <class Visit>
  void sample(const ExploredStretch& stretch, Point2f u, Rng& rng, RenderCounters& counters,
              Visit&& visit) const {
    const MediaStretch& media = stretch.lit.media;
    double sum = 0, chosenSize = 0;
    std::optional<StretchSample> chosen;
    AttenuationDrivenSampling().sample(stretch, u, rng, counters, [&](const StretchSample& candidate) {
      const double size = sizeOf(stretch, media, candidate);
      if (!(size > 0)) return;
      sum += size;
      if (rng.uniformDouble() * sum >= size) return;
      chosen = candidate;
      chosenSize = size;
    });
    if (!chosen) return;
    chosen->walked->weight *= sum / chosenSize;
    visit(*chosen);
  }

 private:
  /// What a candidate would count without a shadow. Where media overlap, all scatter as one without a
  /// preferred direction here.
  static double sizeOf(const ExploredStretch& stretch, const MediaStretch& media, const StretchSample& s) {
    const LightSample light = stretch.lit.lights.sampleAt(s.light, pointOf(media, s.t));
    if (!(light.pdf > 0)) return 0;
    Rgb value = s.walked->through * light.radiance;
    if (s.walked->sigmaS)
      value *= *s.walked->sigmaS * media.state().active(0).medium->phase().evaluate(-media.ray().d, light.wi);
    double size = 0;
    for (std::size_t c = 0; c < 3; ++c) size += std::abs(double{value[c]});
    return std::isfinite(size) ? size * s.walked->weight : 0;
  }
};

}  // namespace pbrtmedia
