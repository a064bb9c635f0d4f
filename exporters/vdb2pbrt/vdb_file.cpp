// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/vdb_file.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/io/io.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <optional>
#include <stdexcept>

#include "base/files.h"
#include "vdb2pbrt/vdb_density_grid.h"

namespace pbrtmedia {
namespace {

namespace io = openvdb::io;

constexpr std::uint64_t kMagic = 0x56444220;
/// Older files need readers that OpenVDB has dropped.
constexpr std::uint32_t kOldestVersion = openvdb::OPENVDB_FILE_VERSION_ROOTNODE_MAP,
                        kNewestVersion = openvdb::OPENVDB_FILE_VERSION;

/// The words that lists of .nvdb files use.
std::string shownClass(openvdb::GridClass gridClass) {
  switch (gridClass) {
    case openvdb::GRID_LEVEL_SET:
      return "level set";
    case openvdb::GRID_FOG_VOLUME:
      return "fog volume";
    case openvdb::GRID_STAGGERED:
      return "staggered";
    default:
      return "unknown class";
  }
}

bool isDensity(const openvdb::GridBase& grid) {
  return grid.isType<openvdb::FloatGrid>() || grid.isType<openvdb::DoubleGrid>();
}

/// "float, fog volume, 1200 active voxels in [..]..[..]", as the file's own metadata tells.
std::string describe(const openvdb::GridBase& grid, bool asHalf) {
  std::ostringstream text;
  text << grid.valueType() << (asHalf ? " stored as half" : "") << ", " << shownClass(grid.getGridClass());
  const auto voxels = grid.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
  const auto lo = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MIN);
  const auto hi = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MAX);
  if (voxels && voxels->value() == 0) {
    text << ", no active voxels";
  } else if (voxels) {
    text << ", " << voxels->value() << " active voxels";
    if (lo && hi) {
      text << " in [" << lo->value().x() << ' ' << lo->value().y() << ' ' << lo->value().z() << "]..["
           << hi->value().x() << ' ' << hi->value().y() << ' ' << hi->value().z() << ']';
    }
  }
  return text.str();
}

Bounds3d worldBoxOf(const openvdb::GridBase& grid) {
  Bounds3d box;
  const auto voxels = grid.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
  const auto lo = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MIN);
  const auto hi = grid.getMetadata<openvdb::Vec3IMetadata>(openvdb::GridBase::META_FILE_BBOX_MAX);
  if (!lo || !hi || (voxels && voxels->value() == 0)) return box;
  const openvdb::Vec3d first = openvdb::Vec3d(lo->value()) - openvdb::Vec3d(1.0),
                       last = openvdb::Vec3d(hi->value()) + openvdb::Vec3d(1.0);
  const Bounds3d inIndex{{first.x(), first.y(), first.z()}, {last.x(), last.y(), last.z()}};
  for (int i = 0; i < 8; ++i) {
    const Vec3d c = inIndex.corner(i);
    const openvdb::Vec3d p = grid.transform().indexToWorld(openvdb::Vec3d(c.x, c.y, c.z));
    box.expand(Vec3d(p.x(), p.y(), p.z()));
  }
  return box;
}

/// A file that tells how much of it was read.
class CountingBuffer : public std::filebuf {
 public:
  std::function<void(std::uint64_t)> onRead;  ///< called with all bytes so far, once for some megabytes

 protected:
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    const std::streamsize read = std::filebuf::xsgetn(to, count);
    bytes_ += static_cast<std::uint64_t>(std::max<std::streamsize>(read, 0));
    if (onRead && bytes_ - told_ > kStep) {
      told_ = bytes_;
      onRead(bytes_);
    }
    return read;
  }

 private:
  static constexpr std::uint64_t kStep = 4u << 20;
  std::uint64_t bytes_ = 0, told_ = 0;
};

}  // namespace

/// The file with its directory. The library's own reader goes on after the end of the data without a word;
/// here the stream throws.
struct VdbFile::Archive : io::Archive {
  CountingBuffer buffer;
  std::istream stream{&buffer};
  std::string creator;
  openvdb::SharedPtr<io::StreamMetadata> metadata{new io::StreamMetadata};
  std::uint64_t size = 0;
  std::vector<io::GridDescriptor> places;

  /// Throws std::runtime_error without the file's name.
  void open(const std::filesystem::path& path) {
    if (buffer.open(path, std::ios::in | std::ios::binary) == nullptr || std::filesystem::is_directory(path))
      throw std::runtime_error("it cannot be opened");
    size = std::filesystem::file_size(path);
    checkHeader(path);
    stream.exceptions(std::ios::failbit | std::ios::badbit);
    io::setStreamMetadataPtr(stream, metadata, /*transfer=*/false);
    readHeader(stream);
    setFormatVersion(stream);
    setLibraryVersion(stream);
    setDataCompression(stream);
    openvdb::MetaMap ofFile;
    ofFile.readMeta(stream);
    if (const auto given = ofFile.getMetadata<openvdb::StringMetadata>("creator")) creator = given->value();
  }

  void checkHeader(const std::filesystem::path& path) {
    std::uint64_t magic = 0;
    std::uint32_t fileVersion = 0;
    stream.read(reinterpret_cast<char*>(&magic), sizeof magic);
    stream.read(reinterpret_cast<char*>(&fileVersion), sizeof fileVersion);
    if (magic != kMagic) {
      constexpr std::uint64_t kMostText = 1024;
      if (size <= kMostText)
        static_cast<void>(FileBytes::open(path));  // throws where it is a Git LFS pointer
      throw std::runtime_error(
          magic == 0x304244566f6e614e || magic == 0x324244566f6e614e
              ? "this is a NanoVDB file already; name it in MakeNamedMedium as it is (--info lists its grids)"
              : "this is not an OpenVDB file");
    }
    if (!stream) throw std::runtime_error("the file is truncated: its header is not complete");
    if (fileVersion < kOldestVersion || fileVersion > kNewestVersion) {
      throw std::runtime_error(
          "the file has OpenVDB format version " + std::to_string(fileVersion) + ", this program reads " +
          std::to_string(kOldestVersion) + " to " + std::to_string(kNewestVersion) +
          (fileVersion > kNewestVersion
               ? "; write it with an older program, or build vdb2pbrt with a newer OpenVDB"
               : "; read and write it again with a program of OpenVDB 3 to 10 (vdb_print, Houdini, "
                 "Blender)"));
    }
    stream.seekg(0);
  }

