// SPDX-License-Identifier: BSD-2-Clause
#include "main/output_files.h"

#include <unistd.h>

#include <map>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include "base/writable.h"

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;

/// The image file of a world, as Film or its default names it, and the place of the name.
std::pair<std::string, SourceLocation> namedOutput(const SceneDescription& world) {
  const Param* name = world.film.params.find(ParamKind::String, "filename");
  if (name == nullptr || name->size() != 1) return {"pbrt.exr", world.worldBegin};
  return {std::get<std::vector<std::string>>(name->values).front(), name->valuesAt};
}

}  // namespace

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

void reportLostFiles(const std::vector<SceneDescription>& worlds, const Options& options,
                     Diagnostics& diagnostics) {
  const std::string image = "the image", resume = "--resume", checkpoint = "--checkpoint";
  std::vector<std::pair<std::string, std::optional<fs::path>>> files;
  for (const fs::path& scene : options.scenes) {
    if (scene != "-") files.emplace_back("the scene", scene);
  }
  files.insert(files.end(), {{"--reference", options.reference}, {resume, options.resume}});
  const std::size_t read = files.size();
  for (const SceneDescription& world : worlds) {
    files.emplace_back(image, options.outfile.value_or(namedOutput(world).first));
    if (!options.png) continue;
    files.push_back(files.back());
    files.back().second->replace_extension(".png");
  }
  files.insert(files.end(), {{"--stats", options.statsFile},
                             {"--convergence", options.convergence},
                             {"--bounds-cache", options.boundsCache},
                             {checkpoint, options.checkpoint}});
  std::map<fs::path, std::string> uses;
  for (std::size_t i = 0; i < files.size(); ++i) {
    const auto& [use, file] = files[i];
    std::error_code ignored;
    if (!file || (fs::exists(*file, ignored) && !fs::is_regular_file(*file, ignored))) continue;
    const auto [first, isNew] =
        uses.try_emplace(fs::weakly_canonical(fs::absolute(*file, ignored), ignored), use);
    if (isNew || i < read || first->second == use || (first->second == resume && use == checkpoint)) continue;
    diagnostics.error({}, use + " \"" + file->string() + "\" is the file of " + first->second +
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
