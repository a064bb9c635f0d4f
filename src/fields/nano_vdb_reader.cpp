// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_reader.h"

#if PBRT_MEDIA_HAS_NANOVDB
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>

#include "base/interruption.h"
#include "fields/nano_vdb_nodes.h"
#endif

namespace pbrtmedia {

#if PBRT_MEDIA_HAS_NANOVDB
namespace {

using Bytes = std::span<const std::byte>;
using IndexPoint = Vec3<std::int64_t>;

constexpr std::uint64_t kGridMagic = 0x304244566f6e614e;     // "NanoVDB0"
constexpr std::uint64_t kNewGridMagic = 0x314244566f6e614e;  // "NanoVDB1"

std::string shown(IndexPoint p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

/// Rounds down to a multiple of a power of two.
std::int64_t floorTo(std::int64_t value, std::int64_t size) { return value & ~(size - 1); }

/// Turns the values of a grid of one build type into densities, checked, and puts them into the result.
template <class Build>
class Reader {
  using Nodes = NanoVdbNodes<Build>;

 public:
  Reader(const Nodes& nodes, const NanoVdbFile& file, Bytes bytes, const DensityMap& map, NanoVdbGrid& out)
      : nodes_(nodes), file_(file), bytes_(bytes), map_(map), out_(out) {}

  void fill() {
    background_ = density(nodes_.background(), 1, [] { return std::string("the background"); });
    out_.hasActive = nodes_.hasActive();
    if (!out_.hasActive) return;
    out_.activeMin = nodes_.activeMin();
    out_.activeMax = nodes_.activeMax();
    const IndexPoint lo = out_.activeMin - IndexPoint(2, 2, 2), hi = out_.activeMax + IndexPoint(2, 2, 2);
    BrickTree::Corner cubes;
    for (std::size_t a = 0; a < 3; ++a) {
      out_.treeOrigin[a] = floorTo(lo[a], Nodes::kRootCube);
      cubes[a] = static_cast<std::uint64_t>(
          (floorTo(hi[a], Nodes::kRootCube) - out_.treeOrigin[a]) / Nodes::kRootCube + 1);
    }
    // Each is at most 2^20 + 1.
    if (cubes.x * cubes.y > BrickTree::kMaxRootCubes ||
        cubes.x * cubes.y * cubes.z > BrickTree::kMaxRootCubes) {
      refuse("its active voxels span " + shown(out_.activeMin) + " to " + shown(out_.activeMax) +
             ", more than " + std::to_string(BrickTree::kMaxRootCubes) + " cubes of 4096 voxels");
    }
    cubes_ = cubes;
    out_.tree = BrickTree(cubes, background_);
    for (const NanoVdbRootTile& tile : nodes_.rootTiles()) fillRoot(tile);
    for (const NanoVdbNode& node : nodes_.uppers()) fillUpper(node);
    for (const NanoVdbNode& node : nodes_.lowers()) fillLower(node);
    std::size_t floats = 0, words = 0;
    for (const NanoVdbNode& node : nodes_.leaves())
      (Nodes::kIsQuantised ? words : floats) += nodes_.payloadOf(node) / 4;
    out_.tree.reserve(nodes_.leaves().size(), floats, words);
    for (const NanoVdbNode& node : nodes_.leaves()) fillLeaf(node);
  }

 private:
  /// `voxels`: how many have the value.
  template <class Where>
  float density(double value, std::size_t voxels, const Where& where) const {
    const double mapped = static_cast<double>(map_.scale) * value + static_cast<double>(map_.offset);
    return checked(static_cast<float>(mapped), value, voxels, where);
  }
  template <class Where>
  float checked(float density, double value, std::size_t voxels, const Where& where) const {
    if (density >= 0 && std::isfinite(density)) return density;
    if (map_.negatives != nullptr && density < 0 && std::isfinite(density) && out_.gridClass != "level set") {
      NegativeDensities& negatives = *map_.negatives;
      if (negatives.count == 0) {
        negatives.first = where();
        negatives.density = density;
      }
      negatives.count += voxels;
      return 0;
    }
    std::ostringstream message;
    message << where() << " holds " << value;
    if (map_.scale != 1 || map_.offset != 0) message << ", which gives the density " << density;
    message << "; densities must be finite and >= 0";
    if (out_.gridClass == "level set") {
      message << " (this grid is a level set, which tells distances; a fog volume is needed)";
    }
    refuse(message.str());
  }

  /// A cube that the tree of the result holds, in its coordinates.
  std::optional<BrickTree::Corner> inTree(IndexPoint origin) const {
    BrickTree::Corner corner;
    for (std::size_t a = 0; a < 3; ++a) {
      if (origin[a] < out_.treeOrigin[a]) return std::nullopt;
      corner[a] = static_cast<std::uint64_t>(origin[a] - out_.treeOrigin[a]);
      if (corner[a] >= cubes_[a] * BrickTree::kRoot) return std::nullopt;
    }
    return corner;
  }
  float tileDensity(double value, IndexPoint origin, std::int64_t size) const {
    return density(value, static_cast<std::size_t>(size * size * size),
                   [&] { return "the tile of " + std::to_string(size) + "^3 voxels at " + shown(origin); });
  }

  void fillRoot(const NanoVdbRootTile& tile) {
    const float value = tileDensity(tile.value, tile.origin, Nodes::kRootCube);
    if (const auto at = inTree(tile.origin)) out_.tree.setRootCube(*at, value);
  }
  void fillUpper(const NanoVdbNode& node) {
    leaveIfStopped();
    if (!inTree(node.origin)) return;
    const NanoVdbCopy<typename Nodes::Upper> upper(bytes_.subspan(node.offset));
    for (std::uint32_t n = 0; n < 32 * 32 * 32; ++n) {
      if (upper->mChildMask.isOn(n)) continue;
      const IndexPoint origin = Nodes::blockOrigin(node, n);
      const float value = tileDensity(upper->mTable[n].value, origin, Nodes::kBlock);
      if (value != background_) out_.tree.setBlock(*inTree(origin), value);
    }
  }
  void fillLower(const NanoVdbNode& node) {
    leaveIfStopped();
    if (!inTree(node.origin)) return;
    const NanoVdbCopy<typename Nodes::Lower> lower(bytes_.subspan(node.offset));
    for (std::uint32_t n = 0; n < 16 * 16 * 16; ++n) {
      if (lower->mChildMask.isOn(n)) continue;
      const IndexPoint origin = Nodes::brickOrigin(node, n);
      const float value = tileDensity(lower->mTable[n].value, origin, Nodes::kBrick);
      if (value != background_) out_.tree.setBrick(*inTree(origin), value);
    }
  }

  static IndexPoint voxel(const NanoVdbNode& node, std::uint32_t i) {
    return node.origin + IndexPoint(i >> 6, i >> 3 & 7, i & 7);
  }

  void fillLeaf(const NanoVdbNode& node) {
    leaveIfStopped();
    const auto at = inTree(node.origin);
    if (!at) return;
    const NanoVdbCopy<typename Nodes::Leaf> leaf(bytes_.subspan(node.offset));
    if constexpr (Nodes::kIsQuantised) {
      const double scale = map_.scale;
      const auto quantum = static_cast<float>(scale * static_cast<double>(leaf->mQuantum));
      const auto minimum =
          static_cast<float>(scale * static_cast<double>(leaf->mMinimum) + static_cast<double>(map_.offset));
      std::array<std::uint32_t, BrickTree::kSamplesPerBrick / 2> room{};
      const std::size_t size = nodes_.payloadOf(node);
      std::memcpy(room.data(), bytes_.data() + node.offset + kCodesAt, size);
      const std::span<const std::uint32_t> words(room.data(), size / sizeof(std::uint32_t));
      const int log2Bits = nodes_.log2BitsOf(node);
      std::array<float, BrickTree::kSamplesPerBrick> densities;
      bool isClamped = false;
      for (std::uint32_t i = 0; i < BrickTree::kSamplesPerBrick; ++i) {
        const auto code = static_cast<float>(BrickTree::codeAt(words.data(), log2Bits, i));
        const float decoded = code * quantum + minimum;
        densities[i] = checked(decoded, static_cast<double>(code * leaf->mQuantum + leaf->mMinimum), 1,
                               [&] { return "voxel " + shown(voxel(node, i)); });
        isClamped = isClamped || densities[i] != decoded;
      }
      if (isClamped) {
        out_.tree.setBrick(*at, densities);  // no code means exactly 0
      } else {
        out_.tree.setBrick(*at, log2Bits, minimum, quantum, words);
      }
    } else {
      std::array<float, BrickTree::kSamplesPerBrick> densities;
      for (std::uint32_t i = 0; i < BrickTree::kSamplesPerBrick; ++i) {
        densities[i] = density(static_cast<double>(leaf->mValues[i]), 1,
                               [&] { return "voxel " + shown(voxel(node, i)); });
      }
      out_.tree.setBrick(*at, densities);
    }
  }

  [[noreturn]] void refuse(const std::string& message) const {
    file_.refuse("grid \"" + out_.name + "\": " + message);
  }

  /// Codes follow the head of a quantised leaf.
  static constexpr std::size_t kCodesAt = sizeof(nanovdb::LeafFnBase<nanovdb::Coord, nanovdb::Mask, 3>);

  const Nodes& nodes_;
  const NanoVdbFile& file_;
  Bytes bytes_;
  DensityMap map_;
  NanoVdbGrid& out_;
  float background_ = 0;
  BrickTree::Corner cubes_;
};

Transform transformOf(const nanovdb::GridData& grid, const NanoVdbFile& file) {
  Matrix4 m;
  bool finite = true;
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) m.m[row][column] = grid.mMap.mMatD[3 * row + column];
    m.m[row][3] = grid.mMap.mVecD[row];
    for (const double x : m.m[row]) finite = finite && std::isfinite(x);
  }
  const Transform transform(finite ? m : Matrix4{});
  if (!finite || transform.isSingular()) {
    file.refuse("a grid is corrupt: its transformation has no inverse or is not finite");
  }
  return transform;
}

template <class Build>
void read(const NanoVdbFile& file, Bytes bytes, const nanovdb::GridData& grid, const DensityMap& map,
          NanoVdbGrid& out) {
  const NanoVdbNodes<Build> nodes(file, out.name, bytes, grid);
  Reader<Build>(nodes, file, bytes, map, out).fill();
}

}  // namespace

