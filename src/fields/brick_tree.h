// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vec.h"

namespace pbrtmedia {

/// Values on a sparse lattice of whole numbers: a tree of the shape of a VDB (Museth 2013,
/// doi:10.1145/2487228.2487235) whose root covers cubes of 4096 samples, its children cubes of 128, theirs
/// bricks of 8; a cube of one value is stored as that value at the level where it appears. Bricks hold floats
/// or quantised codes. A look-up goes down three tables without a search, so it needs no cache and is
/// thread-safe.
///
/// Lattice coordinates here begin at 0; cubes and bricks are aligned to their size.
class BrickTree {
 public:
  using Index = std::uint64_t;
  using Corner = Vec3<Index>;
  static constexpr Index kBrick = 8, kBlock = 128,
                         kRoot = 4096;  ///< samples per edge of a cube of each level
  static constexpr std::size_t kSamplesPerBrick = 512;
  /// Largest number of root cubes: 2^20 cost 4 MiB and span 417,000 samples on every axis.
  static constexpr Index kMaxRootCubes = Index{1} << 20;

  /// A lattice of `rootCubes` cubes of 4096 samples per axis, the product of which is at most kMaxRootCubes;
  /// every value is `background`.
  BrickTree(Vec3<Index> rootCubes, float background);
  BrickTree() : BrickTree({1, 1, 1}, 0) {}

  // Building; not thread-safe. A cube is named by any sample in it.
  /// Makes room for bricks of `floats` floats and `words` words of codes in all.
  void reserve(std::size_t bricks, std::size_t floats, std::size_t words);
  void setRootCube(Corner at, float value);
  void setBlock(Corner at, float value);  ///< of 128 samples
  void setBrick(Corner at, float value);
  /// 512 values, z fastest, then y, then x.
  void setBrick(Corner at, std::span<const float> values);
  /// 512 codes of 2^log2Bits bits, 0 <= log2Bits <= 4, packed from the low bits of 32-bit words up, in the
  /// same order; a value is code * quantum + minimum.
  void setBrick(Corner at, int log2Bits, float minimum, float quantum, std::span<const std::uint32_t> words);
  /// Code number `offset` of a brick's words.
  static std::uint32_t codeAt(const std::uint32_t* words, int log2Bits, std::uint32_t offset) {
    const std::uint32_t perWord = 5u - static_cast<std::uint32_t>(log2Bits);  // log2 of the codes in a word
    const std::uint32_t bits = 1u << log2Bits;
    return words[offset >> perWord] >> ((offset & ((1u << perWord) - 1)) * bits) & ((1u << bits) - 1);
  }

  /// The value of one sample inside the lattice.
  float value(Index x, Index y, Index z) const { return valueIn(slotAt(x, y, z), offsetInBrick(x, y, z)); }
  /// The values of the 8 samples from (x, y, z) to (x + 1, y + 1, z + 1), all inside the lattice, z fastest,
  /// then y. True when all are known to be equal; then only the first is written.
  bool corners(Index x, Index y, Index z, float out[8]) const {
    const bool inOneBrick = (x & 7) < 7 && (y & 7) < 7 && (z & 7) < 7;
    if (!inOneBrick) {
      cornersAcrossBricks(x, y, z, out);
      return false;
    }
    const std::uint32_t slot = slotAt(x, y, z);
    if ((slot & kUniform) != 0) {
      out[0] = uniform_[slot & ~kUniform];
      return true;
    }
    const Brick& brick = bricks_[slot];
    const std::uint32_t at = offsetInBrick(x, y, z);
    constexpr std::uint32_t kSteps[8] = {0, 1, 8, 9, 64, 65, 72, 73};
    if (brick.log2Bits < 0) {
      const float* samples = floats_.data() + brick.first + at;
      for (int i = 0; i < 8; ++i) out[i] = samples[kSteps[i]];
    } else {
      for (int i = 0; i < 8; ++i) out[i] = decode(brick, at + kSteps[i]);
    }
    return false;
  }

