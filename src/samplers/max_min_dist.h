// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "samplers/sampler.h"
#include "samplers/zero_two_slots.h"

namespace pbrtmedia {

/// Sampler "maxmindist": film positions are the rank-1 lattice of as many points as there are samples whose
/// smallest distance on the torus is largest (Dammertz & Keller 2008, doi:10.1007/978-3-540-74496-2_12),
/// randomly shifted and mirrored per pixel and taken in van der Corput order, so prefixes of 2^k samples are
/// lattices too. Other slots are those of "02sequence".
class MaxMinDistSampler final : public Sampler {
 public:
  struct Params {
    std::int64_t pixelSamples = 16;  ///< >= 1; rounded up to a power of two
    int dimensions = 4;              ///< 1D slots and 2D slots (counted apart) of good distribution; >= 0
    std::uint64_t seed = 0;
  };
  /// Largest lattice; more samples per pixel repeat it with new shifts.
  static constexpr std::uint32_t kMaxPoints = 1u << 16;

  /// Throws SceneError when a count is out of range.
  explicit MaxMinDistSampler(const Params& params);
  std::string_view typeName() const override { return "maxmindist"; }
  std::unique_ptr<Sampler> clone() const override;
  void start(Point2i pixel, std::int64_t index) override;
  float get1D() override;
  Point2f get2D() override;
  void get2DArray(std::span<Point2f> out) override;

 private:
  std::uint32_t count_;  ///< samplesPerPixel
  int dimensions_;
  int latticeBits_;           ///< log2 of the lattice's points
  std::uint32_t multiplier_;  ///< point j is (j, multiplier * j mod points) / points
  ZeroTwoSlots slots_;
};

}  // namespace pbrtmedia
