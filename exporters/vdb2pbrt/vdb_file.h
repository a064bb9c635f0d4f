// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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
  VdbDensity read(std::size_t index) const;

 private:
  struct Archive;
  std::filesystem::path path_;
  std::unique_ptr<Archive> archive_;
  std::string version_;
  std::vector<GridCandidate> candidates_;
};

}  // namespace pbrtmedia
