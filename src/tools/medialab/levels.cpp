// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/levels.h"

#include <cmath>
#include <functional>
#include <optional>
#include <stdexcept>
#include <vector>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "reciprocal/reciprocal_function.h"
#include "tools/medialab/fit.h"
#include "tools/medialab/moments.h"
#include "transmittance/estimator_list.h"
#include "transmittance/parts/nested_march.h"

namespace pbrtmedia {
namespace {

/// What an estimator telescopes over.
struct Telescope {
  std::uint64_t teeth;  ///< of its coarse march
  double rate;
  Comb comb;
  std::function<double(double)> function;  ///< of optical depth
};

template <class Estimator>
Telescope telescopeOf(const Estimator& e, std::function<double(double)> function) {
  return {e.n << e.levels, e.rate, e.comb, std::move(function)};
}

/// Nothing for an estimator that has no such levels.
std::optional<Telescope> findTelescope(const LabEstimator& estimator) {
  const auto ofTransmittance = [](const auto& e) {
    return telescopeOf(e, [law = e.law](double depth) { return transmittanceOf(law, depth); });
  };
  if (const AnyReciprocal* const any = std::get_if<AnyReciprocal>(&estimator.held())) {
    const auto* const e = std::get_if<ReciprocalTelescoping>(any);
    return e != nullptr ? std::optional(telescopeOf(*e, ReciprocalFunction{})) : std::nullopt;
  }
  const EstimatorVariant& held = std::get<AnyEstimator>(estimator.held()).held().variant;
  if (const auto* const e = std::get_if<DebiasedRayMarching>(&held)) return ofTransmittance(*e);
  if (const auto* const e = std::get_if<PrefixDebiasedRayMarching>(&held)) return ofTransmittance(*e);
  return std::nullopt;
}

enum class Coupling { Split, Independent };

/// Corrections of one level on one line.
class LevelSampler {
 public:
  LevelSampler(const Telescope& telescope, const LabProblem& problem, unsigned level, Coupling coupling)
      : telescope_(telescope), problem_(problem), teeth_(telescope.teeth << level), coupling_(coupling) {}

  std::uint64_t teeth() const { return teeth_; }
  std::uint64_t lookups() const { return coupling_ == Coupling::Split ? 2 * teeth_ : 3 * teeth_; }
  /// g(F) - (g(F_1) + g(F_2)) / 2 with the halves F_1, F_2 of F, or g(F) - g(F_1) with marches of their own.
  double correction(SampleStream& stream) const {
    const auto g = [&](double column) { return telescope_.function(problem_.sigmaT * column); };
    LookupTally tally;
    if (coupling_ == Coupling::Independent) {
      double value = 0;
      const auto march = [&](std::uint64_t teeth, double sign) {
        NestedMarch(telescope_.comb, teeth, 0)(problem_.line, stream, tally,
                                               [&](double column) { value += sign * g(column); });
      };
      march(2 * teeth_, 1);
      march(teeth_, -1);
      return value;
    }
    double halves = 0, column = 0;
    NestedMarch(telescope_.comb, teeth_, 1)(problem_.line, stream, tally, [&](double half) {
      halves += g(half) / 2;
      column += half / 2;
    });
    return g(column) - halves;
  }
  Moments sample(std::uint64_t seed, std::uint64_t trials, const StopSignal& stop) const {
    constexpr std::uint64_t kChunk = 512;
    std::vector<Moments> chunks(static_cast<std::size_t>((trials + kChunk - 1) / kChunk));
    parallelFor(chunks.size(), [&](std::size_t i) {
      if (stop) return;
      Rng rng(hashCombine(seed, i));
      SampleStream stream(rng);
      for (std::uint64_t t = i * kChunk; t < std::min(trials, (i + 1) * kChunk); ++t) {
        chunks[i].add(correction(stream));
      }
    });
    Moments all;
    for (const Moments& chunk : chunks) all.add(chunk);
    return all;
  }

