// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bounds.h"

namespace pbrtmedia {

/// Rows [first, end) of pixels.
struct RowRange {
  int first = 0, end = 0;
  bool isEmpty() const { return first >= end; }
  int count() const { return isEmpty() ? 0 : end - first; }
};

/// How ranks share a pass: each takes the samples of some tiles, wherever they lie, so that all are done at
/// about the same time, and sums a band of rows of the film, always the same one, for which others send it
/// their samples. So a pixel's sum is made by one rank, in the order of one process.
class PassShares {
 public:
  struct Plan {
    std::size_t ranks = 1;
    std::vector<Bounds2i> tiles{};  ///< of samples
    Bounds2i film{};                ///< pixels
    /// Rows of samples that reach a pixel, relative to its row.
    int firstNeighbour = 0, lastNeighbour = 0;
  };
  explicit PassShares(Plan plan);

  /// Squares of `edge` pixels over `bounds`, row by row; those at its end may be smaller.
  static std::vector<Bounds2i> tilesOf(Bounds2i bounds, int edge);
  /// `edge`, or less where so many threads, of all ranks, could not share such tiles evenly.
  static int tileEdge(const Bounds2i& bounds, int edge, std::uint64_t threads);

  std::size_t ranks() const { return plan_.ranks; }
  const std::vector<Bounds2i>& tiles() const { return plan_.tiles; }
  /// Of the film, that a rank sums. Where there are more ranks than rows some have none.
  RowRange summedBy(std::size_t rank) const;
  /// Of samples, that it needs for that.
  RowRange neededBy(std::size_t rank) const;
  /// Whether a value at a row of samples reaches a rank's rows.
  bool needs(std::size_t rank, int row) const;

  /// Numbers of the tiles whose samples a rank takes, in rising order.
  std::span<const std::size_t> takenBy(std::size_t rank) const { return taken_[rank]; }
  /// The parts of a rank's tiles that another needs, in their order.
  std::vector<Bounds2i> sent(std::size_t from, std::size_t to) const;
  /// Other ranks of whose tiles a rank needs a part, in rising order.
  std::vector<std::size_t> sendersTo(std::size_t rank) const;

  /// Shares tiles anew by what each has cost so far, in any unit: the dearest first, each to the rank with
  /// the least so far. A function of its arguments alone, so that ranks that know the same agree.
  void balance(std::span<const std::uint64_t> costs);

 private:
  Plan plan_;
  std::vector<std::vector<std::size_t>> taken_;  ///< by ranks
};

}  // namespace pbrtmedia
