// SPDX-License-Identifier: BSD-2-Clause
#include "construct/integrators.h"

#include <array>

#include "construct/plugins.h"
#include "integrators/direct_lighting.h"
#include "integrators/light_selection.h"
#include "integrators/path.h"
#include "integrators/vol_path.h"
#include "integrators/whitted.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

using ReadIntegrator = IntegratorPlan (*)(ParamReader&);

constexpr int kMaxDepth = 1 << 30;

PathParams readPathParams(ParamReader& in) {
  PathParams p;
  p.maxDepth = in.findInt("maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  p.rrThreshold = in.findFloat("rrthreshold", p.rrThreshold, Range::nonNegative());
  constexpr std::array<std::string_view, 3> kStrategies = {"uniform", "power", "spatial"};
  p.lightSampleStrategy = kStrategies[in.findChoice("lightsamplestrategy", kStrategies, 2)];
  return p;
}

/// Null where there are no lights.
std::unique_ptr<const LightSelector> selectorFor(const std::vector<const Light*>& lights, const Scene& scene,
                                                 const PathParams& p) {
  if (lights.empty()) return nullptr;
  return makeLightSelector(lightStrategyOfName(p.lightSampleStrategy).value(), lights, scene.bounds());
}

IntegratorPlan readPath(ParamReader& in) {
  const PathParams p = readPathParams(in);
  return {[=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<PathIntegrator>(scene, p, selectorFor(scene.lights(), scene, p));
          },
          false, std::nullopt};
}

IntegratorPlan readVolPath(ParamReader& in) {
  PathParams p = readPathParams(in);
  constexpr std::array<std::string_view, 4> kSamplings = {"auto", "collision", "equiangular", "mis"};
  p.mediumLightSampling =
      std::array{MediumLightSampling::Auto, MediumLightSampling::Collision, MediumLightSampling::Equiangular,
                 MediumLightSampling::Mis}[in.findChoice("mediumlightsampling", kSamplings,
                                                         static_cast<std::size_t>(p.mediumLightSampling))];
  constexpr std::array<std::string_view, 3> kChannels = {"auto", "shared", "split"};
  p.channelSampling = std::array{ChannelSampling::Auto, ChannelSampling::Shared,
                                 ChannelSampling::Split}[in.findChoice("channelsampling", kChannels, 0)];
  return {[=](const Scene& scene, CameraMedium cameraMedium) -> std::unique_ptr<Integrator> {
            return std::make_unique<VolPathIntegrator>(
                scene, p, selectorFor(scene.lightsWithMedia(), scene, p), std::move(cameraMedium));
          },
          true, std::nullopt};
}

IntegratorPlan readDirectLighting(ParamReader& in) {
  DirectLightingParams p;
  p.maxDepth = in.findInt("maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  constexpr std::array<std::string_view, 2> kStrategies = {"all", "one"};
  p.strategy = std::array{DirectLightingParams::Strategy::All,
                          DirectLightingParams::Strategy::One}[in.findChoice("strategy", kStrategies, 0)];
  return {[=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<DirectLightingIntegrator>(scene, p);
          },
          false, std::nullopt};
}

IntegratorPlan readWhitted(ParamReader& in) {
  WhittedParams p;
  p.maxDepth = in.findInt("maxdepth", p.maxDepth, Range::closed(0, kMaxDepth));
  return {[=](const Scene& scene, const CameraMedium&) -> std::unique_ptr<Integrator> {
            return std::make_unique<WhittedIntegrator>(scene, p);
          },
          false, std::nullopt};
}

constexpr std::array<Plugin<ReadIntegrator>, 4> kIntegrators = {{{"path", readPath},
                                                                 {"volpath", readVolPath},
                                                                 {"directlighting", readDirectLighting},
                                                                 {"whitted", readWhitted}}};

/// x0 x1 y0 y1 in pixels, upper exclusive.
std::optional<Bounds2i> readPixelBounds(ParamReader& in) {
  if (!in.has(ParamKind::Integer, "pixelbounds")) return std::nullopt;
  const std::span<const int> b = in.ints("pixelbounds");
  if (b.size() != 4) {
    in.error(ParamKind::Integer, "pixelbounds",
             "found " + std::to_string(b.size()) + " numbers, expected 4: x0 x1 y0 y1");
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

std::optional<IntegratorPlan> readIntegrator(SceneDescription& scene, Diagnostics& diagnostics) {
  Entity& entity = scene.integrator;
  if (!entity.given) entity.type = "path";
  const auto* plugin = findPlugin<ReadIntegrator>(kIntegrators, entity, "Integrator", diagnostics);
  if (plugin == nullptr) {
    if (!diagnostics.strict) {
      diagnostics.error(entity.typeLocation, "Integrator: nothing can be rendered without an integrator");
    }
    return std::nullopt;
  }
  ParamReader in(entity, diagnostics, "Integrator \"" + entity.type + "\"");
  IntegratorPlan plan = plugin->read(in);
  plan.pixelBounds = readPixelBounds(in);
  in.reportUnused();
  return plan;
}

}  // namespace pbrtmedia
