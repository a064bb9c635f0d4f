// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "base/bounds.h"
#include "base/files.h"
#include "fields/grid_choice.h"

namespace pbrtmedia {

/// What the directory of an .nvdb file says of one grid. Not compared with the grid itself.
struct NanoVdbGridInfo {
  std::string name;
  std::string type;        ///< of a value: "float", "double", "Fp16", "Vec3f", …
  std::string gridClass;   ///< "fog volume", "level set", …, or "unknown class"
  std::string codec;       ///< "none", "zip", "blosc"
  std::string version;     ///< of the format: "32.4.2"
  bool isDensity = false;  ///< of a type that readNanoVdbGrid understands
  std::uint64_t activeVoxels = 0;
  std::uint64_t bytes = 0, bytesInFile = 0;  ///< unpacked; as stored
  Vec3<std::int32_t> indexMin, indexMax;     ///< box of the active voxels, both ends included
  Bounds3d world;                            ///< the same in the file's world space
  Vec3d voxelSize;
};

/// The bytes of one grid: in the file itself, or unpacked. Borrows from the NanoVdbFile.
struct NanoVdbGridBytes {
  /// Not initialised, so that memory is taken as far as bytes are unpacked. Null: in the file.
  std::unique_ptr<std::byte[]> unpacked;
  std::span<const std::byte> bytes;
  std::span<const std::byte> view() const { return bytes; }
};

/// An .nvdb file: one or more segments, each with a header, a directory and the bytes of its grids. Reads the
/// file formats of NanoVDB 32.x, uncompressed and zip; blosc where that library was there at build time.
class NanoVdbFile {
 public:
  /// Maps the file and reads its directories. Throws SceneError at the file when it is of another kind
  /// (OpenVDB files are named as such), another version or byte order, or truncated.
  explicit NanoVdbFile(const std::filesystem::path& path);

  const std::vector<NanoVdbGridInfo>& grids() const { return grids_; }
  std::vector<GridCandidate> candidates() const;
  /// The bytes of grid number `index`. Throws SceneError at the file when they are corrupt, would unpack to
  /// more than their codec can or `mostUnpacked` allows, or are packed by a codec that this build does not
  /// have.
  NanoVdbGridBytes bytes(std::size_t index) const;
  /// Throws SceneError at the file.
  [[noreturn]] void refuse(const std::string& message) const;

 private:
  struct Place {
    std::size_t offset = 0, size = 0;
    std::uint16_t codec = 0;
  };
  void readSegment(std::size_t& at);

  std::string shownName_;
  FileBytes file_;
  std::vector<NanoVdbGridInfo> grids_;
  std::vector<Place> places_;
};

}  // namespace pbrtmedia
