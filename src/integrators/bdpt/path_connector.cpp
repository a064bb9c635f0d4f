// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/path_connector.h"

#include <cmath>

#include "base/warp.h"
#include "cameras/camera.h"
#include "world/medium_light.h"
#include "world/visibility.h"

namespace pbrtmedia {
namespace {

/// Density from the other end of the vertex (or light's point) before number `i`, when vertex `i` is
/// connected along unit `d`.
double pdfBefore(const Subpath& path, std::size_t i, Vector3f d) {
  const PathVertex& vertex = path.vertices[i];
  const double pdf{vertex.directionPdf(d, vertex.wo)};
  if (i > 0) return StrategyWeights::arrival(pdf, vertex.p, path.vertices[i - 1], vertex.depth);
  return path.fromLight ? StrategyWeights::arrival(pdf, vertex.p, path.light, vertex.depth) : 0;
}

}  // namespace

Contribution PathConnector::connect(const Subpath& camera, std::size_t j, const Subpath& light,
                                    std::size_t i) {
  const PathVertex& z = camera.vertices[j];
  const PathVertex& y = light.vertices[i];
  const Vec3d apart = Vec3d(y.p) - Vec3d(z.p);
  const double squared = lengthSquared(apart), distance = std::sqrt(squared);
  if (!(distance > 0)) return {};
  const Vector3f d(apart / distance);
  Rgb value = z.beta * z.scatter(d);
  if (value.isBlack()) return {};
  value *= y.beta * y.scatter(-d);
  if (value.isBlack()) return {};
  const WayThrough way =
      wayThrough(setup_, z, {.d = d, .length = static_cast<float>(distance), .end = &y}, time_, context_);
  if (way.transmittance.isBlack()) return {};
  const StrategyWeights& weights = setup_.weights;
  const double fromLight = StrategyWeights::arrival(double{y.directionPdf(y.wo, -d)}, y.p, z, way.depth);
  const double fromCamera = StrategyWeights::arrival(double{z.directionPdf(z.wo, d)}, z.p, y, way.depth);
  const double others = weights.othersOf(camera, j, {fromLight, pdfBefore(camera, j, d)}) +
                        weights.othersOf(light, i, {fromCamera, pdfBefore(light, i, -d)});
  Contribution made;
  made.add(value * way.transmittance * static_cast<float>(1 / squared), 1 / (1 + others));
  return made;
}

double PathConnector::weightOf(const Subpath& camera, std::size_t j, const LightPoint& light, Rgb depth,
                               double looked, double directionPdf) const {
  const StrategyWeights& weights = setup_.weights;
  const PathVertex& z = camera.vertices[j];
  double others = 0;
  if (!light.isDelta())
    others += squaredRatio(StrategyWeights::arrival(directionPdf, z.p, light, depth), looked);
  const double started = squaredRatio(weights.emitted(light, z.p, time_), looked);
  if (started > 0) {
    others +=
        started * weights.othersOf(
                      camera, j, {weights.departure(light, z, depth, time_), pdfBefore(camera, j, light.d)});
  }
  return 1 / (1 + others);
}

Contribution PathConnector::lookForLight(const Subpath& camera, std::size_t j, float uLight, Point2f u) {
  if (!setup_.selector) return {};
  const PathVertex& z = camera.vertices[j];
  const LightSelector::Choice choice = setup_.selector->choose(z.p, uLight);
  if (setup_.scene.mediumLight(choice.light)) return lookForMedium(camera, j, choice, u);
  const Light& light = *setup_.scene.lights()[choice.light];
  const LightSample s = light.sample(z.p, u);
  if (!(s.pdf > 0) || s.radiance.isBlack()) return {};
  const Rgb value = z.beta * z.scatter(s.wi) * s.radiance * (1 / (s.pdf * choice.probability));
  if (value.isBlack()) return {};
  const PrimitiveId target = setup_.scene.lightTarget(choice.light);
  const WayThrough way = wayThrough(
      setup_, z,
      {.d = s.wi, .length = s.distance, .target = target, .hider = setup_.scene.hiderOf(choice.light)}, time_,
      context_);
  if (way.transmittance.isBlack()) return {};
  Contribution made;
  const float directionPdf = z.directionPdf(z.wo, s.wi);
  if (light.isSplit()) {
    made.add(value * way.transmittance, double{powerHeuristic(s.pdf, directionPdf)});
    return made;
  }
  LightPoint point{.index = choice.light, .light = &light, .n = s.n, .d = s.wi, .isArea = target.isValid()};
  if (!point.isInfinite()) point.p = z.p + s.distance * s.wi;
  const double looked = light.isDelta() ? double{choice.probability}
                                        : StrategyWeights::arrival(double{choice.probability} * double{s.pdf},
                                                                   z.p, point, Rgb());
  made.add(value * way.transmittance, weightOf(camera, j, point, way.depth, looked, double{directionPdf}));
  return made;
}

Contribution PathConnector::lookForMedium(const Subpath& camera, std::size_t j,
                                          const LightSelector::Choice& choice, Point2f u) {
  if (!setup_.media) return {};
  const PathVertex& z = camera.vertices[j];
  const MediumLight& light = *setup_.scene.mediumLight(choice.light);
  const LightSample s = light.sampleDirection(z.p, u, time_);
  if (!(s.pdf > 0)) return {};
  const Rgb value = z.beta * z.scatter(s.wi) * (1 / (s.pdf * choice.probability));
  const auto span = light.span(z.p, s.wi, time_);
  if (value.isBlack() || !span) return {};
  MediumState state = z.state;
  Exclusions start;
  if (z.isOnSurface()) {
    setup_.media->leaveSurface(state, z.hit, z.si, z.coincident, s.wi, context_.counters,
                               context_.mismatches);
    start = z.coincident.startingWith(z.hit.hit.id);
  }
  ShadowRay shadow = shadowRayTo(setup_.scene, choice.light, s, z.p, time_, start);
  shadow.ray.tMax = s.distance;
  if (!z.isOnSurface()) shadow.from = &z.at;
  LightPoint point{.index = choice.light, .medium = &light, .d = s.wi, .directionDensity = double{s.pdf}};
  const auto directionPdf = double{z.directionPdf(z.wo, s.wi)};
  Contribution made;
  visitShadowEmission(
      setup_.shadowContext(context_), shadow, light.medium(), *span, state, context_.stream(),
      [&](const EmissionOnWay& e) {
        point.p = Point3f(Vec3d(z.p) + e.t * Vec3d(s.wi));
        made.add(value * e.radiance,
                 weightOf(camera, j, point, e.depth, setup_.weights.looked(point, z.p), directionPdf));
      });
  return made;
}

std::optional<PathConnector::OnFilm> PathConnector::lookForCamera(const Subpath& light, std::size_t i,
                                                                  Point2f lens) {
  const PathVertex& y = light.vertices[i];
  const WiSample s = context_.camera->sampleWi(y.p, lens, time_);
  if (!(s.pdf > 0) || !(s.importance > 0)) return std::nullopt;
  const Rgb value = y.beta * y.scatter(s.wi) * (s.importance / s.pdf);
  if (value.isBlack()) return std::nullopt;
  const WayThrough way = wayThrough(setup_, y, {.d = s.wi, .length = s.distance}, time_, context_);
  if (way.transmittance.isBlack()) return std::nullopt;
  Ray ray;
  ray.o = y.p + s.distance * s.wi;
  ray.d = -s.wi;
  ray.time = time_;
  const double fromCamera = StrategyWeights::arrival(context_.camera->pdfWe(ray), ray.o, ray.d, y, way.depth);
  const double others = setup_.weights.othersOf(light, i, {fromCamera, pdfBefore(light, i, s.wi)});
  OnFilm onFilm{s.film, {}};
  onFilm.contribution.add(value * way.transmittance, 1 / (1 + others));
  return onFilm;
}

}  // namespace pbrtmedia
