// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "fields/grid_choice.h"
#include "vdb2pbrt/vdb_density.h"

namespace pbrtmedia {

/// A .vdb file of OpenVDB. Every failure is a std::runtime_error that names the file; data that ends early is
/// told as such.
class VdbFile {
 public:
  /// Reads the header and the directory. Throws when the file is no OpenVDB file, of a version that this
  /// library does not read, or shorter than its directory tells.
  explicit VdbFile(const std::filesystem::path& path);
  ~VdbFile();
  VdbFile(const VdbFile&) = delete;
  VdbFile& operator=(const VdbFile&) = delete;

  const std::string& version() const { return version_; }  ///< of format and library
  const std::vector<GridCandidate>& grids() const { return candidates_; }
  /// Reads one grid. Double values become float. Throws when it is of another type or its data is damaged.
  /// `progress` is told the share of the grid's bytes that have been read.
  VdbDensity read(std::size_t index, const std::function<void(double)>& progress = {}) const;
  /// World box of the active voxels' centres grown by one, as the grid's metadata tells; empty where they do
  /// not tell, or tell that there are none.
  Bounds3d worldBox(std::size_t index) const { return boxes_.at(index); }
  /// What the program that wrote the file calls itself; often "".
  const std::string& creator() const { return creator_; }

 private:
  struct Archive;
  std::filesystem::path path_;
  std::unique_ptr<Archive> archive_;
  std::string version_, creator_;
  std::vector<GridCandidate> candidates_;
  std::vector<Bounds3d> boxes_;
};

}  // namespace pbrtmedia
