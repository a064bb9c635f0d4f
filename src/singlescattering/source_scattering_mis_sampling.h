// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "singlescattering/equiangular_sampling.h"
#include "singlescattering/explored_stretch.h"
#include "singlescattering/scattering_distances.h"

namespace pbrtmedia {

/// A distance of SourceDrivenSampling and one of ScatteringDrivenSampling, by the balance heuristic (Veach &
/// Guibas 1995), both densities being known; one walk tells the transmittance to both. Szirmay-Kalos et al.
/// 2017, section 4.3.
struct SourceScatteringMisSampling {
  static constexpr std::string_view kName = "source-scattering-mis";

  MediumLightSamplingTraits traits() const {
    return {.summary =
                "on every stretch a distance of `source-driven` and one of `scattering-driven`, weighted "
                "by the balance heuristic, with one random walk for both",
            .source = "Szirmay-Kalos et al. 2017, section 4.3; Veach & Guibas 1995",
            .useWhen =
                "one stretch has dense parts far from a light and thin ones near it, and bounds are not "
                "known"};
  }

  template <class Visit>
  void sample(const ExploredStretch& stretch, Point2f u, Rng& rng, RenderCounters& counters,
              Visit&& visit) const {
    const MediaStretch& media = stretch.lit.media;
    const PositionLights& lights = stretch.lit.lights;
    const ScatteringDistances distances(stretch.mainPart);
    std::array<StretchSample, 2> samples;
    std::size_t count = 0;
    if (const auto source = EquiangularSampling().sample(stretch.lit, u)) {
      const double other =
          distances.pdf(source->t) * lights.probability(pointOf(media, source->t), source->light);
      samples[count++] = {source->light, source->t, source->pdf + other};
    }
    {
      const double t = distances.sample(rng.uniformDouble());
      const auto light = lights.choose(pointOf(media, t), rng.uniform());
      const double own = distances.pdf(t) * light.probability;
      samples[count++] = {light.light, t,
                          own + lights.pdf(light.light, EquiangularSampling::wholeOf(stretch.lit), t)};
    }
    if (count == 2 && samples[1].t < samples[0].t) std::swap(samples[0], samples[1]);
    ExploredWalk walk(stretch, stretch.rate, rng, counters);
    for (std::size_t i = 0; i < count; ++i) {
      samples[i].walked = {walk.transmittanceTo(samples[i].t), 1 / samples[i].pdf, std::nullopt};
      visit(samples[i]);
    }
  }
};

}  // namespace pbrtmedia
