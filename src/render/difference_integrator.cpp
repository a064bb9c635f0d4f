// SPDX-License-Identifier: BSD-2-Clause
#include "render/difference_integrator.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/interruption.h"
#include "film/combination.h"
#include "film/film.h"
#include "render/pass_loop.h"
#include "samplers/sampler.h"

namespace pbrtmedia {
namespace {

/// By default an image has as many passes, or more: levels are drawn often enough, and scenes are not built
/// for every sample.
constexpr std::int64_t kUsualPasses = 64, kMostSamplesPerPass = 16;

std::vector<double> valuesOf(const std::vector<DifferenceTerm>& terms) {
  std::vector<double> values;
  values.reserve(terms.size());
  for (const DifferenceTerm& term : terms) values.push_back(term.value);
  return values;
}

/// What the film was before its first sample.
Film::State emptied(const Film& film) {
  Film::State state = film.state();
  std::fill(state.sums.begin(), state.sums.end(), Film::Sums());
  std::fill(state.odd.begin(), state.odd.end(), Film::Sums());
  state.splats.clear();
  state.oddSplats.clear();
  state.paths = {};
  state.oddPaths = 0;
  return state;
}

}  // namespace

class DifferenceIntegrator::Passes {
 public:
  Passes(const DifferenceIntegrator& integrator, const Sampler& sampler, Film& film,
         const RenderOptions& options)
      : family_(integrator.family_),
        schedule_(integrator.schedule_),
        film_(film),
        options_(options),
        loop_(
            integrator.scene(), options,
            {.end = std::min(options.samplesPerPixel.value_or(sampler.samplesPerPixel()), options.endSample),
             .samplesPerIndex = pixels(),
             .pixels = pixels(),
             .mostPerPass = options.samplesPerPass.value_or(1)}) {}

  RenderResult run() {
    return loop_.run([this](const Pass& pass) { return takeSamples(pass); },
                     [this](std::span<const UnitReport> units) { addToFilm(areComplete(units)); });
  }

 private:
  std::uint64_t pixels() const {
    const Bounds2i samples = film_.sampleBounds();
    const Bounds2i taken = options_.pixelBounds ? intersect(samples, *options_.pixelBounds) : samples;
    return static_cast<std::uint64_t>(taken.area());
  }

  std::vector<UnitReport> takeSamples(const Pass& pass) {
    const std::int64_t number = pass.first / *options_.samplesPerPass;
    terms_ = schedule_.terms(number);
    std::vector<double> values = valuesOf(terms_);
    // What the next pass needs too is not built again.
    for (const double value : valuesOf(schedule_.terms(number + 1))) values.push_back(value);
    family_.keep(values);
    films_.clear();
    std::vector<UnitReport> reports;
    try {
      for (const DifferenceTerm& term : terms_) {
        const SceneFamily::Member member = family_.at(term.value);
        films_.push_back({&member.film, term.factor});
        reports.push_back(reportOf(renderMember(member, pass), reports.empty()));
        if (!reports.back().complete) return leftInside();
      }
    } catch (const Interrupted&) {  // while a scene was built
      return leftInside();
    }
    return reports;
  }

  /// Sides of a difference that have not all samples are no difference.
  static std::vector<UnitReport> leftInside() { return std::vector<UnitReport>(1); }

  RenderResult renderMember(const SceneFamily::Member& member, const Pass& pass) {
    if (film_.hasHalves()) member.film.keepHalves();
    member.film.restore(emptied(member.film));
    RenderOptions render;
    render.seed = options_.seed;
    render.samplesPerPixel = options_.samplesPerPixel;
    render.firstSample = pass.first;
    render.endSample = pass.first + pass.count;
    render.pixelBounds = options_.pixelBounds;
    render.tileSize = options_.tileSize;
    render.samplesPerPass = pass.count;
    render.stop = options_.stop;
    render.maxRecords = options_.maxRecords;
    std::uint64_t counted = 0;
    const std::uint64_t before = films_.size() - 1, all = terms_.size();
    render.progress = [&](const RenderProgress& p) {
      const std::uint64_t done = (before * p.samplesTotal + p.samplesDone) / all,
                          known = before * p.samplesTotal / all + counted;
      if (done <= known) return;
      loop_.count(done - known);
      counted += done - known;
      loop_.reportProgress();
    };
    return member.integrator.render(member.camera, member.sampler, member.film, render);
  }

  /// `isFirst`: all members take the same samples, which count once.
  static UnitReport reportOf(const RenderResult& result, bool isFirst) {
    UnitReport report;
    report.counters = result.counters;
    if (isFirst) {
      report.samples = result.samplesTaken;
      report.pixelsSampled = result.pixelsSampled;
    }
    report.dropped = result.dropped;
    report.mismatches = result.mismatches;
    report.violations = result.violations;
    report.complete = !result.interrupted;
    return report;
  }

  void addToFilm(bool isComplete) {
    if (!isComplete || addCombination(film_, films_)) return;
    throw SceneError({},
                     "the parameter of the derivative changes how samples count for pixels (filter, sampler, "
                     "film), and not only the light of the scene");
  }

  SceneFamily& family_;
  const DifferenceSchedule& schedule_;
  Film& film_;
  const RenderOptions& options_;
  std::vector<DifferenceTerm> terms_;  ///< of the pass under way
  std::vector<FilmTerm> films_;        ///< their films, as far as they are rendered
  PassLoop loop_;
};

int DifferenceIntegrator::samplesPerPass(std::int64_t samplesPerPixel) const {
  return samplesPerPass_.value_or(
      static_cast<int>(std::clamp<std::int64_t>(samplesPerPixel / kUsualPasses, 1, kMostSamplesPerPass)));
}

RenderResult DifferenceIntegrator::render(const Camera& /*camera*/, const Sampler& sampler, Film& film,
                                          const RenderOptions& options) const {
  // A pass has the samples of one level, whoever looks on.
  RenderOptions passes = options;
  passes.samplesPerPass = samplesPerPass(options.samplesPerPixel.value_or(sampler.samplesPerPixel()));
  return Passes(*this, sampler, film, passes).run();
}

std::string DifferenceIntegrator::whyInOnePiece() const {
  return "the samples of a pass share their step; render the whole with other seeds, and imgtool merge takes "
         "the mean";
}

}  // namespace pbrtmedia
