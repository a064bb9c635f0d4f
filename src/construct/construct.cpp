// SPDX-License-Identifier: BSD-2-Clause
#include "construct/construct.h"

#include <algorithm>
#include <array>

#include "base/built_parts.h"
#include "construct/cameras.h"
#include "construct/film.h"
#include "construct/integrators.h"
#include "construct/lights.h"
#include "construct/materials.h"
#include "construct/media.h"
#include "construct/plugins.h"
#include "construct/samplers.h"
#include "construct/shapes.h"
#include "construct/textures.h"
#include "construct/world_builder.h"
#include "media/homogeneous.h"
#include "samplers/halton.h"
#include "world/endless_medium.h"
#include "world/media_faults.h"

namespace pbrtmedia {
namespace {

/// PBRT-v3's accelerators have no effect on the image: their parameters are checked and then not needed.
void readAccelerator(Entity& entity, Diagnostics& diagnostics) {
  if (!entity.given) return;
  using Read = void (*)(ParamReader&);
  constexpr std::array<Plugin<Read>, 2> kAccelerators = {
      {{"bvh",
        [](ParamReader& in) {
          constexpr std::array<std::string_view, 4> kMethods = {"sah", "hlbvh", "middle", "equal"};
          in.findChoice("splitmethod", kMethods, 0);
          in.findInt("maxnodeprims", 4);
        }},
       {"kdtree", [](ParamReader& in) {
          for (const std::string_view name : {"intersectcost", "traversalcost", "maxprims", "maxdepth"})
            in.findInt(name, 1);
          in.findFloat("emptybonus", 0.5f);
        }}}};
  const auto* plugin =
      findPlugin<Read>(kAccelerators, entity, "Accelerator",
                       "the image does not depend on it; PBRT-v3 renders an empty scene", diagnostics);
  if (plugin == nullptr) return;
  ParamReader in(entity, diagnostics, "Accelerator \"" + entity.type + "\"");
  plugin->read(in);
  in.reportUnused();
}

/// The explicit start medium of camera rays: nothing when the scene does not say, so that geometry decides.
std::optional<const Medium*> cameraMediumOf(const SceneDescription& scene, const WorldBuilder& world) {
  if (scene.cameraMedium.location.file == nullptr || scene.cameraMedium.name.empty()) return std::nullopt;
  return world.medium(scene.cameraMedium.index);
}

/// Boundaries that are not what they were meant to be, and media that nobody sees.
void warnOfMedia(const Scene& scene, const CameraMedium& camera, const WorldBuilder& world,
                 Diagnostics& diagnostics) {
  for (const FaultyBoundary& faulty : findFaultyBoundaries(scene, camera)) {
    diagnostics.warning(faulty.boundary->location, faulty.message);
  }
  world.warnOfUnseenMedia(camera, findUnreachedMedia(scene, camera), diagnostics);
}

/// Light from infinitely far never gets through a medium without end. That is right, but hardly meant.
void warnOfEndlessMedium(const SceneDescription& scene, const Scene& built, const Medium& medium,
                         Diagnostics& diagnostics) {
  std::string advice = "enclose the medium in a surface of material \"none\"";
  for (const auto& group : built.primitiveGroups()) {
    for (const Primitive* p : group) {
      if (p->media.inside != &medium || !built.boundaries().faultOf(*p)) continue;
      advice = "its boundary at " + p->location.toString() + " does not enclose it";
    }
  }
  for (const LightDescription& light : scene.lights) {
    if (light.type != "distant" && light.type != "infinite" && light.type != "exinfinite") continue;
    diagnostics.warning(light.location, "LightSource \"" + light.type +
                                            "\": its light comes from infinitely far through medium \"" +
                                            medium.name() + "\", which has no end, so none of it arrives; " +
                                            advice);
  }
}

CameraMedium findCameraMedium(const SceneDescription& scene, const Construction& made,
                              const WorldBuilder& world, Diagnostics& diagnostics) {
  if (!made.scene->hasMediumBoundaries() && scene.cameraMedium.name.empty()) return {};
  const float middle = 0.5f;
  const Camera::WeightedRay central =
      made.camera->generateRay({static_cast<float>(made.film->settings().resolution.x) / 2,
                                static_cast<float>(made.film->settings().resolution.y) / 2},
                               {0.5f, 0.5f}, middle);
  const Ray& ray = central.ray;
  CameraMedium medium(*made.scene, ray.o, ray.time, cameraMediumOf(scene, world));
  for (const std::string& warning : medium.warnings()) {
    const bool isGiven = scene.cameraMedium.location.file != nullptr;
    diagnostics.warning(isGiven ? scene.cameraMedium.location : scene.camera.location, warning);
  }
  if (const Medium* endless = findEndlessMedium(MediaTopology(*made.scene, medium), ray.o, ray.time)) {
    warnOfEndlessMedium(scene, *made.scene, *endless, diagnostics);
  }
  return medium;
}

/// Puts the parameters of the command line among those of the media they are meant for.
void applyMediumParams(SceneDescription& scene, const ParamList& params, Diagnostics& diagnostics) {
  if (params.empty()) return;
  bool anyTakes = false;
  for (MediumDescription& medium : scene.media) {
    if (medium.type == HomogeneousMedium::kTypeName) continue;
    anyTakes = true;
    for (const Param& param : params.all()) medium.params.add(param);
  }
  if (!anyTakes) {
    diagnostics.warning(params.all().front().declaredAt,
                        "the scene has no medium with a density field: nothing was set");
  }
}

/// Nothing would be rendered, silently.
void checkPixelBounds(const SceneDescription& scene, const IntegratorPlan& integrator, const Film& film) {
  if (!integrator.pixelBounds || intersect(film.sampleBounds(), *integrator.pixelBounds).area() > 0) return;
  throw SceneError(scene.integrator.location, "Integrator \"" + scene.integrator.type +
                                                  "\": \"pixelbounds\" lies outside the rendered image");
}

}  // namespace

std::optional<Construction> construct(SceneDescription& scene, const ConstructOptions& options,
                                      Diagnostics& diagnostics) {
  const std::size_t errorsBefore = diagnostics.errorCount();
  applyMediumParams(scene, options.mediumParams, diagnostics);
  FilmPlan film = readFilm(scene, options, diagnostics);
  Construction made;
  made.outfile = film.outfile;
  made.camera = readCamera(scene, {film.settings.resolution, film.diagonal}, diagnostics);
  const std::optional<IntegratorPlan> integrator = readIntegrator(scene, options, diagnostics);
  made.sampler = readSampler(scene, options, diagnostics);
  if (integrator && integrator->samplesPerPixel) {
    made.sampler = std::make_unique<HaltonSampler>(
        HaltonSampler::Params{.pixelSamples = *integrator->samplesPerPixel, .seed = options.seed});
  }
  readAccelerator(scene.accelerator, diagnostics);

  Textures textures(scene, diagnostics);
  Materials materials(scene, textures, diagnostics);
  WorldBuilder world(scene, textures, materials, diagnostics);
  world.read(options.quick);
  if (!integrator || diagnostics.errorCount() > errorsBefore) return std::nullopt;

  bool mediaEmit = false;
  try {
    made.film = builtAt(scene.film.location, "Film \"image\"",
                        [&] { return std::make_unique<Film>(film.settings, *film.filter); });
    checkPixelBounds(scene, *integrator, *made.film);
    made.scene = world.build(integrator->rendersMedia);
    if (textures.wantFootprints()) {
      countBuilt(Part::RayDifferentials);
    } else {
      made.camera->leaveOutDifferentials();
    }
    if (integrator->tracesFromLights) {
      made.scene->prepareEmission();
      if (!integrator->weighsBothEnds)
        world.warnOfCurves(scene.integrator.location, "Integrator \"" + scene.integrator.type + '"');
    }
    CameraMedium cameraMedium;
    if (integrator->rendersMedia) {
      cameraMedium = findCameraMedium(scene, made, world, diagnostics);
      warnOfMedia(*made.scene, cameraMedium, world, diagnostics);
    }
    mediaEmit = made.scene->hasEmissiveMedia() || cameraMedium.state().isEmissive();
    made.integrator = integrator->make(*made.scene, std::move(cameraMedium));
    made.pixelBounds = integrator->pixelBounds;
    const LayerSet layers = chooseLayers(film.layers, *made.integrator, diagnostics);
    builtAt(film.layers.at, film.layers.context, [&] { made.film->setLayers(layers); });
    const std::vector<Medium*>& media = made.scene->media();
    const bool hasNegativeMedia =
        integrator->rendersMedia &&
        std::any_of(media.begin(), media.end(), [](const Medium* m) { return m->mayBeNegative(); });
    if (hasNegativeMedia || integrator->hasNegativeSamples) made.film->keepNegatives();
  } catch (const SceneError& e) {
    diagnostics.add(e);
  }
  if (diagnostics.errorCount() > errorsBefore) return std::nullopt;

  if (integrator->needsLights && made.scene->lights().empty() && !made.scene->hasVisibleEmitters() &&
      !mediaEmit) {
    diagnostics.warning(scene.worldEnd, "the scene has no lights: the image will be black");
  }
  if (!integrator->rendersMedia && world.usesMedia()) {
    diagnostics.warning(scene.integrator.given ? scene.integrator.location : scene.worldEnd,
                        "Integrator \"" + scene.integrator.type +
                            "\" does not render participating media, so the image shows this scene without "
                            "those it has, as in PBRT-v3; \"volpath\" renders them");
  }
  if (!integrator->rendersSubsurface && materials.hasBssrdfs()) {
    diagnostics.warning(
        scene.integrator.given ? scene.integrator.location : scene.worldEnd,
        "Integrator \"" + scene.integrator.type +
            "\" does not render scattering below surfaces, so materials that have it are like "
            "clear glass, as in PBRT-v3; \"path\", \"volpath\", \"bdpt\" and \"mlt\" render it");
  }
  made.report = world.report();
  return made;
}

}  // namespace pbrtmedia
