// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/bounds.h"
#include "base/transform.h"
#include "base/vec.h"
#include "fields/affine_map.h"
#include "fields/grid_batch.h"
#include "fields/grid_samples.h"
#include "fields/lattice_walk.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// Samples of a density on a regular grid over a box, interpolated trilinearly. Sample (i, j, k) lies at the
/// centre of its voxel, ((i + 1/2)/nx, ...) of the box; outside the box the density is 0.
///
/// Local space is the sample lattice: samples lie at whole numbers 1..n per axis, an apron that holds the
/// border rule lies at 0 and n + 1, and the box is [1/2, n + 1/2]. So a look-up needs no test against
/// borders.
class GridField {
 public:
  struct Params {
    int nx = 1, ny = 1, nz = 1;        ///< samples per axis, >= 1
    std::vector<float> density;        ///< nx ny nz values >= 0, finite, x fastest
    Point3f p0{0, 0, 0}, p1{1, 1, 1};  ///< opposite corners in medium space; they differ on every axis
    GridBorder border = GridBorder::Zero;
    GridPrecision precision = GridPrecision::Float;
    GridLayout layout = GridLayout::Automatic;
  };
  static constexpr std::string_view kTypeName = "grid";

  /// Throws SceneError (location unknown) that names the parameter or the first bad voxel. A grid of zeros is
  /// valid and clear.
  GridField(const Params& params, const Transform& worldFromMedium);

  /// Density at a local point inside the box (up to almost half a voxel outside is safe).
  float density(Vec3d p) const { return samples_.view().density(p); }
  /// Densities at the points o + s d of a line, bit for bit those of `density`; sizes are equal. Any order
  /// and spacing of s; each point where `density` is safe.
  void densities(const LocalLine& line, std::span<const double> s, std::span<float> out) const {
    if (s.size() >= kSmallestBatch) {
      gridDensities(samples_.view(), line.o, line.d, s, out);
      return;
    }
    for (std::size_t i = 0; i < s.size(); ++i) out[i] = density(line.o + s[i] * line.d);
  }
  /// From here on the batch is faster than look-ups one by one (bench/layout_bench.cpp).
  static constexpr std::size_t kSmallestBatch = 4;
  /// Density at any point of world space; 0 outside the box.
  float densityAt(Point3f world) const;

  int nx() const { return n_[0]; }
  int ny() const { return n_[1]; }
  int nz() const { return n_[2]; }
  const AffineMap& localFromWorld() const { return localFromWorld_; }
  const Transform& worldFromLocal() const { return worldFromLocal_; }
  Bounds3d localBox() const;
  /// Cells of whole gaps between samples, by default of 2^kDefaultSuperVoxelPower per axis.
  SuperVoxelLattice lattice(const WantedCells& wanted) const;
  /// Bounds and means (fields/grid_bounds.h) for such a lattice.
  SuperVoxels superVoxels(const SuperVoxelLattice& lattice) const;
  /// The same with cells of 2^power samples per axis, 0 <= power <=
  /// kMaxSuperVoxelPower; throws SceneError beyond.
  SuperVoxels superVoxels(int power = kDefaultSuperVoxelPower) const;
  static constexpr int kDefaultSuperVoxelPower = 2, kMaxSuperVoxelPower = 10;
  /// Cuts the line (local units) at the lattice planes: between two, the density is a cubic in s.
  template <class Visit>
  void walkPieces(const LocalLine& line, double sMin, double sMax, Visit&& visit) const {
    const LatticeShape gaps{{n_[0] + std::int64_t{1}, n_[1] + std::int64_t{1}, n_[2] + std::int64_t{1}}};
    double sEnter = sMin;
    walkLattice(gaps, line, sMin, sMax, [&](double sExit, std::size_t) {
      const bool more = visit(sEnter, sExit);
      sEnter = sExit;
      return more;
    });
  }
  const GridSamples& samples() const { return samples_; }
  bool isBricked() const { return samples_.layout().isBricked(); }
  std::string describe() const;
  std::size_t bytes() const { return samples_.bytes(); }

 private:
  int n_[3];
  GridSamples samples_;
  Transform worldFromLocal_;
  AffineMap localFromWorld_;
};

}  // namespace pbrtmedia
