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

#include "base/diagnostics.h"
#include "fields/field_line.h"
#include "fields/super_voxels.h"
#include "freeflight/any_sampler.h"
#include "media/coefficients.h"
#include "media/control_density.h"
#include "media/field_emission.h"
#include "media/field_medium_params.h"
#include "media/medium.h"
#include "media/rgb_channels.h"
#include "media/tracking_choice.h"
#include "transmittance/any_estimator.h"
#include "transmittance/estimate_on.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// A medium whose coefficients are a density field times constants: joins field, super-voxel bounds,
/// estimator and free-flight sampler, and finds the concrete ones once per segment. One channel where sigma_t
/// is grey, else three that share every look-up.
template <class Field>
class FieldMedium final : public Medium {
 public:
  /// Throws SceneError (location unknown) when a parameter is out of range.
  /// `bounds`: nothing for a field that has its own in force (UnprovenField).
  FieldMedium(const FieldMediumParams& params, std::string_view typeName, Field field,
              std::optional<SuperVoxels> bounds)
      : Medium(params.name, params.overlap),
        field_(std::move(field)),
        ownBounds_(std::move(bounds)),
        bounds_(inForce(field_, ownBounds_)),
        typeName_(typeName),
        sigmaT_(params.sigmaA + params.sigmaS),
        isAuto_(!params.estimator),
        estimator_(params.estimator.value_or(AnyEstimator())),
        sampler_(params.sampler),
        samplingPattern_(params.pattern),
        phase_(makePhaseFunction(params.phase)),
        sigmaS_(params.sigmaS),
        emission_(params.sigmaA * params.le, params.sigmaA + params.sigmaS, params.emissionPattern, field_,
                  bounds_) {
    checkCoefficients(params.sigmaA, params.sigmaS, name());
    checkEmission(params.le, params.sigmaA * params.le, name());
    albedo_ = albedoOf(sigmaS_, sigmaT_);
    if (isAuto_) {
      estimator_ = chooseEstimator({.lines = lineStatistics(field_, bounds_),
                                    .sigmaT = static_cast<double>(sigmaT_.max()),
                                    .provenBounds = Field::kProvenBounds,
                                    .batchedLookups = BatchedField<Field>});
    }
    law_ = lawOf(estimator_);
    if (!traitsOf(sampler_).laws.has(law_) && !sigmaS_.isBlack()) {
      throw SceneError(SourceLocation{}, "free flights of this sampler follow the exponential law only");
    }
    if (!PiecewiseCubicField<Field> && (traitsOf(estimator_).needsPieces || traitsOf(sampler_).needsPieces)) {
      throw SceneError(SourceLocation{},
                       "regular tracking goes from voxel to voxel, but this density has none");
    }
  }

  LearnedBounds* learnedBounds() override {
    if constexpr (requires { field_.learned(); }) {
      return field_.learned();
    } else {
      return nullptr;
    }
  }

  /// Under proven bounds every sampler's weights are positive.
  bool mayBeNegative() const override {
    return !Field::kProvenBounds || traitsOf(estimator_).mayLeaveUnitInterval;
  }

  std::string_view typeName() const override { return typeName_; }
  const PhaseFunction& phase() const override { return *phase_; }
  bool isExponential() const override { return std::holds_alternative<ExponentialLaw>(law_); }
  Rgb sigmaT() const override { return sigmaT_; }

  /// A segment with a NaN gives NaN, so that the sample is dropped and counted where such are.
  Rgb transmittance(const Segment& segment, Rng& rng, RenderCounters& counters) const override {
    if (hasNaN(segment)) return kNaN;
    const auto line = lineOf(segment);
    if (!line) return Rgb(1.0f);
    explore(*line, rng, counters);
    return dimmed(*line, segment, rng, counters);
  }

