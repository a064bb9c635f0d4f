// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory_resource>
#include <span>
#include <vector>

#include "fields/density_line.h"

namespace pbrtmedia {

/// One interval of a profile. Densities as in SuperVoxel, but a known mean is raised to kLeastMean of the
/// majorant, so that no density is out of reach of points spread by it, even where a stored mean is rounded
/// or guessed to 0. Integrals (density times the unit of s) are those over everything before the interval.
struct BoundPiece {
  static constexpr double kLeastMean = 0x1p-10;  ///< hardly ever active: one sample in 8^3 is more

  double sEnter, sExit;
  double upper, lower, mean;
  double upperBefore, lowerBefore, meanBefore;

  double length() const { return sExit - sEnter; }
};

/// The bounds along one line with their running integrals: what estimators need that place points out of
/// order, know the whole optical depth beforehand, or warp their points. Walks the line once; no heap memory
/// up to kInPlace intervals. Lives on the stack of one estimate.
class BoundProfile {
 public:
  static constexpr std::size_t kInPlace = 64;

  /// The densities that points can be distributed by.
  enum class Weight {
    Upper,   ///< the majorant
    Excess,  ///< majorant - minorant
    Mean     ///< the mean, see hasMeans()
  };
  struct Place {
    double s;
    const BoundPiece* piece;
  };

  template <DensityLine Line>
  explicit BoundProfile(const Line& line) : memory_(&buffer_, sizeof buffer_), pieces_(&memory_) {
    pieces_.reserve(kInPlace);
    line.walk([&](double sEnter, double sExit, const auto& bound) {
      const double length = sExit - sEnter;
      hasMeans_ = hasMeans_ && bound.hasMean();
      const double mean =
          bound.hasMean() ? std::max<double>(bound.mean, BoundPiece::kLeastMean * bound.upper) : bound.mean;
      pieces_.push_back({sEnter, sExit, bound.upper, bound.lower, mean, upper_, lower_, mean_});
      upper_ += length * static_cast<double>(bound.upper);
      lower_ += length * static_cast<double>(bound.lower);
      mean_ += length * mean;
      length_ = sExit;
      return true;
    });
  }
  BoundProfile(const BoundProfile&) = delete;
  BoundProfile& operator=(const BoundProfile&) = delete;

  std::span<const BoundPiece> pieces() const { return pieces_; }
  double length() const { return length_; }
  double upper() const { return upper_; }  ///< integral of the majorant
  double lower() const { return lower_; }  ///< integral of the minorant
  double excess() const { return std::max(upper_ - lower_, 0.0); }
  double mean() const { return mean_; }  ///< integral of the (raised) means; meaningful if hasMeans()
  bool hasMeans() const { return hasMeans_; }
  double total(Weight weight) const {
    return weight == Weight::Upper ? upper() : weight == Weight::Excess ? excess() : mean();
  }
  static double densityOf(const BoundPiece& piece, Weight weight) {
    return weight == Weight::Upper    ? piece.upper
           : weight == Weight::Excess ? piece.upper - piece.lower
                                      : piece.mean;
  }
  static double before(const BoundPiece& piece, Weight weight) {
    return weight == Weight::Upper    ? piece.upperBefore
           : weight == Weight::Excess ? piece.upperBefore - piece.lowerBefore
                                      : piece.meanBefore;
  }

  /// Where the integral of the weight from 0 reaches `amount`, 0 <= amount <= total(weight), total > 0. The
  /// piece found has a positive weight.
  Place place(Weight weight, double amount) const {
    // The last piece that begins at or below the amount and has weight of its own.
    auto after = std::upper_bound(
        pieces_.begin(), pieces_.end(), amount,
        [&](double value, const BoundPiece& piece) { return value < before(piece, weight); });
    auto at = after == pieces_.begin() ? after : after - 1;
    while (at != pieces_.begin() && !(densityOf(*at, weight) > 0)) --at;
    while (at + 1 != pieces_.end() && !(densityOf(*at, weight) > 0)) ++at;
    const double s = at->sEnter + (amount - before(*at, weight)) / densityOf(*at, weight);
    return {std::clamp(s, at->sEnter, at->sExit), &*at};
  }

 private:
  alignas(BoundPiece) std::array<std::byte, kInPlace * sizeof(BoundPiece)> buffer_;
  std::pmr::monotonic_buffer_resource memory_;
  std::pmr::vector<BoundPiece> pieces_;
  double upper_ = 0, lower_ = 0, mean_ = 0, length_ = 0;
  bool hasMeans_ = true;
};

}  // namespace pbrtmedia
