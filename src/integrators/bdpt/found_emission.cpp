// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/found_emission.h"

#include <algorithm>
#include <optional>

#include "world/media_stretch.h"
#include "world/medium_light.h"

namespace pbrtmedia {

Contribution& FoundEmission::here() {
  const std::size_t scatterings = path_.scatterings();
  if (found_.size() <= scatterings) found_.resize(scatterings + 1);
  return found_[scatterings];
}

/// Other strategies find what is where their light samples look.
void FoundEmission::addMedia(const MediaStretch& stretch, const MediumState& state) {
  for (std::size_t i = 0; i < state.activeCount(); ++i) {
    const PlacedMedium m = state.active(i);
    if (!m.medium->isEmissive()) continue;
    const EmissionSamples found = stretch.sampleEmission(i, context_.stream(), context_.counters);
    if (found.count == 0) continue;
    const auto number = path_.vertices.empty() ? std::nullopt : setup_.scene.lightOf(m);
    const MediumLight* const light = number ? setup_.scene.mediumLight(*number) : nullptr;
    const auto span = light ? light->span(way_.ray.o, way_.ray.d, way_.ray.time) : std::nullopt;
    LightPoint point;
    if (span) {
      point = {.index = *number,
               .medium = light,
               .d = way_.ray.d,
               .directionDensity = light->directionPdf(way_.ray.o, way_.ray.d, way_.ray.time)};
    }
    for (const EmissionSamples::Sample& e : found) {
      double weight = 1;
      if (span && e.t >= span->tMin && e.t <= span->tMax) {
        point.p = Point3f(Vec3d(way_.ray.o) + e.t * Vec3d(way_.ray.d));
        weight = weightOf(point, way_.depth + stretch.upTo(e.t).control().depth);
      }
      here().add(way_.beta * e.radiance, weight);
    }
  }
}

/// An emitter without material illuminates by its side that is met first. Directly seen are all.
void FoundEmission::addHit(const SceneHit& hit, const SurfaceInteraction& si) {
  bool isHidden = false;
  if (hit.light != SceneHit::kNoLight && !hit.primitive->material) {
    isHidden = std::ranges::find(passedEmitters_, hit.hit.id.geometry) != passedEmitters_.end();
    if (!isHidden) passedEmitters_.push_back(hit.hit.id.geometry);
  }
  const Rgb emitted = hit.areaLight().emitted(si.n, si.wo);
  if (emitted.isBlack()) return;
  double weight = 1;
  if (isHidden || hit.light == SceneHit::kNoLight) {
    weight = isDirect() ? 1 : 0;
  } else if (!path_.vertices.empty()) {
    weight = weightOf({.index = hit.light,
                       .light = setup_.scene.lights()[hit.light],
                       .p = si.p,
                       .n = si.n,
                       .d = way_.ray.d,
                       .isArea = true},
                      way_.depth);
  }
  here().add(way_.beta * emitted, weight);
}

void FoundEmission::addBackground() {
  for (const std::uint32_t index : setup_.scene.infiniteLights()) {
    const Light* const light = setup_.scene.lights()[index];
    const Rgb background = light->background(way_.ray.d);
    if (background.isBlack()) continue;
    const double weight =
        path_.vertices.empty() ? 1 : weightOf({.index = index, .light = light, .d = way_.ray.d}, way_.depth);
    here().add(way_.beta * background, weight);
  }
}

double FoundEmission::weightOf(const LightPoint& light, Rgb depth) const {
  const StrategyWeights& weights = setup_.weights;
  const PathVertex& last = path_.vertices.back();
  if (light.isSplit()) {
    if (last.isSpecular) return 1;
    const float pdf = weights.lookedDirection(light, last.p);
    return double{powerHeuristic(static_cast<float>(way_.pdfDirection), pdf)};
  }
  const double found = StrategyWeights::arrival(way_.pdfDirection, last.p, light, depth);
  double others = last.isSpecular ? 0 : squaredRatio(weights.looked(light, last.p), found);
  const std::size_t count = path_.vertices.size();
  const double taken = squaredRatio(weights.emitted(light, last.p, way_.ray.time), found) *
                       squaredRatio(weights.departure(light, last, depth, way_.ray.time), last.pdf);
  if (taken > 0) {
    if (count == 1) {
      others += taken * (last.isSpecular ? 0 : path_.firstOthers);
    } else {
      const PathVertex& before = path_.vertices[count - 2];
      others += taken * ((last.isSpecular || before.isSpecular ? 0 : 1) + before.others);
    }
  }
  return 1 / (1 + others);
}

}  // namespace pbrtmedia
