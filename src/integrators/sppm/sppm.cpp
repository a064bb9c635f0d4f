// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/sppm.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/interruption.h"
#include "base/parallel.h"
#include "film/film.h"
#include "integrators/path/path_tracer.h"
#include "integrators/sppm/photon_gather.h"
#include "integrators/sppm/photon_tracer.h"
#include "integrators/sppm/pixel_radii.h"
#include "render/pass_loop.h"
#include "render/sample_taker.h"
#include "samplers/halton.h"
#include "samplers/radical_inverse.h"

namespace pbrtmedia {
namespace {

/// "phot", "time" and "leve" in ASCII: keep random numbers of these apart from other uses of the same seed.
constexpr std::uint64_t kPhotonTag = 0x70686f74, kTimeTag = 0x74696d65, kLevelTag = 0x6c657665;
/// Light paths of one unit of work.
constexpr std::int64_t kPathsOfUnit = 1024;
/// Light paths that a correction of bias may have, unless iterations have more anyway: some gigabytes of
/// photons. What limits it only makes it noisier.
constexpr std::int64_t kMostPathsOfCorrection = std::int64_t{1} << 22;

/// Van der Corput's sequence in base 2: any 2^k values in a row are spread evenly.
double radicalInverse(std::uint64_t index) {
  double value = 0;
  for (double digit = 0.5; index > 0; index >>= 1, digit /= 2) value += (index & 1) != 0 ? digit : 0;
  return value;
}

/// A camera all of whose rays are at one time.
class CameraAtTime final : public Camera {
 public:
  CameraAtTime(const Camera& camera, float time)
      : Camera(camera.worldFromCamera(), 0, 0), camera_(camera), time_(time) {}
  WeightedRay generateRay(Point2f film, Point2f lens, float) const override {
    return camera_.generateRay(film, lens, time_);
  }

 private:
  const Camera& camera_;
  float time_;
};

/// The camera's half of the samples of one thread.
class CameraPaths final : public SamplingIntegrator {
 public:
  CameraPaths(const PathSetup& setup, const MediaTopology& media, IndirectLight& indirect)
      : SamplingIntegrator(setup.scene), setup_(setup), media_(media), indirect_(indirect) {}
  std::string_view typeName() const override { return "sppm"; }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override {
    return PathTracer(setup_, ray, media_.stateOf(ray, context.counters), context, &indirect_).trace();
  }

 private:
  const PathSetup& setup_;
  const MediaTopology& media_;
  IndirectLight& indirect_;
};

}  // namespace

/// One render.
class SppmIntegrator::Iterations {
 public:
  Iterations(const SppmIntegrator& sppm, const Camera& camera, const Sampler& sampler, Film& film,
             const RenderOptions& options)
      : sppm_(sppm),
        camera_(camera),
        sampler_(sampler),
        film_(film),
        options_(options),
        bounds_(options.pixelBounds ? intersect(film.sampleBounds(), *options.pixelBounds)
                                    : film.sampleBounds()),
        iterations_(options.samplesPerPixel.value_or(sampler.samplesPerPixel())),
        paths_(sppm.needsPhotons() ? sppm.params_.photonsPerIteration.value_or(film.pixelBounds().area())
                                   : 0),
        schedule_(sppm.params_.schedule),
        hasMedia_(sppm.media_.hasMedia()),
        setup_{sppm.scene(),
               sppm.pathParams_,
               sppm.scene().illuminants().size(),
               sppm.selector_.get(),
               hasMedia_ || sppm.scene().hasShadowAlpha() ? &sppm.media_ : nullptr,
               hasMedia_ ? &sppm.singleScattering_ : nullptr,
               sppm.media_.hasEmission()},
        loop_(sppm.scene(), options,
              {.end = std::min(iterations_, options.endSample),
               .samplesPerIndex = static_cast<std::uint64_t>(bounds_.area()),
               .pixels = static_cast<std::uint64_t>(bounds_.area())}) {
    CHECK(options.firstSample == 0 || !sppm.hasOwnRadii()) << sppm.whyInOnePiece();
    std::vector<double> start = sppm.carriedAtStart(static_cast<std::uint64_t>(bounds_.area()));
    std::vector<double>& carried = loop_.carried();
    if (!carried.empty() && carried.size() != start.size())
      throw SceneError({}, "the checkpoint lacks the radii of \"sppm\"");
    if (carried.empty()) carried = std::move(start);
  }

  RenderResult run() {
    return loop_.run([this](const Pass& pass) { return iterate(pass); },
                     [this](std::span<const UnitReport> units) { finish(units); });
  }

 private:
  struct Iteration {
    std::int64_t number;
    float time;
    KernelSizes sizes;   ///< of all pixels, unless they have radii of their own
    std::int64_t paths;  ///< from the lights
    /// Of photons: the numbers of their sampler go on from one iteration to the next where these are alike.
    std::uint64_t samplerSeed;
    std::int64_t firstPath;
  };