 private:
  const Telescope& telescope_;
  const LabProblem& problem_;
  std::uint64_t teeth_;
  Coupling coupling_;
};

const char* nameOf(Coupling coupling) { return coupling == Coupling::Split ? "split" : "independent"; }

/// How variances fall, in a line.
std::string decayNote(const std::string& what, const std::vector<LogPoint>& points) {
  const LogSlope slope = fitLogSlope(points);
  const auto rounded = [](double x) { return formatNumber(std::round(1000 * x) / 1000); };
  return what + ": variance ~ look-ups^" + rounded(slope.slope) + " +- " + rounded(slope.error);
}

/// All levels of one estimator on one line under one coupling.
void addRows(LabTable& table, const LevelsOptions& o, const LabEstimator& estimator,
             const Telescope& telescope, const LabProblem& problem, const ProblemChoice& choice,
             Coupling coupling, const StopSignal& stop) {
  const std::string function = problem.line.function().about().name;
  std::vector<LogPoint> variances;
  for (unsigned level = 0; level < o.levels && !stop; ++level) {
    const LevelSampler sampler(telescope, problem, level, coupling);
    const std::uint64_t seed = hashCombine(rowSeed(o.lab.seed, estimator.label(), function, choice), level,
                                           coupling == Coupling::Split);
    const Moments m = sampler.sample(seed, o.trials, stop);
    if (stop) return;
    const double lookups = static_cast<double>(sampler.lookups());
    const double probability = telescope.rate * std::pow(1 - telescope.rate, level);
    const double square = m.variance() + m.mean() * m.mean();
    table.add({estimator.label(), function, choice.depth, std::string(nameOf(coupling)), std::uint64_t{level},
               sampler.teeth(), m.count(), m.mean(), m.meanError(), m.variance(), m.varianceError(), lookups,
               m.variance() * lookups, probability, square / probability, lookups * probability});
    variances.push_back({lookups, m.variance(), m.varianceError()});
  }
  if (variances.size() > 1) {
    table.note(decayNote(estimator.label() + " on " + function + ", depth " + formatNumber(choice.depth) +
                             ", " + nameOf(coupling),
                         variances));
  }
}

}  // namespace

LabTable levelsTable(const LevelsOptions& o, const StopSignal& stop) {
  o.problem.check();
  LabTable table(o.lab.command, {"estimator", "extinction", "depth", "coupling", "level", "teeth", "trials",
                                 "mean", "mean_stderr", "variance", "variance_stderr", "lookups",
                                 "variance_lookups", "probability", "second_moment_share", "lookups_share"});
  std::vector<LabTable::Skipped> skipped;
  const std::vector<LabEstimator> estimators = o.selection.select(skipped);
  noteQuantity(table, estimators);
  for (const auto& s : skipped) table.skip(s.what, s.reason);
  for (const LabEstimator& estimator : estimators) {
    const std::optional<Telescope> telescope = findTelescope(estimator);
    if (!telescope) {
      throw std::runtime_error(estimator.label() +
                               " has no levels; those that telescope: debiased-ray-marching, "
                               "prefix-debiased-ray-marching, reciprocal-telescoping");
    }
    if (telescope->teeth << o.levels > std::uint64_t{1} << 30) {
      throw std::runtime_error(estimator.label() + ": its last level of " + std::to_string(o.levels) +
                               " has more than 2^30 look-ups");
    }
    for (const CanonicalFunction& function : o.functions.select()) {
      for (const ProblemChoice& choice : problemChoices(o.problem, function)) {
        const LabProblem problem = makeProblem(o.problem, function, choice);
        for (const Coupling coupling : {Coupling::Split, Coupling::Independent}) {
          addRows(table, o, estimator, *telescope, problem, choice, coupling, stop);
          if (stop) {
            table.markStopped();
            return table;
          }
        }
      }
    }
  }
  return table;
}

int runLevels(const LevelsOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  writeTable(levelsTable(options, stop), options.lab);
  return 0;
}

}  // namespace pbrtmedia
