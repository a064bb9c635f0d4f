// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/hashed_permutation.h"
#include "samplers/sampler.h"

namespace pbrtmedia {

/// Sampler "stratified": the samples of a pixel visit each cell of an xSamples x ySamples grid (for single
/// numbers: each of xSamples*ySamples intervals) once, in an order that is a hashed permutation of its own in
/// every slot. Samples after the last begin a new round with new orders.
class StratifiedSampler final : public Sampler {
 public:
  struct Params {
    int xSamples = 4, ySamples = 4;  ///< >= 1
    bool jitter = true;              ///< false: cell centres
    int dimensions = 4;              ///< 1D slots and 2D slots (counted apart) that are stratified; >= 0
    std::uint64_t seed = 0;
  };
  /// Throws SceneError when a count is out of range.
  explicit StratifiedSampler(const Params& params);
  std::string_view typeName() const override { return "stratified"; }
  std::unique_ptr<Sampler> clone() const override;
  void start(Point2i pixel, std::int64_t index) override;
  float get1D() override;
  Point2f get2D() override;
  /// The points of all samples together fill the cells of a grid, in a hashed order.
  void get2DArray(std::span<Point2f> out) override;

 private:
  std::uint32_t xSamples_, ySamples_;
  bool jitter_;
  int dimensions_;
  HashedPermutation order_;  ///< of the strata
  std::uint64_t roundKey_ = 0, slot_ = 0;
  std::uint32_t inRound_ = 0;
  int used1D_ = 0, used2D_ = 0;
};

}  // namespace pbrtmedia