  FreeFlight sampleFreeFlight(const Segment& segment, Rgb throughput, Rng& rng,
                              RenderCounters& counters) const override {
    if (hasNaN(segment)) return {.weight = kNaN};
    const auto line = lineOf(segment);
    if (!line) return {};
    explore(*line, rng, counters);
    // What only absorbs dims: its collisions would end paths and nothing else.
    if (sigmaS_.isBlack()) return {false, 0, dimmed(*line, segment, rng, counters)};
    const AnyLaw* const law = isExponential() ? nullptr : &law_;
    FreeFlight flight =
        sigmaT_.isGrey()
            ? flyOn(*line, segment, FlightQuery<1>{{sigmaT_.r}, {albedo_.average()}, {1}, law}, rng, counters)
            : flyOn(*line, segment,
                    FlightQuery<3>{channelsOf(sigmaT_), channelsOf(albedo_),
                                   importanceOf(channelsOf(throughput)), law},
                    rng, counters);
    if (!flight.collided) return flight;
    flight.t = std::clamp(flight.t, segment.tMin, segment.tMax);
    flight.weight *= albedo_;
    return flight;
  }

  MediumPoint at(Point3f p, RenderCounters& counters) const override {
    const Vec3d local = field_.localFromWorld().point(Vec3d(p));
    if (!bounds_.occupied().contains(local)) return {};
    ++counters.densityLookups;
    const float density = field_.density(local);
    return {sigmaS_ * density, emission_.at(Vec3d(p), density)};
  }

  /// From the control densities of the super-voxels.
  FlightControl flightControl(const Segment& segment) const override {
    const auto line = FieldLine<Field>::clip(field_, bounds_, segment);
    if (!line) return {};
    double depth = 0, rate = 0;
    line->walk([&](double sEnter, double sExit, const SuperVoxel& bound) {
      rate = bound.upper > 0 ? static_cast<double>(controlDensity(bound)) : 0;
      depth += rate * (sExit - sEnter);
      return true;
    });
    // Behind the last of the medium nothing collides.
    const double slack = kEndSlack * (line->length() + line->tEntry());
    if (segment.tMax > line->tEntry() + line->length() + slack) rate = 0;
    return {sigmaT_ * static_cast<float>(depth), sigmaT_ * static_cast<float>(rate)};
  }

  bool isEmissive() const override { return emission_.isEmissive(); }

  /// One point by a profile of what emits, one by a free flight: FieldEmission::flightShare.
  EmissionSamples sampleEmission(const Segment& segment, Rng& rng, RenderCounters& counters) const override {
    EmissionSamples samples;
    const auto line = emissionLine(segment);
    if (!line) return samples;
    EmissionSampler sampler(EmissionSampler::kDefensiveShare, rng);
    // Under another law a collision is not extinction times transmittance.
    const bool flies = emission_.addTo(sampler, *line, isExponential());
    if (const auto distance = sampler.distance()) {
      ++counters.densityLookups;
      const double t = std::clamp(line->tEntry() + distance->s, segment.tMin, segment.tMax);
      const Rgb emission = emission_.at(pointOf(segment, t), line->density(distance->s));
      const double weight = distance->tag / distance->pdf;
      if (!emission.isBlack()) {
        const Rgb through = transmittance({segment.o, segment.d, segment.tMin, t}, rng, counters);
        samples.add(t, through * emission * static_cast<float>(weight));
      }
    }
    if (flies) flyToEmission(samples, *line, segment, rng, counters);
    return samples;
  }

  void exploreBounds(const Exploration& plan, std::size_t first, std::size_t last, std::uint64_t seed,
                     RenderCounters& counters) const override {
    if constexpr (requires { field_.explore(plan, first, last, seed); }) {
      counters.densityLookups += field_.explore(plan, first, last, seed);
    }
  }

  std::unique_ptr<const EmissionVolume> emissionVolume(const Bounds3f&) const override {
    return emission_.volume(bounds_, field_.worldFromLocal());
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
    if (isAuto_) text << " (auto)";
    if (!isExponential()) text << " (law " << nameOf(law_) << ')';
    if (samplingPattern_ != PatternKind::Independent)
      text << " (pattern " << kPatternNames[static_cast<std::size_t>(samplingPattern_)] << ')';
    text << ", sampler " << nameOf(sampler_) << ", " << (sigmaT_.isGrey() ? "1 channel" : "3 channels")
         << emission_.describe() << ", " << field_.bytes() + bounds_.bytes() + emission_.bytes() << " bytes";
    return text.str();
  }

  std::string complaint() const override {
    if constexpr (requires { field_.complaint(); }) {
      return field_.complaint();
    } else {
      return {};
    }
  }

