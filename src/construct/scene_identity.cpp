// SPDX-License-Identifier: BSD-2-Clause
#include "construct/scene_identity.h"

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/hash.h"
#include "base/parallel.h"
#include "scene/input_folders.h"

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;

/// 0 for a file that cannot be read.
std::uint64_t hashOfFile(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::vector<char> buffer(std::size_t{1} << 20);
  std::uint64_t hash = 1, size = 0;
  while (in) {
    in.read(buffer.data(), static_cast<std::streamsize>(buffer.size()));
    const auto count = static_cast<std::size_t>(in.gcount());
    hash = hashText({buffer.data(), count}, hash);
    size += count;
  }
  return size > 0 ? hashCombine(hash, size) : 0;
}

class Collector {
 public:
  void addEntity(const Entity& entity) {
    for (const Param& p : entity.params.all()) {
      if (p.kind == ParamKind::Spectrum) addSpectra(std::get<std::vector<Rgb>>(p.values));
      if (p.kind == ParamKind::String) addFiles(p, entity);
    }
  }
  void addFiles(const Param& param, const Entity& entity) {
    static const InputFolders kWorkingFolder;
    const InputFolders& folders = entity.folders ? *entity.folders : kWorkingFolder;
    for (const std::string& name : std::get<std::vector<std::string>>(param.values)) {
      if (name.empty() || name.find('\0') != std::string::npos) continue;
      if (!asked_.emplace(&folders, name).second) continue;
      const auto found = folders.locate(name);
      std::error_code ignored;
      if (found && fs::is_regular_file(found->path, ignored)) files_.emplace(name, found->path);
    }
  }

  std::uint64_t spectra() const { return spectra_; }
  std::vector<SceneIdentity::File> hashFiles() const {
    std::vector<std::pair<std::string, fs::path>> files(files_.begin(), files_.end());
    std::vector<SceneIdentity::File> hashed(files.size());
    parallelFor(files.size(), [&](std::size_t i) {
      hashed[i] = {files[i].first, hashOfFile(files[i].second)};
    });
    return hashed;
  }

 private:
  void addSpectra(const std::vector<Rgb>& colours) {
    for (const Rgb& c : colours) {
      const float rgb[] = {c.r, c.g, c.b};
      spectra_ = hashText({reinterpret_cast<const char*>(rgb), sizeof rgb}, spectra_);
    }
  }

  std::uint64_t spectra_ = 0;
  std::set<std::pair<const InputFolders*, std::string>> asked_;  ///< the disk is asked once
  std::map<std::string, fs::path> files_;
};

}  // namespace

std::uint64_t SceneIdentity::hash() const {
  std::uint64_t all = hashCombine(text, hashBytes(mediumParams));
  for (const File& f : files) all = hashCombine(all, hashBytes(f.name), f.content);
  if (!derivative.empty()) all = hashCombine(all, hashBytes(derivative));
  return all;
}

SceneIdentity identify(const SceneDescription& scene, const std::string& mediumText,
                       const ParamList& mediumParams) {
  Collector collector;
  const auto addAll = [&](const auto& entities) {
    for (const Entity& entity : entities) collector.addEntity(entity);
  };
  addAll(scene.media);
  addAll(scene.textures);
  addAll(scene.materials);
  addAll(scene.lights);
  addAll(scene.areaLights);
  addAll(scene.shapes);
  collector.addEntity(scene.camera);
  for (const MediumDescription& medium : scene.media) {
    for (const Param& p : mediumParams.all()) {
      if (p.kind == ParamKind::String) collector.addFiles(p, medium);
    }
  }
  return {.text = hashCombine(scene.textHash, collector.spectra()),
          .mediumParams = mediumText,
          .files = collector.hashFiles()};
}

}  // namespace pbrtmedia
