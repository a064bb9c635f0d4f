// SPDX-License-Identifier: BSD-2-Clause
#include "fields/brick_tree.h"

#include <gtest/gtest.h>

#include <array>
#include <map>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

using Index = BrickTree::Index;
using Corner = BrickTree::Corner;
using Values = std::array<float, BrickTree::kSamplesPerBrick>;

Values randomValues(std::uint64_t seed) {
  Rng rng(seed);
  Values values;
  for (float& v : values) v = rng.uniform();
  return values;
}

/// Background 0.5; a brick of floats, one of codes beside it, tiles of every level.
BrickTree mixedTree() {
  BrickTree tree({2, 1, 1}, 0.5f);
  tree.setRootCube({4096, 0, 0}, 4);
  tree.setBlock({128, 0, 0}, 3);
  tree.setBrick({16, 0, 0}, 2);
  tree.setBrick({0, 0, 0}, randomValues(1));
  std::array<std::uint32_t, 512 * 4 / 32> words;
  for (std::uint32_t i = 0; i < words.size(); ++i) words[i] = 0x76543210u ^ (0x11111111u * (i % 15));
  tree.setBrick({8, 0, 0}, 2, 10, 0.25f, words);
  return tree;
}

TEST(BrickTree, FindsTheValueOfEveryLevel) {
  const BrickTree tree = mixedTree();
  const Values floats = randomValues(1);
  EXPECT_EQ(tree.value(0, 0, 0), floats[0]);
  EXPECT_EQ(tree.value(1, 2, 3), floats[1 * 64 + 2 * 8 + 3]);
  EXPECT_EQ(tree.value(8, 0, 0), 10.0f);
  EXPECT_EQ(tree.value(8, 0, 7), 10.0f + 7 * 0.25f);
  EXPECT_EQ(tree.value(16, 7, 7), 2.0f);
  EXPECT_EQ(tree.value(24, 0, 0), 0.5f);
  EXPECT_EQ(tree.value(128, 127, 3), 3.0f);
  EXPECT_EQ(tree.value(300, 0, 0), 0.5f);
  EXPECT_EQ(tree.value(4096, 4095, 17), 4.0f);
  EXPECT_EQ(tree.brickCount(), 2u);
}

TEST(BrickTree, UnpacksCodesOfEveryWidth) {
  for (int log2Bits = 0; log2Bits <= 4; ++log2Bits) {
    const std::uint32_t bits = 1u << log2Bits, mask = (1u << bits) - 1;
    std::vector<std::uint32_t> words(BrickTree::kSamplesPerBrick * bits / 32, 0);
    std::vector<std::uint32_t> codes;
    Rng rng(7);
    for (std::uint32_t i = 0; i < BrickTree::kSamplesPerBrick; ++i) {
      codes.push_back(rng.uniformInt(65536) & mask);
      words[i * bits / 32] |= codes.back() << (i * bits % 32);
    }
    BrickTree tree;
    tree.setBrick({0, 0, 0}, log2Bits, -1, 0.5f, words);
    for (std::uint32_t i = 0; i < BrickTree::kSamplesPerBrick; ++i) {
      ASSERT_EQ(tree.value(i >> 6, i >> 3 & 7, i & 7), static_cast<float>(codes[i]) * 0.5f - 1)
          << log2Bits << " bits, value " << i;
    }
  }
}

TEST(BrickTree, AnswersTheEightCornersAsOneByOneAlsoAcrossBricks) {
  const BrickTree tree = mixedTree();
  Rng rng(3);
  for (int n = 0; n < 20000; ++n) {
    const Index x = n % 4 == 0 ? 4088 + rng.uniformInt(10) : rng.uniformInt(300), y = rng.uniformInt(140),
                z = rng.uniformInt(30);
    float out[8];
    const bool equal = tree.corners(x, y, z, out);
    for (unsigned i = 0; i < 8; ++i) {
      ASSERT_EQ(out[equal ? 0 : i], tree.value(x + (i >> 2), y + (i >> 1 & 1), z + (i & 1)))
          << x << ' ' << y << ' ' << z << " corner " << i;
    }
  }
}

TEST(BrickTree, StoresABrickOfOneValueAsATile) {
  BrickTree tree;
  Values same;
  same.fill(7);
  tree.setBrick({8, 8, 8}, same);
  EXPECT_EQ(tree.brickCount(), 0u);
  EXPECT_EQ(tree.value(15, 8, 9), 7.0f);
}

TEST(BrickTree, SummarisesBoxesAsTheirSamplesTell) {
  const BrickTree tree = mixedTree();
  Rng rng(5);
  for (int n = 0; n < 400; ++n) {
    Corner lo, hi;
    for (std::size_t a = 0; a < 3; ++a) {
      lo[a] = rng.uniformInt(a == 0 ? 140 : 20);
      hi[a] = lo[a] + rng.uniformInt(n % 3 == 0 ? 3 : 12);
    }
    double sum = 0, weights = 0;
    float lower = tree.value(lo.x, lo.y, lo.z), upper = lower;
    const auto weight = [&](std::size_t a, Index at) {
      return lo[a] == hi[a] ? 1.0 : (at == lo[a] || at == hi[a] ? 0.5 : 1.0);
    };
    for (Index x = lo.x; x <= hi.x; ++x) {
      for (Index y = lo.y; y <= hi.y; ++y) {
        for (Index z = lo.z; z <= hi.z; ++z) {
          const float v = tree.value(x, y, z);
          const double w = weight(0, x) * weight(1, y) * weight(2, z);
          lower = std::min(lower, v);
          upper = std::max(upper, v);
          sum += w * static_cast<double>(v);
          weights += w;
        }
      }
    }
    const BrickTree::Summary summary = tree.summary(lo, hi);
    ASSERT_EQ(summary.lower, lower) << lo << hi;
    ASSERT_EQ(summary.upper, upper) << lo << hi;
    ASSERT_NEAR(summary.mean, sum / weights, 1e-9) << lo << hi;
  }
}

TEST(BrickTree, SummarisesHugeBoxesOfTilesWithoutVisitingTheirSamples) {
  BrickTree tree({64, 64, 64}, 0);
  tree.setRootCube({4096, 0, 0}, 8);
  const BrickTree::Summary all = tree.summary({0, 0, 0}, {64 * 4096 - 1, 64 * 4096 - 1, 64 * 4096 - 1});
  EXPECT_EQ(all.upper, 8.0f);
  EXPECT_EQ(all.lower, 0.0f);
  // One cube of 64^3; half a sample is missing at y = 0 and z = 0.
  const double edge = 64 * 4096 - 1;
  EXPECT_NEAR(all.mean, 8 * 4096 * 4095.5 * 4095.5 / (edge * edge * edge), 1e-12);
}

TEST(BrickTree, AddressesMoreSamplesThanThirtyTwoBitsCount) {
  BrickTree tree({1, 1, 1024}, 0);
  const Values values = randomValues(9);
  const Index far = 1024 * 4096 - 8;  // 4096^2 * 4194304 = 7e13 samples
  tree.setBrick({4088, 4088, far}, values);
  EXPECT_EQ(tree.value(4095, 4095, far + 7), values[511]);
  EXPECT_EQ(tree.value(4095, 4095, far - 1), 0.0f);
  EXPECT_LT(tree.bytes(), std::size_t{1} << 20);
}

}  // namespace
}  // namespace pbrtmedia
