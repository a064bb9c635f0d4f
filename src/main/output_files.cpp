// SPDX-License-Identifier: BSD-2-Clause
#include "main/output_files.h"

#include <unistd.h>

#include <map>
#include <stdexcept>
#include <system_error>

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
    const auto [earlier, isNew] = seen.try_emplace(fs::path(name).lexically_normal(), at);
    if (isNew) continue;
    diagnostics.tolerated(at, "the image \"" + name + "\" is that of the world at " +
                                  earlier->second.toString() +
                                  " too, and only the last one rendered stays; give each world a Film "
                                  "\"string filename\" of its own" +
                                  (options.outfile ? " and leave --outfile out" : ""));
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
