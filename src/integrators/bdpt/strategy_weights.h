// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "cameras/camera.h"
#include "integrators/bdpt/path_vertex.h"
#include "lighting/light_selector.h"

namespace pbrtmedia {

/// Densities with which the strategies of bidirectional path tracing find one path, for the power heuristic
/// (Veach 1997, chapter 10). Strategy s takes s vertices from the light's end.
///
/// Densities of null-collision flights are not known. What stands for them here is a function of the path
/// alone: the control of its media (Medium::flightControl) tells the optical depth of each way and, per
/// channel, the extinction at each collision. Every strategy evaluates the same numbers, whichever end they
/// are met from, so the weights of all strategies of a path sum to 1; and as flights carry what an unbiased
/// estimate of the path's contribution needs in their own weights, that is all that keeps the image unbiased.
/// A poor control costs noise only. In a homogeneous medium of one colour it is exact.
///
/// The extinction at a collision is a factor that all strategies share, as each of them flies there from one
/// of its sides: only how it differs among the channels is kept. The way that a strategy connects across is
/// passed by none of its flights.
///
/// Points in media that emit are densities relative to that of the points that their light samples look for,
/// per volume, which all strategies have in common: looking for light is then the choice of the medium alone,
/// and so is starting there; a scattered ray finds light by its own density over that of the light samples'
/// direction, as in `volpath`.
class StrategyWeights {
 public:
  /// Per solid angle, of directions in which media emit.
  static constexpr double kAnyDirection = 1 / (4 * double{kPi});

  /// `selector`: of light samples. `starts`: of light subpaths; null: there are none.
  StrategyWeights(const LightSelector* selector, const LightSelector* starts, bool infiniteLightsStart)
      : selector_(selector), starts_(starts), infiniteLightsStart_(infiniteLightsStart) {}

  /// Whether subpaths start on a light. On those that are split (Light::isSplit) they would shine where light
  /// samples do not, and from infinity only into scenes with nothing but vacuum around them.
  bool startsOn(const Light& light) const {
    return starts_ && !light.isSplit() && (infiniteLightsStart_ || !light.isAtInfinity());
  }

  /// Area density (volume density, where `to` is in a medium) of a vertex that is found along a direction of
  /// solid-angle density `pdf` from `from`, through a way of control depth `depth`.
  static double arrival(double pdf, Point3f from, const PathVertex& to, Rgb depth);
  /// The same of a point on a light: area density, or solid angle for lights at infinity.
  static double arrival(double pdf, Point3f from, const LightPoint& to, Rgb depth);
  /// Of a vertex that rays of the camera of density `pdf` find along unit `d` from `from`.
  static double arrival(WePdf pdf, Point3f from, Vector3f d, const PathVertex& to, Rgb depth);
  /// Of a vertex when a light subpath leaves the light's point toward it.
  double departure(const LightPoint& from, const PathVertex& to, Rgb depth, float time) const;
  /// Of the light's point: LightPoint::emitted.
  double emitted(const LightPoint& light, Point3f next, float time) const;
  /// The same when `next` looks for it.
  double looked(const LightPoint& light, Point3f next) const;
  /// Of the same direction, per solid angle, without the choice among lights.
  float lookedDirection(const LightPoint& light, Point3f next) const;

  /// Tells a subpath that its last vertex scatters on, with the density `pdfBack` (per solid angle) of the
  /// way it came if that were looked for from the other side.
  void scattersOn(Subpath& path, double pdfBack) const;

  /// Densities from the other end of the last vertices of a subpath, for `othersOf`.
  struct FromOtherEnd {
    double last = 0;    ///< of the last vertex
    double before = 0;  ///< of the one before, or the light's point
  };
  /// Sum of the squared densities, relative to that of connecting to vertex number `last`, of the strategies
  /// that take that vertex from the other end, and more.
  double othersOf(const Subpath& path, std::size_t last, const FromOtherEnd& from) const;

 private:
  const LightSelector* selector_;
  const LightSelector* starts_;
  bool infiniteLightsStart_;
};

/// (a / b)², 0 where b is 0.
inline double squaredRatio(double a, double b) {
  const double r = b > 0 ? a / b : 0;
  return r * r;
}

}  // namespace pbrtmedia
