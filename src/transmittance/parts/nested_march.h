// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "base/hash.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/comb.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// A march whose 2^splits * teeth look-ups are a binary tree of combs: the whole comb splits into two halves,
/// each of which is a comb of half the teeth, and so on down to the leaves of `teeth` teeth. Over its random
/// numbers and the choice among its siblings, every part has the distribution of a march of its size made
/// alone, so the mean of g over the parts of one size estimates E[g(march of that size)] without bias.
///
/// How a comb splits (Misso et al. 2022, section 5.2, after Blanchet & Glynn 2015, leave this open):
///   equidistant  its odd and its even teeth, which again have one offset and equal steps;
///   stratified   of each pair of neighbouring strata one half takes a random one (odd and even strata would
///                leave gaps that a jittered march of half the teeth does not have: a bias);
///   independent  anyhow;
///   golden ratio its first and its second half, whose offset is uniform again.
///
/// Look-ups: in batches, memory of one batch whatever the size. Random numbers: one uniform for the combs of
/// one offset, one per tooth for the others; the random choices are hashed from a key outside the dimensions.
class NestedMarch {
 public:
  /// teeth >= 1, teeth * 2^splits <= 2^40.
  NestedMarch(Comb comb, std::uint64_t teeth, unsigned splits)
      : comb_(comb), splits_(splits), teeth_(teeth), leaves_(std::uint64_t{1} << splits) {}

  std::uint64_t lookups() const { return teeth_ * leaves_; }

  /// Calls leaf(column) for all leaves from left to right in the tree: the parts of size teeth * 2^i are the
  /// runs of 2^i leaves that begin at multiples of 2^i, and their columns are the means of those of the
  /// leaves. column: estimate of the integral of the density over the line (unit of s).
  template <DensityLine Line, class Leaf>
  void operator()(const Line& line, SampleStream& stream, LookupTally& tally, Leaf&& leaf) const {
    const bool oneOffset = comb_ == Comb::Equidistant || comb_ == Comb::GoldenRatio;
    const double offset = oneOffset ? stream.uniform() : 0;
    const std::uint64_t key = comb_ == Comb::Stratified ? stream.rng().next() : 0, all = lookups();
    const double scale = line.length() / static_cast<double>(teeth_);
    std::array<double, kBatch> s;
    std::array<DensityOf<Line>, kBatch> density;
    std::uint64_t inLeaf = 0, leafIndex = 0, tooth = 0;  // of the tooth placed next
    double sum = 0;
    for (std::uint64_t first = 0; first < all; first += kBatch) {
      const auto n = static_cast<std::size_t>(std::min<std::uint64_t>(kBatch, all - first));
      for (std::size_t i = 0; i < n; ++i) {
        s[i] =
            std::min(place(leafIndex, tooth, first + i, offset, key, stream) * line.length(), line.length());
        if (++tooth == teeth_) {
          tooth = 0;
          ++leafIndex;
        }
      }
      line.densities(std::span<const double>(s).first(n), std::span(density).first(n));
      for (std::size_t i = 0; i < n; ++i) {
        sum += static_cast<double>(density[i]);
        if (++inLeaf == teeth_) {
          leaf(sum * scale);
          inLeaf = 0;
          sum = 0;
        }
      }
    }
    tally.lookups += all;
  }

 private:
  static constexpr std::size_t kBatch = 256;

  /// Position in [0, 1] of a tooth of a leaf, the `order`-th of all that are placed.
  double place(std::uint64_t leaf, std::uint64_t tooth, std::uint64_t order, double offset, std::uint64_t key,
               SampleStream& stream) const {
    const double total = static_cast<double>(lookups());
    switch (comb_) {
      case Comb::Equidistant:
        return (static_cast<double>(tooth * leaves_ + reversed(leaf)) + offset) / total;
      case Comb::Stratified:
        return (static_cast<double>(tooth * leaves_ + scrambled(reversed(leaf), hashCombine(key, tooth))) +
                stream.uniform()) /
               total;
      case Comb::Independent:
        return stream.uniform();
      case Comb::GoldenRatio:
        break;
    }
    constexpr double kGolden = 0.61803398874989484820;
    const double turns = offset + static_cast<double>(order) * kGolden;
    return turns - std::floor(turns);
  }

  /// The lowest `splits` bits in reverse order: siblings of the last split are farthest apart.
  std::uint64_t reversed(std::uint64_t leaf) const {
    std::uint64_t result = 0;
    for (unsigned bit = 0; bit < splits_; ++bit) result = result << 1 | (leaf >> bit & 1);
    return result;
  }
  /// Turns each bit by a random one that depends on the bits above: among two neighbouring strata of any
  /// size, which one comes first is random and independent of all other pairs of that size.
  std::uint64_t scrambled(std::uint64_t index, std::uint64_t key) const {
    std::uint64_t result = 0;
    for (unsigned bit = splits_; bit-- > 0;) {
      const std::uint64_t above = std::uint64_t{1} << (splits_ - 1 - bit) | result;  // bits and their number
      result = result << 1 | ((index >> bit ^ hashCombine(key, above)) & 1);
    }
    return result;
  }

  Comb comb_;
  unsigned splits_;
  std::uint64_t teeth_, leaves_;
};

}  // namespace pbrtmedia
