// SPDX-License-Identifier: BSD-2-Clause
#include "construct/cameras.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cameras/environment.h"
#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "cameras/realistic.h"
#include "cameras/screen_window.h"
#include "construct/lens_file.h"
#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

using ReadCamera = std::unique_ptr<Camera> (*)(ParamReader&, const AnimatedTransform&, const FilmSize&);

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
      tolerate(in, ParamKind::Float, "screenwindow",
               "found " + std::to_string(w.size()) +
                   " numbers, expected 4: xmin xmax ymin ymax; it is left out, as in PBRT-v3");
    }
  }
  return resolveScreenWindow(fullResolution, aspect, window);
}

struct Lens {
  float radius = 0, focalDistance = 1e6f;
};

/// Of lenses; what is all sharp looks the same at every scale.
void warnOfScale(ParamReader& in, const AnimatedTransform& place) {
  if (!cameraScales(place)) return;
  in.diagnostics().warning(in.entity().location,
                           "Camera: the transformation scales; lengths of the lens are in camera units");
}

/// PBRT-v3 has a lens only where its radius is above 0, and looks at the focal distance only then.
Lens readLens(ParamReader& in, const AnimatedTransform& place, Lens fallback) {
  Lens lens{in.findFloat("lensradius", fallback.radius),
            in.findFloat("focaldistance", fallback.focalDistance)};
  if (lens.radius < 0) {
    tolerate(in, ParamKind::Float, "lensradius",
             "found " + shownNumber(lens.radius) + ", expected >= 0; taken as 0, as in PBRT-v3");
    lens.radius = 0;
  }
  if (lens.radius > 0 && !(lens.focalDistance > 0)) {
    tolerate(in, ParamKind::Float, "focaldistance",
             "found " + shownNumber(lens.focalDistance) +
                 ", expected > 0; the lens is left out, so that all is sharp; PBRT-v3 looks backwards");
    lens.radius = 0;
  }
  if (lens.radius > 0) {
    warnOfScale(in, place);
  } else {
    lens.focalDistance = fallback.focalDistance;
  }
  return lens;
}

/// The full angle. Beyond (0, 180) the formula goes on, by the tangent of its half: the picture is turned.
float readFov(ParamReader& in, float fallback) {
  const float whole = in.findFloat("fov", fallback), half = in.findFloat("halffov", -1);
  const float fov = resolveFov(whole, half);
  if (Range::open(0, 180).contains(static_cast<double>(fov))) return fov;
  const std::string_view name = half > 0 ? "halffov" : "fov";
  const double folded = std::remainder(static_cast<double>(fov), 360.0);  // of the same tangent
  const std::string found = "found " + shownNumber(half > 0 ? half : whole) + ", expected ";
  const std::string expected = half > 0 ? "above 0 and below 90" : "in (0, 180)";
  if (std::abs(folded) == 0 || std::abs(folded) == 180) {
    in.error(ParamKind::Float, name, found + expected);
    return fallback;
  }
  tolerate(in, ParamKind::Float, name,
           found + expected + "; as in PBRT-v3 " +
               (folded < 0 ? "the picture is turned by 180 degrees" : "this is the same as ") +
               (folded < 0 ? "" : shownNumber(static_cast<float>(folded))));
  return static_cast<float>(folded);
}

std::unique_ptr<Camera> readPerspective(ParamReader& in, const AnimatedTransform& place,
                                        const FilmSize& film) {
  PerspectiveCamera::Params p;
  p.fullResolution = film.fullResolution;
  p.screenWindow = readScreenWindow(in, film.fullResolution);
  p.fov = readFov(in, p.fov);
  if (p.fov < 0) {  // the tangent of a negative angle mirrors both axes
    p.fov = -p.fov;
    p.screenWindow = {-p.screenWindow.xMin, -p.screenWindow.xMax, -p.screenWindow.yMin, -p.screenWindow.yMax};
  }
  const Lens lens = readLens(in, place, {p.lensRadius, p.focalDistance});
  p.lensRadius = lens.radius;
  p.focalDistance = lens.focalDistance;
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  return std::make_unique<PerspectiveCamera>(place, p);
}

