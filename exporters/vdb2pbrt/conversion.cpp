// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/conversion.h"

#include <zlib.h>

#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

#include "base/files.h"
#include "base/writable.h"
#include "vdb2pbrt/look.h"
#include "vdb2pbrt/pbrt_include.h"
#include "vdb2pbrt/vdb_file.h"
#include "vdb2pbrt/volume.h"

namespace pbrtmedia {
namespace {

void writeText(const std::filesystem::path& path, const std::string& text, bool gz) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    const auto failed = [&] { return std::runtime_error("cannot write \"" + path.string() + '"'); };
    if (!gz) {
      std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
      out.write(text.data(), static_cast<std::streamsize>(text.size()));
      out.close();
      if (!out) throw failed();
      return;
    }
    std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(temporary.c_str(), "wb6"), gzclose);
    if (!out || gzfwrite(text.data(), 1, text.size(), out.get()) != text.size()) throw failed();
    if (gzclose(out.release()) != Z_OK) throw failed();
  });
}

void checkNames(const std::filesystem::path& output, const std::filesystem::path& scene) {
  const std::string extension = output.extension().string();
  if (extension == ".nvdb" || extension == ".vdb") {
    throw std::runtime_error("the output is a .pbrt include (the .nvdb file gets its name); found \"" +
                             output.string() + '"');
  }
  if (scene.empty()) return checkWritable(output);
  if (scene.extension() != ".pbrt") {
    throw std::runtime_error("--scene: expected a name that ends with .pbrt, found \"" + scene.string() +
                             '"');
  }
  if (std::filesystem::absolute(scene).lexically_normal() ==
      std::filesystem::absolute(output).lexically_normal()) {
    throw std::runtime_error("--scene and the include are both \"" + output.string() +
                             "\"; another name for one of them");
  }
  checkWritable(output);
  checkWritable(scene);
}

std::vector<IncludeGrid> includeGrids(const Volume& volume, const std::vector<std::string>& selectors,
                                      const std::string& medium, const std::string& stem) {
  const std::vector<std::string> media = mediumNames(volume.densities(), stem);
  std::vector<IncludeGrid> grids;
  for (std::size_t i = 0; i < volume.densityCount; ++i) {
    const bool named = volume.densityCount == 1 && !medium.empty();
    grids.push_back({&volume.grids[i], named ? medium : media[i], selectors[i]});
  }
  return grids;
}

IncludeEmission includeEmission(const Volume& volume, const std::vector<std::string>& selectors,
                                const ConversionOptions& look) {
  IncludeEmission emission;
  if (!volume.glows()) return emission;
  if (volume.temperature) {
    emission.temperature = &volume.grids[*volume.temperature];
    emission.temperatureGrid = selectors[*volume.temperature];
  }
  if (volume.factor) {
    emission.factor = &volume.grids[*volume.factor];
    emission.factorGrid = selectors[*volume.factor];
  }
  emission.temperatureScale = *look.temperatureScale;
  emission.temperatureOffset = look.temperatureOffset;
  emission.le = *look.le;
  emission.leScale = *look.leScale;
  return emission;
}

std::string sceneFor(const Volume& volume, const std::filesystem::path& input,
                     const std::filesystem::path& output, const ConversionOptions& look) {
  SceneParams scene;
  scene.source = input.filename().string();
  const std::filesystem::path folder = std::filesystem::absolute(look.scene).lexically_normal().parent_path();
  scene.include = std::filesystem::absolute(output).lexically_normal().lexically_proximate(folder).string();
  scene.image = std::filesystem::path(look.scene).filename().replace_extension(".exr").string();
  scene.box = look.sceneBox ? *look.sceneBox : volume.box();
  if (scene.box.isEmpty()) scene.box = {{-1, -1, -1}, {1, 1, 1}};
  scene.up = *look.up;
  scene.glows = volume.glows();
  return framedScene(scene);
}

}  // namespace

void convertVdb(const std::filesystem::path& input, const std::filesystem::path& output,
                const ConversionOptions& options, const Notice& notice, const Progress& progress) {
  checkNames(output, options.scene);
  const Volume volume = readVolume(input, options, notice, progress);
  if (progress) progress("measuring", -1);
  const ConversionOptions look = options.isSettled ? options : lookFor(volume, options, notice);
  const std::vector<std::string> selectors = gridSelectors(volume.grids);
  const std::vector<IncludeGrid> grids =
      includeGrids(volume, selectors, options.medium, input.stem().string());
  const IncludeEmission emission = includeEmission(volume, selectors, look);
  const IncludeOptions coefficients{.sigmaA = *look.sigmaA, .sigmaS = *look.sigmaS, .scale = *look.scale};
  const std::string source = input.filename().string();
  if (options.dense != DenseForm::None) {
    if (progress) progress("writing \"" + output.string() + '"', -1);
    writeText(output, denseInclude(grids, emission, source, coefficients), options.dense == DenseForm::Gz);
  } else {
    std::filesystem::path nvdb = output;
    nvdb.replace_extension(".nvdb");
    if (progress) progress("writing \"" + nvdb.string() + '"', -1);
    const std::string text = nvdbInclude(grids, emission, nvdb.filename().string(), source, coefficients);
    writeNvdb(nvdb, volume.grids, options.nvdb);
    writeText(output, text, false);
  }
  if (!options.scene.empty()) writeText(options.scene, sceneFor(volume, input, output, look), false);
}

ConversionOptions settled(const std::filesystem::path& input, const ConversionOptions& options,
                          const Notice& notice, const Progress& progress) {
  // What is wrong with single voxels is told when the frame is converted.
  const Volume volume = readVolume(
      input, options, [](const std::string&) {}, progress);
  if (progress) progress("measuring", -1);
  ConversionOptions look = lookFor(volume, options, notice);
  look.isSettled = true;
  return look;
}

Bounds3d boxOfDensities(const std::filesystem::path& input, const ConversionOptions& options) {
  const VdbFile file(input);
  Bounds3d box;
  for (const std::size_t index : selectGrids(file.grids(), options.grids).densities) {
    const Bounds3d told = file.worldBox(index);
    box.expand(told.isEmpty() ? file.read(index).worldBox() : told);
  }
  return box;
}

}  // namespace pbrtmedia
