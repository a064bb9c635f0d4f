// SPDX-License-Identifier: BSD-2-Clause
#include "construct/film.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/writable.h"
#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "filters/box.h"
#include "filters/gaussian.h"
#include "filters/mitchell.h"
#include "filters/sinc.h"
#include "filters/triangle.h"
#include "image/image.h"
#include "scene/param_reader.h"

namespace pbrtmedia {
namespace {

constexpr int kMaxResolution = 1 << 20;  // pixels per axis: far above any display, far below overflow

using ReadFilter = std::unique_ptr<Filter> (*)(ParamReader&);

Vector2f readRadius(ParamReader& in, Vector2f fallback) {
  return {in.findFloat("xwidth", fallback.x, Range::positive()),
          in.findFloat("ywidth", fallback.y, Range::positive())};
}

std::unique_ptr<Filter> readBox(ParamReader& in) {
  return std::make_unique<BoxFilter>(BoxFilter::Params{.radius = readRadius(in, BoxFilter::Params{}.radius)});
}

std::unique_ptr<Filter> readTriangle(ParamReader& in) {
  return std::make_unique<TriangleFilter>(
      TriangleFilter::Params{.radius = readRadius(in, TriangleFilter::Params{}.radius)});
}

std::unique_ptr<Filter> readGaussian(ParamReader& in) {
  GaussianFilter::Params p;
  p.radius = readRadius(in, p.radius);
  p.alpha = in.findFloat("alpha", p.alpha, Range::positive());
  return std::make_unique<GaussianFilter>(p);
}

std::unique_ptr<Filter> readMitchell(ParamReader& in) {
  MitchellFilter::Params p;
  p.radius = readRadius(in, p.radius);
  p.b = in.findFloat("B", p.b);
  p.c = in.findFloat("C", p.c);
  return std::make_unique<MitchellFilter>(p);
}

std::unique_ptr<Filter> readSinc(ParamReader& in) {
  SincFilter::Params p;
  p.radius = readRadius(in, p.radius);
  p.tau = std::abs(in.findFloat("tau", p.tau));  // its sign cancels
  if (p.tau == 0) in.error(ParamKind::Float, "tau", "found 0, expected > 0");
  return std::make_unique<SincFilter>(p);
}

constexpr std::array<Plugin<ReadFilter>, 5> kFilters = {{{"box", readBox},
                                                         {"triangle", readTriangle},
                                                         {"gaussian", readGaussian},
                                                         {"mitchell", readMitchell},
                                                         {"sinc", readSinc}}};

std::unique_ptr<Filter> readFilter(Entity& entity, Diagnostics& diagnostics) {
  if (!entity.given) return std::make_unique<BoxFilter>(BoxFilter::Params{});
  const auto* plugin = findPlugin<ReadFilter>(kFilters, entity, "PixelFilter", "", diagnostics);
  if (plugin == nullptr) return nullptr;
  ParamReader in(entity, diagnostics, "PixelFilter \"" + entity.type + "\"");
  std::unique_ptr<Filter> filter;
  try {
    filter = builtAt(entity.location, in.context(), [&] { return plugin->read(in); });
  } catch (const SceneError& e) {
    diagnostics.add(e);
  }
  in.reportUnused();
  return filter;
}

/// Sorted and clamped as PBRT-v3 does it.
void setCropWindow(Film::Settings& settings, std::span<const float> c) {
  const auto clamped = [](float x) { return std::clamp(x, 0.0f, 1.0f); };
  settings.cropWindow[0] = clamped(std::min(c[0], c[1]));
  settings.cropWindow[1] = clamped(std::max(c[0], c[1]));
  settings.cropWindow[2] = clamped(std::min(c[2], c[3]));
  settings.cropWindow[3] = clamped(std::max(c[2], c[3]));
}

/// Whether the image could be written, found out before hours of rendering.
void checkOutfile(const std::filesystem::path& path, const SourceLocation& location,
                  Diagnostics& diagnostics) {
  if (!isWritableImageName(path)) {
    diagnostics.error(location, "output \"" + path.string() + "\": unknown image format \"" +
                                    path.extension().string() + "\"; known: .exr, .png, .pfm, .tga");
    return;
  }
  const std::string reason = unwritableReason(path);
  if (!reason.empty()) {
    diagnostics.error(location, "output \"" + path.string() + "\" cannot be written: " + reason);
  }
}

}  // namespace

FilmPlan readFilm(SceneDescription& scene, const ConstructOptions& options, Diagnostics& diagnostics) {
  FilmPlan plan;
  plan.filter = readFilter(scene.filter, diagnostics);
  Entity& entity = scene.film;
  if (entity.given && entity.type != "image") {
    constexpr std::string_view kKnown[] = {"image"};
    diagnostics.error(entity.typeLocation,
                      "Film: unknown type \"" + entity.type + "\"" + suggestion(entity.type, kKnown));
    return plan;
  }
  ParamReader in(entity, diagnostics, "Film \"image\"");
  in.setPbrtNames(
      {"xresolution", "yresolution", "scale", "maxsampleluminance", "diagonal", "cropwindow", "filename"});
  Film::Settings& s = plan.settings;
  const Range resolution = Range::closed(1, kMaxResolution);
  s.resolution = {in.findInt("xresolution", s.resolution.x, resolution),
                  in.findInt("yresolution", s.resolution.y, resolution)};
  if (options.quick) s.resolution = {std::max(1, s.resolution.x / 4), std::max(1, s.resolution.y / 4)};
  s.scale = in.findFloat("scale", s.scale);
  if (const std::optional<float> most = in.optionalFloat("maxsampleluminance")) {
    if (*most > 0) {
      s.maxSampleLuminance = *most;
    } else {
      tolerate(
          in, ParamKind::Float, "maxsampleluminance",
          "found " + shownNumber(*most) + ", expected > 0; no sample is limited; PBRT-v3's image is black");
    }
  }
  plan.diagonal = in.findFloat("diagonal", plan.diagonal);
  if (options.cropWindow) setCropWindow(s, *options.cropWindow);
  if (in.has(ParamKind::Float, "cropwindow")) {
    const std::span<const float> crop = in.floats("cropwindow");
    if (crop.size() == 4) {
      setCropWindow(s, crop);
      if (options.cropWindow) {
        diagnostics.warning(in.locationOf(ParamKind::Float, "cropwindow"),
                            in.context() + ": \"cropwindow\" wins over --cropwindow, as in PBRT-v3");
      }
    } else {
      in.error(ParamKind::Float, "cropwindow",
               "found " + std::to_string(crop.size()) + " numbers, expected 4: x0 x1 y0 y1");
    }
  }
  const std::string filename = in.findString("filename", "pbrt.exr");
  const bool named = in.has(ParamKind::String, "filename");
  plan.outfile = options.outfile ? *options.outfile : std::filesystem::path(filename);
  checkOutfile(plan.outfile,
               !options.outfile && named ? in.locationOf(ParamKind::String, "filename") : SourceLocation{},
               diagnostics);
  plan.layers = readLayers(in, options, plan.outfile, diagnostics);
  in.reportUnused();
  return plan;
}

}  // namespace pbrtmedia
