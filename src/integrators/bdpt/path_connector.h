// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/bdpt/connecting_way.h"
#include "integrators/bdpt/contribution.h"
#include "integrators/bdpt/path_vertex.h"

namespace pbrtmedia {

/// Joins two subpaths to paths. Vertices are numbered in their subpath from 0.
class PathConnector {
 public:
  PathConnector(const BdptSetup& setup, SampleContext& context, float time)
      : setup_(setup), context_(context), time_(time) {}

  /// A vertex from the camera with one from the light.
  Contribution connect(const Subpath& camera, std::size_t j, const Subpath& light, std::size_t i);
  /// A vertex from the camera with a point of a light that is looked for from there. `uLight` chooses the
  /// light, `u` the point; of a medium a direction, along which some points are chosen.
  Contribution lookForLight(const Subpath& camera, std::size_t j, float uLight, Point2f u);
  /// A vertex from the light with the camera; its value is what SplatBuffer takes at `film`. `lens`: uniform
  /// in the unit square.
  struct OnFilm {
    Point2f film;
    Contribution contribution;
  };
  std::optional<OnFilm> lookForCamera(const Subpath& light, std::size_t i, Point2f lens);

 private:
  Contribution lookForMedium(const Subpath& camera, std::size_t j, const LightSelector::Choice& choice,
                             Point2f u);
  /// Of finding that point of a light by looking for it with the density `looked`, on a way of that control
  /// depth. `directionPdf`: of that direction, were it chosen by scattering.
  double weightOf(const Subpath& camera, std::size_t j, const LightPoint& light, Rgb depth, double looked,
                  double directionPdf) const;

  const BdptSetup& setup_;
  SampleContext& context_;
  float time_;
};

}  // namespace pbrtmedia