  const Field& field() const { return field_; }
  const SuperVoxels& superVoxels() const { return bounds_; }

 private:
  static constexpr float kQuietNaN = std::numeric_limits<float>::quiet_NaN();
  static constexpr Rgb kNaN{kQuietNaN};

  static const SuperVoxels& inForce(const Field& field, const std::optional<SuperVoxels>& own) {
    if constexpr (requires { field.inForce(); }) {
      return field.inForce();
    } else {
      return *own;
    }
  }

  static bool hasNaN(const Segment& s) {
    return std::isnan(s.tMin) || std::isnan(s.tMax) || std::isnan(s.o.x + s.o.y + s.o.z) ||
           std::isnan(s.d.x + s.d.y + s.d.z);
  }

  /// The line of a segment for estimators and samplers. Under an extinction so large that the bounds of cells
  /// would cost millions of null collisions it tells closer ones.
  std::optional<FieldLine<Field>> lineOf(const Segment& segment) const {
    auto line = FieldLine<Field>::clip(field_, bounds_, segment);
    if constexpr (Field::kProvenBounds) {
      const double sigmaMax = sigmaT_.max(), column = line ? line->length() * double{bounds_.maximum()} : 0;
      if (sigmaMax * column > kRefinedDepth) [[unlikely]]
        line->refineAbove(kRefinedDepth / sigmaMax);
    }
    return line;
  }
  /// Optical depth of a bound above which it is refined: far above what is rendered every day, and some
  /// tenths of a millisecond of null collisions.
  static constexpr double kRefinedDepth = 0x1p14;

  /// Of a segment's length: rounding of the place where it leaves the medium.
  static constexpr double kEndSlack = 1e-12;

  std::optional<FieldLine<Field>> emissionLine(const Segment& segment) const {
    if (!emission_.isEmissive() || hasNaN(segment)) return std::nullopt;
    return FieldLine<Field>::clip(field_, emission_.cells(bounds_), segment);
  }

  static Vec3d pointOf(const Segment& segment, double t) { return Vec3d(segment.o) + t * Vec3d(segment.d); }

  /// The emission that free flights find. What a collision stands for is emission over extinction, of which
  /// the density is no part.
  void flyToEmission(EmissionSamples& samples, const FieldLine<Field>& emissionLine, const Segment& segment,
                     Rng& rng, RenderCounters& counters) const {
    const auto line = FieldLine<Field>::clip(field_, bounds_, segment);
    if (!line) return;
    const FreeFlight flight =
        sigmaT_.isGrey() ? flyOn(*line, segment, FlightQuery<1>{.sigmaT = {sigmaT_.r}}, rng, counters)
                         : flyOn(*line, segment,
                                 FlightQuery<3>{.sigmaT = channelsOf(sigmaT_),
                                                .importance = importanceOf(channelsOf(emission_.sourceOf()))},
                                 rng, counters);
    if (!flight.collided) return;
    const double t = std::clamp(flight.t, segment.tMin, segment.tMax);
    const double share = emission_.flightShareAt(emissionLine, flight.t - emissionLine.tEntry());
    if (!(share > 0)) return;
    samples.add(t, flight.weight * emission_.sourceAt(pointOf(segment, t)) * static_cast<float>(share));
  }

  template <std::size_t N>
  Rgb estimate(const FieldLine<Field>& line, const Segment& segment, const Channels<N>& sigmaT, Rng& rng,
               RenderCounters& counters) const {
    if (PixelSample& pixel = rng.pixelSample(); samplingPattern_ != PatternKind::Independent &&
                                                pixel.index < pixel.count &&
                                                pixel.count <= std::numeric_limits<std::uint32_t>::max()) {
      // The n-th estimates of all samples of a pixel share a pattern.
      const SamplingPattern pattern(samplingPattern_, static_cast<std::uint32_t>(pixel.count),
                                    hashCombine(pixel.key, pixel.estimates++));
      SampleStream stream(rng, pattern, static_cast<std::uint32_t>(pixel.index));
      return estimate(line, segment, sigmaT, stream, counters);
    }
    SampleStream stream(rng);
    return estimate(line, segment, sigmaT, stream, counters);
  }