  Iteration iterationOf(std::int64_t number) const {
    Iteration iteration{number,         timeOf(number), {}, paths_, hashCombine(options_.seed, kPhotonTag),
                        number * paths_};
    if (sppm_.hasOwnRadii()) return iteration;
    const KernelSchedule::Step step = schedule_.of(number, levelSample(number));
    iteration.sizes = step.sizes;
    const auto paths = static_cast<double>(std::max<std::int64_t>(paths_, 1));
    const double most = std::max(1.0, static_cast<double>(kMostPathsOfCorrection) / paths);
    iteration.paths = static_cast<std::int64_t>(std::min(step.photons, most) * static_cast<double>(paths_));
    iteration.samplerSeed = hashCombine(iteration.samplerSeed, static_cast<std::uint64_t>(number));
    iteration.firstPath = 0;
    return iteration;
  }
  /// Uniform in [0, 1), evenly spread over iterations: rare levels come as often as they should.
  double levelSample(std::int64_t iteration) const {
    const double shifted = radicalInverse(static_cast<std::uint64_t>(iteration)) +
                           Rng(hashCombine(options_.seed, kLevelTag)).uniformDouble();
    return shifted - std::floor(shifted);
  }

  std::vector<UnitReport> iterate(const Pass& pass) {
    const Iteration iteration = iterationOf(pass.first);
    std::vector<UnitReport> units = tracePhotons(iteration);
    taken_.emplace(film_.sampleBounds(), pass.count, film_.layers(), pass.first);
    if (areComplete(units)) {
      std::vector<UnitReport> rows = takeSamples(iteration);
      units.insert(units.end(), std::make_move_iterator(rows.begin()), std::make_move_iterator(rows.end()));
    }
    if (!areComplete(units)) leaveOut(units);
    return units;
  }

  /// Where between opening and closing of the shutter, for all rays.
  float timeOf(std::int64_t iteration) const {
    return scrambledRadicalInverse<2>(static_cast<std::uint64_t>(iteration),
                                      static_cast<std::uint64_t>(iterations_),
                                      hashCombine(options_.seed, kTimeTag));
  }

  std::vector<UnitReport> tracePhotons(const Iteration& iteration) {
    const auto count = static_cast<std::size_t>((iteration.paths + kPathsOfUnit - 1) / kPathsOfUnit);
    std::vector<Photons> found(count);
    std::vector<UnitReport> units(count);
    const Point2f middle{static_cast<float>(film_.settings().resolution.x) / 2,
                         static_cast<float>(film_.settings().resolution.y) / 2};
    const float sceneTime = camera_.generateRay(middle, {.5f, .5f}, iteration.time).ray.time;
    parallelFor(count, [&](std::size_t i) {
      const std::int64_t first = static_cast<std::int64_t>(i) * kPathsOfUnit;
      traceUnit(iteration, {first, std::min(first + kPathsOfUnit, iteration.paths)}, sceneTime, found[i],
                units[i]);
    });
    if (!areComplete(units)) return units;
    Photons all;
    for (Photons& unit : found) {
      all.onSurfaces.insert(all.onSurfaces.end(), unit.onSurfaces.begin(), unit.onSurfaces.end());
      all.inMedia.insert(all.inMedia.end(), unit.inMedia.begin(), unit.inMedia.end());
      unit = {};
    }
    maps_ = {PhotonMap<SurfacePhoton>(all.onSurfaces), PhotonMap<MediumPhoton>(all.inMedia),
             static_cast<double>(std::max<std::int64_t>(iteration.paths, 1))};
    return units;
  }

  struct Range {
    std::int64_t first, end;
  };
  void traceUnit(const Iteration& iteration, Range paths, float time, Photons& found, UnitReport& unit) {
    const PhotonSetup setup{.scene = sppm_.scene(),
                            .media = hasMedia_ ? &sppm_.media_ : nullptr,
                            .selector = *sppm_.photonSelector_,
                            .mostScatterings = sppm_.params_.maxDepth - 1,
                            .time = time};
    HaltonSampler sampler({.pixelSamples = iteration.paths, .seed = iteration.samplerSeed});
    for (std::int64_t i = paths.first; i < paths.end; ++i) {
      if (loop_.shouldStop()) return;
      sampler.start({0, 0}, iteration.firstPath + i);
      Rng rng(hashCombine(options_.seed, static_cast<std::uint64_t>(iteration.number),
                          static_cast<std::uint64_t>(i), kPhotonTag));
      try {
        PhotonTracer(setup, sampler, rng, unit.counters).trace(found);
      } catch (const Interrupted&) {
        return;
      }
    }
    unit.complete = true;
  }

