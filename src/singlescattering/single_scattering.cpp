// SPDX-License-Identifier: BSD-2-Clause
#include "singlescattering/single_scattering.h"

#include "singlescattering/explore.h"
#include "world/visibility.h"

namespace pbrtmedia {

SingleScattering::SingleScattering(const std::vector<const Light*>& lights, const LightSelector* selector,
                                   const MediumLightSampling& sampling)
    : table_(lights),
      selector_(selector),
      sampling_(sampling),
      lights_(lights),
      onStretches_(!lights_.isEmpty() && traitsOf(sampling).onStretches) {}

std::optional<LitStretch> SingleScattering::lit(const MediaStretch& media) const {
  if (!onStretches_ || !media.state().isExponential()) return std::nullopt;
  const double extinction = media.meanExtinction();
  if (!(extinction > 0)) return std::nullopt;
  return with(media, extinction);
}

Rgb SingleScattering::radiance(const LitStretch& stretch, const StretchSample& sample, const ScatterPoint& at,
                               Rgb throughput, const MediaWalk::Context& shadows, PixelStream random) const {
  const MediaStretch before = stretch.media.upTo(sample.t);
  const Ray& ray = before.ray();
  const LightSample light = table_[sample.light]->sample(at.p, {});
  if (!(light.pdf > 0) || light.radiance.isBlack()) return {};
  const bool isKnown = sample.walked && sample.walked->sigmaS;
  const Rgb scattered =
      isKnown ? *sample.walked->sigmaS * before.state().active(0).medium->phase().evaluate(-ray.d, light.wi)
              : before.scattering(sample.t, -ray.d, light.wi, shadows.counters);
  if (scattered.isBlack()) return {};
  const CollisionDensity collisions(before, *selector_, sample.light, sample.t, at.p);
  const double weight = weightOf(sampling_, sample, collisions);
  const Rgb through = sample.walked ? sample.walked->through : before.transmittance(random, shadows.counters);
  if (through.isBlack()) return {};
  ShadowRay shadow = shadowRayTo(shadows.scene, sample.light, light, at.p, ray.time, {});
  shadow.from = &at;
  MediumState state = before.state();
  return throughput * through * scattered * static_cast<float>(weight) *
         (light.radiance * shadowTransmittance(shadows, shadow, state, random));
}

float SingleScattering::collisionShare(const LitStretch& stretch, std::size_t light, double t,
                                       Point3f p) const {
  if (!lights_.contains(light)) return 1;
  const CollisionDensity collisions(stretch.media, *selector_, light, t, p);
  return static_cast<float>(std::visit(
      [&]<class Sampling>(const Sampling& sampling) -> double {
        if constexpr (ExploringSampling<Sampling>) {
          return isExplorable(stretch.media) ? 0 : 1;
        } else {
          return sampling.collisionShare(stretch, light, t, collisions);
        }
      },
      sampling_));
}

}  // namespace pbrtmedia
