// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/strategy_weights.h"

#include <algorithm>
#include <cmath>

namespace pbrtmedia {
namespace {

/// Beyond it densities only need to be small, and squares of their ratios finite.
constexpr float kMostDepth = 80;
/// The same of squared distances, where scatterings coincide.
constexpr double kLeastSquared = 1e-30;

/// Of passing, or of colliding at the end: the mean over the channels.
double flightDensity(Rgb rate, Rgb depth) {
  double sum = 0;
  if (depth.isBlack()) {
    for (std::size_t c = 0; c < 3; ++c) sum += double{rate[c]};
    return sum / 3;
  }
  for (std::size_t c = 0; c < 3; ++c)
    sum += double{rate[c]} * std::exp(-double{std::min(depth[c], kMostDepth)});
  return sum / 3;
}

struct Way {
  double squared;  ///< length
  Vec3d d;         ///< unit
};
Way wayBetween(Point3f a, Point3f b) {
  const Vec3d d = Vec3d(b) - Vec3d(a);
  const double squared = std::max(lengthSquared(d), kLeastSquared);
  return {squared, d / std::sqrt(squared)};
}

/// Of parallel rays along unit `d`, `pdf` per area across them.
double arrivalAcross(double pdf, Vector3f d, const PathVertex& to, Rgb depth) {
  const double across = to.isOnSurface() ? absDot(Vec3d(to.si.n), Vec3d(d)) : 1;
  return pdf * across * flightDensity(to.rate, depth);
}

Ray rayFrom(const LightPoint& light, Point3f next, float time) {
  Ray ray;
  ray.o = light.isInfinite() ? next : light.p;
  ray.d = -light.d;
  ray.time = time;
  return ray;
}

}  // namespace

double StrategyWeights::arrival(double pdf, Point3f from, const PathVertex& to, Rgb depth) {
  const Way way = wayBetween(from, to.p);
  const double across = to.isOnSurface() ? absDot(Vec3d(to.si.n), way.d) : 1;
  return pdf * across / way.squared * flightDensity(to.rate, depth);
}

double StrategyWeights::arrival(double pdf, Point3f from, const LightPoint& to, Rgb depth) {
  if (to.medium) return to.directionDensity > 0 ? pdf / to.directionDensity : 0;
  const double passing = pdf * flightDensity(Rgb(1.0f), depth);
  if (to.isInfinite()) return passing;
  const Way way = wayBetween(from, to.p);
  return passing * (to.isArea ? absDot(Vec3d(to.n), way.d) : 1) / way.squared;
}

double StrategyWeights::arrival(WePdf pdf, Point3f from, Vector3f d, const PathVertex& to, Rgb depth) {
  if (pdf.direction > 0) return arrival(double{pdf.direction}, from, to, depth);
  return arrivalAcross(double{pdf.position}, d, to, depth);
}

double StrategyWeights::departure(const LightPoint& from, const PathVertex& to, Rgb depth, float time) const {
  if (from.medium) return starts_ ? arrival(kAnyDirection, from.p, to, depth) : 0;
  if (!startsOn(*from.light)) return 0;
  const LePdf pdf = from.light->pdfLe(rayFrom(from, to.p, time), from.n);
  if (!from.isInfinite()) return arrival(double{pdf.direction}, from.p, to, depth);
  return arrivalAcross(double{pdf.position}, from.d, to, depth);
}

double StrategyWeights::emitted(const LightPoint& light, Point3f next, float time) const {
  if (light.medium) return starts_ ? double{starts_->probability(next, light.index)} : 0;
  if (!startsOn(*light.light)) return 0;
  const double choice{starts_->probability(next, light.index)};
  if (light.light->isDelta()) return choice;
  const LePdf pdf = light.light->pdfLe(rayFrom(light, next, time), light.n);
  return choice * double{light.isInfinite() ? pdf.direction : pdf.position};
}

float StrategyWeights::lookedDirection(const LightPoint& light, Point3f next) const {
  SurfaceInteraction si;
  si.p = light.p;
  si.n = light.n;
  return light.light->pdf(next, light.d, light.isArea ? &si : nullptr);
}

double StrategyWeights::looked(const LightPoint& light, Point3f next) const {
  const double choice{selector_->probability(next, light.index)};
  if (light.medium || light.isDelta()) return choice;
  const double pdf = choice * double{lookedDirection(light, next)};
  return arrival(pdf, next, light, Rgb());
}

void StrategyWeights::scattersOn(Subpath& path, double pdfBack) const {
  const std::size_t count = path.vertices.size();
  const PathVertex& last = path.vertices.back();
  if (count == 1) {
    if (!path.fromLight || path.light.isDelta()) return;
    path.beforeOthers = squaredRatio(arrival(pdfBack, last.p, path.light, last.depth), path.light.emitted);
    return;
  }
  PathVertex& before = path.vertices[count - 2];
  const double taken = squaredRatio(arrival(pdfBack, last.p, before, last.depth), before.pdf);
  double others = 0;
  if (count == 2) {
    others = (before.isSpecular ? 0 : path.firstOthers) + path.beforeOthers;
  } else {
    const PathVertex& next = path.vertices[count - 3];
    others = (before.isSpecular || next.isSpecular ? 0 : 1) + next.others;
  }
  before.others = taken > 0 ? taken * others : 0;
}

double StrategyWeights::othersOf(const Subpath& path, std::size_t last, const FromOtherEnd& from) const {
  const PathVertex& vertex = path.vertices[last];
  const double taken = squaredRatio(from.last, vertex.pdf);
  if (!(taken > 0)) return 0;
  if (last == 0) {
    double others = path.firstOthers;
    if (path.fromLight && !path.light.isDelta()) others += squaredRatio(from.before, path.light.emitted);
    return taken * others;
  }
  const PathVertex& before = path.vertices[last - 1];
  double others = before.isSpecular ? 0 : 1;
  const double takenToo = squaredRatio(from.before, before.pdf);
  if (takenToo > 0) {
    if (last == 1) {
      others += takenToo * ((before.isSpecular ? 0 : path.firstOthers) + path.beforeOthers);
    } else {
      const PathVertex& next = path.vertices[last - 2];
      others += takenToo * ((before.isSpecular || next.isSpecular ? 0 : 1) + next.others);
    }
  }
  return taken * others;
}

}  // namespace pbrtmedia
