// SPDX-License-Identifier: BSD-2-Clause
#include "fields/nano_vdb_reader.h"

#if PBRT_MEDIA_HAS_NANOVDB
#include <nanovdb/NanoVDB.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <sstream>
#include <type_traits>
#include <vector>
#endif

namespace pbrtmedia {

#if PBRT_MEDIA_HAS_NANOVDB
namespace {

using Bytes = std::span<const std::byte>;
using IndexPoint = Vec3<std::int64_t>;

constexpr std::uint64_t kGridMagic = 0x304244566f6e614e;     // "NanoVDB0"
constexpr std::uint64_t kNewGridMagic = 0x314244566f6e614e;  // "NanoVDB1"
constexpr std::uint32_t kNoChecksum = 0xffffffffu;
constexpr std::uint32_t kChecksumMinorVersion = 4;

/// An aligned copy of a structure of the file, where it may stand at any address.
template <class Data>
class Copy {
 public:
  explicit Copy(Bytes from) { std::memcpy(bytes_, from.data(), sizeof(Data)); }
  const Data& operator*() const { return *reinterpret_cast<const Data*>(bytes_); }
  const Data* operator->() const { return &**this; }

 private:
  alignas(alignof(Data)) std::byte bytes_[sizeof(Data)];
};

std::uint32_t checksumOf(Bytes bytes) {
  return static_cast<std::uint32_t>(
      crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
}

std::string shown(IndexPoint p) {
  return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
}

/// Rounds down to a multiple of a power of two.
std::int64_t floorTo(std::int64_t value, std::int64_t size) { return value & ~(size - 1); }

/// A node that the walk over the tree found.
struct Node {
  std::size_t offset;  ///< from the start of the grid
  IndexPoint origin;
};

/// Reads a grid of one build type: first `survey`, which checks the structure and finds the active box, then
/// `fill`.
template <class Build>
class Reader {
  using Root = typename nanovdb::NanoRoot<Build>::DataType;
  using Upper = typename nanovdb::NanoUpper<Build>::DataType;
  using Lower = typename nanovdb::NanoLower<Build>::DataType;
  using Leaf = typename nanovdb::NanoLeaf<Build>::DataType;
  using Tile = typename Root::Tile;
  static constexpr bool kIsQuantised = !std::is_floating_point_v<Build>;
  static constexpr bool kHasVariableBits = std::is_same_v<Build, nanovdb::FpN>;
  static constexpr std::int64_t kRootCube = 4096, kBlock = 128, kBrick = 8;

 public:
  Reader(const NanoVdbFile& file, Bytes bytes, const DensityMap& map, NanoVdbGrid& out)
      : file_(file), bytes_(bytes), map_(map), out_(out) {}

  void survey(const nanovdb::GridData& grid) {
    const Copy<nanovdb::TreeData<3>> tree(
        part(sizeof(nanovdb::GridData), sizeof(nanovdb::TreeData<3>), "tree"));
    rootOffset_ = offsetFrom(sizeof(nanovdb::GridData), tree->mNodeOffset[3], sizeof(Root), "root");
    const Copy<Root> root(part(rootOffset_, sizeof(Root), "root"));
    const std::size_t tilesAt = rootOffset_ + sizeof(Root);
    if (root->mTableSize > (bytes_.size() - tilesAt) / sizeof(Tile)) {
      corrupt("its root announces " + std::to_string(root->mTableSize) + " tiles");
    }
    background_ = density(root->mBackground, [] { return std::string("the background"); });
    checkHead(grid, tilesAt + root->mTableSize * sizeof(Tile));
    limitNodes(*tree);
    for (std::uint32_t i = 0; i < root->mTableSize; ++i) surveyTile(tilesAt + i * sizeof(Tile));
    checkTail(grid);
  }

  void fill() {
    const IndexPoint lo = out_.activeMin - IndexPoint(2, 2, 2), hi = out_.activeMax + IndexPoint(2, 2, 2);
    BrickTree::Corner cubes;
    for (std::size_t a = 0; a < 3; ++a) {
      out_.treeOrigin[a] = floorTo(lo[a], kRootCube);
      cubes[a] = static_cast<std::uint64_t>((floorTo(hi[a], kRootCube) - out_.treeOrigin[a]) / kRootCube + 1);
    }
    // Each is at most 2^20 + 1.
    if (cubes.x * cubes.y > BrickTree::kMaxRootCubes ||
        cubes.x * cubes.y * cubes.z > BrickTree::kMaxRootCubes) {
      refuse("its active voxels span " + shown(out_.activeMin) + " to " + shown(out_.activeMax) +
             ", more than " + std::to_string(BrickTree::kMaxRootCubes) + " cubes of 4096 voxels");
    }
    cubes_ = cubes;
    out_.tree = BrickTree(cubes, background_);
    for (const Tile& tile : rootTiles_) fillRoot(tile);
    for (const Node& node : uppers_) fillUpper(node);
    for (const Node& node : lowers_) fillLower(node);
    std::size_t floats = 0, words = 0;
    for (const Node& node : leaves_) (kIsQuantised ? words : floats) += payloadOf(node) / 4;
    out_.tree.reserve(leaves_.size(), floats, words);
    for (const Node& node : leaves_) fillLeaf(node);
  }

 private:
  // Structure
  // ------------------------------------------------------------------------------------------------

  Bytes part(std::size_t offset, std::size_t size, const char* what) const {
    if (offset > bytes_.size() || size > bytes_.size() - offset) {
      corrupt(std::string("its ") + what + " ends beyond its last byte");
    }
    return bytes_.subspan(offset, size);
  }
  /// `base` + a signed distance, checked to hold `size` bytes behind the tree's header.
  std::size_t offsetFrom(std::size_t base, std::uint64_t distance, std::size_t size, const char* what) const {
    // Unsigned arithmetic: a negative distance wraps around and back.
    const std::uint64_t offset = base + distance;
    constexpr std::size_t kFirst = sizeof(nanovdb::GridData) + sizeof(nanovdb::TreeData<3>);
    if (offset < kFirst || offset > bytes_.size() || size > bytes_.size() - offset) {
      corrupt(std::string("a ") + what + " lies outside of it");
    }
    return static_cast<std::size_t>(offset);
  }

  /// So a file whose nodes share children cannot ask for more work than it has bytes.
  void limitNodes(const nanovdb::TreeData<3>& tree) {
    constexpr std::size_t kSizes[3] = {sizeof(Leaf), sizeof(Lower), sizeof(Upper)};
    for (std::size_t level = 0; level < 3; ++level) {
      limits_[level] = tree.mNodeCount[level];
      if (limits_[level] > bytes_.size() / kSizes[level]) {
        corrupt("it announces " + std::to_string(limits_[level]) + " nodes of level " +
                std::to_string(level) + ", more than fit");
      }
    }
  }
  void addNode(std::vector<Node>& nodes, std::size_t level, Node node) const {
    if (nodes.size() >= limits_[level]) {
      corrupt("it has more nodes of level " + std::to_string(level) + " than it announces");
    }
    nodes.push_back(node);
  }

  void surveyTile(std::size_t at) {
    const Copy<Tile> tile(bytes_.subspan(at, sizeof(Tile)));
    const nanovdb::Coord corner = Root::KeyToCoord(tile->key);
    const IndexPoint origin(corner[0], corner[1], corner[2]);
    if (tile->child == 0) {
      rootTiles_.push_back(*tile);
      if (tile->state != 0)
        addActive(origin, origin + IndexPoint(kRootCube - 1, kRootCube - 1, kRootCube - 1));
      return;
    }
    const std::size_t upper =
        offsetFrom(rootOffset_, static_cast<std::uint64_t>(tile->child), sizeof(Upper), "node");
    addNode(uppers_, 2, {upper, origin});
    surveyUpper(uppers_.back());
  }

  void surveyUpper(const Node& node) {
    const Copy<Upper> upper(bytes_.subspan(node.offset, sizeof(Upper)));
    for (std::uint32_t n = 0; n < 32 * 32 * 32; ++n) {
      const IndexPoint origin = node.origin + IndexPoint(n >> 10, n >> 5 & 31, n & 31) * kBlock;
      if (!upper->mChildMask.isOn(n)) {
        if (upper->mValueMask.isOn(n))
          addActive(origin, origin + IndexPoint(kBlock - 1, kBlock - 1, kBlock - 1));
        continue;
      }
      const std::size_t lower =
          offsetFrom(node.offset, static_cast<std::uint64_t>(upper->mTable[n].child), sizeof(Lower), "node");
      addNode(lowers_, 1, {lower, origin});
      surveyLower(lowers_.back());
    }
  }

  void surveyLower(Node node) {
    const Copy<Lower> lower(bytes_.subspan(node.offset, sizeof(Lower)));
    for (std::uint32_t n = 0; n < 16 * 16 * 16; ++n) {
      const IndexPoint origin = node.origin + IndexPoint(n >> 8, n >> 4 & 15, n & 15) * kBrick;
      if (!lower->mChildMask.isOn(n)) {
        if (lower->mValueMask.isOn(n))
          addActive(origin, origin + IndexPoint(kBrick - 1, kBrick - 1, kBrick - 1));
        continue;
      }
      const std::size_t leaf =
          offsetFrom(node.offset, static_cast<std::uint64_t>(lower->mTable[n].child), sizeof(Leaf), "leaf");
      addNode(leaves_, 0, {leaf, origin});
      if constexpr (kHasVariableBits) part(leaf + sizeof(Leaf), payloadOf(leaves_.back()), "last leaf");
      surveyLeaf(leaves_.back());
    }
  }

  void surveyLeaf(const Node& node) {
    const Copy<Leaf> leaf(bytes_.subspan(node.offset, sizeof(Leaf)));
    // One word per x, in it one byte per y.
    static_assert(sizeof(nanovdb::Mask<3>) == 64);
    std::array<std::uint64_t, 8> active;
    const void* const mask = &leaf->mValueMask;
    std::memcpy(active.data(), mask, sizeof active);
    std::uint64_t any = 0;
    IndexPoint lo(7, 7, 7), hi(0, 0, 0);
    for (int x = 0; x < 8; ++x) {
      if (active[static_cast<std::size_t>(x)] == 0) continue;
      any |= active[static_cast<std::size_t>(x)];
      lo.x = std::min<std::int64_t>(lo.x, x);
      hi.x = x;
    }
    if (any == 0) return;
    std::uint64_t z = 0;
    for (int y = 0; y < 8; ++y) z |= any >> (8 * y) & 0xff;
    lo.y = std::countr_zero(any) / 8;
    hi.y = 7 - std::countl_zero(any) / 8;
    lo.z = std::countr_zero(z);
    hi.z = 63 - std::countl_zero(z);
    addActive(node.origin + lo, node.origin + hi);
  }

  void addActive(IndexPoint lo, IndexPoint hi) {
    out_.activeMin = out_.hasActive ? min(out_.activeMin, lo) : lo;
    out_.activeMax = out_.hasActive ? max(out_.activeMax, hi) : hi;
    out_.hasActive = true;
  }

  // Checksums
  // ------------------------------------------------------------------------------------------------

  static bool hasChecksum(const nanovdb::GridData& grid) {
    return grid.mVersion.getMinor() == kChecksumMinorVersion &&
           static_cast<std::uint32_t>(grid.mChecksum) != kNoChecksum;
  }
  void checkHead(const nanovdb::GridData& grid, std::size_t end) const {
    constexpr std::size_t kAfterMagicAndChecksum = 16;
    if (hasChecksum(grid) &&
        checksumOf(bytes_.subspan(kAfterMagicAndChecksum, end - kAfterMagicAndChecksum)) !=
            static_cast<std::uint32_t>(grid.mChecksum)) {
      corrupt("the checksum of its head is wrong");
    }
  }
  /// The second checksum is one over those of all nodes, 8 bytes for each: all of the highest level first,
  /// each level in the order of memory where nodes are of one size and stored so, else in that of the walk.
  void checkTail(const nanovdb::GridData& grid) {
    const auto expected = static_cast<std::uint32_t>(grid.mChecksum >> 32);
    if (!hasChecksum(grid) || expected == kNoChecksum || rootIsEmpty()) return;
    constexpr auto kBreadthFirst = static_cast<std::uint32_t>(nanovdb::GridFlags::IsBreadthFirst);
    const bool inMemoryOrder = !kHasVariableBits && (grid.mFlags & kBreadthFirst) != 0;
    std::vector<std::uint64_t> sums;
    const auto add = [&](std::vector<Node> nodes, std::size_t size) {
      if (inMemoryOrder) {
        std::sort(nodes.begin(), nodes.end(),
                  [](const Node& a, const Node& b) { return a.offset < b.offset; });
      }
      for (const Node& node : nodes) sums.push_back(checksumOf(bytes_.subspan(node.offset, size)));
    };
    add(uppers_, sizeof(Upper));
    add(lowers_, sizeof(Lower));
    add(leaves_, sizeof(Leaf));
    if (checksumOf(std::as_bytes(std::span(sums))) != expected) corrupt("the checksum of its nodes is wrong");
  }
  bool rootIsEmpty() const { return rootTiles_.empty() && uppers_.empty(); }

  // Values
  // ---------------------------------------------------------------------------------------------------

  template <class Where>
  float density(double value, const Where& where) const {
    const double mapped = static_cast<double>(map_.scale) * value + static_cast<double>(map_.offset);
    return checked(static_cast<float>(mapped), value, where);
  }
  template <class Where>
  float checked(float density, double value, const Where& where) const {
    if (density >= 0 && std::isfinite(density)) return density;
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
    return density(value,
                   [&] { return "the tile of " + std::to_string(size) + "^3 voxels at " + shown(origin); });
  }

  void fillRoot(const Tile& tile) {
    const nanovdb::Coord corner = Root::KeyToCoord(tile.key);
    const IndexPoint origin(corner[0], corner[1], corner[2]);
    const float value = tileDensity(tile.value, origin, kRootCube);
    if (const auto at = inTree(origin)) out_.tree.setRootCube(*at, value);
  }
  void fillUpper(const Node& node) {
    if (!inTree(node.origin)) return;
    const Copy<Upper> upper(bytes_.subspan(node.offset, sizeof(Upper)));
    for (std::uint32_t n = 0; n < 32 * 32 * 32; ++n) {
      if (upper->mChildMask.isOn(n)) continue;
      const IndexPoint origin = node.origin + IndexPoint(n >> 10, n >> 5 & 31, n & 31) * kBlock;
      const float value = tileDensity(upper->mTable[n].value, origin, kBlock);
      if (value != background_) out_.tree.setBlock(*inTree(origin), value);
    }
  }
  void fillLower(const Node& node) {
    if (!inTree(node.origin)) return;
    const Copy<Lower> lower(bytes_.subspan(node.offset, sizeof(Lower)));
    for (std::uint32_t n = 0; n < 16 * 16 * 16; ++n) {
      if (lower->mChildMask.isOn(n)) continue;
      const IndexPoint origin = node.origin + IndexPoint(n >> 8, n >> 4 & 15, n & 15) * kBrick;
      const float value = tileDensity(lower->mTable[n].value, origin, kBrick);
      if (value != background_) out_.tree.setBrick(*inTree(origin), value);
    }
  }

  /// Bytes of a leaf's values.
  std::size_t payloadOf(const Node& node) const {
    if constexpr (kHasVariableBits) {
      return std::size_t{64} << log2BitsOf(node);  // 512 values
    } else if constexpr (kIsQuantised) {
      return Leaf::bitWidth() * 64u;
    } else {
      return 4 * BrickTree::kSamplesPerBrick;
    }
  }
  int log2BitsOf(const Node& node) const {
    if constexpr (kHasVariableBits) {
      const unsigned log2Bits = Copy<Leaf>(bytes_.subspan(node.offset, sizeof(Leaf)))->mFlags >> 5;
      if (log2Bits > 4) corrupt("a leaf stores 2^" + std::to_string(log2Bits) + " bits per value");
      return static_cast<int>(log2Bits);
    } else {
      return std::countr_zero(static_cast<unsigned>(Leaf::bitWidth()));
    }
  }
  static IndexPoint voxel(const Node& node, std::uint32_t i) {
    return node.origin + IndexPoint(i >> 6, i >> 3 & 7, i & 7);
  }

  void fillLeaf(const Node& node) {
    const auto at = inTree(node.origin);
    if (!at) return;
    const Copy<Leaf> leaf(bytes_.subspan(node.offset, sizeof(Leaf)));
    if constexpr (kIsQuantised) {
      const double scale = map_.scale;
      const auto quantum = static_cast<float>(scale * static_cast<double>(leaf->mQuantum));
      const auto minimum =
          static_cast<float>(scale * static_cast<double>(leaf->mMinimum) + static_cast<double>(map_.offset));
      std::array<std::uint32_t, BrickTree::kSamplesPerBrick / 2> room{};
      const std::size_t size = payloadOf(node);
      std::memcpy(room.data(), bytes_.data() + node.offset + kCodesAt, size);
      const std::span<const std::uint32_t> words(room.data(), size / sizeof(std::uint32_t));
      const int log2Bits = log2BitsOf(node);
      for (std::uint32_t i = 0; i < BrickTree::kSamplesPerBrick; ++i) {
        const auto code = static_cast<float>(BrickTree::codeAt(words.data(), log2Bits, i));
        checked(code * quantum + minimum, static_cast<double>(code * leaf->mQuantum + leaf->mMinimum),
                [&] { return "voxel " + shown(voxel(node, i)); });
      }
      out_.tree.setBrick(*at, log2Bits, minimum, quantum, words);
    } else {
      std::array<float, BrickTree::kSamplesPerBrick> densities;
      for (std::uint32_t i = 0; i < BrickTree::kSamplesPerBrick; ++i) {
        densities[i] =
            density(static_cast<double>(leaf->mValues[i]), [&] { return "voxel " + shown(voxel(node, i)); });
      }
      out_.tree.setBrick(*at, densities);
    }
  }

  [[noreturn]] void refuse(const std::string& message) const {
    file_.refuse("grid \"" + out_.name + "\": " + message);
  }
  [[noreturn]] void corrupt(const std::string& what) const {
    file_.refuse("grid \"" + out_.name + "\" is corrupt: " + what);
  }

  /// Codes follow the head of a quantised leaf.
  static constexpr std::size_t kCodesAt = sizeof(nanovdb::LeafFnBase<nanovdb::Coord, nanovdb::Mask, 3>);

  const NanoVdbFile& file_;
  Bytes bytes_;
  DensityMap map_;
  NanoVdbGrid& out_;
  std::size_t rootOffset_ = 0;
  std::size_t limits_[3] = {};  ///< of leaves, lower and upper nodes
  float background_ = 0;
  BrickTree::Corner cubes_;
  std::vector<Tile> rootTiles_;
  std::vector<Node> uppers_, lowers_, leaves_;
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
  Reader<Build> reader(file, bytes, map, out);
  reader.survey(grid);
  if (out.hasActive) reader.fill();
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
  const auto corrupt = [&](const std::string& what) {
    file.refuse("grid \"" + info.name + "\" is corrupt: " + what);
  };
  if (bytes.size() < sizeof(nanovdb::GridData)) corrupt("it is shorter than its head");
  const Copy<nanovdb::GridData> grid(bytes);
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