  /// Reads what stands before the tree: compression, metadata, transformation.
  openvdb::GridBase::Ptr readStart(std::size_t index) {
    io::GridDescriptor place = places[index];
    stream.seekg(starts[index]);
    openvdb::GridBase::Ptr grid = place.read(stream);
    readGridCompression(stream);
    grid->readMeta(stream);
    grid->readTransform(stream);
    grid->setName(place.gridName());
    return grid;
  }
  openvdb::GridBase::Ptr readWhole(std::size_t index) {
    io::GridDescriptor place = places[index];
    stream.seekg(starts[index]);
    openvdb::GridBase::Ptr grid = place.read(stream);
    readGrid(grid, place, stream);
    grid->setName(place.gridName());
    if (!place.isInstance()) return grid;
    // Shares the tree of another grid of the file.
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i == index || places[i].uniqueName() != place.instanceParentName()) continue;
      if (places[i].isInstance()) break;
      grid->setTree(readWhole(i)->baseTreePtr());
      return grid;
    }
    throw std::runtime_error("grid \"" + place.gridName() + "\" refers to a tree that is not there");
  }

  /// Of the grid's data; 0 where the file does not tell.
  std::uint64_t bytesOf(std::size_t index) const {
    const std::int64_t from = places[index].getGridPos(), to = places[index].getEndPos();
    return to > from ? static_cast<std::uint64_t>(to - from) : 0;
  }

  void readDirectory() {
    const std::int32_t count = readGridCount(stream);
    for (std::int32_t i = 0; i < count; ++i) {
      starts.push_back(stream.tellg());
      places.emplace_back();
      const openvdb::GridBase::Ptr grid = places.back().read(stream);
      if (inputHasGridOffsets()) {
        const std::int64_t end = places.back().getEndPos();
        if (end < stream.tellg()) throw std::runtime_error("its directory is damaged");
        if (static_cast<std::uint64_t>(end) > size) {
          throw std::runtime_error("the file is truncated: grid \"" + places.back().gridName() +
                                   "\" ends at byte " + std::to_string(end) + ", the file at " +
                                   std::to_string(size));
        }
        stream.seekg(end);
      } else {
        readGrid(grid, places.back(), stream);  // there is no other way to the next one
      }
    }
  }

  std::vector<std::streampos> starts;  ///< of the descriptors
};

VdbFile::VdbFile(const std::filesystem::path& path) : path_(path), archive_(std::make_unique<Archive>()) {
  static const bool initialised = [] {
    openvdb::initialize();
    return true;
  }();
  static_cast<void>(initialised);
  try {
    archive_->open(path);
    version_ = archive_->version();
    creator_ = archive_->creator;
    archive_->readDirectory();
    for (std::size_t i = 0; i < archive_->places.size(); ++i) {
      const openvdb::GridBase::Ptr grid = archive_->readStart(i);
      candidates_.push_back({archive_->places[i].gridName(),
                             describe(*grid, archive_->places[i].saveFloatAsHalf()), isDensity(*grid)});
      boxes_.push_back(worldBoxOf(*grid));
    }
  } catch (const std::ios_base::failure&) {
    throw std::runtime_error(path.string() + ": the file is truncated: its data ends early");
  } catch (const std::exception& e) {
    throw std::runtime_error(path.string() + ": " + e.what());
  }
}

VdbFile::~VdbFile() = default;

VdbDensity VdbFile::read(std::size_t index, const std::function<void(double)>& progress) const {
  const GridCandidate& wanted = candidates_.at(index);
  const auto fail = [&](const std::string& what) -> std::runtime_error {
    return std::runtime_error(path_.string() + ": " + what);
  };
  if (!wanted.isDensity) {
    throw fail("grid \"" + wanted.name + "\" is no density: its values are " + wanted.description +
               "; expected float or double. The file holds:\n" + listGrids(candidates_));
  }
  try {
    archive_->buffer.onRead = nullptr;
    if (progress) {
      const auto size = static_cast<double>(archive_->bytesOf(index));
      archive_->buffer.onRead = [&, size,
                                 before = std::optional<std::uint64_t>()](std::uint64_t bytes) mutable {
        if (!before) before = bytes;
        if (size > 0) progress(std::min(1.0, static_cast<double>(bytes - *before) / size));
      };
    }
    const openvdb::GridBase::Ptr grid = archive_->readWhole(index);
    archive_->buffer.onRead = nullptr;
    auto result = std::make_unique<VdbDensity::Grid>();
    if (grid->isType<openvdb::FloatGrid>()) {
      result->grid = openvdb::gridPtrCast<openvdb::FloatGrid>(grid);
    } else {
      result->grid = std::make_shared<openvdb::FloatGrid>(*openvdb::gridPtrCast<openvdb::DoubleGrid>(grid));
    }
    return VdbDensity(std::move(result));
  } catch (const std::ios_base::failure&) {
    throw fail("the file is truncated: grid \"" + wanted.name + "\" ends early");
  } catch (const std::exception& e) {
    throw fail(e.what());
  }
}

}  // namespace pbrtmedia
