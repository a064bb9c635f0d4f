// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "base/vec.h"
#include "fields/density_function.h"

namespace pbrtmedia {

// Densities in closed form, in the space of the medium. Each is a small value with kName, `at` and `range`.

/// The test medium of Szirmay-Kalos et al. 2017, Eq. (21): within the sphere of radius 10 around (0, 0, 10),
/// ((cos(3 (x + y + z) / 2) + 1) / 2)^5 (sin(z / 2) + 2) / 3; maximum 1. Along (0, 0, z) its integral is
/// 3.415684.
struct SineSphere {
  static constexpr std::string_view kName = "sinesphere";
  double at(Vec3d p) const;
  Interval range(const Bounds3d& box) const;
};

/// A ball: 1 inside, falling smoothly (3 t² - 2 t³) to 0 over the outermost `edge` of its radius.
struct Ball {
  static constexpr std::string_view kName = "sphere";
  Point3f center{0, 0, 0};
  double radius = 1;  ///< > 0
  double edge = 0;    ///< width of the fall, in [0, radius]; 0: a jump
  double at(Vec3d p) const;
  Interval range(const Bounds3d& box) const;
};

/// 1 between the planes z = from and z = to, both included.
struct Slab {
  static constexpr std::string_view kName = "slab";
  double from = 0, to = 1;  ///< from < to
  double at(Vec3d p) const;
  Interval range(const Bounds3d& box) const;
};

/// Rises linearly from 0 at z = from to 1 at z = to, and stays there.
struct Ramp {
  static constexpr std::string_view kName = "ramp";
  double from = 0, to = 1;  ///< from < to
  double at(Vec3d p) const;
  Interval range(const Bounds3d& box) const;
};

/// floor + height exp(-(z - position)² / (2 width²)): thin fog with a sheet of high density that bounds by
/// samples miss.
struct Needle {
  static constexpr std::string_view kName = "needle";
  double floor = 0.1, height = 1000, position = 0.5, width = 0.002;  ///< floor, height >= 0; width > 0
  double at(Vec3d p) const;
  Interval range(const Bounds3d& box) const;
};

/// The one list of analytic densities.
using AnyAnalytic = std::variant<SineSphere, Ball, Slab, Ramp, Needle>;

std::optional<AnyAnalytic> findAnalytic(std::string_view name);
std::vector<std::string_view> analyticNames();
/// Throws SceneError (location unknown) that names a parameter out of range.
std::unique_ptr<DensityFunction> makeAnalyticDensity(const AnyAnalytic& density);

}  // namespace pbrtmedia