  /// What the samples of a box hold.
  struct Summary {
    float lower = 0, upper = 0;
    double mean = 0;  ///< of the trilinear interpolant over the box
  };
  /// Over the samples lo..hi, both included, lo <= hi on every axis; an axis with lo = hi counts as flat.
  /// Cost: the stored cubes that overlap, not the volume.
  Summary summary(Corner lo, Corner hi) const;

  Vec3<Index> rootCubes() const { return rootCubes_; }
  std::size_t brickCount() const { return bricks_.size(); }
  std::size_t bytes() const;

 private:
  static constexpr std::uint32_t kUniform = 0x80000000u;  ///< marks a slot that holds a value, not a child
  static constexpr std::size_t kBlocksPerRoot = 32 * 32 * 32, kBricksPerBlock = 16 * 16 * 16;

  struct Brick {
    std::size_t first = 0;  ///< in floats_ or words_
    float minimum = 0, quantum = 0;
    std::int32_t log2Bits = -1;  ///< -1: floats
    float lower = 0, upper = 0;
  };
  struct Accumulator;

  static std::uint32_t offsetInBrick(Index x, Index y, Index z) {
    return static_cast<std::uint32_t>((x & 7) << 6 | (y & 7) << 3 | (z & 7));
  }
  static std::size_t blockInRoot(Index x, Index y, Index z) {
    return (x >> 7 & 31) << 10 | (y >> 7 & 31) << 5 | (z >> 7 & 31);
  }
  static std::size_t brickInBlock(Index x, Index y, Index z) {
    return (x >> 3 & 15) << 8 | (y >> 3 & 15) << 4 | (z >> 3 & 15);
  }
  std::size_t rootIndex(Index x, Index y, Index z) const {
    return ((x >> 12) * rootCubes_.y + (y >> 12)) * rootCubes_.z + (z >> 12);
  }
  /// A brick's number, or kUniform with the number of a value.
  std::uint32_t slotAt(Index x, Index y, Index z) const {
    const std::uint32_t root = roots_[rootIndex(x, y, z)];
    if ((root & kUniform) != 0) return root;
    const std::uint32_t block = blocks_[root * kBlocksPerRoot + blockInRoot(x, y, z)];
    if ((block & kUniform) != 0) return block;
    return brickSlots_[block * kBricksPerBlock + brickInBlock(x, y, z)];
  }
  float valueIn(std::uint32_t slot, std::uint32_t offset) const {
    if ((slot & kUniform) != 0) return uniform_[slot & ~kUniform];
    const Brick& brick = bricks_[slot];
    return brick.log2Bits < 0 ? floats_[brick.first + offset] : decode(brick, offset);
  }
  float decode(const Brick& brick, std::uint32_t offset) const {
    return static_cast<float>(codeAt(words_.data() + brick.first, brick.log2Bits, offset)) * brick.quantum +
           brick.minimum;
  }
  void cornersAcrossBricks(Index x, Index y, Index z, float out[8]) const;
  std::uint32_t uniformSlot(float value);
  std::uint32_t& rootSlot(Corner at) { return roots_[rootIndex(at.x, at.y, at.z)]; }
  std::uint32_t& blockSlot(Corner at);
  std::uint32_t& brickSlot(Corner at);
  void addBrick(Corner at, Brick brick);
  void summarise(std::uint32_t slot, Corner lo, Corner hi, Accumulator& sum) const;

  Vec3<Index> rootCubes_;
  std::vector<float> uniform_;             ///< the values of cubes of one value
  std::vector<std::uint32_t> roots_;       ///< z fastest
  std::vector<std::uint32_t> blocks_;      ///< 32^3 for each root cube that has children
  std::vector<std::uint32_t> brickSlots_;  ///< 16^3 for each block that has children
  std::vector<Brick> bricks_;
  std::vector<float> floats_;
  std::vector<std::uint32_t> words_;
};

}  // namespace pbrtmedia
