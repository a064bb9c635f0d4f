// SPDX-License-Identifier: BSD-2-Clause
#pragma once

// Seen by nano_vdb_reader.cpp only, which keeps NanoVDB's headers to itself.
#include <nanovdb/NanoVDB.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "base/vec.h"
#include "fields/brick_tree.h"
#include "fields/nano_vdb_file.h"

namespace pbrtmedia {

[[noreturn]] inline void refuseCorruptGrid(const NanoVdbFile& file, const std::string& name,
                                           const std::string& what) {
  file.refuse("grid \"" + name + "\" is corrupt: " + what);
}

/// An aligned copy of a structure of the file, where it may stand at any address.
template <class Data>
class NanoVdbCopy {
 public:
  explicit NanoVdbCopy(std::span<const std::byte> from) { std::memcpy(bytes_, from.data(), sizeof(Data)); }
  const Data& operator*() const { return *reinterpret_cast<const Data*>(bytes_); }
  const Data* operator->() const { return &**this; }

 private:
  alignas(alignof(Data)) std::byte bytes_[sizeof(Data)];
};

/// A node that the walk over the tree found.
struct NanoVdbNode {
  std::size_t offset;  ///< from the start of the grid
  Vec3<std::int64_t> origin;
};

/// A cube of 4096^3 voxels of one value.
struct NanoVdbRootTile {
  double value;
  Vec3<std::int64_t> origin;
};

/// The structure of a grid of one build type: its nodes, found and checked, so that all of them can be read.
/// Offsets are checked before they are followed, numbers of nodes against the bytes that are there, and the
/// checksums of version 32.4 are compared.
template <class Build>
class NanoVdbNodes {
  using Root = typename nanovdb::NanoRoot<Build>::DataType;
  using Tile = typename Root::Tile;
  using Bytes = std::span<const std::byte>;
  using IndexPoint = Vec3<std::int64_t>;
  template <class Data>
  using Copy = NanoVdbCopy<Data>;

 public:
  using Upper = typename nanovdb::NanoUpper<Build>::DataType;
  using Lower = typename nanovdb::NanoLower<Build>::DataType;
  using Leaf = typename nanovdb::NanoLeaf<Build>::DataType;
  static constexpr bool kIsQuantised = !std::is_floating_point_v<Build>;
  static constexpr std::int64_t kRootCube = 4096, kBlock = 128, kBrick = 8;  ///< voxels on an edge

  /// Walks over the tree of the grid that `bytes` hold, which outlive the nodes, as file and name do. Throws
  /// SceneError at the file when the grid is corrupt.
  NanoVdbNodes(const NanoVdbFile& file, const std::string& name, Bytes bytes, const nanovdb::GridData& grid)
      : file_(file), name_(name), bytes_(bytes) {
    const Copy<nanovdb::TreeData<3>> tree(
        part(sizeof(nanovdb::GridData), sizeof(nanovdb::TreeData<3>), "tree"));
    rootOffset_ = offsetFrom(sizeof(nanovdb::GridData), tree->mNodeOffset[3], sizeof(Root), "root");
    const Copy<Root> root(part(rootOffset_, sizeof(Root), "root"));
    const std::size_t tilesAt = rootOffset_ + sizeof(Root);
    if (root->mTableSize > (bytes_.size() - tilesAt) / sizeof(Tile)) {
      corrupt("its root announces " + std::to_string(root->mTableSize) + " tiles");
    }
    background_ = static_cast<double>(root->mBackground);
    checkHead(grid, tilesAt + root->mTableSize * sizeof(Tile));
    limitNodes(*tree);
    for (std::uint32_t i = 0; i < root->mTableSize; ++i) surveyTile(tilesAt + i * sizeof(Tile));
    checkTail(grid);
  }

  const std::vector<NanoVdbRootTile>& rootTiles() const { return rootTiles_; }
  const std::vector<NanoVdbNode>& uppers() const { return uppers_; }
  const std::vector<NanoVdbNode>& lowers() const { return lowers_; }
  const std::vector<NanoVdbNode>& leaves() const { return leaves_; }
  double background() const { return background_; }
  bool hasActive() const { return hasActive_; }  ///< some voxel or tile is active
  /// Box of the active voxels, both ends included.
  IndexPoint activeMin() const { return activeMin_; }
  IndexPoint activeMax() const { return activeMax_; }

