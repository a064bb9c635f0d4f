// SPDX-License-Identifier: BSD-2-Clause
#include "main/output_files.h"

#include <unistd.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "base/writable.h"
#include "construct/scene_identity.h"
#include "integrators/bdpt/strategy_images.h"

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;

/// The image file of a world, as Film or its default names it, and the place of the name.
std::pair<std::string, SourceLocation> namedOutput(const SceneDescription& world) {
  const Param* name = world.film.params.find(ParamKind::String, "filename");
  if (name == nullptr || name->size() != 1) return {"pbrt.exr", world.worldBegin};
  return {std::get<std::vector<std::string>>(name->values).front(), name->valuesAt};
}

/// A file, and what for.
struct FileUse {
  std::string use;
  fs::path file;
};
constexpr const char *kResume = "--resume", *kCheckpoint = "--checkpoint";

fs::path withoutLinks(const fs::path& file) {
  std::error_code ignored;
  return fs::weakly_canonical(fs::absolute(file, ignored), ignored);
}

/// Files that the run writes.
std::vector<FileUse> outputsOf(const std::vector<SceneDescription>& worlds, const Options& options) {
  std::vector<FileUse> files;
  for (const SceneDescription& world : worlds) {
    files.push_back({"the image", options.outfile.value_or(namedOutput(world).first)});
    const fs::path image = files.back().file;
    if (options.png) {
      files.push_back(files.back());
      files.back().file.replace_extension(".png");
    }
    if (!makesStrategyImages(world)) continue;
    for (const SideImage& side : strategyImages(kMostShownDepth))
      files.push_back({"an image of strategies", image.parent_path() / side.name});
  }
  const std::pair<const char*, const std::optional<fs::path>*> more[] = {
      {"--stats", &options.statsFile},
      {"--convergence", &options.convergence},
      {"--bounds-cache", &options.boundsCache},
      {kCheckpoint, &options.checkpoint}};
  for (const auto& [use, file] : more) {
    if (*file) files.push_back({use, **file});
  }
  return files;
}

/// What files are read for, by their paths without links.
std::map<fs::path, std::string> usesOfInputs(const std::vector<SceneDescription>& worlds,
                                             const ParamList& mediumParams, const Options& options) {
  std::map<fs::path, std::string> uses;
  for (const fs::path& scene : options.scenes) {
    if (scene != "-") uses.emplace(withoutLinks(scene), "the scene");
  }
  if (options.reference) uses.emplace(withoutLinks(*options.reference), "--reference");
  if (options.resume) uses.emplace(withoutLinks(*options.resume), kResume);
  for (const SceneDescription& world : worlds) {
    if (world.files) {
      for (const fs::path& file : *world.files) uses.emplace(withoutLinks(file), "an Include or a spectrum");
    }
    for (const NamedFile& file : namedFiles(world, mediumParams))
      uses.emplace(withoutLinks(file.path), "a parameter (" + file.at.toString() + ')');
  }
  return uses;
}

}  // namespace

bool makesStrategyImages(const SceneDescription& world) {
  const auto isSet = [&](const char* name) {
    const Param* const p = world.integrator.params.find(ParamKind::Bool, name);
    return p != nullptr && p->size() == 1 && std::get<std::vector<std::uint8_t>>(p->values).front() != 0;
  };
  return world.integrator.type == "bdpt" && (isSet("visualizestrategies") || isSet("visualizeweights"));
}

std::string imageNameOf(const SceneDescription& world) { return namedOutput(world).first; }

void requireWritable(const std::string& option, const fs::path& file) {
  const std::string reason = unwritableReason(file);
  if (!reason.empty())
    throw SceneError({}, option + " \"" + file.string() + "\": cannot be written: " + reason);
}

void reportSharedOutputs(const std::vector<SceneDescription>& worlds, const Options& options,
                         Diagnostics& diagnostics) {
  std::map<fs::path, SourceLocation> seen;
  for (const SceneDescription& world : worlds) {
    auto [name, at] = namedOutput(world);
    if (options.outfile) {
      name = options.outfile->string();
      at = world.worldBegin;
    }
    fs::path key = fs::path(name).lexically_normal();
    if (options.png) key.replace_extension(".png");  // which is written beside each
    const auto [earlier, isNew] = seen.try_emplace(key, at);
    if (isNew) continue;
    diagnostics.tolerated(at, "the image \"" + name + "\" is that of the world at " +
                                  earlier->second.toString() +
                                  " too, and only the last one rendered stays; give each world a Film "
                                  "\"string filename\" of its own" +
                                  (options.outfile ? " and leave --outfile out" : ""));
  }
}

void reportSharedStrategyImages(const std::vector<SceneDescription>& worlds, const Options& options,
                                Diagnostics& diagnostics) {
  std::map<fs::path, SourceLocation> seen;
  for (const SceneDescription& world : worlds) {
    if (!makesStrategyImages(world)) continue;
    const fs::path image = options.outfile.value_or(namedOutput(world).first);
    const auto [earlier, isNew] =
        seen.try_emplace(image.parent_path().lexically_normal(), world.integrator.location);
    if (isNew) continue;
    diagnostics.tolerated(world.integrator.location,
                          "the images of strategies are written over those of the world at " +
                              earlier->second.toString() +
                              "; give the worlds a Film \"string filename\" in a folder of their own");
  }
}

void reportLostFiles(const std::vector<SceneDescription>& worlds, const ParamList& mediumParams,
                     const Options& options, Diagnostics& diagnostics) {
  const std::vector<FileUse> outputs = outputsOf(worlds, options);
  std::error_code ignored;
  // Where none of them is there yet, none is read, and nobody need look for what is.
  const bool isAnyThere = std::any_of(outputs.begin(), outputs.end(), [&](const FileUse& output) {
    return fs::is_regular_file(output.file, ignored);
  });
  std::map<fs::path, std::string> uses;
  if (isAnyThere) uses = usesOfInputs(worlds, mediumParams, options);
  for (const auto& [use, file] : outputs) {
    if (fs::exists(file, ignored) && !fs::is_regular_file(file, ignored)) continue;
    const auto [first, isNew] = uses.try_emplace(withoutLinks(file), use);
    const bool goesOn = first->second == kResume && use == kCheckpoint;
    if (isNew || first->second == use || goesOn) continue;
    diagnostics.error({}, use + " \"" + file.string() + "\" is the file of " + first->second +
                              " too, and would be written over it; give each a name of its own");
  }
}

SavedImage saveImage(const fs::path& wanted, const Image& image, const WriteOptions& write) {
  std::string problem;
  try {
    writeImage(wanted, image, write);
    return {wanted, {}};
  } catch (const std::exception& e) {
    problem = e.what();
  }
  fs::path name = wanted.stem();
  name += "-rescued-" + std::to_string(::getpid());
  name += wanted.extension();
  std::error_code error;
  for (const fs::path& folder : {fs::current_path(error), fs::temp_directory_path(error)}) {
    try {
      writeImage(folder / name, image, write);
      return {folder / name, problem};
    } catch (const std::exception&) {
      continue;  // the first reason is the one to tell
    }
  }
  throw std::runtime_error(problem);
}

}  // namespace pbrtmedia
