// SPDX-License-Identifier: BSD-2-Clause
#include "construct/lights.h"

#include <algorithm>
#include <array>
#include <functional>
#include <utility>

#include "construct/light_messages.h"
#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "image/image.h"
#include "lights/distant.h"
#include "lights/goniometric.h"
#include "lights/infinite.h"
#include "lights/point.h"
#include "lights/projection.h"
#include "lights/spot.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

struct LightInput {
  ParamReader& in;
  Transform worldFromLight;
  bool quick;
};
using ReadLight = LightPlan (*)(const LightInput&);

Rgb readScaled(ParamReader& in, std::string_view name) {
  const Rgb colour = in.findSpectrum(name, Rgb(1)) * in.findSpectrum("scale", Rgb(1));
  if (colour.luminance() < 0) {
    in.diagnostics().warning(
        in.locationOf(ParamKind::Spectrum, name),
        in.context() + ": \"" + std::string(name) +
            "\" times \"scale\" is negative: a light that takes light away. As in PBRT-v3 every sample whose "
            "sum is negative counts as black, so it darkens less than that, or nothing; lower other lights");
  }
  return colour;
}

/// "samples", with the alias "nsamples" of lower priority.
int readSamples(ParamReader& in, bool quick) {
  const Range range = Range::closed(1, 1 << 20);
  const std::optional<int> alias = optionalIntWithin(in, "nsamples", range);
  const int samples = findIntWithin(in, "samples", alias.value_or(1), range);
  return quick ? std::max(1, samples / 4) : samples;
}

/// Reads the picture of "mapname" when the light is made. Nothing, as in PBRT-v3, where there is none.
std::function<std::optional<Image>()> readMap(ParamReader& in, std::string_view without) {
  const std::string consequence = std::string(without) + ", as in PBRT-v3";
  const std::optional<std::filesystem::path> file = in.findInputFile("mapname", consequence);
  if (!file) return [] { return std::nullopt; };
  return [path = *file, named = in.locationOf(ParamKind::String, "mapname"), context = in.context(),
          consequence, &diagnostics = in.diagnostics()]() -> std::optional<Image> {
    try {
      return readImage(path);
    } catch (const SceneError& e) {
      diagnostics.tolerated(named, context + ": parameter \"mapname\": " + problemOf(e) + "; " + consequence);
      return std::nullopt;
    }
  };
}

LightPlan readPoint(const LightInput& input) {
  PointLight::Params p;
  p.intensity = readScaled(input.in, "I");
  p.from = input.in.findPoint3("from", p.from);
  return [=, place = input.worldFromLight] { return std::make_unique<PointLight>(place, p); };
}

LightPlan readSpot(const LightInput& input) {
  SpotLight::Params p;
  p.intensity = readScaled(input.in, "I");
  p.from = input.in.findPoint3("from", p.from);
  p.to = input.in.findPoint3("to", p.to);
  p.coneAngle = input.in.findFloat("coneangle", p.coneAngle);
  p.coneDeltaAngle = input.in.findFloat("conedeltaangle", p.coneDeltaAngle);
  if (!Range::closed(0, 180).contains(static_cast<double>(p.coneAngle))) {
    tolerate(input.in, ParamKind::Float, "coneangle",
             "found " + shownNumber(p.coneAngle) +
                 ", expected in [0, 180]; its cosine is what counts, as in PBRT-v3");
  }
  return [=, place = input.worldFromLight] { return std::make_unique<SpotLight>(place, p); };
}

LightPlan readDistant(const LightInput& input) {
  DistantLight::Params p;
  p.radiance = readScaled(input.in, "L");
  p.from = input.in.findPoint3("from", p.from);
  p.to = input.in.findPoint3("to", p.to);
  return [=, place = input.worldFromLight] { return std::make_unique<DistantLight>(place, p); };
}

LightPlan readGoniometric(const LightInput& input) {
  const Rgb intensity = readScaled(input.in, "I");
  const auto map = readMap(input.in, "the light shines alike in all directions");
  return [=, place = input.worldFromLight] {
    GoniometricLight::Params p{.intensity = intensity, .map = map()};
    return std::make_unique<GoniometricLight>(place, p);
  };
}