  std::vector<UnitReport> takeSamples(const Iteration& iteration) {
    const CameraAtTime camera(camera_, iteration.time);
    found_.assign(static_cast<std::size_t>(bounds_.area()), {});
    std::vector<UnitReport> rows(static_cast<std::size_t>(bounds_.height()));
    parallelFor(rows.size(), [&](std::size_t row) { takeRow(camera, row, iteration, rows[row]); });
    return rows;
  }

  void takeRow(const Camera& camera, std::size_t row, const Iteration& iteration, UnitReport& unit) {
    PhotonGather gather(maps_, sppm_.params_.maxDepth);
    const CameraPaths paths(setup_, sppm_.media_, gather);
    SampleTaker taker(camera, sampler_, paths, film_, options_, iterations_);
    std::size_t pixel = row * static_cast<std::size_t>(bounds_.width());
    for (int x = bounds_.min.x; x < bounds_.max.x; ++x, ++pixel) {
      if (loop_.shouldStop()) return;
      gather.begin(kernelsOf(pixel, iteration));
      try {
        taker.take({x, bounds_.min.y + static_cast<int>(row)}, iteration.number, 0, *taken_, unit, nullptr);
      } catch (const Interrupted&) {
        return;
      }
      found_[pixel] = gather.found();
      ++unit.pixelsSampled;
    }
    loop_.count(unit.samples);
    loop_.reportProgress();
    unit.complete = true;
  }

  PhotonGather::Kernels kernelsOf(std::size_t pixel, const Iteration& iteration) {
    const SppmParams& params = sppm_.params_;
    if (!sppm_.hasOwnRadii()) {
      return {{params.kernel, params.radius, iteration.sizes},
              {params.kernel, params.radius, iteration.sizes}};
    }
    const PixelRadii::Radii radii = PixelRadii(loop_.carried()).of(pixel);
    return {{params.kernel, radii.onSurfaces}, {params.kernel, radii.inMedia}};
  }

  /// Part of an iteration is none: photons are of all its light paths, and pixels go on together.
  static void leaveOut(std::vector<UnitReport>& units) {
    for (UnitReport& unit : units) {
      unit.abandoned = std::exchange(unit.samples, 0);
      unit.pixelsSampled = 0;
    }
  }

  void finish(std::span<const UnitReport> units) {
    if (areComplete(units)) {
      film_.accumulate(*taken_);
      if (sppm_.hasOwnRadii()) shrinkRadii();
    }
    taken_.reset();
    maps_ = {};
  }

  void shrinkRadii() {
    PixelRadii radii(loop_.carried());
    for (std::size_t pixel = 0; pixel < found_.size(); ++pixel) radii.shrink(pixel, found_[pixel]);
  }

  const SppmIntegrator& sppm_;
  const Camera& camera_;
  const Sampler& sampler_;
  Film& film_;
  const RenderOptions& options_;
  Bounds2i bounds_;
  std::int64_t iterations_;
  std::int64_t paths_;  ///< of an iteration, unless a correction of bias has more
  KernelSchedule schedule_;
  bool hasMedia_;
  PathSetup setup_;
  PhotonMaps maps_;
  std::optional<SamplePass> taken_;         ///< by the iteration under way
  std::vector<PhotonGather::Found> found_;  ///< by its samples
  PassLoop loop_;
};

SppmIntegrator::SppmIntegrator(const Scene& scene, const SppmParams& params,
                               std::unique_ptr<const LightSelector> selector,
                               std::unique_ptr<const LightSelector> photonSelector, CameraMedium cameraMedium)
    : Integrator(scene),
      params_(params),
      pathParams_{.maxDepth = params.maxDepth},
      selector_(std::move(selector)),
      photonSelector_(std::move(photonSelector)),
      media_(scene, std::move(cameraMedium)),
      singleScattering_(scene.lights(), selector_.get(), pathParams_.mediumLightSampling) {
  CHECK(selector_ || scene.illuminants().empty()) << "lights need a selector";
  CHECK(photonSelector_ || scene.illuminants().empty()) << "lights need a selector";
}
SppmIntegrator::~SppmIntegrator() = default;

RenderResult SppmIntegrator::render(const Camera& camera, const Sampler& sampler, Film& film,
                                    const RenderOptions& options) const {
  return Iterations(*this, camera, sampler, film, options).run();
}

std::vector<double> SppmIntegrator::carriedAtStart(std::uint64_t pixels) const {
  if (!hasOwnRadii()) return {};
  std::vector<double> numbers(pixels * PixelRadii::kNumbers);
  PixelRadii(numbers).start(params_.radius);
  return numbers;
}

std::string SppmIntegrator::whyInOnePiece() const {
  if (!hasOwnRadii()) return {};
  return "the radii of an iteration of \"sppm\" follow from what all those before have found";
}

}  // namespace pbrtmedia
