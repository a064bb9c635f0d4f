// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "construct/construct.h"
#include "image/image.h"
#include "render/sample_taker.h"
#include "scene/parser.h"
#include "support/running_stats.h"
#include "support/source_dir.h"
#include "support/z_test.h"

// Whole renders of scenes given as text, through the same parser, construction and loop as the program.
namespace pbrtmedia::test {

struct RenderSettings {
  std::uint64_t seed = 0;
  unsigned threads = 0;
  int tileSize = 16;
  std::optional<std::int64_t> samplesPerPixel{};
};

struct Rendered {
  Image image;
  RenderResult result;
  std::string warnings;  ///< of parsing and construction
};

inline Construction constructDescription(SceneDescription& description, const RenderSettings& settings,
                                         Diagnostics& diagnostics) {
  ConstructOptions options;
  options.outfile = "unused.exr";
  options.seed = settings.seed;
  options.samplesPerPixel = settings.samplesPerPixel;
  std::optional<Construction> scene = construct(description, options, diagnostics);
  if (!scene) throw std::runtime_error(diagnostics.format());
  return std::move(*scene);
}

/// The one world of a text. Throws std::runtime_error with all messages when it is not a good scene.
inline SceneDescription parsedWorld(const std::string& text, const std::filesystem::path& folder,
                                    Diagnostics& diagnostics) {
  std::vector<SceneDescription> worlds = parseText(text, "test.pbrt", folder, diagnostics);
  if (diagnostics.hasErrors() || worlds.size() != 1)
    throw std::runtime_error("no scene: " + diagnostics.format());
  return std::move(worlds.front());
}

/// Ready to take samples of. Throws as parsedWorld.
inline Construction constructText(const std::string& text, const RenderSettings& settings = {},
                                  const std::filesystem::path& folder = ".") {
  Diagnostics diagnostics;
  SceneDescription world = parsedWorld(text, folder, diagnostics);
  return constructDescription(world, settings, diagnostics);
}

/// The integrator of a scene that has one which estimates radiance along rays, for renderSample.
inline const SamplingIntegrator& samplingIntegrator(const Construction& scene) {
  return dynamic_cast<const SamplingIntegrator&>(*scene.integrator);
}

inline Rendered renderDescription(SceneDescription& description, const RenderSettings& settings,
                                  Diagnostics& diagnostics) {
  const ThreadLimit threads(settings.threads);
  const Construction scene = constructDescription(description, settings, diagnostics);
  RenderOptions loop;
  loop.seed = settings.seed;
  loop.tileSize = settings.tileSize;
  loop.pixelBounds = scene.pixelBounds;
  Rendered rendered;
  rendered.result = scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, loop);
  rendered.image = scene.film->develop();
  rendered.warnings = diagnostics.format();
  return rendered;
}

/// Throws std::runtime_error with all messages when the text is not a good scene.
inline Rendered renderText(const std::string& text, const RenderSettings& settings = {},
                           const std::filesystem::path& folder = ".") {
  Diagnostics diagnostics;
  SceneDescription world = parsedWorld(text, folder, diagnostics);
  return renderDescription(world, settings, diagnostics);
}

inline Rendered renderFile(const std::filesystem::path& path, const RenderSettings& settings = {}) {
  Diagnostics diagnostics;
  const std::vector<std::filesystem::path> files = {path};
  std::vector<SceneDescription> worlds = parseFiles(files, diagnostics);
  if (diagnostics.hasErrors() || worlds.size() != 1)
    throw std::runtime_error("no scene: " + diagnostics.format());
  return renderDescription(worlds.front(), settings, diagnostics);
}

/// Mean of one channel over all pixels.
inline double imageMean(const Image& image, std::size_t channel = 0) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += image.at(x, y, channel);
  }
  return sum / (static_cast<double>(image.width()) * image.height());
}

/// The mean over the image, from `seeds` independent renders, against its true value.
inline ZTest zTestOfMean(const std::string& text, double truth, std::size_t channel = 0,
                         std::uint64_t seeds = 16, std::uint64_t firstSeed = 1) {
  RunningStats means;
  for (std::uint64_t s = 0; s < seeds; ++s) {
    means.add(imageMean(renderText(text, {.seed = firstSeed + s}).image, channel));
  }
  return zTest(means, truth, firstSeed);
}

// ---- Pieces of scenes
// ----------------------------------------------------------------------------------------------

