// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/sampler.h"
#include "samplers/zero_two_slots.h"

namespace pbrtmedia {

/// Sampler "02sequence", alias "lowdiscrepancy": in every slot the van der Corput sequence (1D) or Sobol's
/// (0, 2)-sequence (2D), each with its own shuffled index and Owen scrambling per pixel.
class ZeroTwoSampler final : public Sampler {
 public:
  struct Params {
    std::int64_t pixelSamples = 16;  ///< >= 1; rounded up to a power of two
    int dimensions = 4;              ///< 1D slots and 2D slots (counted apart) of good distribution; >= 0
    std::uint64_t seed = 0;
  };
  /// Throws SceneError when a count is out of range.
  explicit ZeroTwoSampler(const Params& params);
  std::string_view typeName() const override { return "02sequence"; }
  std::unique_ptr<Sampler> clone() const override;
  void start(Point2i pixel, std::int64_t index) override;
  float get1D() override;
  Point2f get2D() override;
  void get2DArray(std::span<Point2f> out) override;

 private:
  std::uint32_t count_;  ///< samplesPerPixel
  int dimensions_;
  ZeroTwoSlots slots_;
};

}  // namespace pbrtmedia
