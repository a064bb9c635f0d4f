// SPDX-License-Identifier: BSD-2-Clause
#include "construct/cameras.h"

#include <array>
#include <optional>

#include "cameras/environment.h"
#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "cameras/screen_window.h"
#include "construct/plugins.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

using ReadCamera = std::unique_ptr<Camera> (*)(ParamReader&, const AnimatedTransform&, Point2i);

struct Shutter {
  float open, close;
};

Shutter readShutter(ParamReader& in) {
  Shutter s{in.findFloat("shutteropen", 0), in.findFloat("shutterclose", 1)};
  if (s.close < s.open) {
    in.diagnostics().warning(
        in.locationOf(ParamKind::Float, "shutteropen"),
        in.context() + ": the shutter closes before it opens; the two times are exchanged");
    std::swap(s.open, s.close);
  }
  return s;
}

ScreenWindow readScreenWindow(ParamReader& in, Point2i fullResolution) {
  const std::optional<float> aspect = in.optionalFloat("frameaspectratio", Range::positive());
  std::optional<ScreenWindow> window;
  if (in.has(ParamKind::Float, "screenwindow")) {
    const std::span<const float> w = in.floats("screenwindow");
    if (w.size() == 4) {
      window = ScreenWindow{w[0], w[1], w[2], w[3]};
    } else {
      in.error(ParamKind::Float, "screenwindow",
               "found " + std::to_string(w.size()) + " numbers, expected 4: xmin xmax ymin ymax");
    }
  }
  return resolveScreenWindow(fullResolution, aspect, window);
}

std::unique_ptr<Camera> readPerspective(ParamReader& in, const AnimatedTransform& place, Point2i resolution) {
  PerspectiveCamera::Params p;
  p.fullResolution = resolution;
  p.screenWindow = readScreenWindow(in, resolution);
  const float fov = in.findFloat("fov", p.fov, Range::open(0, 180));
  p.fov = resolveFov(fov, in.findFloat("halffov", -1, Range{.max = 90, .openMax = true}));
  p.lensRadius = in.findFloat("lensradius", p.lensRadius, Range::nonNegative());
  p.focalDistance = in.findFloat("focaldistance", p.focalDistance, Range::positive());
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  return std::make_unique<PerspectiveCamera>(place, p);
}

std::unique_ptr<Camera> readOrthographic(ParamReader& in, const AnimatedTransform& place,
                                         Point2i resolution) {
  OrthographicCamera::Params p;
  p.fullResolution = resolution;
  p.screenWindow = readScreenWindow(in, resolution);
  p.lensRadius = in.findFloat("lensradius", p.lensRadius, Range::nonNegative());
  p.focalDistance = in.findFloat("focaldistance", p.focalDistance, Range::positive());
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  return std::make_unique<OrthographicCamera>(place, p);
}

std::unique_ptr<Camera> readEnvironment(ParamReader& in, const AnimatedTransform& place, Point2i resolution) {
  EnvironmentCamera::Params p;
  p.fullResolution = resolution;
  // PBRT-v3 accepts the window and lens parameters here and ignores them.
  readScreenWindow(in, resolution);
  in.findFloat("lensradius", 0);
  in.findFloat("focaldistance", 0);
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  return std::make_unique<EnvironmentCamera>(place, p);
}

constexpr std::array<Plugin<ReadCamera>, 3> kCameras = {
    {{"perspective", readPerspective}, {"orthographic", readOrthographic}, {"environment", readEnvironment}}};

}  // namespace

std::unique_ptr<Camera> readCamera(SceneDescription& scene, Point2i fullResolution,
                                   Diagnostics& diagnostics) {
  CameraDescription& entity = scene.camera;
  const AnimatedTransform place(entity.worldFromCamera->start, scene.transformStartTime,
                                entity.worldFromCamera->end, scene.transformEndTime);
  if (place.start().isSingular() || place.end().isSingular()) {
    diagnostics.error(entity.location, "Camera: the transformation is singular: it has no inverse");
    return nullptr;
  }
  if (cameraScales(place)) {
    diagnostics.warning(
        entity.location,
        "Camera: the transformation scales; focal distance and lens radius are in camera units");
  }
  if (!entity.given) entity.type = "perspective";
  const auto* plugin = findPlugin<ReadCamera>(kCameras, entity, "Camera", diagnostics);
  if (plugin == nullptr) {
    // There is no picture without a camera, --strict or not.
    if (!diagnostics.strict)
      diagnostics.error(entity.typeLocation, "Camera: nothing can be rendered without a camera");
    return nullptr;
  }
  ParamReader in(entity, diagnostics, "Camera \"" + entity.type + "\"");
  const std::size_t before = diagnostics.errorCount();
  std::unique_ptr<Camera> camera;
  try {
    camera = builtAt(entity.location, in.context(), [&] { return plugin->read(in, place, fullResolution); });
  } catch (const SceneError& e) {
    if (diagnostics.errorCount() == before) diagnostics.add(e);
  }
  in.reportUnused();
  return camera;
}

}  // namespace pbrtmedia