/// A pencil of parallel rays along +z (or what `view` makes of it), box-filtered.
inline std::string pencil(int resolution, int samplesPerPixel, const std::string& integrator,
                          const std::string& view = "", double halfWidth = 1e-3) {
  std::ostringstream os;
  os << "Film \"image\" \"integer xresolution\" " << resolution << " \"integer yresolution\" " << resolution
     << "\nSampler \"random\" \"integer pixelsamples\" " << samplesPerPixel << "\nIntegrator " << integrator
     << '\n'
     << view << "\nCamera \"orthographic\" \"float screenwindow\" [ " << -halfWidth << ' ' << halfWidth << ' '
     << -halfWidth << ' ' << halfWidth << " ]\n";
  return os.str();
}

/// The surface of an axis-parallel box, normals outward.
inline std::string boxMesh(Vec3d a, Vec3d b) {
  std::ostringstream os;
  os.precision(17);
  os << "Shape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2  4 5 6 4 6 7  0 1 5 0 5 4  1 2 6 1 6 5  2 "
        "3 7 2 7 6  "
        "3 0 4 3 4 7 ] \"point P\" [ "
     << a.x << ' ' << a.y << ' ' << a.z << "  " << b.x << ' ' << a.y << ' ' << a.z << "  " << b.x << ' '
     << b.y << ' ' << a.z << "  " << a.x << ' ' << b.y << ' ' << a.z << "  " << a.x << ' ' << a.y << ' '
     << b.z << "  " << b.x << ' ' << a.y << ' ' << b.z << "  " << b.x << ' ' << b.y << ' ' << b.z << "  "
     << a.x << ' ' << b.y << ' ' << b.z << " ]\n";
  return os.str();
}

/// MakeNamedMedium of a homogeneous medium that only absorbs, with `extra` parameters.
inline std::string absorbing(const std::string& name, double sigma, const std::string& extra = "") {
  std::ostringstream os;
  os << "MakeNamedMedium \"" << name
     << "\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" [ " << sigma << ' '
     << sigma << ' ' << sigma << " ] " << extra << '\n';
  return os.str();
}

/// A box without material around a medium.
inline std::string mediumBox(const std::string& medium, Vec3d a, Vec3d b) {
  return "AttributeBegin\nMaterial \"none\"\nMediumInterface \"" + medium + "\" \"\"\n" + boxMesh(a, b) +
         "AttributeEnd\n";
}

/// How a medium of constant density is stored; all three must look the same.
enum class Storage { Homogeneous, OneVoxel, Grid64 };

inline const char* nameOf(Storage storage) {
  return storage == Storage::Homogeneous ? "homogeneous"
         : storage == Storage::OneVoxel  ? "1-voxel grid"
                                         : "64^3 grid";
}

/// MakeNamedMedium "m" of the given coefficients in the box.
inline std::string constantMedium(Storage storage, double sigmaA, double sigmaS, double g, Vec3d a, Vec3d b,
                                  const std::string& name = "m", const std::string& extra = "") {
  std::ostringstream os;
  os.precision(17);
  os << "MakeNamedMedium \"" << name << "\" \"rgb sigma_a\" [ " << sigmaA << ' ' << sigmaA << ' ' << sigmaA
     << " ] \"rgb sigma_s\" [ " << sigmaS << ' ' << sigmaS << ' ' << sigmaS << " ] \"float g\" " << g << ' '
     << extra;
  if (storage == Storage::Homogeneous) {
    os << " \"string type\" \"homogeneous\"\n";
    return os.str();
  }
  const int n = storage == Storage::OneVoxel ? 1 : 64;
  os << " \"string type\" \"heterogeneous\" \"string border\" \"clamp\" \"integer nx\" " << n
     << " \"integer ny\" " << n << " \"integer nz\" " << n << " \"point p0\" [ " << a.x << ' ' << a.y << ' '
     << a.z << " ] \"point p1\" [ " << b.x << ' ' << b.y << ' ' << b.z << " ] \"float density\" [ ";
  for (int i = 0; i < n * n * n; ++i) os << "1 ";
  os << "]\n";
  return os.str();
}

inline const std::string kWhiteEnvironment = "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n";

/// The folder of real PBRT-v3 scenes, where it exists beside the checkout.
inline std::optional<std::filesystem::path> pbrtSceneFolder() {
  const std::filesystem::path folder = test::sourceDir() / ".." / "shared" / "scenes" / "pbrt-v3";
  if (!std::filesystem::is_directory(folder)) return std::nullopt;
  return folder;
}

}  // namespace pbrtmedia::test
