// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <string_view>

#include "base/bounds.h"
#include "base/transform.h"
#include "base/vec.h"
#include "fields/affine_map.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// One density throughout a box; 0 outside. Local space: the unit cube.
class ConstantField {
 public:
  struct Params {
    float density = 1;                 ///< >= 0, finite
    Point3f p0{0, 0, 0}, p1{1, 1, 1};  ///< opposite corners in medium space; they differ on every axis
  };
  static constexpr std::string_view kTypeName = "constant";

  /// Throws SceneError (location unknown) when a parameter is out of range.
  ConstantField(const Params& params, const Transform& worldFromMedium);

  /// Density at a local point inside the box.
  float density(Vec3d) const { return density_; }
  void densities(const LocalLine&, std::span<const double>, std::span<float> out) const {
    std::fill(out.begin(), out.end(), density_);
  }
  /// Density at any point of world space.
  float densityAt(Point3f world) const;
  const AffineMap& localFromWorld() const { return localFromWorld_; }
  const Transform& worldFromLocal() const { return worldFromLocal_; }
  Bounds3d localBox() const { return {{0, 0, 0}, {1, 1, 1}}; }
  SuperVoxels superVoxels() const;
  template <class Visit>
  void walkPieces(const LocalLine&, double sMin, double sMax, Visit&& visit) const {
    if (sMin < sMax) visit(sMin, sMax);
  }
  std::string describe() const;
  std::size_t bytes() const { return 0; }

 private:
  float density_;
  Transform worldFromLocal_;
  AffineMap localFromWorld_;
};

}  // namespace pbrtmedia
