// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>

#include "freeflight/flight_query.h"
#include "media/medium.h"
#include "media/medium_params.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The same coefficients everywhere; unbounded. Transmittance is exact; free flights sample one channel's
/// exponential, chosen uniformly, and weigh with the mean density of all channels.
class HomogeneousMedium final : public Medium {
 public:
  using Params = MediumParams;
  static constexpr std::string_view kTypeName = "homogeneous";

  /// Throws SceneError (location unknown) when a parameter is out of range.
  explicit HomogeneousMedium(Params params);

  std::string_view typeName() const override { return kTypeName; }
  Rgb transmittance(const Segment& segment, PixelStream random, RenderCounters& counters) const override;
  FreeFlight sampleFreeFlight(const Segment& segment, Rgb throughput, PixelStream random,
                              RenderCounters& counters) const override;
  ScatteringProposal proposeScattering(const Segment& segment, Rgb throughput, PixelStream random,
                                       RenderCounters& counters) const override;
  const PhaseFunction& phase() const override { return *phase_; }
  Rgb sigmaT() const override { return sigmaT_; }
  double densestScattering() const override { return sigmaS_.isBlack() ? 0 : double{sigmaT_.max()}; }
  MediumPoint at(Point3f, RenderCounters&) const override { return {sigmaS_, sigmaT_, emission_}; }
  FlightControl flightControl(const Segment& segment) const override;
  bool isEmissive() const override { return !emission_.isBlack(); }
  EmissionSamples sampleEmission(const Segment& segment, PixelStream random,
                                 RenderCounters& counters) const override;
  std::unique_ptr<const EmissionVolume> emissionVolume(const Bounds3f& boundary) const override;
  Bounds3f bounds() const override;
  std::string describe() const override;

 private:
  template <std::size_t N>
  FreeFlight fly(const Segment& segment, const FlightQuery<N>& query, SampleStream stream) const;

  Rgb sigmaS_, sigmaT_, albedo_, emission_;
  std::unique_ptr<PhaseFunction> phase_;
  bool grey_;
};

}  // namespace pbrtmedia
