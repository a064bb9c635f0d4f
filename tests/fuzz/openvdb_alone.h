// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>
#include <openvdb/openvdb.h>

#include <cstdint>
#include <exception>
#include <filesystem>
#include <fstream>
#include <vector>

namespace pbrtmedia::test {

/// What OpenVDB does with a file when nobody looks at what it read: the calls that VdbFile makes, in order,
/// and no other code. So what ends a process that reads by VdbFile but not one that does this is VdbFile's.
class OpenVdbAlone : openvdb::io::Archive {
 public:
  /// Answers nothing: errors are as good as success.
  static void read(const std::filesystem::path& path) {
    openvdb::initialize();
    try {
      OpenVdbAlone archive;
      archive.open(path);
      archive.readDirectory();
      for (std::size_t i = 0; i < archive.places_.size(); ++i) archive.tryToRead(i);
    } catch (const std::exception&) {
    }
  }

 private:
  void open(const std::filesystem::path& path) {
    stream_.open(path, std::ios::binary);
    stream_.exceptions(std::ios::failbit | std::ios::badbit);
    openvdb::io::setStreamMetadataPtr(stream_, metadata_, /*transfer=*/false);
    readHeader(stream_);
    setFormatVersion(stream_);
    setLibraryVersion(stream_);
    setDataCompression(stream_);
    openvdb::MetaMap().readMeta(stream_);
  }

  void readDirectory() {
    const std::int32_t count = readGridCount(stream_);
    for (std::int32_t i = 0; i < count; ++i) {
      starts_.push_back(stream_.tellg());
      const openvdb::GridBase::Ptr grid = places_.emplace_back().read(stream_);
      if (inputHasGridOffsets()) {
        stream_.seekg(places_.back().getEndPos());
      } else {
        readGrid(grid, places_.back(), stream_);
      }
    }
  }

  void tryToRead(std::size_t index) {
    try {
      openvdb::io::GridDescriptor place = places_[index];
      stream_.seekg(starts_[index]);
      openvdb::GridBase::Ptr grid = place.read(stream_);
      readGridCompression(stream_);
      grid->readMeta(stream_);
      grid->readTransform(stream_);
      stream_.seekg(starts_[index]);
      grid = place.read(stream_);
      readGrid(grid, place, stream_);
      if (grid->isType<openvdb::DoubleGrid>())
        grid =
            openvdb::FloatGrid::Ptr(new openvdb::FloatGrid(*openvdb::gridPtrCast<openvdb::DoubleGrid>(grid)));
      static_cast<void>(grid->activeVoxelCount());
      static_cast<void>(grid->evalActiveVoxelBoundingBox());
    } catch (const std::exception&) {
    }
  }

  std::ifstream stream_;
  openvdb::SharedPtr<openvdb::io::StreamMetadata> metadata_{new openvdb::io::StreamMetadata};
  std::vector<std::streampos> starts_;
  std::vector<openvdb::io::GridDescriptor> places_;
};

}  // namespace pbrtmedia::test
