// SPDX-License-Identifier: BSD-2-Clause
#include "render/difference_integrator.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "base/interruption.h"
#include "film/combination.h"
#include "film/film.h"
#include "render/pass_loop.h"
#include "render/render_state.h"
#include "render/shared_bounds.h"
#include "samplers/sampler.h"

namespace pbrtmedia {
namespace {

/// By default an image has as many passes, or more: levels are drawn often enough, and scenes are not built
/// for every sample.
constexpr std::int64_t kUsualPasses = 64, kMostSamplesPerPass = 16;
/// "part" in ASCII: keeps the random numbers of sums that start again apart from other uses of the seed.
constexpr std::uint64_t kPartTag = 0x70617274;

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
        samplesPerPass_(options.samplesPerPass.value_or(1)),
        bounds_(integrator.scene()),
        rendersSums_(integrator.rendersSums_),
        loop_(
            integrator.scene(), options,
            {.end = std::min(options.samplesPerPixel.value_or(sampler.samplesPerPixel()), options.endSample),
             .samplesPerIndex = pixels(),
             .pixels = pixels(),
             .mostPerPass = integrator.takesSingleSamples_ ? 1 : samplesPerPass_}) {}

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
    const std::int64_t number = pass.first / samplesPerPass_;
    terms_ = schedule_.terms(number);
    std::vector<double> values = valuesOf(terms_);
    // What the next pass needs too is not built again.
    for (const double value : valuesOf(schedule_.terms(number + 1))) values.push_back(value);
    family_.keep(values);
    films_.clear();
    std::vector<UnitReport> reports;
    try {
      std::vector<SceneFamily::Member> members;
      for (const DifferenceTerm& term : terms_) {
        members.push_back(family_.at(term.value));
        bounds_.lendTo(members.back().integrator.scene());
      }
      startCarried();
      if (members.front().integrator.rendersSums()) {
        reports.push_back(reportOf(renderSum(members, pass), true));
        films_.push_back({&members.front().film, 1});
      } else {
        for (std::size_t i = 0; i < members.size(); ++i) {
          reports.push_back(reportOf(renderMember(i, members[i], pass), reports.empty()));
          films_.push_back({&members[i].film, terms_[i].factor});
          if (!reports.back().complete) break;
        }
      }
      for (const SceneFamily::Member& member : members) bounds_.takeBackFrom(member.integrator.scene());
    } catch (const Interrupted&) {  // while a scene was built
      return leftInside();
    }
    return reports.back().complete ? reports : leftInside();
  }

  /// Sides of a difference that have not all samples are no difference.
  static std::vector<UnitReport> leftInside() { return std::vector<UnitReport>(1); }

  /// What all scenes of a pass go on from.
  void startCarried() {
    if (!loop_.carried().empty()) return;
    loop_.carried() = family_.at(schedule_.params().value).integrator.carriedAtStart(pixels());
  }

  RenderResult renderMember(std::size_t i, const SceneFamily::Member& member, const Pass& pass) {
    RenderState start;
    RenderOptions render = optionsOf(pass, i, start);
    if (member.integrator.whyInOnePiece().empty()) {
      render.start = nullptr;
      render.firstSample = pass.first;
    }
    prepare(member.film);
    RenderResult result = member.integrator.render(member.camera, member.sampler, member.film, render);
    if (i == nearest()) carried_ = std::move(result.carried);
    if (render.start) result.samplesTaken -= start.result.samplesTaken;
    return result;
  }

  /// All scenes at once. Where they are others in each pass, each is a whole of its own.
  RenderResult renderSum(std::span<const SceneFamily::Member> members, const Pass& pass) {
    std::vector<ImageTerm> images;
    for (std::size_t i = 0; i < members.size(); ++i)
      images.push_back({members[i].integrator, members[i].camera, terms_[i].factor});
    RenderState start;
    RenderOptions render = optionsOf(pass, 0, start);
    std::optional<std::int64_t> parts;
    if (schedule_.params().debias != DifferenceSchedule::Debias::None) {
      parts = kUsualPasses;  // whatever there are: the same samples however many follow
      render.seed = hashCombine(options_.seed, kPartTag, static_cast<std::uint64_t>(pass.first));
      start.result.carried.clear();
    }
    const SceneFamily::Member& first = members.front();
    prepare(first.film);
    RenderResult result = first.integrator.renderSum(images, parts, first.sampler, first.film, render);
    carried_ = parts ? std::vector<double>() : std::move(result.carried);
    result.samplesTaken -= start.result.samplesTaken;
    return result;
  }

  void prepare(Film& film) const {
    if (film_.hasHalves()) film.keepHalves();
    film.restore(emptied(film));
  }

  /// Of the render of term `i`, which goes on from `start`.
  RenderOptions optionsOf(const Pass& pass, std::size_t i, RenderState& start) {
    start.result.carried = loop_.carried();
    start.result.completedSamplesPerPixel = pass.first;
    start.result.samplesTaken = static_cast<std::uint64_t>(pass.first) * pixels();
    RenderOptions render;
    render.start = &start;
    render.seed = options_.seed;
    render.samplesPerPixel = options_.samplesPerPixel;
    render.endSample = pass.first + pass.count;
    render.pixelBounds = options_.pixelBounds;
    render.tileSize = options_.tileSize;
    render.samplesPerPass = pass.count;
    render.stop = options_.stop;
    render.maxRecords = options_.maxRecords;
    render.learnsBounds = false;
    const std::uint64_t total = static_cast<std::uint64_t>(pass.count) * pixels();
    const std::uint64_t all = rendersSums_ ? 1 : terms_.size();
    render.progress = [this, i, total, all, counted = std::uint64_t{0}](const RenderProgress& p) mutable {
      const std::uint64_t left = p.samplesTotal - std::min(p.samplesTotal, p.samplesDone),
                          done = (i * total + total - std::min(total, left)) / all,
                          known = i * total / all + counted;
      if (done <= known) return;
      loop_.count(done - known);
      counted += done - known;
      loop_.reportProgress();
    };
    return render;
  }

  /// Number of the term whose scene is nearest to that at the value: what it carries to its next pass is what
  /// all do.
  std::size_t nearest() const {
    const auto distance = [&](const DifferenceTerm& term) {
      return std::abs(term.value - schedule_.params().value);
    };
    return static_cast<std::size_t>(std::ranges::min_element(terms_, {}, distance) - terms_.begin());
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
    if (!isComplete) return;
    loop_.carried() = std::move(carried_);
    if (addCombination(film_, films_)) return;
    throw SceneError({},
                     "the parameter of the derivative changes how samples count for pixels (filter, sampler, "
                     "film), and not only the light of the scene");
  }

  SceneFamily& family_;
  const DifferenceSchedule& schedule_;
  Film& film_;
  const RenderOptions& options_;
  std::int64_t samplesPerPass_;        ///< that share step and level
  std::vector<DifferenceTerm> terms_;  ///< of the pass under way
  std::vector<FilmTerm> films_;        ///< their films, as far as they are rendered
  std::vector<double> carried_;        ///< from them to the next pass
  SharedBounds bounds_;
  bool rendersSums_;
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
