// SPDX-License-Identifier: BSD-2-Clause
#include "media/phase/phase_mixture.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/diagnostics.h"
#include "base/math.h"

namespace pbrtmedia {

PhaseMixture::PhaseMixture(std::vector<Lobe> lobes) : lobes_(std::move(lobes)) {
  double sum = 0;
  for (const Lobe& lobe : lobes_) {
    if (!(lobe.weight >= 0)) throw SceneError(SourceLocation{}, "a phase function's weight must be >= 0");
    sum += lobe.weight;
  }
  if (!(sum > 0) || !std::isfinite(sum)) {
    throw SceneError(SourceLocation{}, "the weights of the phase functions must have a positive, finite sum");
  }
  for (Lobe& lobe : lobes_) lobe.weight /= sum;
}

float PhaseMixture::evaluate(Vector3f wo, Vector3f wi) const {
  double sum = 0;
  for (const Lobe& lobe : lobes_) {
    if (lobe.weight > 0) sum += lobe.weight * static_cast<double>(lobe.function->evaluate(wo, wi));
  }
  return static_cast<float>(sum);
}

PhaseFunction::Sample PhaseMixture::sample(Vector3f wo, Point2f u) const {
  // The lobe takes the leading part of u.x; what is left of it is uniform again.
  double rest = u.x;
  const Lobe* chosen = nullptr;
  for (const Lobe& lobe : lobes_) {
    if (!(lobe.weight > 0)) continue;
    if (chosen != nullptr) rest -= chosen->weight;
    chosen = &lobe;
    if (rest < lobe.weight) break;
  }
  const float within = std::clamp(static_cast<float>(rest / chosen->weight), 0.0f, kOneMinusEpsilon);
  const Vector3f wi = chosen->function->sample(wo, {within, u.y}).wi;
  return {wi, evaluate(wo, wi)};
}

}  // namespace pbrtmedia
