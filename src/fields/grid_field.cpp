// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "fields/field_box.h"

namespace pbrtmedia {
namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw SceneError(SourceLocation{}, "grid field: " + what);
}

void checkShape(const GridField::Params& p) {
  if (p.nx < 1 || p.ny < 1 || p.nz < 1) {
    refuse("\"nx\", \"ny\", \"nz\" must be at least 1; found " + std::to_string(p.nx) + ", " +
           std::to_string(p.ny) + ", " + std::to_string(p.nz));
  }
  // The product of three int fits an unsigned 128-bit number; of two a 64-bit one.
  const auto slice = static_cast<std::uint64_t>(p.nx) * static_cast<std::uint64_t>(p.ny);
  const auto nz = static_cast<std::uint64_t>(p.nz);
  const bool fits = slice <= std::numeric_limits<std::uint64_t>::max() / nz;
  if (!fits || slice * nz != p.density.size()) {
    refuse("\"density\" must hold nx * ny * nz = " + std::to_string(p.nx) + " * " + std::to_string(p.ny) +
           " * " + std::to_string(p.nz) + (fits ? " = " + std::to_string(slice * nz) : "") +
           " values; found " + std::to_string(p.density.size()));
  }
}

void checkValues(const GridField::Params& p) {
  const auto bad = std::find_if(p.density.begin(), p.density.end(),
                                [](float v) { return !(v >= 0) || !std::isfinite(v); });
  if (bad == p.density.end()) return;
  const auto index = static_cast<std::uint64_t>(bad - p.density.begin());
  const auto nx = static_cast<std::uint64_t>(p.nx), ny = static_cast<std::uint64_t>(p.ny);
  std::ostringstream message;
  message << "\"density\" must be finite and >= 0; found " << *bad << " at voxel (" << index % nx << ", "
          << index / nx % ny << ", " << index / nx / ny << "), value number " << index << " counted from 0";
  refuse(message.str());
}

/// Relative slack of bounds for the rounding of a look-up: three nested float interpolations, each off by at
/// most 3 ulp of the largest sample, stay below 9 * 2^-24; this is 16 * 2^-24.
constexpr float kLookupRounding = 0x1p-20f;

SuperVoxel withRoundingSlack(float lower, float upper) {
  // Equal samples are interpolated exactly.
  if (lower == upper) return {upper, lower};
  constexpr float kLargest = std::numeric_limits<float>::max();
  return {std::min(std::nextafter(upper * (1 + kLookupRounding), kLargest), kLargest),
          std::nextafter(lower * (1 - kLookupRounding), 0.0f)};
}

}  // namespace

GridField::GridField(const Params& params, const Transform& worldFromMedium)
    : n_{params.nx, params.ny, params.nz},
      row_(std::int64_t{params.nx} + 2),
      slice_(row_ * (std::int64_t{params.ny} + 2)) {
  checkShape(params);
  checkValues(params);
  const Transform worldFromCube = worldFromUnitCube(params.p0, params.p1, worldFromMedium, kTypeName);
  // Unit cube -> [1/2, n + 1/2].
  worldFromLocal_ = worldFromCube * Transform::scale(1.0 / n_[0], 1.0 / n_[1], 1.0 / n_[2]) *
                    Transform::translate({-0.5, -0.5, -0.5});
  localFromWorld_ = AffineMap(worldFromLocal_.inverseMatrix());

  samples_.resize(static_cast<std::size_t>(slice_ * (std::int64_t{n_[2]} + 2)));
  const bool clamp = params.border == GridBorder::Clamp;
  const auto source = [](std::int64_t i, int n) { return std::clamp<std::int64_t>(i - 1, 0, n - 1); };
  const auto inApron = [](std::int64_t i, int n) { return i == 0 || i == n + std::int64_t{1}; };
  parallelFor(static_cast<std::size_t>(n_[2]) + 2, [&](std::size_t slice) {
    const auto k = static_cast<std::int64_t>(slice);
    for (std::int64_t j = 0; j < n_[1] + std::int64_t{2}; ++j) {
      if (!clamp && (inApron(k, n_[2]) || inApron(j, n_[1]))) continue;  // stays 0
      const float* from = params.density.data() + (source(k, n_[2]) * n_[1] + source(j, n_[1])) * n_[0];
      float* to = samples_.data() + k * slice_ + j * row_;
      std::copy(from, from + n_[0], to + 1);
      if (!clamp) continue;
      to[0] = from[0];
      to[n_[0] + 1] = from[n_[0] - 1];
    }
  });
}

float GridField::densityAt(Point3f world) const {
  const Vec3d p = localFromWorld_.point(Vec3d(world));
  return localBox().contains(p) ? density(p) : 0;
}

Bounds3d GridField::localBox() const { return {{0.5, 0.5, 0.5}, {n_[0] + 0.5, n_[1] + 0.5, n_[2] + 0.5}}; }

SuperVoxels GridField::superVoxels(int power) const {
  if (power < 0 || power > kMaxSuperVoxelPower) {
    refuse("a super-voxel spans 2^p samples, p from 0 to " + std::to_string(kMaxSuperVoxelPower) +
           "; found p = " + std::to_string(power));
  }
  // n + 1 gaps between the n + 2 samples of an axis, apron included.
  const std::int64_t size = std::int64_t{1} << power;
  const auto cells = [&](int n) { return (n + size) >> power; };
  const LatticeShape shape{{cells(n_[0]), cells(n_[1]), cells(n_[2])}};
  // Interpolation never leaves the range of the samples around, so the samples of the closed cell bound it.
  const auto boundOf = [&](std::int64_t ci, std::int64_t cj, std::int64_t ck) {
    const auto last = [&](std::int64_t c, int n) { return std::min((c + 1) * size, n + std::int64_t{1}); };
    float lower = std::numeric_limits<float>::infinity(), upper = 0;
    for (std::int64_t k = ck * size; k <= last(ck, n_[2]); ++k) {
      for (std::int64_t j = cj * size; j <= last(cj, n_[1]); ++j) {
        const float* s = samples_.data() + k * slice_ + j * row_;
        for (std::int64_t i = ci * size; i <= last(ci, n_[0]); ++i) {
          lower = std::min(lower, s[i]);
          upper = std::max(upper, s[i]);
        }
      }
    }
    return withRoundingSlack(lower, upper);
  };
  return SuperVoxels(shape, static_cast<double>(size), localBox(), boundOf);
}

std::string GridField::describe() const {
  std::ostringstream text;
  text << "grid " << n_[0] << " x " << n_[1] << " x " << n_[2];
  return text.str();
}

}  // namespace pbrtmedia
