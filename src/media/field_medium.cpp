// SPDX-License-Identifier: BSD-2-Clause
#include "media/field_medium.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <variant>

#include "base/built_parts.h"
#include "base/diagnostics.h"
#include "fields/explore_bounds.h"
#include "media/coefficients.h"
#include "media/control_density.h"
#include "media/line_statistics.h"
#include "media/rgb_channels.h"
#include "media/tracking_choice.h"
#include "spectrum/magnitudes.h"

namespace pbrtmedia {
namespace {

constexpr Rgb kNaN{std::numeric_limits<float>::quiet_NaN()};
/// Optical depth of a bound above which it is refined: far above what is rendered every day, and some tenths
/// of a millisecond of null collisions.
constexpr double kRefinedDepth = 0x1p14;
/// Optical depth of the diagonal from which products of weights of either sign are told to say little.
constexpr double kManyScatterings = 50;
/// Optical depth of unproven bounds across a medium above which less is tracked: some milliseconds of null
/// collisions, mean free paths of 4e-6 of the medium.
constexpr double kMostDepth = 0x1p18;
/// The share of places to scatter at that are chosen as if nothing were in front of them: the control may be
/// wrong about that, and laws other than the exponential let more light through than collides behind.
constexpr double kScatteringDefence = 0.3;
/// Of the largest bound: density of cells whose own bound is less, and that nobody has proven.
constexpr float kLeastControl = 0.1f;
/// Of a segment's length: rounding of the place where it leaves the medium.
constexpr double kEndSlack = 1e-12;

bool hasNaN(const Segment& s) {
  return std::isnan(s.tMin) || std::isnan(s.tMax) || std::isnan(s.o.x + s.o.y + s.o.z) ||
         std::isnan(s.d.x + s.d.y + s.d.z);
}

/// The longest diagonal, in world space, of the box that may hold density.
double extentOf(const DensityKernel& kernel) {
  const Bounds3d& box = kernel.superVoxels().lattice().box;
  double most = 0;
  for (int i = 0; i < 4; ++i) {
    const Transform& world = kernel.worldFromLocal();
    most = std::max(most, length(world.point(box.corner(i)) - world.point(box.corner(7 - i))));
  }
  return most;
}

Vec3d pointOf(const Segment& segment, double t) { return Vec3d(segment.o) + t * Vec3d(segment.d); }

}  // namespace

FieldMedium::FieldMedium(const FieldMediumParams& params, std::string_view typeName,
                         std::unique_ptr<const DensityKernel> kernel)
    : Medium(params.name, params.overlap),
      typeName_(typeName),
      kernel_(std::move(kernel)),
      extent_(extentOf(*kernel_)),
      sigmaS_(params.sigmaS),
      sigmaT_(params.sigmaA + params.sigmaS),
      isAuto_(!params.estimator),
      flights_(params.flights),
      samplingPattern_(params.pattern),
      phase_(makePhaseFunction(params.phase)),
      emission_(params.sigmaA * params.le, sigmaT_, params.emissionPattern, *kernel_) {
  checkCoefficients(params.sigmaA, params.sigmaS, name());
  checkEmission(params.le, params.sigmaA * params.le, name());
  countBuilt(Part::Media);
  if (!sigmaT_.isGrey()) countBuilt(Part::ChromaticMedia);
  albedo_ = albedoOf(sigmaS_, sigmaT_);
  estimator_ = params.estimator ? *params.estimator
                                : chooseEstimator({.lines = lineStatistics(*kernel_),
                                                   .sigmaT = static_cast<double>(sigmaT_.max()),
                                                   .provenBounds = kernel_->bounds().areProven(),
                                                   .batchedLookups = kernel_->hasBatches(),
                                                   .onlyAbsorbs = sigmaS_.isBlack()});
  tellsSpread_ = traitsOf(estimator_).tellsSpread;
  law_ = lawOf(estimator_);
  isExponential_ = std::holds_alternative<ExponentialLaw>(law_);
  if (!isExponential_) collisions_ = collisionEstimatorOf(estimator_);
  fliesUnderLaw_ = traitsOf(flights_).laws.has(law_);
  if (!fliesUnderLaw_ && !sigmaS_.isBlack()) {
    throw SceneError(SourceLocation{}, "these free flights do not follow the law of the medium");
  }
  if (!kernel_->hasPieces() && (traitsOf(estimator_).needsPieces || traitsOf(flights_).needsPieces)) {
    throw SceneError(SourceLocation{},
                     "regular tracking goes from voxel to voxel, but this density has none");
  }
}

bool FieldMedium::mayBeNegative() const {
  return !kernel_->bounds().areProven() || traitsOf(estimator_).mayLeaveUnitInterval ||
         traitsOf(flights_).mayBeNegative;
}

double FieldMedium::densestScattering() const {
  if (sigmaS_.isBlack()) return 0;
  return double{trackedSigmaT().max()} * double{kernel_->superVoxels().maximum()};
}

Rgb FieldMedium::transmittance(const Segment& segment, PixelStream random, RenderCounters& counters) const {
  if (hasNaN(segment)) return kNaN;
  const auto line = lineOf(segment);
  if (!line) return Rgb(1.0f);
  explore(*line, random, counters);
  return dimmed(*line, segment, random, counters);
}

PairedTransmittance FieldMedium::pairedTransmittance(const Segment& segment, PixelStream random,
                                                     RenderCounters& counters) const {
  if (!tellsSpread_) return Medium::pairedTransmittance(segment, random, counters);
  if (hasNaN(segment)) return {kNaN, Rgb()};
  const auto line = lineOf(segment);
  if (!line) return {};
  explore(*line, random, counters);
  if (line->isRefined() && isExponential_) [[unlikely]]
    return {dimmedOrOpaque(*line, segment, random, counters), Rgb()};
  const Rgb sigmaT = trackedSigmaT();
  return sigmaT.isGrey() ? paired(*line, segment, Channels<1>{sigmaT.r}, random, counters)
                         : paired(*line, segment, channelsOf(sigmaT), random, counters);
}

FreeFlight FieldMedium::sampleFreeFlight(const Segment& segment, Rgb throughput, PixelStream random,
                                         RenderCounters& counters) const {
  if (hasNaN(segment)) return {.weight = kNaN};
  const auto line = lineOf(segment);
  if (!line) return {};
  explore(*line, random, counters);
  // What only absorbs dims: its collisions would end paths and nothing else.
  if (sigmaS_.isBlack()) return {false, 0, dimmed(*line, segment, random, counters)};
  const AnyLaw* const law = lawOfFlights();
  const Rgb sigmaT = trackedSigmaT();
  FreeFlight flight =
      sigmaT.isGrey()
          ? flyOn(*line, segment, FlightQuery<1>{{sigmaT.r}, {albedo_.average()}, {1}, law}, random, counters)
          : flyOn(*line, segment,
                  FlightQuery<3>{channelsOf(sigmaT), channelsOf(albedo_),
                                 importanceOf(channelsOf(throughput)), law},
                  random, counters);
  if (!flight.collided) return flight;
  flight.t = std::clamp(flight.t, segment.tMin, segment.tMax);
  flight.weight *= albedo_;
  return flight;
}

MediumPoint FieldMedium::at(Point3f p, RenderCounters& counters) const {
  const Vec3d local = kernel_->localFromWorld().point(Vec3d(p));
  if (!kernel_->superVoxels().occupied().contains(local)) return {};
  ++counters.densityLookups;
  const float density = kernel_->density(local);
  return {sigmaS_ * density, sigmaT_ * density, emission_.at(Vec3d(p), density)};
}

FlightControl FieldMedium::flightControl(const Segment& segment) const {
  const auto line = kernel_->clip(segment);
  if (!line) return {};
  double depth = 0, rate = 0;
  line->walkCells([&](double sEnter, double sExit, const SuperVoxel& bound) {
    rate = bound.upper > 0 ? static_cast<double>(controlDensity(bound)) : 0;
    depth += rate * (sExit - sEnter);
    return true;
  });
  // Behind the last of the medium nothing collides.
  const double slack = kEndSlack * (line->length() + line->tEntry());
  if (segment.tMax > line->tEntry() + line->length() + slack) rate = 0;
  return {sigmaT_ * static_cast<float>(depth), sigmaT_ * static_cast<float>(rate)};
}

EmissionSamples FieldMedium::sampleEmission(const Segment& segment, PixelStream random,
                                            RenderCounters& counters) const {
  EmissionSamples samples;
  const auto line = emissionLine(segment);
  if (!line) return samples;
  EmissionSampler sampler(EmissionSampler::kDefensiveShare, random.rng(), lawOfFlights());
  const bool flies = emission_.addTo(sampler, *line, fliesUnderLaw_);
  if (const auto distance = sampler.distance()) {
    ++counters.densityLookups;
    const double t = std::clamp(line->tEntry() + distance->s, segment.tMin, segment.tMax);
    const Rgb emission = emission_.at(pointOf(segment, t), kernel_->density(*line, distance->s));
    const double weight = distance->tag / distance->pdf;
    if (!emission.isBlack()) {
      const Segment before{segment.o, segment.d, segment.tMin, t};
      samples.add(t, collisionShare(before, random, counters) * emission * static_cast<float>(weight));
    }
  }
  if (flies) flyToEmission(samples, *line, segment, random, counters);
  return samples;
}

ScatteringProposal FieldMedium::proposeScattering(const Segment& segment, Rgb throughput, PixelStream random,
                                                  RenderCounters& counters) const {
  ScatteringProposal proposal;
  if (hasNaN(segment)) return {.passed = kNaN};
  const auto line = kernel_->clip(segment);
  if (!line) return proposal;
  const Rgb sigmaT = trackedSigmaT(), sigmaS = sigmaT * albedo_;
  // Where nobody has proven that nothing is there, there may be something.
  const float most = kernel_->superVoxels().maximum();
  const float least = kernel_->bounds().areProven() ? 0 : most > 0 ? kLeastControl * most : 1;
  EmissionSampler sampler(kScatteringDefence, random.rng(), lawOfFlights());
  double column = 0;
  line->walkCells([&](double sEnter, double sExit, const SuperVoxel& bound) {
    const float density = std::max(bound.upper > 0 ? controlDensity(bound) : 0.0f, least);
    if (!(density > 0)) return true;
    sampler.add(sEnter, sExit, channelsOf(magnitudes(throughput) * sigmaS * density),
                channelsOf(sigmaT * density));
    column += static_cast<double>(density) * (sExit - sEnter);
    return true;
  });
  for (std::size_t c = 0; c < 3; ++c) {
    const double passed = transmittanceOf(law_, static_cast<double>(sigmaT[c]) * column);
    proposal.passed[c] = static_cast<float>(passed);
    proposal.scattered += std::abs(double{throughput[c]}) * double{albedo_[c]} * (1 - passed);
  }
  const auto distance = sampler.distance();
  if (!distance) return proposal;
  ++counters.densityLookups;
  proposal.t = std::clamp(line->tEntry() + distance->s, segment.tMin, segment.tMax);
  proposal.pdf = distance->pdf;
  proposal.sigmaS = sigmaS * kernel_->density(*line, distance->s);
  return proposal;
}

Rgb FieldMedium::collisionShare(const Segment& segment, PixelStream random, RenderCounters& counters) const {
  if (isExponential_) return transmittance(segment, random, counters);
  if (hasNaN(segment)) return kNaN;
  Rgb share(1.0f);
  if (const auto line = lineOf(segment)) {
    explore(*line, random, counters);
    const Rgb sigmaT = trackedSigmaT() * static_cast<float>(collisions_.depthScale);
    share = sigmaT.isGrey()
                ? estimate(*line, segment, collisions_.estimator, Channels<1>{sigmaT.r}, random, counters)
                : estimate(*line, segment, collisions_.estimator, channelsOf(sigmaT), random, counters);
  }
  return share * static_cast<float>(collisionsAtStart(law_));
}

void FieldMedium::flyToEmission(EmissionSamples& samples, const ClippedLine& emissionLine,
                                const Segment& segment, PixelStream random, RenderCounters& counters) const {
  const auto line = kernel_->clip(segment);
  if (!line) return;
  const Rgb sigmaT = trackedSigmaT();
  const FreeFlight flight =
      sigmaT.isGrey() ? flyOn(*line, segment, FlightQuery<1>{.sigmaT = {sigmaT.r}, .law = lawOfFlights()},
                              random, counters)
                      : flyOn(*line, segment,
                              FlightQuery<3>{.sigmaT = channelsOf(sigmaT),
                                             .importance = importanceOf(channelsOf(emission_.sourceOf())),
                                             .law = lawOfFlights()},
                              random, counters);
  if (!flight.collided) return;
  const double t = std::clamp(flight.t, segment.tMin, segment.tMax);
  const double share = emission_.flightShareAt(emissionLine, flight.t - emissionLine.tEntry());
  if (!(share > 0)) return;
  samples.add(t, flight.weight * emission_.sourceAt(pointOf(segment, t)) * static_cast<float>(share));
}

std::unique_ptr<const EmissionVolume> FieldMedium::emissionVolume(const Bounds3f&) const {
  return emission_.volume(kernel_->superVoxels(), kernel_->worldFromLocal());
}

Bounds3f FieldMedium::bounds() const {
  const Bounds3d& occupied = kernel_->superVoxels().occupied();
  if (occupied.isEmpty()) return {};
  Bounds3f box;
  for (int i = 0; i < 8; ++i) {
    const Vec3d p = kernel_->worldFromLocal().point(occupied.corner(i));
    for (std::size_t a = 0; a < 3; ++a) {
      const float x = static_cast<float>(p[a]);
      box.min[a] = std::min(box.min[a], std::nextafter(x, -kInfinity));
      box.max[a] = std::max(box.max[a], std::nextafter(x, kInfinity));
    }
  }
  return box;
}

void FieldMedium::exploreBounds(const Exploration& plan, std::size_t first, std::size_t last,
                                std::uint64_t seed, RenderCounters& counters) const {
  const LearnedBounds* const learned = kernel_->bounds().learned();
  if (learned == nullptr) return;
  counters.densityLookups += pbrtmedia::exploreBounds(*learned, plan, first, last, seed,
                                                      [&](Vec3d p) { return kernel_->uncutDensity(p); });
}

std::string FieldMedium::complaint() const {
  std::string text = kernel_->complaint();
  if (const double share = trackedShare(); share < 1) {
    std::ostringstream more;
    more << (text.empty() ? "" : "; ") << "its extinction is rendered as "
         << static_cast<float>(double{sigmaT_.max()} * share) << " at density 1 instead of " << sigmaT_.max()
         << ", as bounds that nobody has proven cost a null collision for each mean free path: it looks the "
            "same "
            "except where its density is below a thousandth of the largest, where more light passes";
    text += more.str();
  }
  if (const double scatterings = densestScattering() * double{length(bounds().diagonal())};
      traitsOf(flights_).mayBeNegative && scatterings > kManyScatterings) {
    std::ostringstream more;
    more << (text.empty() ? "" : "; ") << "paths may scatter often in it, as "
         << static_cast<float>(scatterings)
         << " mean free paths lie in its box, and weights of free flights by \"" << nameOf(flights_)
         << "\" have either sign: few paths bring most of the image, so that it is mostly too dark, by more "
            "than "
            "its noise tells; other free flights (medialab list) have positive weights";
    text += more.str();
  }
  return text;
}

std::string FieldMedium::describe() const {
  const SuperVoxels& cells = kernel_->superVoxels();
  const auto& n = cells.shape().count;
  std::ostringstream text;
  text << kernel_->describe();
  if (kernel_->bounds().learned() != nullptr) {
    text << ", bounds learned";
  } else if (!kernel_->bounds().areProven()) {
    text << ", bounds given";
  }
  text << ", super-voxels " << n.x << " x " << n.y << " x " << n.z << " (" << cells.emptyCells()
       << " empty), estimator " << nameOf(estimator_);
  if (isAuto_) text << " (auto)";
  if (!isExponential_) text << " (law " << nameOf(law_) << ')';
  if (samplingPattern_ != PatternKind::Independent)
    text << " (pattern " << kPatternNames[static_cast<std::size_t>(samplingPattern_)] << ')';
  text << ", free flights " << nameOf(flights_) << ", " << (sigmaT_.isGrey() ? "1 channel" : "3 channels")
       << emission_.describe() << ", " << kernel_->bytes() + emission_.bytes() << " bytes";
  return text.str();
}

std::optional<ClippedLine> FieldMedium::lineOf(const Segment& segment) const {
  auto line = kernel_->clip(segment);
  const double sigmaMax = sigmaT_.max();
  const double column = line ? line->length() * double{kernel_->superVoxels().maximum()} : 0;
  if (sigmaMax * column > kRefinedDepth && kernel_->bounds().areProven()) [[unlikely]]
    line->refineAbove(kRefinedDepth / sigmaMax);
  return line;
}

std::optional<ClippedLine> FieldMedium::emissionLine(const Segment& segment) const {
  if (!emission_.isEmissive() || hasNaN(segment)) return std::nullopt;
  return ClippedLine::clip(kernel_->localFromWorld(), emission_.cells(kernel_->superVoxels()), segment);
}

Rgb FieldMedium::dimmed(const ClippedLine& line, const Segment& segment, PixelStream random,
                        RenderCounters& counters) const {
  if (line.isRefined() && isExponential_) [[unlikely]]
    return dimmedOrOpaque(line, segment, random, counters);
  const Rgb sigmaT = trackedSigmaT();
  return sigmaT.isGrey() ? estimate(line, segment, estimator_, Channels<1>{sigmaT.r}, random, counters)
                         : estimate(line, segment, estimator_, channelsOf(sigmaT), random, counters);
}

double FieldMedium::trackedShare() const {
  if (kernel_->bounds().areProven() || !isExponential_) return 1;
  const double depth = double{sigmaT_.max()} * double{kernel_->superVoxels().maximum()} * extent_;
  return depth > kMostDepth ? kMostDepth / depth : 1;
}

Rgb FieldMedium::dimmedOrOpaque(const ClippedLine& line, const Segment& segment, PixelStream random,
                                RenderCounters& counters) const {
  constexpr double kOpaque = 746;  // exp of less is 0
  double column = 0;
  auto add = [&](double sEnter, double sExit, const SuperVoxel& bound) {
    column += bound.lower * (sExit - sEnter);
    return !(sigmaT_.min() * column >= kOpaque);
  };
  kernel_->walk(line, AnyVisit(add));
  Channels<3> clear = channelsOf(sigmaT_);
  for (double& sigma : clear) sigma = sigma * column >= kOpaque ? 0 : sigma;
  const Rgb through =
      clear == Channels<3>{} ? Rgb(1.0f) : estimate(line, segment, estimator_, clear, random, counters);
  Rgb result;
  for (std::size_t c = 0; c < 3; ++c) result[c] = sigmaT_[c] * column >= kOpaque ? 0 : through[c];
  return result;
}

template <class F>
auto FieldMedium::withEstimateStream(PixelStream random, const F& f) const {
  if (PixelSample* const pixel = random.sample();
      pixel != nullptr && samplingPattern_ != PatternKind::Independent && pixel->index < pixel->count &&
      pixel->count <= std::numeric_limits<std::uint32_t>::max()) {
    // The n-th estimates of all samples of a pixel share a pattern.
    const SamplingPattern pattern(samplingPattern_, static_cast<std::uint32_t>(pixel->count),
                                  hashCombine(pixel->key, pixel->estimates++));
    SampleStream stream(random.rng(), pattern, static_cast<std::uint32_t>(pixel->index));
    return f(stream);
  }
  SampleStream stream(random.rng());
  return f(stream);
}

template <std::size_t N>
Rgb FieldMedium::estimate(const ClippedLine& line, const Segment& segment, const AnyEstimator& estimator,
                          const Channels<N>& sigmaT, PixelStream random, RenderCounters& counters) const {
  return withEstimateStream(random, [&](SampleStream& stream) {
    const Estimate<N> result = kernel_->estimate(line, sigmaT, estimator, stream);
    count(line, segment, result.tally, counters);
    return toRgb(result.value);
  });
}

template <std::size_t N>
PairedTransmittance FieldMedium::paired(const ClippedLine& line, const Segment& segment,
                                        const Channels<N>& sigmaT, PixelStream random,
                                        RenderCounters& counters) const {
  return withEstimateStream(random, [&](SampleStream& stream) {
    const PairedEstimate<N> result = kernel_->paired(line, sigmaT, estimator_, stream);
    count(line, segment, result.tally, counters);
    return PairedTransmittance{toRgb(result.value), toRgb(result.spread)};
  });
}

template <std::size_t N>
FreeFlight FieldMedium::flyOn(const ClippedLine& line, const Segment& segment, const FlightQuery<N>& query,
                              PixelStream random, RenderCounters& counters) const {
  SampleStream stream(random.rng());
  const FlightSample<N> result = kernel_->fly(line, query, flights_, stream);
  count(line, segment, result.tally, counters);
  const Rgb weight = toRgb(result.weight);
  if (!result.collided) return {false, 0, weight};
  return {true, line.tEntry() + result.s, weight};
}

void FieldMedium::explore(const ClippedLine& line, PixelStream random, RenderCounters& counters) const {
  const LearnedBounds* const learned = kernel_->bounds().learned();
  if (learned == nullptr || !learned->isExploring()) return;
  const Vec3d p = line.pointAt(line.length() * random.rng().uniformDouble());
  learned->probe(p, kernel_->uncutDensity(p), static_cast<double>(sigmaT_.max()) * line.length());
  ++counters.densityLookups;
}

void FieldMedium::count(const ClippedLine& line, const Segment& segment, const LookupTally& tally,
                        RenderCounters& counters) const {
  tally.addTo(counters);
  if (tally.violations == 0 || counters.violation) return;
  const double t = line.tEntry() + tally.worstS;
  counters.violation = BoundViolation{name(), segment.o, segment.d, t, tally.worstDensity, tally.worstBound};
}

}  // namespace pbrtmedia
