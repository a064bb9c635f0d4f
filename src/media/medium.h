// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "base/bounds.h"
#include "base/pixel_stream.h"
#include "base/segment.h"
#include "base/statistics.h"
#include "media/paired_transmittance.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

class EmissionVolume;
class LearnedBounds;
class PhaseFunction;
struct Exploration;

/// The outcome of a free flight along a segment.
struct FreeFlight {
  bool collided = false;
  double t = 0;  ///< where, when collided
  /// Per channel. Collided: sigma_s(x) T(x) / pdf(t), which carries the albedo. Passed: T / Pr{pass}.
  /// Expectation over both outcomes reproduces the radiative transfer equation; never clamped.
  Rgb weight{1.0f};
};

/// What there is at one point of a medium, per world length.
struct MediumPoint {
  Rgb sigmaS;    ///< scattering coefficient
  Rgb sigmaT;    ///< extinction coefficient
  Rgb emission;  ///< sigma_a Le: radiance gained
};

/// What a segment looks like to the weights of multiple importance sampling, without looking anything up:
/// exact for a homogeneous medium, else by the bounds. Any deterministic answer keeps estimates unbiased.
struct FlightControl {
  Rgb depth;  ///< optical depth of the segment
  Rgb rate;   ///< extinction at its end, 1/length
};

/// Points chosen where a segment emits, with what comes from there to the segment's start, dimmed by the
/// medium itself: the sum of f(t) times the radiance is, for any function f of the distance, an unbiased
/// estimate of that sum over all that the segment emits.
struct EmissionSamples {
  struct Sample {
    double t = 0;
    Rgb radiance;
  };
  std::array<Sample, 2> samples;
  std::size_t count = 0;

  void add(double t, Rgb radiance) { samples[count++] = {t, radiance}; }
  const Sample* begin() const { return samples.data(); }
  const Sample* end() const { return samples.data() + count; }
};

/// Where what flies along a segment may scatter, chosen by what is known of the medium without a look at it.
struct ScatteringProposal {
  Rgb passed{1.0f};      ///< by that, what passes the segment
  double scattered = 0;  ///< by that, how much of the throughput's channels together scatters on it
  double t = 0;          ///< a place where the medium may scatter
  double pdf = 0;        ///< its density, 1/length; 0: there is no place
  Rgb sigmaS{};          ///< scattering coefficient there
};

/// How a medium behaves where others overlap it.
struct OverlapRule {
  /// Boundary: PBRT-v3's rule, a boundary names the medium on both its sides. Add: the medium is present
  /// between its boundaries whatever else is there, and coefficients add. Priority: as Add, but of the media
  /// present that have a priority only the one with the highest counts.
  enum class Mode { Boundary, Add, Priority } mode = Mode::Boundary;
  int priority = 0;
};

/// A participating medium: joins a field, bounds, an estimator and a free-flight sampler
/// (docs/architecture.md). Segments are in the world space of the medium's definition. Virtual once per
/// segment. Immutable while a pass is rendered, thread-safe; random numbers and counters are arguments.
class Medium {
 public:
  virtual ~Medium();
  virtual std::string_view typeName() const = 0;
  const std::string& name() const { return name_; }
  OverlapRule overlap() const { return overlap_; }

  /// Unbiased estimate of exp(-∫ sigma_t dt) per channel over the segment; may leave [0, 1] where the
  /// estimator's traits say so. Zero length: exactly 1.
  virtual Rgb transmittance(const Segment& segment, PixelStream random, RenderCounters& counters) const = 0;
  /// The same estimate with what it knows of its own noise, for as many look-ups.
  virtual PairedTransmittance pairedTransmittance(const Segment& segment, PixelStream random,
                                                  RenderCounters& counters) const {
    return {transmittance(segment, random, counters), Rgb()};
  }
  /// Samples where the next real collision lies. Random numbers are drawn on the way: with the same numbers,
  /// the flight over a shorter segment with the same start takes the same steps up to its end, and passes
  /// when the longer one collides beyond it. (Overlapping media rely on it.)
  /// `throughput`: of the path so far, any sign. Chances are shared out among the channels as the path weighs
  /// them, which bounds the weights of whole paths; where it is 0 a chromatic medium may return weight 0.
  virtual FreeFlight sampleFreeFlight(const Segment& segment, Rgb throughput, PixelStream random,
                                      RenderCounters& counters) const = 0;
  /// A place to scatter at; every place of the segment that scatters may be it.
  virtual ScatteringProposal proposeScattering(const Segment& segment, Rgb throughput, PixelStream random,
                                               RenderCounters& counters) const = 0;
  /// Of light that a collision at the end of a segment sends along it (scattered there, or emitted), an
  /// unbiased estimate of what is seen at its start. Under a law g of the optical depth F that is -g'(F), as
  /// flights from there collide so often, and not the transmittance g(F); under the exponential law they are
  /// the same. So a body emits what it absorbs, and a furnace of one temperature is dark or bright everywhere
  /// alike.
  virtual Rgb collisionShare(const Segment& segment, PixelStream random, RenderCounters& counters) const {
    return transmittance(segment, random, counters);
  }
  virtual const PhaseFunction& phase() const = 0;
  /// Whether transmittance is the exponential of the optical depth. If not, collisions at a distance are not
  /// extinction times transmittance.
  virtual bool isExponential() const { return true; }
  /// Extinction coefficient, where a density scales it that at density 1. Tells how far channels differ.
  virtual Rgb sigmaT() const = 0;
  /// The largest extinction at which it scatters, of any channel anywhere, by the bounds in force; 0:
  /// nowhere.
  virtual double densestScattering() const { return 0; }

  /// Coefficients at a point.
  virtual MediumPoint at(Point3f p, RenderCounters& counters) const = 0;
  virtual FlightControl flightControl(const Segment& segment) const = 0;

  // What emits has these too.
  virtual bool isEmissive() const { return false; }
  virtual EmissionSamples sampleEmission(const Segment& segment, PixelStream random,
                                         RenderCounters& counters) const {
    (void)segment, (void)random, (void)counters;
    return {};
  }
  /// For light sampling; null when there is nothing to sample. A medium without an end of its own is sampled
  /// inside `boundary`.
  virtual std::unique_ptr<const EmissionVolume> emissionVolume(const Bounds3f& boundary) const;

  /// Whether transmittances or weights of flights may be negative, as those of some unbiased estimators are.
  virtual bool mayBeNegative() const { return false; }

  /// Where the density can be positive; infinite for a homogeneous medium.
  virtual Bounds3f bounds() const = 0;
  /// Bounds that are learned while rendering: whoever renders publishes them between passes. Null for media
  /// whose bounds stay as they are.
  virtual LearnedBounds* learnedBounds() { return nullptr; }
  /// Learned bounds only: proposes bounds for the blocks [first, last) of `plan`, x fastest, from look-ups in
  /// each (fields/explore_bounds.h). They depend on block and seed alone. Thread-safe.
  virtual void exploreBounds(const Exploration& plan, std::size_t first, std::size_t last, std::uint64_t seed,
                             RenderCounters& counters) const {
    (void)plan, (void)first, (void)last, (void)seed, (void)counters;
  }
  /// What was wrong with densities so far, for a warning after rendering; empty: nothing.
  virtual std::string complaint() const { return {}; }
  /// One line for --verbose: field, bounds, estimator, sampler, bytes.
  virtual std::string describe() const = 0;

 protected:
  Medium(std::string name, OverlapRule overlap) : name_(std::move(name)), overlap_(overlap) {}

 private:
  std::string name_;
  OverlapRule overlap_;
};

}  // namespace pbrtmedia