NanoVdbGrid readNanoVdbGrid(const NanoVdbFile& file, std::size_t index, const DensityMap& map) {
  const NanoVdbGridInfo& info = file.grids().at(index);
  NanoVdbGrid out;
  out.name = info.name;
  out.type = info.type;
  out.gridClass = info.gridClass;
  if (!info.isDensity) {
    file.refuse("grid \"" + info.name + "\" holds values of type " + info.type +
                "; a density is float, double, Fp4, Fp8, Fp16 or FpN. The file holds:\n" +
                listGrids(file.candidates()));
  }
  const NanoVdbGridBytes stored = file.bytes(index);
  const Bytes bytes = stored.view();
  const auto corrupt = [&](const std::string& what) { refuseCorruptGrid(file, info.name, what); };
  if (bytes.size() < sizeof(nanovdb::GridData)) corrupt("it is shorter than its head");
  const NanoVdbCopy<nanovdb::GridData> grid(bytes);
  if (grid->mMagic != kGridMagic && grid->mMagic != kNewGridMagic) corrupt("it does not begin as a grid");
  if (grid->mGridSize != bytes.size()) {
    corrupt("it announces " + std::to_string(grid->mGridSize) + " bytes and has " +
            std::to_string(bytes.size()));
  }
  if (grid->mVersion.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER) {
    corrupt("it has version " + std::to_string(grid->mVersion.getMajor()) + ", its file " + info.version);
  }
  out.worldFromIndex = transformOf(*grid, file);
  switch (grid->mGridType) {
    case nanovdb::GridType::Float:
      read<float>(file, bytes, *grid, map, out);
      break;
    case nanovdb::GridType::Double:
      read<double>(file, bytes, *grid, map, out);
      break;
    case nanovdb::GridType::Fp4:
      read<nanovdb::Fp4>(file, bytes, *grid, map, out);
      break;
    case nanovdb::GridType::Fp8:
      read<nanovdb::Fp8>(file, bytes, *grid, map, out);
      break;
    case nanovdb::GridType::Fp16:
      read<nanovdb::Fp16>(file, bytes, *grid, map, out);
      break;
    case nanovdb::GridType::FpN:
      read<nanovdb::FpN>(file, bytes, *grid, map, out);
      break;
    default:
      corrupt("its type is not the one that the directory tells");
  }
  return out;
}

#else

NanoVdbGrid readNanoVdbGrid(const NanoVdbFile& file, std::size_t, const DensityMap&) {
  file.refuse("this program was built without NanoVDB; install libnanovdb-dev and build again");
}

#endif

}  // namespace pbrtmedia