  static IndexPoint blockOrigin(const NanoVdbNode& upper, std::uint32_t n) {
    return upper.origin + IndexPoint(n >> 10, n >> 5 & 31, n & 31) * kBlock;
  }
  static IndexPoint brickOrigin(const NanoVdbNode& lower, std::uint32_t n) {
    return lower.origin + IndexPoint(n >> 8, n >> 4 & 15, n & 15) * kBrick;
  }
  /// Bytes of a leaf's values.
  std::size_t payloadOf(const NanoVdbNode& node) const {
    if constexpr (kHasVariableBits) {
      return std::size_t{64} << log2BitsOf(node);  // 512 values
    } else if constexpr (kIsQuantised) {
      return Leaf::bitWidth() * 64u;
    } else {
      return 4 * BrickTree::kSamplesPerBrick;
    }
  }
  /// The number of bits per value of a quantised leaf, as a power of two: 0 to 4.
  int log2BitsOf(const NanoVdbNode& node) const {
    if constexpr (kHasVariableBits) {
      const unsigned log2Bits = Copy<Leaf>(bytes_.subspan(node.offset, sizeof(Leaf)))->mFlags >> 5;
      if (log2Bits > 4) corrupt("a leaf stores 2^" + std::to_string(log2Bits) + " bits per value");
      return static_cast<int>(log2Bits);
    } else {
      return std::countr_zero(static_cast<unsigned>(Leaf::bitWidth()));
    }
  }

 private:
  static constexpr bool kHasVariableBits = std::is_same_v<Build, nanovdb::FpN>;
  static constexpr std::uint32_t kNoChecksum = 0xffffffffu;
  static constexpr std::uint32_t kChecksumMinorVersion = 4;

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
  void addNode(std::vector<NanoVdbNode>& nodes, std::size_t level, NanoVdbNode node) const {
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
      rootTiles_.push_back({static_cast<double>(tile->value), origin});
      if (tile->state != 0)
        addActive(origin, origin + IndexPoint(kRootCube - 1, kRootCube - 1, kRootCube - 1));
      return;
    }
    const std::size_t upper =
        offsetFrom(rootOffset_, static_cast<std::uint64_t>(tile->child), sizeof(Upper), "node");
    addNode(uppers_, 2, {upper, origin});
    surveyUpper(uppers_.back());
  }

  void surveyUpper(const NanoVdbNode& node) {
    const Copy<Upper> upper(bytes_.subspan(node.offset, sizeof(Upper)));
    for (std::uint32_t n = 0; n < 32 * 32 * 32; ++n) {
      const IndexPoint origin = blockOrigin(node, n);
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

  void surveyLower(NanoVdbNode node) {
    const Copy<Lower> lower(bytes_.subspan(node.offset, sizeof(Lower)));
    for (std::uint32_t n = 0; n < 16 * 16 * 16; ++n) {
      const IndexPoint origin = brickOrigin(node, n);
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

  void surveyLeaf(const NanoVdbNode& node) {
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
    activeMin_ = hasActive_ ? min(activeMin_, lo) : lo;
    activeMax_ = hasActive_ ? max(activeMax_, hi) : hi;
    hasActive_ = true;
  }

  static std::uint32_t checksumOf(Bytes bytes) {
    return static_cast<std::uint32_t>(
        crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<z_size_t>(bytes.size())));
  }
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
    const auto add = [&](std::vector<NanoVdbNode> nodes, std::size_t size) {
      if (inMemoryOrder) {
        std::sort(nodes.begin(), nodes.end(),
                  [](const NanoVdbNode& a, const NanoVdbNode& b) { return a.offset < b.offset; });
      }
      for (const NanoVdbNode& node : nodes) sums.push_back(checksumOf(bytes_.subspan(node.offset, size)));
    };
    add(uppers_, sizeof(Upper));
    add(lowers_, sizeof(Lower));
    add(leaves_, sizeof(Leaf));
    if (checksumOf(std::as_bytes(std::span(sums))) != expected) corrupt("the checksum of its nodes is wrong");
  }
  bool rootIsEmpty() const { return rootTiles_.empty() && uppers_.empty(); }

  [[noreturn]] void corrupt(const std::string& what) const { refuseCorruptGrid(file_, name_, what); }

  const NanoVdbFile& file_;
  const std::string& name_;
  Bytes bytes_;
  std::size_t rootOffset_ = 0;
  std::size_t limits_[3] = {};  ///< of leaves, lower and upper nodes
  double background_ = 0;
  bool hasActive_ = false;
  IndexPoint activeMin_, activeMax_;
  std::vector<NanoVdbRootTile> rootTiles_;
  std::vector<NanoVdbNode> uppers_, lowers_, leaves_;
};

}  // namespace pbrtmedia