std::unique_ptr<Camera> readOrthographic(ParamReader& in, const AnimatedTransform& place,
                                         const FilmSize& film) {
  OrthographicCamera::Params p;
  p.fullResolution = film.fullResolution;
  p.screenWindow = readScreenWindow(in, film.fullResolution);
  const Lens lens = readLens(in, place, {p.lensRadius, p.focalDistance});
  p.lensRadius = lens.radius;
  p.focalDistance = lens.focalDistance;
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  return std::make_unique<OrthographicCamera>(place, p);
}

std::unique_ptr<Camera> readEnvironment(ParamReader& in, const AnimatedTransform& place,
                                        const FilmSize& film) {
  EnvironmentCamera::Params p;
  p.fullResolution = film.fullResolution;
  // PBRT-v3 accepts the window and lens parameters here and ignores them.
  readScreenWindow(in, film.fullResolution);
  in.findFloat("lensradius", 0);
  in.findFloat("focaldistance", 0);
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  return std::make_unique<EnvironmentCamera>(place, p);
}

/// The numbers of "lensfile"; nothing, told, when there are none.
std::optional<std::vector<LensElement>> readLenses(ParamReader& in, float apertureDiameter) {
  const auto file = requireFile(in, "lensfile");
  if (!file) return std::nullopt;
  try {
    LensFile lenses = readLensFile(*file, &in.diagnostics());
    if (const auto widest = lenses.setAperture(apertureDiameter)) {
      tolerate(in, ParamKind::Float, "aperturediameter",
               "found " + shownNumber(apertureDiameter) + " mm, expected at most the " +
                   shownNumber(*widest) + " mm of the lens; that is taken, as in PBRT-v3");
    }
    return std::move(lenses.elements);
  } catch (const SceneError& e) {
    in.error(ParamKind::String, "lensfile", problemOf(e));
    return std::nullopt;
  }
}

std::unique_ptr<Camera> readRealistic(ParamReader& in, const AnimatedTransform& place, const FilmSize& film) {
  RealisticCamera::Params p;
  p.fullResolution = film.fullResolution;
  p.filmDiagonal = 0.001 * static_cast<double>(film.diagonal);
  const float aperture = in.findFloat("aperturediameter", 1, Range::positive());
  p.focusDistance = static_cast<double>(
      in.findFloat("focusdistance", static_cast<float>(p.focusDistance), Range::positive()));
  p.simpleWeighting = in.findBool("simpleweighting", p.simpleWeighting);
  const Shutter shutter = readShutter(in);
  p.shutterOpen = shutter.open;
  p.shutterClose = shutter.close;
  if (!p.simpleWeighting && p.shutterOpen == p.shutterClose) {
    in.diagnostics().warning(in.entity().location,
                             in.context() +
                                 ": the image is black: without \"simpleweighting\" it is in proportion to "
                                 "\"shutterclose\" minus \"shutteropen\", which is 0");
  }
  warnOfScale(in, place);
  const auto lenses = readLenses(in, aperture);
  if (!lenses) return nullptr;
  return std::make_unique<RealisticCamera>(place, LensSystem(*lenses), p);
}

constexpr std::array<Plugin<ReadCamera>, 4> kCameras = {{{"perspective", readPerspective},
                                                         {"orthographic", readOrthographic},
                                                         {"environment", readEnvironment},
                                                         {"realistic", readRealistic}}};

}  // namespace

std::unique_ptr<Camera> readCamera(SceneDescription& scene, const FilmSize& film, Diagnostics& diagnostics) {
  CameraDescription& entity = scene.camera;
  const AnimatedTransform place(entity.worldFromCamera->start, scene.transformStartTime,
                                entity.worldFromCamera->end, scene.transformEndTime);
  if (place.start().isSingular() || place.end().isSingular()) {
    diagnostics.error(entity.location, "Camera: the transformation is singular: it has no inverse");
    return nullptr;
  }
  if (!entity.given) entity.type = "perspective";
  const auto* plugin = findPlugin<ReadCamera>(kCameras, entity, "Camera", "", diagnostics);
  if (plugin == nullptr) return nullptr;
  ParamReader in(entity, diagnostics, "Camera \"" + entity.type + "\"");
  const std::size_t before = diagnostics.errorCount();
  std::unique_ptr<Camera> camera;
  try {
    camera = builtAt(entity.location, in.context(), [&] { return plugin->read(in, place, film); });
  } catch (const SceneError& e) {
    if (diagnostics.errorCount() == before) diagnostics.add(e);
  }
  in.reportUnused();
  return camera;
}

}  // namespace pbrtmedia
