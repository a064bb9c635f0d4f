// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/bounds.h"
#include "base/transform.h"
#include "base/vec.h"
#include "fields/affine_map.h"
#include "fields/lattice_walk.h"
#include "fields/nano_vdb_reader.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// A sparse density read from an .nvdb file, interpolated trilinearly as OpenVDB's box sampler does: the
/// value of voxel (i, j, k) lies at that whole point of index space, and the file's own transform places it.
/// Tiles and inactive voxels count with their values, as does the background, but only inside the box of the
/// active voxels grown by one voxel, which is where an active voxel reaches; beyond it the density is 0.
///
/// Local space is index space moved by whole bricks of 8 voxels, so that the box is positive.
class NanoVdbField {
 public:
  struct Params {
    std::filesystem::path file;  ///< .nvdb
    std::string grid;  ///< name, number or unique beginning (fields/grid_choice.h); "": the only density
    DensityMap map;
  };
  static constexpr std::string_view kTypeName = "nanovdb";

  /// Throws SceneError: at the file when it or the grid cannot be used (fields/nano_vdb_reader.h), with
  /// unknown location for a bad parameter or a grid that is not there. A grid without active voxels is valid
  /// and clear.
  NanoVdbField(const Params& params, const Transform& worldFromMedium);

  /// Density at a local point inside the box (up to a quarter of a voxel outside is safe).
  float density(Vec3d p) const {
    // Local coordinates are positive, so truncation is floor.
    const auto ix = static_cast<std::int64_t>(p.x), iy = static_cast<std::int64_t>(p.y),
               iz = static_cast<std::int64_t>(p.z);
    float s[8];
    if (tree_.corners(static_cast<std::uint64_t>(ix + shift_.x), static_cast<std::uint64_t>(iy + shift_.y),
                      static_cast<std::uint64_t>(iz + shift_.z), s)) {
      return s[0];
    }
    const float fx = static_cast<float>(p.x - static_cast<double>(ix)),
                fy = static_cast<float>(p.y - static_cast<double>(iy)),
                fz = static_cast<float>(p.z - static_cast<double>(iz));
    const auto along = [](float f, float a, float b) { return a + f * (b - a); };
    const float low = along(fy, along(fz, s[0], s[1]), along(fz, s[2], s[3]));
    const float high = along(fy, along(fz, s[4], s[5]), along(fz, s[6], s[7]));
    return along(fx, low, high);
  }
  /// Density at any point of world space; 0 outside the box.
  float densityAt(Vec3d world) const;

  const AffineMap& localFromWorld() const { return localFromWorld_; }
  const Transform& worldFromLocal() const { return worldFromLocal_; }
  Bounds3d localBox() const { return box_; }
  /// The box of the active voxels, both ends included, in the file's index space.
  Vec3<std::int64_t> activeMin() const { return activeMin_; }
  Vec3<std::int64_t> activeMax() const { return activeMax_; }

  /// Cells of whole voxels, by default of 2^power per axis with the smallest power from
  /// kFinestSuperVoxelPower on that gives at most kMaxSuperVoxels cells.
  SuperVoxelLattice lattice(const WantedCells& wanted) const;
  /// Bounds for such a lattice. Their cost follows the stored bricks and the number of cells.
  SuperVoxels superVoxels(const SuperVoxelLattice& lattice) const;
  /// Bounds with cells of 2^power voxels per axis, 0 <= power <= kMaxSuperVoxelPower; throws SceneError
  /// beyond.
  SuperVoxels superVoxels(int power) const;
  SuperVoxels superVoxels() const { return superVoxels(lattice({})); }
  static constexpr int kFinestSuperVoxelPower = 3, kMaxSuperVoxelPower = 13;
  static constexpr std::int64_t kMaxSuperVoxels = std::int64_t{1} << 22;  ///< 48 MiB

  /// Cuts the line (local units) at the lattice planes: between two, the density is a cubic in s.
  template <class Visit>
  void walkPieces(const LocalLine& line, double sMin, double sMax, Visit&& visit) const {
    double sEnter = sMin;
    walkLattice(LatticeShape{gaps_}, line, sMin, sMax, [&](double sExit, std::size_t) {
      const bool more = visit(sEnter, sExit);
      sEnter = sExit;
      return more;
    });
  }
  std::string describe() const;
  std::size_t bytes() const { return tree_.bytes(); }

 private:
  SuperVoxelLattice latticeOf(const Vec3<std::int64_t>& voxelsPerCell) const;

  std::string name_, type_;
  bool isEmpty_;
  BrickTree tree_;
  Vec3<std::int64_t> activeMin_, activeMax_;
  Vec3<std::int64_t> shift_;  ///< local to the tree's coordinates: multiples of 8
  Vec3<std::int64_t> gaps_;   ///< between the local samples 0 and the last of the box
  Bounds3d box_;
  Transform worldFromLocal_;
  AffineMap localFromWorld_;
};

}  // namespace pbrtmedia
