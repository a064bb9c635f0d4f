// SPDX-License-Identifier: BSD-2-Clause
#include "construct/scene_identity.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>

#include "base/hash.h"
#include "base/parallel.h"
#include "scene/input_folders.h"
#include "scene/print.h"

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

/// Of the colours, which may come from files.
std::uint64_t hashOfSpectra(const Entity& entity, std::uint64_t hash) {
  for (const Param& p : entity.params.all()) {
    if (p.kind != ParamKind::Spectrum) continue;
    for (const Rgb& c : std::get<std::vector<Rgb>>(p.values)) {
      const float rgb[] = {c.r, c.g, c.b};
      hash = hashText({reinterpret_cast<const char*>(rgb), sizeof rgb}, hash);
    }
  }
  return hash;
}

/// Calls visit(entity) for all that may name files.
template <class Visit>
void visitEntities(const SceneDescription& scene, const Visit& visit) {
  const auto visitAll = [&](const auto& entities) {
    for (const Entity& entity : entities) visit(entity);
  };
  visitAll(scene.media);
  visitAll(scene.textures);
  visitAll(scene.materials);
  visitAll(scene.lights);
  visitAll(scene.areaLights);
  visitAll(scene.shapes);
  visit(scene.camera);
}

class FileList {
 public:
  void add(const ParamList& params, const InputFolders* of) {
    static const InputFolders kWorkingFolder;
    const InputFolders& folders = of ? *of : kWorkingFolder;
    for (const Param& p : params.all()) {
      if (p.kind == ParamKind::String) addNames(p, folders);
    }
  }
  std::vector<NamedFile> take() { return std::move(files_); }

 private:
  void addNames(const Param& param, const InputFolders& folders) {
    std::size_t element = 0;
    for (const std::string& name : std::get<std::vector<std::string>>(param.values)) {
      const SourceLocation at = param.locationOf(element++);
      if (name.empty() || name.find('\0') != std::string::npos) continue;
      if (!asked_.emplace(&folders, name).second) continue;
      const auto found = folders.locate(name);
      std::error_code ignored;
      if (!found || !fs::is_regular_file(found->path, ignored)) continue;
      if (known_.emplace(name, found->path).second) files_.push_back({name, found->path, at});
    }
  }

  std::vector<NamedFile> files_;
  std::set<std::pair<const InputFolders*, std::string>> asked_;  ///< the disk is asked once
  std::set<std::pair<std::string, fs::path>> known_;
};

}  // namespace

std::uint64_t SceneIdentity::hash() const {
  std::uint64_t all = hashCombine(text, hashBytes(mediumParams));
  for (const auto& [name, value] : variables) all = hashCombine(all, hashBytes(name), hashBytes(value));
  for (const File& f : files) all = hashCombine(all, hashBytes(f.name), f.content);
  if (!derivative.empty()) all = hashCombine(all, hashBytes(derivative));
  return all;
}

std::vector<NamedFile> namedFiles(const SceneDescription& scene, const ParamList& mediumParams) {
  FileList files;
  visitEntities(scene, [&](const Entity& entity) { files.add(entity.params, entity.folders.get()); });
  for (const MediumDescription& medium : scene.media) files.add(mediumParams, medium.folders.get());
  return files.take();
}

SceneIdentity identify(const SceneDescription& scene, const ParamList& mediumParams) {
  std::uint64_t spectra = 0;
  visitEntities(scene, [&](const Entity& entity) { spectra = hashOfSpectra(entity, spectra); });
  std::vector<NamedFile> named = namedFiles(scene, mediumParams);
  std::sort(named.begin(), named.end(), [](const NamedFile& a, const NamedFile& b) {
    return std::tie(a.name, a.path) < std::tie(b.name, b.path);
  });
  std::vector<SceneIdentity::File> files(named.size());
  parallelFor(named.size(), [&](std::size_t i) {
    // Of one name in several folders the first alone is known by it.
    const bool isFirst = i == 0 || named[i - 1].name != named[i].name;
    files[i] = {isFirst ? named[i].name : named[i].path.string(), hashOfFile(named[i].path)};
  });
  return {.text = hashCombine(scene.textHash, spectra),
          .variables = scene.variables,
          .mediumParams = textOf(mediumParams),
          .files = std::move(files)};
}

}  // namespace pbrtmedia
