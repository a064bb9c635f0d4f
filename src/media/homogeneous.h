// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "media/medium.h"
#include "media/phase_params.h"

namespace pbrtmedia {

/// The same coefficients everywhere; unbounded. Transmittance is exact; free flights sample one channel's
/// exponential, chosen uniformly, and weigh with the mean density of all channels.
class HomogeneousMedium final : public Medium {
 public:
  struct Params {
    std::string name;
    Rgb sigmaA{.0011f, .0024f, .014f};  ///< absorption, 1/world length, >= 0
    Rgb sigmaS{2.55f, 3.21f, 3.77f};    ///< scattering, 1/world length, >= 0
    std::vector<PhaseLobe> phase = {PhaseLobe{}};
    OverlapRule overlap;
  };
  static constexpr std::string_view kTypeName = "homogeneous";

  /// Throws SceneError (location unknown) when a parameter is out of range.
  explicit HomogeneousMedium(Params params);

  std::string_view typeName() const override { return kTypeName; }
  Rgb transmittance(const Segment& segment, Rng& rng, RenderCounters& counters) const override;
  FreeFlight sampleFreeFlight(const Segment& segment, Rng& rng, RenderCounters& counters) const override;
  const PhaseFunction& phase() const override { return *phase_; }
  Bounds3f bounds() const override;
  std::string describe() const override;
  Rgb sigmaT() const { return sigmaT_; }

 private:
  Rgb sigmaS_, sigmaT_;
  std::unique_ptr<PhaseFunction> phase_;
  bool grey_;
};

}  // namespace pbrtmedia