  template <std::size_t N>
  Rgb estimate(const FieldLine<Field>& line, const Segment& segment, const Channels<N>& sigmaT,
               SampleStream& stream, RenderCounters& counters) const {
    const Estimate<N> result = std::visit(
        [&](const auto& estimator) { return estimateOn(estimator, line, sigmaT, stream); }, estimator_);
    count(line, segment, result.tally, counters);
    return toRgb(result.value);
  }

  /// The transmittance of a segment.
  Rgb dimmed(const FieldLine<Field>& line, const Segment& segment, Rng& rng, RenderCounters& counters) const {
    if (line.isRefined() && isExponential()) [[unlikely]]
      return dimmedOrOpaque(line, segment, rng, counters);
    return sigmaT_.isGrey() ? estimate(line, segment, Channels<1>{sigmaT_.r}, rng, counters)
                            : estimate(line, segment, channelsOf(sigmaT_), rng, counters);
  }

  /// The same where some channels may be opaque: lower bounds alone leave nothing of them that a double could
  /// tell from 0. Not every estimator ends on such lines.
  Rgb dimmedOrOpaque(const FieldLine<Field>& line, const Segment& segment, Rng& rng,
                     RenderCounters& counters) const {
    constexpr double kOpaque = 746;  // exp of less is 0
    double column = 0;
    line.walk([&](double sEnter, double sExit, const SuperVoxel& bound) {
      column += bound.lower * (sExit - sEnter);
      return !(sigmaT_.min() * column >= kOpaque);
    });
    Channels<3> clear = channelsOf(sigmaT_);
    for (double& sigma : clear) sigma = sigma * column >= kOpaque ? 0 : sigma;
    const Rgb through = clear == Channels<3>{} ? Rgb(1.0f) : estimate(line, segment, clear, rng, counters);
    Rgb result;
    for (std::size_t c = 0; c < 3; ++c) result[c] = sigmaT_[c] * column >= kOpaque ? 0 : through[c];
    return result;
  }

  /// Learned bounds grow where somebody looks. While they still do, every segment looks once more, at a
  /// random point: thin first bounds alone would hardly ever look, nor tell how much they cut away. It
  /// changes no estimate of the pass.
  void explore(const FieldLine<Field>& line, Rng& rng, RenderCounters& counters) const {
    if constexpr (requires { field_.learned(); }) {
      if (field_.learned() == nullptr || !field_.learned()->isExploring()) return;
      const Vec3d p = line.localPoint(line.length() * rng.uniformDouble());
      field_.learned()->probe(p, field_.uncutDensity(p), static_cast<double>(sigmaT_.max()) * line.length());
      ++counters.densityLookups;
    }
  }

  /// Adds what a segment cost, and notes an example of a violated bound if there is none yet.
  void count(const FieldLine<Field>& line, const Segment& segment, const LookupTally& tally,
             RenderCounters& counters) const {
    tally.addTo(counters);
    if (tally.violations == 0 || counters.violation) return;
    const double t = line.tEntry() + tally.worstS;
    counters.violation =
        BoundViolation{name(), segment.o, segment.d, t, tally.worstDensity, tally.worstBound};
  }

  /// Collisions weigh extinction, not scattering.
  template <std::size_t N>
  FreeFlight flyOn(const FieldLine<Field>& line, const Segment& segment, const FlightQuery<N>& query,
                   Rng& rng, RenderCounters& counters) const {
    const FlightSample<N> result =
        std::visit([&](const auto& sampler) { return pbrtmedia::fly(sampler, line, query, rng); }, sampler_);
    count(line, segment, result.tally, counters);
    const Rgb weight = toRgb(result.weight);
    if (!result.collided) return {false, 0, weight};
    return {true, line.tEntry() + result.s, weight};
  }

  Field field_;
  std::optional<SuperVoxels> ownBounds_;
  const SuperVoxels& bounds_;  ///< the own ones, or those in force in the field
  std::string_view typeName_;
  Rgb sigmaT_, albedo_;
  bool isAuto_;  ///< the estimator
  AnyEstimator estimator_;
  AnyLaw law_;
  AnySampler sampler_;
  PatternKind samplingPattern_;
  std::unique_ptr<PhaseFunction> phase_;
  Rgb sigmaS_;
  FieldEmission emission_;
};

}  // namespace pbrtmedia
