// SPDX-License-Identifier: BSD-2-Clause
#include "fields/brick_tree.h"

#include <glog/logging.h>

#include <bit>
#include <limits>

namespace pbrtmedia {

BrickTree::BrickTree(Vec3<Index> rootCubes, float background) : rootCubes_(rootCubes) {
  CHECK(rootCubes.x > 0 && rootCubes.y > 0 && rootCubes.z > 0);
  CHECK_LE(rootCubes.x, kMaxRootCubes);
  CHECK_LE(rootCubes.y, kMaxRootCubes / rootCubes.x);
  CHECK_LE(rootCubes.z, kMaxRootCubes / (rootCubes.x * rootCubes.y));
  roots_.assign(rootCubes.x * rootCubes.y * rootCubes.z, uniformSlot(background));
}

std::uint32_t BrickTree::uniformSlot(float value) {
  // Tiles of a grid repeat few values, mostly the one just seen or the background; an exhaustive search would
  // make a file of many different ones quadratic.
  const auto isSame = [&](float known) {
    return std::bit_cast<std::uint32_t>(known) == std::bit_cast<std::uint32_t>(value);
  };
  if (!uniform_.empty() && isSame(uniform_.front())) return kUniform;
  if (uniform_.empty() || !isSame(uniform_.back())) uniform_.push_back(value);
  CHECK_LE(uniform_.size(), std::size_t{kUniform});
  return kUniform | static_cast<std::uint32_t>(uniform_.size() - 1);
}

std::uint32_t& BrickTree::blockSlot(Corner at) {
  std::uint32_t& root = rootSlot(at);
  if ((root & kUniform) != 0) {
    const std::uint32_t filled = root;
    root = static_cast<std::uint32_t>(blocks_.size() / kBlocksPerRoot);
    blocks_.resize(blocks_.size() + kBlocksPerRoot, filled);
  }
  return blocks_[root * kBlocksPerRoot + blockInRoot(at.x, at.y, at.z)];
}

std::uint32_t& BrickTree::brickSlot(Corner at) {
  std::uint32_t& block = blockSlot(at);
  if ((block & kUniform) != 0) {
    const std::uint32_t filled = block;
    CHECK_LT(brickSlots_.size() / kBricksPerBlock, std::size_t{kUniform});
    block = static_cast<std::uint32_t>(brickSlots_.size() / kBricksPerBlock);
    brickSlots_.resize(brickSlots_.size() + kBricksPerBlock, filled);
  }
  return brickSlots_[block * kBricksPerBlock + brickInBlock(at.x, at.y, at.z)];
}

void BrickTree::reserve(std::size_t bricks, std::size_t floats, std::size_t words) {
  bricks_.reserve(bricks);
  floats_.reserve(floats);
  words_.reserve(words);
}

void BrickTree::setRootCube(Corner at, float value) { rootSlot(at) = uniformSlot(value); }
void BrickTree::setBlock(Corner at, float value) { blockSlot(at) = uniformSlot(value); }
void BrickTree::setBrick(Corner at, float value) { brickSlot(at) = uniformSlot(value); }

void BrickTree::setBrick(Corner at, std::span<const float> values) {
  CHECK_EQ(values.size(), kSamplesPerBrick);
  Brick brick{.first = floats_.size()};
  floats_.insert(floats_.end(), values.begin(), values.end());
  addBrick(at, brick);
}

void BrickTree::setBrick(Corner at, int log2Bits, float minimum, float quantum,
                         std::span<const std::uint32_t> words) {
  CHECK(log2Bits >= 0 && log2Bits <= 4);
  CHECK_EQ(words.size(), kSamplesPerBrick >> (5 - log2Bits));
  Brick brick{.first = words_.size(), .minimum = minimum, .quantum = quantum, .log2Bits = log2Bits};
  words_.insert(words_.end(), words.begin(), words.end());
  addBrick(at, brick);
}

void BrickTree::addBrick(Corner at, Brick brick) {
  brick.lower = std::numeric_limits<float>::infinity();
  brick.upper = -std::numeric_limits<float>::infinity();
  for (std::uint32_t i = 0; i < kSamplesPerBrick; ++i) {
    const float v = brick.log2Bits < 0 ? floats_[brick.first + i] : decode(brick, i);
    brick.lower = std::min(brick.lower, v);
    brick.upper = std::max(brick.upper, v);
  }
  if (brick.lower == brick.upper) {
    (brick.log2Bits < 0 ? floats_.resize(brick.first) : words_.resize(brick.first));
    return setBrick(at, brick.lower);
  }
  CHECK_LT(bricks_.size(), std::size_t{kUniform});
  brickSlot(at) = static_cast<std::uint32_t>(bricks_.size());
  bricks_.push_back(brick);
}

void BrickTree::cornersAcrossBricks(Index x, Index y, Index z, float out[8]) const {
  // Two corners next to each other on an axis share their brick unless the axis crosses a face.
  const bool split[3] = {(x & 7) == 7, (y & 7) == 7, (z & 7) == 7};
  std::uint32_t slots[8];
  for (unsigned i = 0; i < 8; ++i) {
    const Index dx = i >> 2, dy = i >> 1 & 1, dz = i & 1;
    // The corner of the same brick that was found first.
    const unsigned known = (split[0] ? i & 4 : 0) | (split[1] ? i & 2 : 0) | (split[2] ? i & 1 : 0);
    slots[i] = known < i ? slots[known] : slotAt(x + dx, y + dy, z + dz);
    out[i] = valueIn(slots[i], offsetInBrick(x + dx, y + dy, z + dz));
  }
}

/// Sums the samples of a box with the weights of the trapezoid rule, exact for the trilinear interpolant.
struct BrickTree::Accumulator {
  Corner lo, hi;  ///< the whole box
  float lower = std::numeric_limits<float>::infinity(), upper = -std::numeric_limits<float>::infinity();
  double sum = 0;

