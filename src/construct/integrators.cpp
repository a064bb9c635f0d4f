// SPDX-License-Identifier: BSD-2-Clause
#include "construct/integrators.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "construct/enum_parameter.h"
#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "integrators/ambientocclusion/ambient_occlusion.h"
#include "integrators/bdpt/bdpt.h"
#include "integrators/direct/direct_lighting.h"
#include "integrators/direct/whitted.h"
#include "integrators/mlt/mlt.h"
#include "integrators/path/path.h"
#include "integrators/path/vol_path.h"
#include "integrators/sppm/sppm.h"
#include "lighting/light_strategy.h"
#include "media/medium.h"
#include "scene/param_reader.h"
#include "world/media_topology.h"

namespace pbrtmedia {
namespace {

using ReadIntegrator = IntegratorPlan (*)(ParamReader&, const ConstructOptions&);

constexpr int kMaxDepth = 1 << 30;
/// Of one camera ray; all of them are held in memory.
constexpr int kMaxOcclusionSamples = 1 << 20;
/// The bootstrap of chains keeps a number for each of its samples of each number of scatterings.
constexpr int kMaxMltDepth = 255, kMaxBootstrapSamples = 1 << 20, kMaxChains = 1 << 20;
/// The part of iterations and mutations that --quick takes.
constexpr int kQuick = 16;
/// Light paths of an iteration, with their photons some gigabytes.
constexpr int kMaxPhotons = 1 << 25;

/// Who makes no exploratory paths knows all strategies but the last.
constexpr std::array<std::string_view, 5> kLightStrategies = {"uniform", "power", "spatial", "tree",
                                                              "learned"};

/// `fallback`: number of the default.
std::string_view readLightSampleStrategy(ParamReader& in, std::span<const std::string_view> known,
                                         std::size_t fallback) {
  return known[in.findChoice("lightsamplestrategy", known, fallback)];
}

PathParams readPathParams(ParamReader& in) {
  PathParams p;
  p.maxDepth = findIntWithin(in, "maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  p.rrThreshold = findFloatWithin(in, "rrthreshold", p.rrThreshold, Range::nonNegative());
  p.lightSampleStrategy = readLightSampleStrategy(in, kLightStrategies, 3);
  return p;
}

/// Null where there are no lights.
std::unique_ptr<const LightSelector> selectorFor(std::span<const Illuminant* const> lights,
                                                 const Scene& scene, std::string_view strategy) {
  if (lights.empty()) return nullptr;
  return makeLightSelector(lightStrategyOfName(strategy).value(), lights, scene.bounds());
}

/// Those of a scene, without its media.
std::span<const Illuminant* const> lightsOf(const Scene& scene) {
  return std::span(scene.illuminants()).first(scene.lights().size());
}

IntegratorPlan readPath(ParamReader& in, const ConstructOptions&) {
  const PathParams p = readPathParams(in);
  return {[=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<PathIntegrator>(
                scene, p, selectorFor(lightsOf(scene), scene, p.lightSampleStrategy));
          },
          false, std::nullopt, /*needsLights=*/true, /*rendersSubsurface=*/true};
}

IntegratorPlan readVolPath(ParamReader& in, const ConstructOptions&) {
  PathParams p = readPathParams(in);
  const std::vector<std::string_view> samplings = alternativeNames<MediumLightSampling>();
  const std::size_t sampling =
      findOwnChoice(in, "mediumlightsampling", samplings, p.mediumLightSampling.index());
  p.mediumLightSampling = findAlternative<MediumLightSampling>(samplings[sampling]).value();
  constexpr std::array<std::string_view, 3> kChannels = {"auto", "shared", "split"};
  p.channelSampling = findOwnEnum(in, "channelsampling", kChannels, ChannelSampling::Auto);
  constexpr std::array<std::string_view, 4> kTransmittances = {"none", "bounds", "independent", "joint"};
  p.misTransmittance = findOwnEnum(in, "mistransmittance", kTransmittances, MisTransmittance::None);
  return {[=](const Scene& scene, CameraMedium cameraMedium) -> std::unique_ptr<Integrator> {
            return std::make_unique<VolPathIntegrator>(
                scene, p, selectorFor(scene.illuminants(), scene, p.lightSampleStrategy),
                std::move(cameraMedium));
          },
          true, std::nullopt, /*needsLights=*/true, /*rendersSubsurface=*/true};
}

IntegratorPlan readDirectLighting(ParamReader& in, const ConstructOptions&) {
  DirectLightingParams p;
  p.maxDepth = findIntWithin(in, "maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  constexpr std::array<std::string_view, 2> kStrategies = {"all", "one"};
  p.strategy = findEnum(in, "strategy", kStrategies, DirectLightingParams::Strategy::All);
  return {[=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<DirectLightingIntegrator>(scene, p);
          },
          false, std::nullopt};
}

IntegratorPlan readWhitted(ParamReader& in, const ConstructOptions&) {
  WhittedParams p;
  p.maxDepth = findIntWithin(in, "maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  return {[=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<WhittedIntegrator>(scene, p);
          },
          false, std::nullopt};
}

IntegratorPlan readAmbientOcclusion(ParamReader& in, const ConstructOptions& options) {
  AmbientOcclusionParams p;
  p.cosineSampling = in.findBool("cossample", p.cosineSampling);
  p.samples = findIntWithin(in, "nsamples", p.samples, Range::closed(1, kMaxOcclusionSamples));
  if (options.quick) p.samples = 1;
  return {.make = [=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<AmbientOcclusionIntegrator>(scene, p);
          },
          .needsLights = false};
}

/// --spp, else "iterations", which is also called "numiterations", a sixteenth of it for --quick.
std::int64_t readIterations(ParamReader& in, const ConstructOptions& options) {
  const Range range = Range::atLeast(1);
  int asked = findIntWithin(in, "numiterations", 64, range);
  asked = findIntWithin(in, "iterations", asked, range);
  if (options.samplesPerPixel) return *options.samplesPerPixel;
  return options.quick ? std::max(1, asked / kQuick) : asked;
}

/// An emissive medium of which light paths start in no part, or not in all; null: there is none.
const Medium* emitterWithoutEnd(const Scene& scene, const CameraMedium& camera) {
  for (std::size_t i = 0; i < camera.state().activeCount(); ++i) {
    const PlacedMedium m = camera.state().active(i);
    if (m.medium->isEmissive() && !scene.lightOf(m)) return m.medium;
  }
  if (!scene.hasEmissiveMedia()) return nullptr;
  const MediaTopology media(scene, camera);
  for (const Medium* medium : scene.media()) {
    const Bounds3f own = medium->bounds();
    const bool isBounded = own.isEmpty() || maxComponent(own.diagonal()) < kInfinity;
    if (medium->isEmissive() && !isBounded && !media.isConfined(medium)) return medium;
  }
  return nullptr;
}

/// What photons cannot tell of media, at the Integrator.
void checkMediaForPhotons(const Scene& scene, const CameraMedium& camera, const SourceLocation& at,
                          Diagnostics& diagnostics) {
  if (const Medium* const medium = emitterWithoutEnd(scene, camera)) {
    diagnostics.warning(
        at,
        "Integrator \"sppm\": medium \"" + medium->name() +
            "\" emits, and as nothing encloses it there is no place for its photons to start: it is seen, "
            "and lights what paths from the camera meet first, but what is scattered of its light lights "
            "nothing else; enclose it in a surface of material \"none\", or take \"volpath\"");
  }
}

/// "photonsperiteration": nothing for 0 and less. All of them are held in memory.
std::optional<std::int64_t> readPhotons(ParamReader& in) {
  const int asked = in.findInt("photonsperiteration", -1);
  if (asked <= 0) return std::nullopt;
  if (asked > kMaxPhotons) {
    tolerate(in, ParamKind::Integer, "photonsperiteration",
             "found " + std::to_string(asked) + "; as photons are held in memory, an iteration has at most " +
                 std::to_string(kMaxPhotons) + ", and the image more noise: let it have more iterations");
  }
  return std::min(asked, kMaxPhotons);
}

/// What is done about the bias of kernels, and their shape.
void readDebiasing(ParamReader& in, SppmParams& p) {
  constexpr std::array<std::string_view, 4> kDebias = {"none", "single", "progressive",
                                                       "progressive-unbiased"};
  KernelSchedule::Params& schedule = p.schedule;
  schedule.debias = findOwnEnum(in, "debias", kDebias, schedule.debias);
  schedule.alpha = double{in.findFloat("alpha", KernelSchedule::kAlpha, Range::open(0, 1))};
  schedule.c = double{in.findFloat("c", KernelSchedule::kC, Range::positive())};
  for (const std::string_view name : {"alpha", "c"}) {
    const bool isUsed =
        schedule.debias != Debias::None && (name == "alpha" || schedule.debias != Debias::Progressive);
    if (isUsed || !in.has(ParamKind::Float, name)) continue;
    in.diagnostics().warning(in.locationOf(ParamKind::Float, name),
                             in.context() + ": \"" + std::string(name) +
                                 "\" has no effect with \"debias\" \"" +
                                 std::string(kDebias[static_cast<std::size_t>(schedule.debias)]) + '"');
  }
  constexpr std::array<std::string_view, 4> kKernels = {"uniform", "cone", "quadratic", "quartic"};
  p.kernel = findOwnEnum(in, "kernel", kKernels,
                         schedule.debias == Debias::None ? KernelShape::Uniform : KernelShape::Cone);
}

IntegratorPlan readSppm(ParamReader& in, const ConstructOptions& options) {
  SppmParams p;
  p.maxDepth = findIntWithin(in, "maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  const std::int64_t iterations = readIterations(in, options);
  p.photonsPerIteration = readPhotons(in);
  p.radius = in.findFloat("radius", p.radius, Range::positive());
  readDebiasing(in, p);
  if (in.has(ParamKind::Integer, "imagewritefrequency")) {
    in.diagnostics().warning(
        in.locationOf(ParamKind::Integer, "imagewritefrequency"),
        in.context() +
            ": \"imagewritefrequency\" has no effect: the image is written once; --serve and "
            "--display-server show it on its way, --checkpoint keeps what there is");
  }
  const auto make = [p, at = in.entity().location, diagnostics = &in.diagnostics()](
                        const Scene& scene, CameraMedium cameraMedium) -> std::unique_ptr<Integrator> {
    checkMediaForPhotons(scene, cameraMedium, at, *diagnostics);
    std::unique_ptr<const LightSelector> selector, photonSelector;
    if (!scene.illuminants().empty()) {
      selector = makeLightSelector(LightStrategy::Tree, scene.illuminants(), scene.bounds());
      photonSelector = makeLightSelector(LightStrategy::Power, scene.illuminants(), scene.bounds());
    }
    return std::make_unique<SppmIntegrator>(scene, p, std::move(selector), std::move(photonSelector),
                                            std::move(cameraMedium));
  };
  const Debias debias = p.schedule.debias;
  return {.make = make,
          .rendersMedia = true,
          .samplesPerPixel = iterations,
          .tracesFromLights = true,
          .hasNegativeSamples = debias == Debias::Single || debias == Debias::ProgressiveUnbiased};
}

/// What images of strategies are to show. PBRT-v3 makes them of short paths only, and so it makes the image.
void readStrategyView(ParamReader& in, BdptParams& p) {
  const bool strategies = in.findBool("visualizestrategies", false),
             weights = in.findBool("visualizeweights", false);
  if (!strategies && !weights) return;
  p.view = weights ? StrategyView::Weighted : StrategyView::Unweighted;
  if (p.maxDepth <= kMostShownDepth) return;
  const char* const name = weights ? "visualizeweights" : "visualizestrategies";
  in.diagnostics().warning(in.locationOf(ParamKind::Bool, name),
                           in.context() + ": \"" + name + "\" limits \"maxdepth\" to " +
                               std::to_string(kMostShownDepth) + ", as in PBRT-v3 (found " +
                               std::to_string(p.maxDepth) +
                               "): light that scatters more often is missing; leave it out for the image");
  p.maxDepth = kMostShownDepth;
}

IntegratorPlan readBdpt(ParamReader& in, const ConstructOptions&) {
  BdptParams p;
  p.maxDepth = findIntWithin(in, "maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  const std::string_view strategy = readLightSampleStrategy(in, std::span(kLightStrategies).first(4), 1);
  readStrategyView(in, p);
  // Light subpaths start before anybody knows where they are looked at from.
  const std::string_view starts = strategy == "uniform" ? "uniform" : "power";
  return {.make = [=](const Scene& scene, CameraMedium cameraMedium) -> std::unique_ptr<Integrator> {
            return std::make_unique<BdptIntegrator>(
                scene, p, selectorFor(scene.illuminants(), scene, strategy),
                selectorFor(scene.illuminants(), scene, starts), std::move(cameraMedium));
          },
          .rendersMedia = true,
          .rendersSubsurface = true,
          .tracesFromLights = true,
          .weighsBothEnds = true};
}

/// --spp, else "mutationsperpixel", a sixteenth of it for --quick.
std::int64_t readMutations(ParamReader& in, const ConstructOptions& options) {
  const int asked = findIntWithin(in, "mutationsperpixel", 100, Range::atLeast(1));
  if (options.samplesPerPixel) return *options.samplesPerPixel;
  return options.quick ? std::max(1, asked / kQuick) : asked;
}

IntegratorPlan readMlt(ParamReader& in, const ConstructOptions& options) {
  MltParams p;
  p.maxDepth = findIntWithin(in, "maxdepth", p.maxDepth, Range::closed(0, kMaxMltDepth));
  p.bootstrapSamples =
      findIntWithin(in, "bootstrapsamples", p.bootstrapSamples, Range::closed(1, kMaxBootstrapSamples));
  if (options.quick) p.bootstrapSamples = std::max(1, p.bootstrapSamples / kQuick);
  p.chains = findIntWithin(in, "chains", p.chains, Range::closed(1, kMaxChains));
  p.largeStepProbability =
      findFloatWithin(in, "largestepprobability", p.largeStepProbability, Range::closed(0, 1));
  p.sigma = findFloatWithin(in, "sigma", p.sigma, Range::nonNegative());
  const std::int64_t mutations = readMutations(in, options);
  return {.make = [=](const Scene& scene, CameraMedium cameraMedium) -> std::unique_ptr<Integrator> {
            return std::make_unique<MltIntegrator>(scene, p, selectorFor(scene.illuminants(), scene, "power"),
                                                   selectorFor(scene.illuminants(), scene, "power"),
                                                   std::move(cameraMedium));
          },
          .rendersMedia = true,
          .rendersSubsurface = true,
          .samplesPerPixel = mutations,
          .tracesFromLights = true,
          .weighsBothEnds = true};
}

constexpr auto kIntegrators = std::to_array<Plugin<ReadIntegrator>>({
    {"path", readPath},
    {"volpath", readVolPath},
    {"directlighting", readDirectLighting},
    {"whitted", readWhitted},
    {"ambientocclusion", readAmbientOcclusion},
    {"bdpt", readBdpt},
    {"mlt", readMlt},
    {"sppm", readSppm},
});

/// x0 x1 y0 y1 in pixels, upper exclusive.
std::optional<Bounds2i> readPixelBounds(ParamReader& in) {
  if (!in.has(ParamKind::Integer, "pixelbounds")) return std::nullopt;
  const std::span<const int> b = in.ints("pixelbounds");
  if (b.size() != 4) {
    tolerate(in, ParamKind::Integer, "pixelbounds",
             "found " + std::to_string(b.size()) +
                 " numbers, expected 4: x0 x1 y0 y1; they are left out, as in PBRT-v3");
    return std::nullopt;
  }
  const Bounds2i bounds{{b[0], b[2]}, {b[1], b[3]}};
  if (bounds.area() == 0) {
    in.error(ParamKind::Integer, "pixelbounds", "the rectangle holds no pixel");
    return std::nullopt;
  }
  return bounds;
}

}  // namespace

std::optional<IntegratorPlan> readIntegrator(SceneDescription& scene, const ConstructOptions& options,
                                             Diagnostics& diagnostics) {
  Entity& entity = scene.integrator;
  if (!entity.given) entity.type = "path";
  const auto* plugin = findPlugin<ReadIntegrator>(kIntegrators, entity, "Integrator", "", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(entity, diagnostics, "Integrator \"" + entity.type + "\"");
  in.setPbrtNames({"maxdepth", "rrthreshold", "lightsamplestrategy", "strategy", "pixelbounds", "nsamples",
                   "cossample", "iterations", "numiterations", "photonsperiteration", "imagewritefrequency",
                   "radius", "bootstrapsamples", "chains", "mutationsperpixel", "largestepprobability",
                   "sigma"});
  IntegratorPlan plan = plugin->read(in, options);
  plan.pixelBounds = readPixelBounds(in);
  in.reportUnused();
  return plan;
}

}  // namespace pbrtmedia