LightPlan readProjection(const LightInput& input) {
  const Rgb intensity = readScaled(input.in, "I");
  const float fov = input.in.findFloat("fov", 45);
  const auto map = readMap(input.in, "the light shines without a picture");
  if (!Range::open(0, 180).contains(static_cast<double>(fov))) {
    tolerate(
        input.in, ParamKind::Float, "fov",
        "found " + shownNumber(fov) +
            ", expected in (0, 180); the light is left out; PBRT-v3 makes a turned picture or NaN of it");
    return {};
  }
  return [=, place = input.worldFromLight] {
    ProjectionLight::Params p{.intensity = intensity, .fov = fov, .map = map()};
    return std::make_unique<ProjectionLight>(place, p);
  };
}

LightPlan readInfinite(const LightInput& input) {
  const Rgb radiance = readScaled(input.in, "L");
  const int samples = readSamples(input.in, input.quick);
  const auto map = readMap(input.in, "the light has the colour L alone");
  return [=, place = input.worldFromLight] {
    InfiniteLight::Params p{.radiance = radiance, .map = map(), .samples = samples};
    return std::make_unique<InfiniteLight>(place, p);
  };
}

constexpr std::array<Plugin<ReadLight>, 7> kLights = {{{"point", readPoint},
                                                       {"spot", readSpot},
                                                       {"distant", readDistant},
                                                       {"goniometric", readGoniometric},
                                                       {"projection", readProjection},
                                                       {"infinite", readInfinite},
                                                       {"exinfinite", readInfinite}}};

using ReadAreaLight = DiffuseAreaLight::Params (*)(ParamReader&, bool);

DiffuseAreaLight::Params readDiffuse(ParamReader& in, bool quick) {
  DiffuseAreaLight::Params p;
  p.radiance = readScaled(in, "L");
  p.twoSided = in.findBool("twosided", p.twoSided);
  p.samples = readSamples(in, quick);
  return p;
}

constexpr std::array<Plugin<ReadAreaLight>, 2> kAreaLights = {
    {{"diffuse", readDiffuse}, {"area", readDiffuse}}};

}  // namespace

std::optional<LightPlan> readLight(LightDescription& light, bool quick, Diagnostics& diagnostics) {
  const auto* plugin =
      findPlugin<ReadLight>(kLights, light, "LightSource", "it is left out, as in PBRT-v3", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(light, diagnostics, "LightSource \"" + light.type + "\"");
  if (light.ctm->isAnimated()) {
    diagnostics.warning(light.location,
                        in.context() + ": lights do not move; the transformation of the start time is used");
  }
  if (plugin->read == readInfinite && !light.ctm->start.isSingular()) {
    reportScaledSky(light.ctm->start, light.location, in.context(), diagnostics);
  }
  LightPlan plan = plugin->read({in, light.ctm->start, quick});
  in.reportUnused();
  if (!plan) return std::nullopt;
  LightPlan located = [plan = std::move(plan), location = light.location, context = in.context()] {
    return builtAt(location, context, plan);
  };
  const bool readsFile = std::as_const(light.params).find(ParamKind::String, "mapname") != nullptr;
  if (readsFile) return located;
  try {  // made once to have its own checks now, with all other problems
    located();
  } catch (const SceneError& e) {
    diagnostics.tolerated(e.location(),
                          std::string(e.what()) + "; the light is left out; PBRT-v3 makes NaN of it");
    return std::nullopt;
  }
  return located;
}

std::optional<DiffuseAreaLight::Params> readAreaLight(Entity& light, bool quick, Diagnostics& diagnostics) {
  const auto* plugin = findPlugin<ReadAreaLight>(kAreaLights, light, "AreaLightSource",
                                                 "the shapes emit nothing, as in PBRT-v3", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(light, diagnostics, "AreaLightSource \"" + light.type + "\"");
  const DiffuseAreaLight::Params params = plugin->read(in, quick);
  in.reportUnused();
  return params;
}

}  // namespace pbrtmedia
