// SPDX-License-Identifier: BSD-2-Clause
#include "fields/gradient_noise.h"

#include <array>
#include <cmath>

namespace pbrtmedia {
namespace {

struct Gradient {
  double x, y, z;
};
constexpr std::array<Gradient, 16> kGradients = {{{1, 1, 0},
                                                  {-1, 1, 0},
                                                  {1, -1, 0},
                                                  {-1, -1, 0},
                                                  {1, 0, 1},
                                                  {-1, 0, 1},
                                                  {1, 0, -1},
                                                  {-1, 0, -1},
                                                  {0, 1, 1},
                                                  {0, -1, 1},
                                                  {0, 1, -1},
                                                  {0, -1, -1},
                                                  // Four of the twelve again, a tetrahedron, to fill up 16.
                                                  {1, 1, 0},
                                                  {-1, 1, 0},
                                                  {0, -1, 1},
                                                  {0, -1, -1}}};

double blend(double t) { return t * t * t * (t * (6 * t - 15) + 10); }
double mix(double w, double a, double b) { return a + w * (b - a); }
/// The range of mix over w in [0, 1]: it is linear in each of its arguments, so the ends tell.
Interval mix(Interval w, Interval a, Interval b) {
  return {std::min(mix(w.lo, a.lo, b.lo), mix(w.hi, a.lo, b.lo)),
          std::max(mix(w.lo, a.hi, b.hi), mix(w.hi, a.hi, b.hi))};
}

}  // namespace

std::uint32_t GradientNoise::hash(std::int64_t x, std::int64_t y, std::int64_t z) const {
  std::uint32_t h = seed_ + static_cast<std::uint32_t>(x) * 0x9e3779b1u +
                    static_cast<std::uint32_t>(y) * 0x85ebca77u + static_cast<std::uint32_t>(z) * 0xc2b2ae3du;
  h ^= h >> 15;
  h *= 0x2c1b3c6du;
  h ^= h >> 12;
  h *= 0x297a2d39u;
  return (h ^ h >> 15) & 15u;
}

double GradientNoise::at(Vec3d p) const {
  const Vec3d cell(std::floor(p.x), std::floor(p.y), std::floor(p.z));
  const Vec3d t = p - cell;
  const auto x = static_cast<std::int64_t>(cell.x), y = static_cast<std::int64_t>(cell.y),
             z = static_cast<std::int64_t>(cell.z);
  const auto corner = [&](int i, int j, int k) {
    const Gradient& g = kGradients[hash(x + i, y + j, z + k)];
    return g.x * (t.x - i) + g.y * (t.y - j) + g.z * (t.z - k);
  };
  const double wx = blend(t.x), wy = blend(t.y), wz = blend(t.z);
  const double low =
      mix(wy, mix(wx, corner(0, 0, 0), corner(1, 0, 0)), mix(wx, corner(0, 1, 0), corner(1, 1, 0)));
  const double high =
      mix(wy, mix(wx, corner(0, 0, 1), corner(1, 0, 1)), mix(wx, corner(0, 1, 1), corner(1, 1, 1)));
  return mix(wz, low, high);
}

Interval GradientNoise::range(const Bounds3d& box) const {
  const Vec3d size = box.max - box.min;
  if (!(size.x < 1 && size.y < 1 && size.z < 1)) return {-kLimit, kLimit};
  Interval all{kLimit, -kLimit};
  const auto first = [](double v) { return static_cast<std::int64_t>(std::floor(v)); };
  for (std::int64_t z = first(box.min.z); z <= first(box.max.z); ++z) {
    for (std::int64_t y = first(box.min.y); y <= first(box.max.y); ++y) {
      for (std::int64_t x = first(box.min.x); x <= first(box.max.x); ++x) {
        const auto within = [](double lo, double hi, std::int64_t cell) {
          const double c = static_cast<double>(cell);
          return clamped({lo - c, hi - c}, 0, 1);
        };
        const Interval tx = within(box.min.x, box.max.x, x), ty = within(box.min.y, box.max.y, y),
                       tz = within(box.min.z, box.max.z, z);
        const auto corner = [&](int i, int j, int k) {
          const Gradient& g = kGradients[hash(x + i, y + j, z + k)];
          return (tx - i) * g.x + (ty - j) * g.y + (tz - k) * g.z;
        };
        const Interval wx = mapRising(tx, blend), wy = mapRising(ty, blend), wz = mapRising(tz, blend);
        const Interval low =
            mix(wy, mix(wx, corner(0, 0, 0), corner(1, 0, 0)), mix(wx, corner(0, 1, 0), corner(1, 1, 0)));
        const Interval high =
            mix(wy, mix(wx, corner(0, 0, 1), corner(1, 0, 1)), mix(wx, corner(0, 1, 1), corner(1, 1, 1)));
        const Interval here = mix(wz, low, high);
        all = {std::min(all.lo, here.lo), std::max(all.hi, here.hi)};
      }
    }
  }
  return clamped(all, -kLimit, kLimit);
}

}  // namespace pbrtmedia
