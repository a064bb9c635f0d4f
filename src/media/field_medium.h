// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>

#include "fields/field_line.h"
#include "fields/super_voxels.h"
#include "freeflight/any_sampler.h"
#include "media/coefficients.h"
#include "media/field_medium_params.h"
#include "media/medium.h"
#include "transmittance/any_estimator.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// A medium whose coefficients are a density field times constants: joins field, super-voxel bounds,
/// estimator and free-flight sampler, and finds the concrete ones once per segment. One channel where sigma_t
/// is grey, else three that share every look-up.
template <class Field>
class FieldMedium final : public Medium {
 public:
  /// Throws SceneError (location unknown) when a parameter is out of range.
  FieldMedium(const FieldMediumParams& params, std::string_view typeName, Field field, SuperVoxels bounds)
      : Medium(params.name, params.overlap),
        field_(std::move(field)),
        bounds_(std::move(bounds)),
        typeName_(typeName),
        sigmaT_(params.sigmaA + params.sigmaS),
        estimator_(params.estimator),
        sampler_(params.sampler),
        phase_(makePhaseFunction(params.phase)) {
    checkCoefficients(params.sigmaA, params.sigmaS, name());
    for (std::size_t c = 0; c < 3; ++c) albedo_[c] = sigmaT_[c] > 0 ? params.sigmaS[c] / sigmaT_[c] : 0.0f;
  }

  std::string_view typeName() const override { return typeName_; }
  const PhaseFunction& phase() const override { return *phase_; }

  /// A segment with a NaN gives NaN, so that the sample is dropped and counted where such are.
  Rgb transmittance(const Segment& segment, Rng& rng, RenderCounters& counters) const override {
    if (hasNaN(segment)) return kNaN;
    const auto line = FieldLine<Field>::clip(field_, bounds_, segment);
    if (!line) return Rgb(1.0f);
    return sigmaT_.isGrey() ? estimate(*line, Channels<1>{sigmaT_.r}, rng, counters)
                            : estimate(*line, Channels<3>{sigmaT_.r, sigmaT_.g, sigmaT_.b}, rng, counters);
  }

  FreeFlight sampleFreeFlight(const Segment& segment, Rng& rng, RenderCounters& counters) const override {
    if (hasNaN(segment)) return {.weight = kNaN};
    const auto line = FieldLine<Field>::clip(field_, bounds_, segment);
    if (!line) return {};
    FreeFlight flight = sigmaT_.isGrey()
                            ? fly(*line, Channels<1>{sigmaT_.r}, rng, counters)
                            : fly(*line, Channels<3>{sigmaT_.r, sigmaT_.g, sigmaT_.b}, rng, counters);
    if (flight.collided) flight.t = std::clamp(flight.t, segment.tMin, segment.tMax);
    return flight;
  }

  /// The occupied super-voxels in world space, rounded outward. Empty when the density is 0 everywhere.
  Bounds3f bounds() const override {
    if (bounds_.occupied().isEmpty()) return {};
    Bounds3f box;
    for (int i = 0; i < 8; ++i) {
      const Vec3d p = field_.worldFromLocal().point(bounds_.occupied().corner(i));
      for (std::size_t a = 0; a < 3; ++a) {
        const float x = static_cast<float>(p[a]);
        box.min[a] = std::min(box.min[a], std::nextafter(x, -kInfinity));
        box.max[a] = std::max(box.max[a], std::nextafter(x, kInfinity));
      }
    }
    return box;
  }

  std::string describe() const override {
    const auto& n = bounds_.shape().count;
    std::ostringstream text;
    text << field_.describe() << ", super-voxels " << n.x << " x " << n.y << " x " << n.z << " ("
         << bounds_.emptyCells() << " empty), estimator " << nameOf(estimator_);
    if (const AnyLaw law = lawOf(estimator_); !std::holds_alternative<ExponentialLaw>(law)) {
      text << " (law " << nameOf(law) << ')';
    }
    text << ", sampler " << nameOf(sampler_) << ", " << (sigmaT_.isGrey() ? "1 channel" : "3 channels")
         << ", " << field_.bytes() + bounds_.bytes() << " bytes";
    return text.str();
  }

  const Field& field() const { return field_; }
  const SuperVoxels& superVoxels() const { return bounds_; }

 private:
  static constexpr float kQuietNaN = std::numeric_limits<float>::quiet_NaN();
  static constexpr Rgb kNaN{kQuietNaN};

  static bool hasNaN(const Segment& s) {
    return std::isnan(s.tMin) || std::isnan(s.tMax) || std::isnan(s.o.x + s.o.y + s.o.z) ||
           std::isnan(s.d.x + s.d.y + s.d.z);
  }

  template <std::size_t N>
  static Rgb toRgb(const Channels<N>& c) {
    if constexpr (N == 1) {
      return Rgb(static_cast<float>(c[0]));
    } else {
      return Rgb(static_cast<float>(c[0]), static_cast<float>(c[1]), static_cast<float>(c[2]));
    }
  }

  template <std::size_t N>
  Rgb estimate(const FieldLine<Field>& line, const Channels<N>& sigmaT, Rng& rng,
               RenderCounters& counters) const {
    SampleStream stream(rng);
    const Estimate<N> result =
        std::visit([&](const auto& estimator) { return estimator(line, sigmaT, stream); }, estimator_);
    result.tally.addTo(counters);
    return toRgb(result.value);
  }

  template <std::size_t N>
  FreeFlight fly(const FieldLine<Field>& line, const Channels<N>& sigmaT, Rng& rng,
                 RenderCounters& counters) const {
    Channels<N> albedo;
    for (std::size_t c = 0; c < N; ++c) albedo[c] = static_cast<double>(albedo_[c]);
    const FlightSample<N> result = std::visit(
        [&](const auto& sampler) { return pbrtmedia::fly(sampler, line, sigmaT, albedo, rng); }, sampler_);
    result.tally.addTo(counters);
    const Rgb weight = toRgb(result.weight);
    if (!result.collided) return {false, 0, weight};
    return {true, line.tEntry() + result.s, weight * albedo_};
  }

  Field field_;
  SuperVoxels bounds_;
  std::string_view typeName_;
  Rgb sigmaT_, albedo_;
  AnyEstimator estimator_;
  AnySampler sampler_;
  std::unique_ptr<PhaseFunction> phase_;
};

}  // namespace pbrtmedia
