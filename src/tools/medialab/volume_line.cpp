// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/volume_line.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/parameters.h"
#include "base/transform.h"
#include "fields/nano_vdb_field.h"

namespace pbrtmedia {
namespace {

/// The part [enter, exit] of a line inside a box; enter >= exit when it misses it.
std::pair<double, double> clipToBox(const Bounds3d& box, Vec3d o, Vec3d d) {
  double enter = 0, exit = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) {
      if (o[axis] < box.min[axis] || o[axis] > box.max[axis]) return {0, 0};
      continue;
    }
    const double a = (box.min[axis] - o[axis]) / d[axis], b = (box.max[axis] - o[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    exit = std::min(exit, std::max(a, b));
  }
  return {enter, exit};
}

/// Where the line crosses planes of voxel centres between `enter` and `exit`, both of these included.
std::vector<double> crossings(Vec3d o, Vec3d d, double enter, double exit) {
  std::vector<double> cuts{enter, exit};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0) continue;
    const double a = o[axis] + enter * d[axis], b = o[axis] + exit * d[axis];
    for (double plane = std::ceil(std::min(a, b)); plane <= std::max(a, b); ++plane) {
      const double s = (plane - o[axis]) / d[axis];
      if (s > enter && s < exit) cuts.push_back(s);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  // Two crossings within rounding of each other are one.
  const auto last = std::unique(cuts.begin(), cuts.end(),
                                [&](double x, double y) { return y - x <= 1e-12 * (exit - enter); });
  cuts.erase(last, cuts.end());
  cuts.back() = exit;
  return cuts;
}

/// "(0, 0, 0) to (1, 1, 1)": where the volume lies in world space.
std::string boxText(const NanoVdbField& field) {
  const Bounds3d local = field.localBox();
  const Bounds3f box = field.worldFromLocal().bounds({Point3f(local.min), Point3f(local.max)});
  std::string text;
  for (const Point3f& end : {box.min, box.max}) {
    text += text.empty() ? "(" : " to (";
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (axis > 0) text += ", ";
      text += std::to_string(end[axis]);
    }
    text += ')';
  }
  return text;
}

/// The cubic through four look-ups inside [a, b], about a.
CanonicalFunction::Stretch cubicOn(const NanoVdbField& field, Vec3d o, Vec3d d, double a, double b,
                                   double origin) {
  constexpr std::array<double, 4> kAt = {0.125, 0.375, 0.625, 0.875};
  std::array<double, 4> c{};  // divided differences, then coefficients of powers of the share of [a, b]
  for (std::size_t i = 0; i < 4; ++i) {
    c[i] = static_cast<double>(field.density(o + (a + kAt[i] * (b - a)) * d));
  }
  for (std::size_t order = 1; order < 4; ++order) {
    for (std::size_t i = 3; i >= order; --i) c[i] = (c[i] - c[i - 1]) / (kAt[i] - kAt[i - order]);
  }
  for (std::size_t k = 3; k-- > 0;) {
    for (std::size_t i = k; i < 3; ++i) c[i] -= kAt[k] * c[i + 1];
  }
  const double h = b - a;
  return {.end = b - origin,
          .constant = c[0],
          .slope = c[1] / h,
          .square = c[2] / h / h,
          .cube = c[3] / h / h / h};
}

}  // namespace

CanonicalFunction functionAlong(const std::filesystem::path& file, const std::string& grid,
                                const VolumeRay& ray) {
  const double length = std::sqrt(dot(ray.d, ray.d));
  if (!(length > 0) || !std::isfinite(length)) throw std::runtime_error("--ray: expected a direction");
  const auto problem = [&](const std::string& text) {
    return std::runtime_error('"' + file.string() + "\": " + text);
  };
  try {
    const NanoVdbField field({.file = file, .grid = grid, .map = {}}, Transform());
    const Vec3d o = field.localFromWorld().point(ray.o), d = field.localFromWorld().vector(ray.d / length);
    const auto [enter, exit] = clipToBox(field.localBox(), o, d);
    if (!(enter < exit)) throw problem("the ray misses the volume, which fills " + boxText(field));
    const std::vector<double> cuts = crossings(o, d, enter, exit);
    std::vector<CanonicalFunction::Stretch> stretches;
    for (std::size_t i = 1; i < cuts.size(); ++i) {
      stretches.push_back(cubicOn(field, o, d, cuts[i - 1], cuts[i], enter));
    }
    CanonicalFunction function(
        {.name = file.string(), .formula = "density along a ray", .source = "a volume file"},
        std::move(stretches));
    if (!(function.integral() > 0)) throw problem("the ray meets no density");
    return function;
  } catch (const SceneError& e) {
    throw problem(e.what());
  }
}

}  // namespace pbrtmedia
