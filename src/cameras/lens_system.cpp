// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/lens_system.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "base/math.h"

namespace pbrtmedia {
namespace {

/// By Snell's law; `d` and `n` unit, n against d. Nothing for total reflection.
std::optional<Vec3d> refracted(Vec3d d, Vec3d n, double etaRatio) {
  const double cosine = -dot(d, n);
  const double sineSquared = etaRatio * etaRatio * std::max(0.0, 1 - cosine * cosine);
  if (!(sineSquared < 1)) return std::nullopt;
  return etaRatio * d + (etaRatio * cosine - std::sqrt(1 - sineSquared)) * n;
}

void require(bool isGood, std::size_t row, const char* column, const char* expected, double found) {
  if (isGood) return;
  throw std::invalid_argument("lens " + std::to_string(row + 1) + ": " + column + ": expected " + expected +
                              ", found " + std::to_string(found));
}

}  // namespace

LensSystem::LensSystem(std::vector<LensElement> elements) : elements_(std::move(elements)) {
  if (elements_.empty()) throw std::invalid_argument("expected at least one lens, found none");
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const LensElement& e = elements_[i];
    require(std::isfinite(e.curvatureRadius), i, "curvature radius", "a finite number", e.curvatureRadius);
    require(std::isfinite(e.thickness), i, "distance", "a finite number", e.thickness);
    require(e.eta > 0 && std::isfinite(e.eta), i, "index of refraction", "a finite number > 0", e.eta);
    require(e.apertureRadius > 0 && std::isfinite(e.apertureRadius), i, "aperture diameter",
            "a finite number > 0", 2 * e.apertureRadius);
    frontZ_ += e.thickness;
  }
}

bool LensSystem::meets(const LensElement& element, double z, LensRay& ray, Vec3d& normal) {
  double t;
  if (element.isStop()) {
    t = (z - ray.o.z) / ray.d.z;
  } else {
    const Vec3d centre{0, 0, z - element.curvatureRadius}, o = ray.o - centre;
    double t0, t1;
    const double c = lengthSquared(o) - sqr(element.curvatureRadius);
    if (!solveQuadratic(lengthSquared(ray.d), 2 * dot(ray.d, o), c, t0, t1)) return false;
    // The half of the sphere around its vertex on the axis.
    const bool isCloser = (ray.d.z < 0) != (element.curvatureRadius < 0);
    t = isCloser ? t0 : t1;
    normal = (o + t * ray.d) / std::abs(element.curvatureRadius);
    normal = faceForward(normal, -ray.d);
  }
  if (!(t >= 0)) return false;
  ray.o += t * ray.d;
  return sqr(ray.o.x) + sqr(ray.o.y) <= sqr(element.apertureRadius);
}

std::optional<LensRay> LensSystem::traceFromFilm(LensRay ray) const {
  double z = 0;
  ray.d = normalize(ray.d);
  for (std::size_t i = elements_.size(); i-- > 0;) {
    const LensElement& e = elements_[i];
    z += e.thickness;
    if (e.isStop() && !(ray.d.z > 0)) return std::nullopt;
    Vec3d normal;
    if (!meets(e, z, ray, normal)) return std::nullopt;
    if (e.isStop()) continue;
    const double etaBeyond = i > 0 ? elements_[i - 1].eta : 1;
    const auto d = refracted(ray.d, normal, e.eta / etaBeyond);
    if (!d) return std::nullopt;
    ray.d = *d;
  }
  return ray;
}

std::optional<LensRay> LensSystem::traceFromScene(LensRay ray) const {
  double z = frontZ_;
  ray.d = normalize(ray.d);
  for (std::size_t i = 0; i < elements_.size(); ++i) {
    const LensElement& e = elements_[i];
    if (e.isStop() && !(ray.d.z < 0)) return std::nullopt;
    Vec3d normal;
    if (!meets(e, z, ray, normal)) return std::nullopt;
    z -= e.thickness;
    if (e.isStop()) continue;
    const double etaBefore = i > 0 ? elements_[i - 1].eta : 1;
    const auto d = refracted(ray.d, normal, etaBefore / e.eta);
    if (!d) return std::nullopt;
    ray.d = *d;
  }
  return ray;
}

std::optional<LensSystem::Cardinal> LensSystem::cardinal(const LensRay& in,
                                                         const std::optional<LensRay>& out) {
  if (!out) return std::nullopt;
  const auto zAt = [&](double x) { return out->o.z + (x - out->o.x) / out->d.x * out->d.z; };
  return Cardinal{.principal = -zAt(in.o.x), .focal = -zAt(0)};
}

LensSystem LensSystem::focusedAt(double distance, double height) const {
  const LensRay fromScene{{height, 0, frontZ_ + 1}, {0, 0, -1}},
      fromFilm{{height, 0, rearZ() - 1}, {0, 0, 1}};
  const auto scene = cardinal(fromScene, traceFromScene(fromScene));
  const auto film = cardinal(fromFilm, traceFromFilm(fromFilm));
  if (!scene || !film) {
    throw std::invalid_argument("no ray along the axis comes through the lens; is an aperture too small?");
  }
  // Thin lens equation between the principal planes, solved for the shift of the lens: Pharr, Jakob &
  // Humphreys 2016, "Physically Based Rendering", 6.4.4.
  const double f = scene->focal - scene->principal, z = -distance;
  const double c =
      (film->principal - z - scene->principal) * (film->principal - z - 4 * f - scene->principal);
  const double shift = 0.5 * (film->principal - z + scene->principal - std::sqrt(c));
  if (!(c > 0) || !std::isfinite(shift)) {
    throw std::invalid_argument("focusdistance: the lens, of focal length " + std::to_string(1000 * f) +
                                " mm, cannot be focused at " + std::to_string(distance) +
                                " m from the film; expected a larger distance");
  }
  std::vector<LensElement> moved = elements_;
  moved.back().thickness += shift;
  return LensSystem(std::move(moved));
}

}  // namespace pbrtmedia
