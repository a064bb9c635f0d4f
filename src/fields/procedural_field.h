// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "base/bounds.h"
#include "base/transform.h"
#include "base/vec.h"
#include "fields/affine_map.h"
#include "fields/density_function.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// A density function inside a box; 0 outside. Local space is the lattice of its super-voxels: `cells` of
/// them per axis by default, each a unit cube.
class ProceduralField {
 public:
  struct Params {
    std::shared_ptr<const DensityFunction> function;
    Point3f p0{0, 0, 0}, p1{1, 1, 1};      ///< opposite corners in medium space; they differ on every axis
    std::array<int, 3> cells{32, 32, 32};  ///< super-voxels per axis, >= 1
    std::string_view typeName = "procedural";
  };
  static constexpr std::string_view kTypeName = "procedural";

  /// Throws SceneError (location unknown) when a parameter is out of range.
  ProceduralField(const Params& params, const Transform& worldFromMedium);

  /// Density at a local point inside the box.
  float density(Vec3d p) const { return params_.function->at(mediumFromLocal_.point(p)); }
  /// Density at any point of world space; 0 outside the box.
  float densityAt(Point3f world) const;

  const AffineMap& localFromWorld() const { return localFromWorld_; }
  const Transform& worldFromLocal() const { return worldFromLocal_; }
  Bounds3d localBox() const;
  /// By default Params::cells per axis.
  SuperVoxelLattice lattice(const WantedCells& wanted) const;
  /// From the ranges of the function, one per cell, halved `kHalvings` times along each axis so that their
  /// first-order slack shrinks. Nothing when the function knows no ranges. The mean is the middle of the
  /// parts' ranges, no exact one.
  std::optional<SuperVoxels> superVoxels(const SuperVoxelLattice& lattice) const;
  std::optional<SuperVoxels> superVoxels() const { return superVoxels(lattice({})); }
  /// Bounds of the density on a stretch of a line (local units) and the box around it. Only for functions
  /// that know ranges.
  SuperVoxel rangeOn(const LocalLine& line, double sEnter, double sExit) const;
  static constexpr int kHalvings = 1;
  std::string describe() const;
  std::string complaint() const { return params_.function->complaint(); }
  std::size_t bytes() const { return 0; }

 private:
  Params params_;
  Transform worldFromLocal_;
  AffineMap localFromWorld_, mediumFromLocal_;
};

}  // namespace pbrtmedia