  double weight(std::size_t axis, Index at) const {
    if (lo[axis] == hi[axis]) return 1;
    return at == lo[axis] || at == hi[axis] ? 0.5 : 1.0;
  }
  /// Sum of the weights from `first` to `last`, both included.
  double weight(std::size_t axis, Index first, Index last) const {
    if (lo[axis] == hi[axis]) return 1;
    const double ends = (first == lo[axis] ? 0.5 : 0.0) + (last == hi[axis] ? 0.5 : 0.0);
    return static_cast<double>(last - first + 1) - ends;
  }
  double boxWeight(Corner first, Corner last) const {
    return weight(0, first.x, last.x) * weight(1, first.y, last.y) * weight(2, first.z, last.z);
  }
  void addUniform(float value, Corner first, Corner last) {
    lower = std::min(lower, value);
    upper = std::max(upper, value);
    sum += static_cast<double>(value) * boxWeight(first, last);
  }
};

namespace {

/// Calls visit(first, last) for the parts of the box lo..hi in each aligned cube of `size` samples.
template <class Visit>
void forEachCube(BrickTree::Corner lo, BrickTree::Corner hi, BrickTree::Index size, const Visit& visit) {
  using Index = BrickTree::Index;
  const auto next = [size](Index at) { return (at / size + 1) * size; };
  for (Index x = lo.x; x <= hi.x; x = next(x)) {
    for (Index y = lo.y; y <= hi.y; y = next(y)) {
      for (Index z = lo.z; z <= hi.z; z = next(z)) {
        visit(BrickTree::Corner{x, y, z},
              BrickTree::Corner{std::min(hi.x, next(x) - 1), std::min(hi.y, next(y) - 1),
                                std::min(hi.z, next(z) - 1)});
      }
    }
  }
}

}  // namespace

BrickTree::Summary BrickTree::summary(Corner lo, Corner hi) const {
  Accumulator sum;
  sum.lo = lo;
  sum.hi = hi;
  forEachCube(lo, hi, kRoot, [&](Corner rootLo, Corner rootHi) {
    const std::uint32_t root = roots_[rootIndex(rootLo.x, rootLo.y, rootLo.z)];
    if ((root & kUniform) != 0) return sum.addUniform(uniform_[root & ~kUniform], rootLo, rootHi);
    forEachCube(rootLo, rootHi, kBlock, [&](Corner blockLo, Corner blockHi) {
      const std::uint32_t block =
          blocks_[root * kBlocksPerRoot + blockInRoot(blockLo.x, blockLo.y, blockLo.z)];
      if ((block & kUniform) != 0) return sum.addUniform(uniform_[block & ~kUniform], blockLo, blockHi);
      forEachCube(blockLo, blockHi, kBrick, [&](Corner brickLo, Corner brickHi) {
        summarise(brickSlots_[block * kBricksPerBlock + brickInBlock(brickLo.x, brickLo.y, brickLo.z)],
                  brickLo, brickHi, sum);
      });
    });
  });
  Summary result{.lower = sum.lower, .upper = sum.upper};
  result.mean = std::clamp<double>(sum.sum / sum.boxWeight(lo, hi), result.lower, result.upper);
  return result;
}

void BrickTree::summarise(std::uint32_t slot, Corner lo, Corner hi, Accumulator& sum) const {
  if ((slot & kUniform) != 0) return sum.addUniform(uniform_[slot & ~kUniform], lo, hi);
  const Brick& brick = bricks_[slot];
  const bool whole = hi.x - lo.x == 7 && hi.y - lo.y == 7 && hi.z - lo.z == 7;
  float lower = brick.lower, upper = brick.upper;
  if (!whole) std::swap(lower, upper);  // from nothing: shrinks to what the part holds
  for (Index x = lo.x; x <= hi.x; ++x) {
    for (Index y = lo.y; y <= hi.y; ++y) {
      double row = 0;
      for (Index z = lo.z; z <= hi.z; ++z) {
        const float v = valueIn(slot, offsetInBrick(x, y, z));
        row += sum.weight(2, z) * static_cast<double>(v);
        if (whole) continue;
        lower = std::min(lower, v);
        upper = std::max(upper, v);
      }
      sum.sum += sum.weight(0, x) * sum.weight(1, y) * row;
    }
  }
  sum.lower = std::min(sum.lower, lower);
  sum.upper = std::max(sum.upper, upper);
}

std::size_t BrickTree::bytes() const {
  return (uniform_.size() + floats_.size()) * sizeof(float) + bricks_.size() * sizeof(Brick) +
         (roots_.size() + blocks_.size() + brickSlots_.size() + words_.size()) * sizeof(std::uint32_t);
}

}  // namespace pbrtmedia
