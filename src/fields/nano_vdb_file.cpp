// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_file.h"

#include <zlib.h>
#if PBRT_MEDIA_HAS_BLOSC
#include <blosc.h>
#endif

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>
#include <memory>
#include <new>
#include <sstream>
#include <type_traits>

#include "base/diagnostics.h"
#include "base/interruption.h"

namespace pbrtmedia {
namespace {

// The layout of a file, as NanoVDB's IO.h tells: little-endian, no padding between the parts.
constexpr std::size_t kHeaderSize = 16, kDirectoryEntrySize = 176;
constexpr std::uint64_t kMagic = 0x304244566f6e614e;      // "NanoVDB0"
constexpr std::uint64_t kFileMagic = 0x324244566f6e614e;  // "NanoVDB2", of newer writers
constexpr std::uint64_t kOpenVdbMagic = 0x56444220;       // eight bytes at the start of a .vdb file
constexpr std::uint32_t kMajorVersion = 32;
constexpr std::uint32_t kMaxNameSize = 1 << 16;
/// No deflate stream grows by more.
constexpr std::uint64_t kMaxDeflateRatio = 1032;
/// Blosc streams hold at most this much each.
constexpr std::uint64_t kBloscChunk = std::uint64_t{1} << 30;

constexpr std::array<const char*, 3> kCodecs = {"none", "zip", "blosc"};
constexpr std::array<const char*, 21> kTypes = {
    "unknown type", "float", "double", "int16", "int32", "int64", "Vec3f", "Vec3d", "mask",  "half", "uint32",
    "bool",         "RGBA8", "Fp4",    "Fp8",   "Fp16",  "FpN",   "Vec4f", "Vec4d", "index", "index"};
constexpr std::array<const char*, 10> kClasses = {"unknown class", "level set",  "fog volume", "staggered",
                                                  "point index",   "point data", "topology",   "voxel volume",
                                                  "index grid",    "tensor grid"};

template <std::size_t N>
std::string nameIn(const std::array<const char*, N>& names, std::uint32_t number) {
  return number < N ? names[number] : std::string(names[0]) + " " + std::to_string(number);
}

bool holdsRealNumbers(std::uint32_t type) { return type == 1 || type == 2 || (type >= 13 && type <= 16); }

template <class T>
T valueAt(std::span<const std::byte> bytes, std::size_t offset) {
  static_assert(std::endian::native == std::endian::little, "NanoVDB files are little-endian");
  static_assert(std::is_arithmetic_v<T>);
  T value;
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

std::string versionText(std::uint32_t packed) {
  return std::to_string(packed >> 21) + "." + std::to_string(packed >> 10 & 0x7ff) + "." +
         std::to_string(packed & 0x3ff);
}

NanoVdbGridInfo readEntry(std::span<const std::byte> entry) {
  NanoVdbGridInfo info;
  info.bytes = valueAt<std::uint64_t>(entry, 0);
  info.bytesInFile = valueAt<std::uint64_t>(entry, 8);
  info.activeVoxels = valueAt<std::uint64_t>(entry, 24);
  const auto type = valueAt<std::uint32_t>(entry, 32);
  info.type = nameIn(kTypes, type);
  info.isDensity = holdsRealNumbers(type);
  info.gridClass = nameIn(kClasses, valueAt<std::uint32_t>(entry, 36));
  for (std::size_t a = 0; a < 3; ++a) {
    info.world.min[a] = valueAt<double>(entry, 40 + 8 * a);
    info.world.max[a] = valueAt<double>(entry, 64 + 8 * a);
    info.indexMin[a] = valueAt<std::int32_t>(entry, 88 + 4 * a);
    info.indexMax[a] = valueAt<std::int32_t>(entry, 100 + 4 * a);
    info.voxelSize[a] = valueAt<double>(entry, 112 + 8 * a);
  }
  return info;
}

std::string describe(const NanoVdbGridInfo& g) {
  std::ostringstream text;
  text << g.type << ", " << g.gridClass << ", ";
  if (g.activeVoxels == 0) {
    text << "no active voxels";
  } else {
    text << g.activeVoxels << " active voxels in [" << g.indexMin.x << ' ' << g.indexMin.y << ' '
         << g.indexMin.z << "]..[" << g.indexMax.x << ' ' << g.indexMax.y << ' ' << g.indexMax.z << ']';
  }
  text << ", " << g.bytes << " bytes";
  return text.str();
}

/// False when the stream is corrupt or does not unpack to exactly the size of `to`.
bool unzip(std::span<const std::byte> from, std::span<std::byte> to) {
  constexpr std::size_t kStep = std::size_t{16} << 20;  // bytes between looks at the time
  z_stream z{};
  if (inflateInit(&z) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&z, inflateEnd);
  for (;;) {
    leaveIfStopped();
    // zlib's interface is older than const.
    z.next_in = reinterpret_cast<Bytef*>(const_cast<std::byte*>(from.data()));
    z.avail_in = static_cast<uInt>(std::min(from.size(), kStep));
    z.next_out = reinterpret_cast<Bytef*>(to.data());
    z.avail_out = static_cast<uInt>(std::min(to.size(), kStep));
    const uInt offered = z.avail_in, room = z.avail_out;
    const int status = inflate(&z, Z_NO_FLUSH);
    const std::size_t read = offered - z.avail_in, written = room - z.avail_out;
    from = from.subspan(read);
    to = to.subspan(written);
    if (status == Z_STREAM_END) return to.empty();
    if (status != Z_OK || read + written == 0) return false;
  }
}

/// What the bytes of blosc streams can grow to at most, by the compressor that the head of the first names.
std::uint64_t largestBloscRatio(std::span<const std::byte> stored) {
  constexpr std::size_t kFlagsAt = 8 + 2;  // after the size of the stream, its version and that of its format
  constexpr std::uint64_t kRun = 256;  // LZ4, blosclz: one byte prolongs a match by 255; snappy: by 64 for 3
  constexpr std::uint64_t kZstd = std::uint64_t{1} << 16;  // a block of 128 KiB in some bytes
  if (stored.size() <= kFlagsAt) return 1;
  switch (std::to_integer<unsigned>(stored[kFlagsAt]) >> 5) {
    case 0:
    case 1:
    case 2:
      return kRun;
    case 3:
      return kMaxDeflateRatio;
    default:
      return kZstd;
  }
}

#if PBRT_MEDIA_HAS_BLOSC
bool unblosc(std::span<const std::byte> from, std::span<std::byte> to) {
  std::size_t unpacked = 0;
  if (blosc_cbuffer_validate(from.data(), from.size(), &unpacked) < 0 || unpacked != to.size()) return false;
  return blosc_decompress_ctx(from.data(), to.data(), to.size(), 1) == static_cast<int>(to.size());
}
#endif

}  // namespace

NanoVdbFile::NanoVdbFile(const std::filesystem::path& path)
    : shownName_(path.string()), file_(FileBytes::open(path)) {
  if (file_.bytes().empty()) refuse("the file is empty");
  for (std::size_t at = 0; at < file_.bytes().size();) readSegment(at);
}

void NanoVdbFile::refuse(const std::string& message) const {
  throw SceneError(SourceLocation{.file = std::make_shared<const std::string>(shownName_)}, message);
}

void NanoVdbFile::readSegment(std::size_t& at) {
  const std::span<const std::byte> all = file_.bytes();
  const auto need = [&](std::uint64_t count, const std::string& what) {
    if (count > all.size() - at) {
      refuse("the file is truncated: " + what + " at byte " + std::to_string(at) + " needs " +
             std::to_string(count) + " bytes, found " + std::to_string(all.size() - at));
    }
  };
  need(8, "the magic number");
  const auto magic = valueAt<std::uint64_t>(all, at);
  if (magic == kOpenVdbMagic) {
    refuse("this is an OpenVDB file; convert it with: vdb2pbrt \"" + shownName_ + '"');
  }
  if (std::byte(magic & 0xff) == std::byte{'0'} && (magic >> 8 & 0xff) == 'B') {
    refuse("the file was written on a machine of the other byte order; write it anew on this one");
  }
  if (magic != kMagic && magic != kFileMagic) {
    refuse(at == 0 ? "this is not a NanoVDB file (it does not begin with \"NanoVDB0\")"
                   : "the file is corrupt: no NanoVDB segment begins at byte " + std::to_string(at));
  }
  need(kHeaderSize, "the header");
  const auto version = valueAt<std::uint32_t>(all, at + 8);
  if (version >> 21 != kMajorVersion) {
    refuse("the file has NanoVDB version " + versionText(version) + ", this program reads " +
           std::to_string(kMajorVersion) + ".x; convert the original again with: vdb2pbrt FILE.vdb");
  }
  const auto count = valueAt<std::uint16_t>(all, at + 12);
  const auto codec = valueAt<std::uint16_t>(all, at + 14);
  if (codec >= kCodecs.size()) {
    refuse("unknown codec number " + std::to_string(codec) + " (file version " + versionText(version) +
           "); known: 0 none, 1 zip, 2 blosc");
  }
  at += kHeaderSize;

  const std::size_t first = grids_.size();
  for (std::uint16_t i = 0; i < count; ++i) {
    need(kDirectoryEntrySize, "the directory");
    NanoVdbGridInfo info = readEntry(all.subspan(at, kDirectoryEntrySize));
    const auto nameSize = valueAt<std::uint32_t>(all, at + 136);
    if (nameSize > kMaxNameSize) {
      refuse("the file is corrupt: a grid's name of " + std::to_string(nameSize) + " bytes");
    }
    at += kDirectoryEntrySize;
    need(nameSize, "the name of a grid");
    const std::string_view name(reinterpret_cast<const char*>(all.data() + at), nameSize);
    info.name = name.substr(0, name.find('\0'));
    info.codec = kCodecs[codec];
    info.version = versionText(version);
    at += nameSize;
    grids_.push_back(std::move(info));
  }
  for (std::size_t i = first; i < grids_.size(); ++i) {
    const NanoVdbGridInfo& info = grids_[i];
    need(info.bytesInFile, "grid \"" + info.name + "\"");
    places_.push_back({at, static_cast<std::size_t>(info.bytesInFile), codec});
    at += static_cast<std::size_t>(info.bytesInFile);
  }
}

std::vector<GridCandidate> NanoVdbFile::candidates() const {
  std::vector<GridCandidate> result;
  for (const NanoVdbGridInfo& g : grids_) result.push_back({g.name, describe(g), g.isDensity});
  return result;
}

NanoVdbGridBytes NanoVdbFile::bytes(std::size_t index) const {
  const NanoVdbGridInfo& info = grids_.at(index);
  const Place& place = places_.at(index);
  std::span<const std::byte> stored = file_.bytes().subspan(place.offset, place.size);
  const auto corrupt = [&](const std::string& what) {
    refuse("grid \"" + info.name + "\" is corrupt: " + what);
  };
  if (place.codec == 0) {
    if (stored.size() != info.bytes) {
      corrupt(std::to_string(stored.size()) + " bytes are stored, " + std::to_string(info.bytes) +
              " are announced");
    }
    return {nullptr, stored};
  }
#if !PBRT_MEDIA_HAS_BLOSC
  if (place.codec == 2) {
    refuse("grid \"" + info.name + "\" is packed by blosc (file version " + info.version +
           "), which this build does not have; install libblosc-dev and build again, or write it with codec "
           "none or zip");
  }
#endif
  const std::uint64_t ratio = place.codec == 1 ? kMaxDeflateRatio : largestBloscRatio(stored);
  if (info.bytes / ratio > stored.size()) {
    corrupt(std::to_string(stored.size()) + " bytes cannot unpack to " + std::to_string(info.bytes));
  }
  if (info.bytes > mostUnpacked(stored.size())) {
    refuse("grid \"" + info.name + "\": its " + std::to_string(stored.size()) + " bytes would unpack to " +
           std::to_string(info.bytes) + ", expected at most " + std::to_string(mostUnpacked(stored.size())) +
           " for this size; write it with codec none if it is what it should be");
  }
  NanoVdbGridBytes result;
  const auto size = static_cast<std::size_t>(info.bytes);
  result.unpacked = std::make_unique_for_overwrite<std::byte[]>(size);
  const std::span<std::byte> whole(result.unpacked.get(), size);
  result.bytes = whole;
  // A zip grid is one stream; a blosc grid one for each GiB. Each is preceded by its packed size.
  for (std::span<std::byte> rest = whole; !rest.empty();) {
    leaveIfStopped();
    if (stored.size() < 8) corrupt("its data ends early");
    const auto packedSize = valueAt<std::uint64_t>(stored, 0);
    stored = stored.subspan(8);
    if (packedSize > stored.size()) corrupt("its data ends early");
    const auto packed = stored.first(static_cast<std::size_t>(packedSize));
    stored = stored.subspan(packed.size());
    const auto part = rest.first(static_cast<std::size_t>(
        place.codec == 1 ? rest.size() : std::min<std::uint64_t>(rest.size(), kBloscChunk)));
    rest = rest.subspan(part.size());
#if PBRT_MEDIA_HAS_BLOSC
    if (place.codec == 2) {
      if (!unblosc(packed, part)) corrupt("its blosc data cannot be unpacked");
      continue;
    }
#endif
    if (!unzip(packed, part)) corrupt("its zip data cannot be unpacked");
  }
  return result;
}

}  // namespace pbrtmedia
