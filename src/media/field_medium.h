// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "media/density_kernel.h"
#include "media/emission/field_emission.h"
#include "media/field_medium_params.h"
#include "media/medium.h"

namespace pbrtmedia {

/// A medium whose coefficients are a density field times constants: joins field, super-voxel bounds,
/// estimator and free-flight sampler. What depends on the kind of field is behind DensityKernel. One channel
/// where sigma_t is grey, else three that share every look-up.
class FieldMedium final : public Medium {
 public:
  /// Throws SceneError (location unknown) when a parameter is out of range. `typeName`: static.
  FieldMedium(const FieldMediumParams& params, std::string_view typeName,
              std::unique_ptr<const DensityKernel> kernel);

  /// A segment with a NaN gives NaN, so that the sample is dropped and counted where such are.
  Rgb transmittance(const Segment& segment, PixelStream random, RenderCounters& counters) const override;
  PairedTransmittance pairedTransmittance(const Segment& segment, PixelStream random,
                                          RenderCounters& counters) const override;
  FreeFlight sampleFreeFlight(const Segment& segment, Rgb throughput, PixelStream random,
                              RenderCounters& counters) const override;
  /// By the control densities of the super-voxels.
  ScatteringProposal proposeScattering(const Segment& segment, Rgb throughput, PixelStream random,
                                       RenderCounters& counters) const override;
  Rgb collisionShare(const Segment& segment, PixelStream random, RenderCounters& counters) const override;
  MediumPoint at(Point3f p, RenderCounters& counters) const override;
  /// From the control densities of the super-voxels.
  FlightControl flightControl(const Segment& segment) const override;
  /// One point by a profile of what emits, one by a free flight: FieldEmission::flightShare.
  EmissionSamples sampleEmission(const Segment& segment, PixelStream random,
                                 RenderCounters& counters) const override;
  std::unique_ptr<const EmissionVolume> emissionVolume(const Bounds3f& boundary) const override;
  /// The occupied super-voxels in world space, rounded outward. Empty when the density is 0 everywhere.
  Bounds3f bounds() const override;

  std::string_view typeName() const override { return typeName_; }
  const PhaseFunction& phase() const override { return *phase_; }
  bool isExponential() const override { return isExponential_; }
  Rgb sigmaT() const override { return sigmaT_; }
  double densestScattering() const override;
  bool isEmissive() const override { return emission_.isEmissive(); }
  /// Under proven bounds every flight's weights are positive.
  bool mayBeNegative() const override;

  LearnedBounds* learnedBounds() override { return kernel_->bounds().learned(); }
  void exploreBounds(const Exploration& plan, std::size_t first, std::size_t last, std::uint64_t seed,
                     RenderCounters& counters) const override;

  std::string complaint() const override;
  std::string describe() const override;

 private:
  /// The line of a segment for estimators and flights. Under an extinction so large that the bounds of cells
  /// would cost millions of null collisions it tells closer ones.
  std::optional<ClippedLine> lineOf(const Segment& segment) const;
  std::optional<ClippedLine> emissionLine(const Segment& segment) const;

  /// The extinction that estimators and flights see, and its share of the true one. Unproven bounds cannot
  /// be made closer: where they would cost more null collisions across the medium than anybody waits for, it
  /// is as thin as that allows. Laws other than the exponential never get opaque, and keep what they were
  /// given.
  double trackedShare() const;
  Rgb trackedSigmaT() const {
    const double share = trackedShare();
    return share < 1 ? sigmaT_ * static_cast<float>(share) : sigmaT_;
  }

  /// Null: the exponential one.
  const AnyLaw* lawOfFlights() const { return isExponential_ ? nullptr : &law_; }

  /// The emission that free flights find. What a collision stands for is emission over extinction, of which
  /// the density is no part.
  void flyToEmission(EmissionSamples& samples, const ClippedLine& emissionLine, const Segment& segment,
                     PixelStream random, RenderCounters& counters) const;

  /// The transmittance of a segment.
  Rgb dimmed(const ClippedLine& line, const Segment& segment, PixelStream random,
             RenderCounters& counters) const;
  /// The same where some channels may be opaque: lower bounds alone leave nothing of them that a double could
  /// tell from 0. Not every estimator ends on such lines.
  Rgb dimmedOrOpaque(const ClippedLine& line, const Segment& segment, PixelStream random,
                     RenderCounters& counters) const;
  template <std::size_t N>
  Rgb estimate(const ClippedLine& line, const Segment& segment, const AnyEstimator& estimator,
               const Channels<N>& sigmaT, PixelStream random, RenderCounters& counters) const;
  template <std::size_t N>
  PairedTransmittance paired(const ClippedLine& line, const Segment& segment, const Channels<N>& sigmaT,
                             PixelStream random, RenderCounters& counters) const;
  /// Calls `f` with the numbers of the sample's next estimate.
  template <class F>
  auto withEstimateStream(PixelStream random, const F& f) const;

  /// Collisions weigh extinction, not scattering.
  template <std::size_t N>
  FreeFlight flyOn(const ClippedLine& line, const Segment& segment, const FlightQuery<N>& query,
                   PixelStream random, RenderCounters& counters) const;

  /// Learned bounds grow where somebody looks. While they still do, every segment looks once more, at a
  /// random point: thin first bounds alone would hardly ever look, nor tell how much they cut away. It
  /// changes no estimate of the pass.
  void explore(const ClippedLine& line, PixelStream random, RenderCounters& counters) const;
  /// Adds what a segment cost, and notes an example of a violated bound if there is none yet.
  void count(const ClippedLine& line, const Segment& segment, const LookupTally& tally,
             RenderCounters& counters) const;

  std::string_view typeName_;
  std::unique_ptr<const DensityKernel> kernel_;
  double extent_;  ///< of the box that may hold density, world length
  Rgb sigmaS_, sigmaT_, albedo_;
  bool isAuto_;  ///< the estimator
  AnyEstimator estimator_;
  bool tellsSpread_;  ///< the estimator
  AnyLaw law_;
  bool isExponential_;
  CollisionEstimator collisions_;  ///< for light from collisions under another law
  AnyFlight flights_;
  bool fliesUnderLaw_;
  PatternKind samplingPattern_;
  std::unique_ptr<PhaseFunction> phase_;
  FieldEmission emission_;
};

}  // namespace pbrtmedia
