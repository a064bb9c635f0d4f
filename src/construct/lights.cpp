// SPDX-License-Identifier: BSD-2-Clause
#include "construct/lights.h"

#include <algorithm>
#include <array>
#include <utility>

#include "construct/plugins.h"
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
  return in.findSpectrum(name, Rgb(1)) * in.findSpectrum("scale", Rgb(1));
}

/// "samples", with the alias "nsamples" of lower priority.
int readSamples(ParamReader& in, bool quick) {
  const Range range = Range::closed(1, 1 << 20);
  const std::optional<int> alias = in.optionalInt("nsamples", range);
  const int samples = in.findInt("samples", alias.value_or(1), range);
  return quick ? std::max(1, samples / 4) : samples;
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
  p.coneAngle = input.in.findFloat("coneangle", p.coneAngle, Range::closed(0, 180));
  p.coneDeltaAngle = input.in.findFloat("conedeltaangle", p.coneDeltaAngle);
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
  const auto file = input.in.findInputFile("mapname");
  return [=, place = input.worldFromLight] {
    GoniometricLight::Params p{.intensity = intensity, .map = std::nullopt};
    if (file) p.map = readImage(*file);
    return std::make_unique<GoniometricLight>(place, p);
  };
}

LightPlan readProjection(const LightInput& input) {
  const Rgb intensity = readScaled(input.in, "I");
  const float fov = input.in.findFloat("fov", 45, Range::open(0, 180));
  const auto file = input.in.findInputFile("mapname");
  return [=, place = input.worldFromLight] {
    ProjectionLight::Params p{.intensity = intensity, .fov = fov, .map = std::nullopt};
    if (file) p.map = readImage(*file);
    return std::make_unique<ProjectionLight>(place, p);
  };
}

LightPlan readInfinite(const LightInput& input) {
  const Rgb radiance = readScaled(input.in, "L");
  const int samples = readSamples(input.in, input.quick);
  const auto file = input.in.findInputFile("mapname");
  return [=, place = input.worldFromLight] {
    InfiniteLight::Params p{.radiance = radiance, .map = std::nullopt, .samples = samples};
    if (file) p.map = readImage(*file);
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
  const auto* plugin = findPlugin<ReadLight>(kLights, light, "LightSource", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(light, diagnostics, "LightSource \"" + light.type + "\"");
  if (light.ctm->isAnimated()) {
    diagnostics.warning(light.location,
                        in.context() + ": lights do not move; the transformation of the start time is used");
  }
  if (light.ctm->start.isSingular()) {
    in.error("the transformation is singular: it has no inverse");
    return std::nullopt;
  }
  LightPlan plan = plugin->read({in, light.ctm->start, quick});
  const bool readsFile = std::as_const(light.params).find(ParamKind::String, "mapname") != nullptr;
  in.reportUnused();
  LightPlan located = [plan = std::move(plan), location = light.location, context = in.context()] {
    return builtAt(location, context, plan);
  };
  if (readsFile) return located;
  try {  // made once to have its own checks now, with all other problems
    located();
  } catch (const SceneError& e) {
    diagnostics.add(e);
    return std::nullopt;
  }
  return located;
}

std::optional<DiffuseAreaLight::Params> readAreaLight(Entity& light, bool quick, Diagnostics& diagnostics) {
  const auto* plugin = findPlugin<ReadAreaLight>(kAreaLights, light, "AreaLightSource", diagnostics);
  if (plugin == nullptr) return std::nullopt;
  ParamReader in(light, diagnostics, "AreaLightSource \"" + light.type + "\"");
  const DiffuseAreaLight::Params params = plugin->read(in, quick);
  in.reportUnused();
  return params;
}

}  // namespace pbrtmedia
