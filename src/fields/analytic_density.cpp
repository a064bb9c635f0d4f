// SPDX-License-Identifier: BSD-2-Clause
#include "fields/analytic_density.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>

#include "base/diagnostics.h"
#include "base/math.h"

namespace pbrtmedia {
namespace {

/// Rounding of the closed forms, relative; far above their error.
constexpr double kRounding = 1e-9;

Interval axis(const Bounds3d& box, std::size_t i) { return {box.min[i], box.max[i]}; }
Interval squaredDistance(const Bounds3d& box, Vec3d centre) {
  return square(axis(box, 0) - centre.x) + square(axis(box, 1) - centre.y) + square(axis(box, 2) - centre.z);
}
double smoothStep(double t) { return t * t * (3 - 2 * t); }

void require(bool holds, std::string_view what) {
  if (!holds) throw SceneError(SourceLocation{}, std::string(what));
}
void check(const SineSphere&) {}
void check(const Ball& ball) {
  require(ball.radius > 0 && std::isfinite(ball.radius), "\"radius\" must be a number above 0");
  require(ball.edge >= 0 && ball.edge <= ball.radius, "\"edge\" must lie between 0 and the radius");
}
void check(const Slab& slab) { require(slab.from < slab.to, "\"from\" must be below \"to\""); }
void check(const Ramp& ramp) { require(ramp.from < ramp.to, "\"from\" must be below \"to\""); }
void check(const Needle& needle) {
  require(needle.floor >= 0 && needle.height >= 0 && std::isfinite(needle.floor + needle.height),
          "\"floor\" and \"height\" must be numbers of at least 0");
  require(needle.width > 0 && std::isfinite(needle.width), "\"width\" must be a number above 0");
}

template <class F>
class AnalyticDensity final : public DensityFunction {
 public:
  explicit AnalyticDensity(const F& f) : f_(f) { check(f); }
  float at(Vec3d p) const override { return static_cast<float>(f_.at(p)); }
  std::optional<Interval> range(const Bounds3d& box) const override {
    const Interval r = f_.range(box);
    return Interval{std::max(0.0, r.lo * (1 - kRounding)), r.hi * (1 + kRounding)};
  }
  std::string describe() const override { return "analytic density " + std::string(F::kName); }

 private:
  F f_;
};

}  // namespace

double SineSphere::at(Vec3d p) const {
  if (lengthSquared(p - Vec3d(0, 0, 10)) > 100) return 0;
  const double wave = (std::cos(1.5 * (p.x + p.y + p.z)) + 1) / 2, w2 = wave * wave;
  return w2 * w2 * wave * (std::sin(p.z / 2) + 2) / 3;
}
Interval SineSphere::range(const Bounds3d& box) const {
  const Interval r2 = squaredDistance(box, {0, 0, 10});
  if (r2.lo > 100) return {0, 0};
  const Interval wave = (cosine((axis(box, 0) + axis(box, 1) + axis(box, 2)) * 1.5) + 1) * .5;
  const Interval inside = mapRising(clamped(wave, 0, 1), [](double w) { return w * w * w * w * w; }) *
                          ((sine(axis(box, 2) * .5) + 2) * (1. / 3));
  // The edge is sharp: a cell that reaches beyond it holds 0 as well.
  return {r2.hi > 100 ? 0 : inside.lo, inside.hi};
}

double Ball::at(Vec3d p) const {
  const double depth = radius - length(p - Vec3d(center));
  if (depth < 0) return 0;
  return depth >= edge ? 1 : smoothStep(depth / edge);
}
Interval Ball::range(const Bounds3d& box) const {
  const Interval depth = Interval{radius, radius} - mapRising(squaredDistance(box, Vec3d(center)),
                                                              [](double v) { return std::sqrt(v); });
  const auto value = [&](double d) { return d < 0 ? 0 : d >= edge ? 1 : smoothStep(d / edge); };
  // Rounding of the distance moves the jump: a hair on either side counts as both.
  const double hair = 1e-12 * (radius + std::abs(depth.lo));
  return {value(depth.lo - hair), value(depth.hi + hair)};
}

double Slab::at(Vec3d p) const { return p.z >= from && p.z <= to ? 1 : 0; }
Interval Slab::range(const Bounds3d& box) const {
  const Interval z = axis(box, 2);
  return {z.lo >= from && z.hi <= to ? 1. : 0., z.hi >= from && z.lo <= to ? 1. : 0.};
}

double Ramp::at(Vec3d p) const { return std::clamp((p.z - from) / (to - from), 0.0, 1.0); }
Interval Ramp::range(const Bounds3d& box) const { return {at({0, 0, box.min.z}), at({0, 0, box.max.z})}; }

double Needle::at(Vec3d p) const { return floor + height * std::exp(-sqr((p.z - position) / width) / 2); }
Interval Needle::range(const Bounds3d& box) const {
  const Interval x = square((axis(box, 2) - position) * (1 / width));
  return {floor + height * std::exp(-x.hi / 2), floor + height * std::exp(-x.lo / 2)};
}

std::optional<AnyAnalytic> findAnalytic(std::string_view name) {
  std::optional<AnyAnalytic> found;
  [&]<std::size_t... I>(std::index_sequence<I...>) {
    ((std::variant_alternative_t<I, AnyAnalytic>::kName == name ? void(found.emplace(std::in_place_index<I>))
                                                                : void()),
     ...);
  }
  (std::make_index_sequence<std::variant_size_v<AnyAnalytic>>{});
  return found;
}

std::vector<std::string_view> analyticNames() {
  return []<std::size_t... I>(std::index_sequence<I...>) {
    return std::vector<std::string_view>{std::variant_alternative_t<I, AnyAnalytic>::kName...};
  }
  (std::make_index_sequence<std::variant_size_v<AnyAnalytic>>{});
}

std::unique_ptr<DensityFunction> makeAnalyticDensity(const AnyAnalytic& density) {
  return std::visit(
      [](const auto& f) -> std::unique_ptr<DensityFunction> {
        return std::make_unique<AnalyticDensity<std::decay_t<decltype(f)>>>(f);
      },
      density);
}

}  // namespace pbrtmedia
