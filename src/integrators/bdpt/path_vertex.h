// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "lights/light.h"
#include "materials/bsdf.h"
#include "media/phase/phase_function.h"
#include "world/coincident_surfaces.h"
#include "world/medium_state.h"
#include "world/scatter_point.h"

namespace pbrtmedia {

class MediumLight;

/// Where a subpath scatters: on a surface, or in a medium.
struct PathVertex {
  /// Of its scattering, in order from 0. Where light comes out of a surface that it went below is the same
  /// scattering as where it went in, in another vertex behind that.
  std::size_t number = 0;
  Point3f p;                             ///< world
  Vector3f wo;                           ///< unit, toward the vertex before
  Rgb beta;                              ///< of the subpath up to here, without what happens here
  MediumState state;                     ///< on arrival
  const PhaseFunction* phase = nullptr;  ///< null: on a surface
  ScatterPoint at{};                     ///< in a medium

  SceneHit hit{};  ///< on a surface, as the following
  SurfaceInteraction si{};
  CoincidentSurfaces coincident{};
  Bsdf bsdf{};

  // For weights (StrategyWeights).
  Rgb rate{1.0f};  ///< share of each channel in the control's extinction; 1 on a surface
  Rgb depth{};     ///< what the control says of the way from the vertex before
  double pdf = 0;  ///< of the point, found from its own end of the path; infinite: only that end can find it
  bool isSpecular = false;  ///< the subpath goes on by a lobe without extent
  double others = 0;        ///< Subpath::others up to here

  bool isOnSurface() const { return phase == nullptr; }
  /// Whether light can be scattered here between two given directions.
  bool isConnectible() const { return !isOnSurface() || bsdf.count(BsdfFlags::AllButSpecular) > 0; }
  /// BSDF times cosine, or phase function, for light (or importance) that arrives from unit `wi`.
  Rgb scatter(Vector3f wi) const {
    if (!isOnSurface()) return Rgb(phase->evaluate(wo, wi));
    return bsdf.f(wo, wi, BsdfFlags::AllButSpecular) * absDot(wi, bsdf.shadingNormal());
  }
  /// Solid-angle density of `to` when the path comes from `from`; both unit, away from the vertex.
  float directionPdf(Vector3f from, Vector3f to) const {
    return isOnSurface() ? bsdf.pdf(from, to) : phase->evaluate(from, to);
  }
};

/// Where a path ends on a light.
struct LightPoint {
  std::size_t index = 0;                ///< in Scene::illuminants()
  const Light* light = nullptr;         ///< null: the light is a medium
  const MediumLight* medium = nullptr;  ///< null: it is not
  Point3f p{};                          ///< world; of no meaning for lights at infinity
  Normal3f n{};                         ///< of hits, where the light is a surface
  Vector3f d{};                         ///< unit, from the path's next vertex to the light
  bool isArea = false;                  ///< p lies on a surface
  double emitted = 0;  ///< density of the point (direction, for lights at infinity) when the path starts here
  /// Per solid angle, with which light samples of a medium choose `d` at the path's next vertex.
  double directionDensity = 0;
  bool isInfinite() const { return light && light->isAtInfinity(); }
  bool isDelta() const { return light && light->isDelta(); }
  bool isSplit() const { return light && light->isSplit(); }
};

/// A part of a path from one of its ends: the vertices at which it scatters, in order. `others`: the sum over
/// the strategies that take vertices from here on away from this end, of their density relative to that of
/// the strategy that takes none, squared.
struct Subpath {
  std::vector<PathVertex> vertices;
  bool fromLight = false;
  LightPoint light{};       ///< fromLight
  double firstOthers = 0;   ///< the strategy that takes the first vertex away: 0 where it cannot be
  double beforeOthers = 0;  ///< those that take the light's point away too

  std::size_t scatterings() const { return vertices.empty() ? 0 : vertices.back().number + 1; }
};

/// The way that a subpath goes behind its last vertex, or its start.
struct SubpathWay {
  Ray ray;
  Rgb beta{1.0f};
  Rgb depth;                ///< so far; by the control
  double pdfDirection = 0;  ///< per solid angle, unless it is the first
};

}  // namespace pbrtmedia
