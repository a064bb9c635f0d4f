// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/exit_pupil.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/math.h"
#include "base/parallel.h"

namespace pbrtmedia {
namespace {

constexpr std::uint32_t kCentralPoints = 1u << 20, kFirstPoints = 1u << 14, kSecondPoints = 1u << 16;
/// PBRT-v3: rear elements are left at up to so many times their aperture radius.
constexpr double kRearReach = 1.5;

/// i written in base kBase, mirrored at the point.
template <std::uint32_t kBase>
double radicalInverse(std::uint32_t i) {
  double value = 0, weight = 1;
  for (; i > 0; i /= kBase) {
    weight *= 1.0 / kBase;
    value += weight * (i % kBase);
  }
  return value;
}

struct Zone {
  double inner, outer;  ///< distances of its film points from the centre
};

/// The smallest rectangle around the points of `within` from which light reaches the zone, and a margin of
/// twice the distance of `count` evenly spread points. All of `within` when there are none.
ExitPupil::Rectangle boundsOf(const LensSystem& lens, const Zone& zone, const ExitPupil::Rectangle& within,
                              std::uint32_t count) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  ExitPupil::Rectangle r{{kFar, kFar}, {-kFar, -kFar}};
  for (std::uint32_t i = 0; i < count; ++i) {
    const double x = lerp(radicalInverse<2>(i), within.min.x, within.max.x);
    const double y = lerp(radicalInverse<3>(i), within.min.y, within.max.y);
    if (x >= r.min.x && x <= r.max.x && y >= r.min.y && y <= r.max.y) continue;
    const double film = lerp((i + 0.5) / count, zone.inner, zone.outer);
    const Vec3d o{film, 0, 0};
    if (!lens.traceFromFilm({o, Vec3d{x, y, lens.rearZ()} - o})) continue;
    r.min = {std::min(r.min.x, x), std::min(r.min.y, y)};
    r.max = {std::max(r.max.x, x), std::max(r.max.y, y)};
  }
  if (r.min.x > r.max.x) return within;
  const double diagonal = std::hypot(within.max.x - within.min.x, within.max.y - within.min.y);
  const double margin = 2 * diagonal / std::sqrt(static_cast<double>(count));
  return {{r.min.x - margin, r.min.y - margin}, {r.max.x + margin, r.max.y + margin}};
}

}  // namespace

ExitPupil::ExitPupil(const LensSystem& lens, double filmRadius) : filmRadius_(filmRadius), zones_(kZones) {
  const double reach = kRearReach * lens.rearApertureRadius();
  const Rectangle rear{{-reach, -reach}, {reach, reach}};
  parallelFor(kZones, [&](std::size_t i) {
    const Zone zone{filmRadius * static_cast<double>(i) / kZones,
                    filmRadius * static_cast<double>(i + 1) / kZones};
    zones_[i] = i == 0 ? boundsOf(lens, zone, rear, kCentralPoints)
                       : boundsOf(lens, zone, boundsOf(lens, zone, rear, kFirstPoints), kSecondPoints);
  });
}

const ExitPupil::Rectangle& ExitPupil::at(double distance) const {
  const double zone = std::floor(distance / filmRadius_ * kZones);
  return zones_[static_cast<std::size_t>(std::clamp(zone, 0.0, double{kZones - 1}))];
}

}  // namespace pbrtmedia
