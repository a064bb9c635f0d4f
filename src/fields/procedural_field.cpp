// SPDX-License-Identifier: BSD-2-Clause
#include "fields/procedural_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "fields/field_box.h"

namespace pbrtmedia {
namespace {

/// The least float that is not below a double, and a hair more: ranges are right up to rounding.
float above(double v) {
  if (!(v > 0)) return 0;
  return std::nextafter(static_cast<float>(v * (1 + 1e-6)), std::numeric_limits<float>::infinity());
}
float below(double v) {
  return v > 0 ? std::max(0.0f, std::nextafter(static_cast<float>(v * (1 - 1e-6)), 0.0f)) : 0.0f;
}

}  // namespace

template <bool kProven>
ProceduralField<kProven>::ProceduralField(const Params& params, const Transform& worldFromMedium)
    : params_(params) {
  for (const int n : params.cells) {
    if (n < 1 || n > 1024) {
      throw SceneError(SourceLocation{},
                       "super-voxels per axis: found " + std::to_string(n) + ", expected 1 to 1024");
    }
  }
  const Transform cube = worldFromUnitCube(params.p0, params.p1, worldFromMedium, params.typeName);
  const auto n = [&](std::size_t i) { return 1.0 / params.cells[i]; };
  worldFromLocal_ = cube * Transform::scale(n(0), n(1), n(2));
  localFromWorld_ = AffineMap(worldFromLocal_.inverseMatrix());
  // Straight from the corners: no way through the world, which may be far away.
  const Vec3d p0(params.p0), d = Vec3d(params.p1) - p0;
  mediumFromLocal_.x = {d.x * n(0), 0, 0};
  mediumFromLocal_.y = {0, d.y * n(1), 0};
  mediumFromLocal_.z = {0, 0, d.z * n(2)};
  mediumFromLocal_.t = p0;
}

template <bool kProven>
float ProceduralField<kProven>::densityAt(Point3f world) const {
  const Vec3d local = localFromWorld_.point(Vec3d(world));
  return localBox().contains(local) ? density(local) : 0;
}

template <bool kProven>
Bounds3d ProceduralField<kProven>::localBox() const {
  return {{0, 0, 0},
          {static_cast<double>(params_.cells[0]), static_cast<double>(params_.cells[1]),
           static_cast<double>(params_.cells[2])}};
}

template <bool kProven>
LatticeShape ProceduralField<kProven>::lattice() const {
  return {{params_.cells[0], params_.cells[1], params_.cells[2]}};
}

template <bool kProven>
std::optional<SuperVoxels> ProceduralField<kProven>::superVoxels() const {
  if (!params_.function->range({mediumFromLocal_.point({0, 0, 0}), mediumFromLocal_.point({0, 0, 0})})) {
    return std::nullopt;
  }
  constexpr int kParts = 1 << kHalvings;
  return SuperVoxels(lattice(), 1.0, localBox(), [&](std::int64_t i, std::int64_t j, std::int64_t k) {
    double lower = std::numeric_limits<double>::infinity(), upper = 0, middle = 0;
    for (int part = 0; part < kParts * kParts * kParts; ++part) {
      const int x = part % kParts, y = part / kParts % kParts, z = part / (kParts * kParts);
      const Vec3d corner = Vec3d(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)) +
                           Vec3d(x, y, z) * (1. / kParts);
      // Points of a line may lie a rounding outside of their cell.
      constexpr double kHair = 1e-9;
      const Vec3d a = mediumFromLocal_.point(corner - Vec3d(kHair, kHair, kHair)),
                  b = mediumFromLocal_.point(
                      corner + Vec3d(1. / kParts + kHair, 1. / kParts + kHair, 1. / kParts + kHair));
      const Interval range = *params_.function->range({min(a, b), max(a, b)});
      lower = std::min(lower, range.lo);
      upper = std::max(upper, range.hi);
      middle += (range.lo + range.hi) / 2;
    }
    return SuperVoxel{above(upper), below(lower), static_cast<float>(middle / (kParts * kParts * kParts))};
  });
}

template <bool kProven>
SuperVoxels ProceduralField<kProven>::constantBounds(float upper) const {
  return SuperVoxels(lattice(), 1.0, localBox(), [&](std::int64_t, std::int64_t, std::int64_t) {
    return SuperVoxel{upper, 0, SuperVoxel::kUnknownMean};
  });
}

template <bool kProven>
std::string ProceduralField<kProven>::describe() const {
  return params_.function->describe();
}

template class ProceduralField<true>;
template class ProceduralField<false>;

}  // namespace pbrtmedia
