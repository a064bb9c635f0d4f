// SPDX-License-Identifier: BSD-2-Clause
#include "main/frames.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/frame_names.h"
#include "main/output_files.h"
#include "scene/parser.h"

namespace pbrtmedia {
namespace {

using File = std::optional<std::filesystem::path>;

/// The name with a place for a number before its extension.
std::string numbered(const std::filesystem::path& file) {
  std::filesystem::path name = file;
  name.replace_filename(file.stem().string() + "-####" + file.extension().string());
  return name.string();
}

[[noreturn]] void throwShared(const std::string& what, const std::filesystem::path& file) {
  throw SceneError({}, "--frames: every frame would write " + what + " \"" + file.string() + "\"; write \"" +
                           numbered(file) +
                           "\", where #### stands for the number of the frame (so do %04d and $F4)");
}

std::vector<std::string> imagesOf(const Options& options, int frame) {
  const Options one = optionsOfFrame(options, frame);
  Diagnostics unseen;  // said again when the frame is rendered
  std::vector<std::string> names;
  for (const SceneDescription& world : parseFiles(one.scenes, unseen, {.variables = one.variables})) {
    names.push_back(imageNameOf(world));
  }
  return names;
}

}  // namespace

Options optionsOfFrame(const Options& options, int frame) {
  Options one = options;
  one.frames = {};
  one.framesShareFolder = options.frames && options.frames->last > options.frames->first &&
                          !(options.outfile && hasFramePlace(options.outfile->parent_path().string()));
  one.variables.setFrame(frame);
  for (File* file : {&one.outfile, &one.statsFile, &one.boundsCache, &one.checkpoint, &one.resume,
                     &one.reference, &one.convergence}) {
    if (*file) *file = frameName((*file)->string(), frame);
  }
  return one;
}

void checkFrames(const Options& options) {
  const FrameRange& frames = options.frames.value();
  if (frames.step > frames.last - frames.first) return;  // one frame
  const std::pair<const char*, const File*> files[] = {{"--outfile", &options.outfile},
                                                       {"--stats", &options.statsFile},
                                                       {"--bounds-cache", &options.boundsCache},
                                                       {"--checkpoint", &options.checkpoint},
                                                       {"--convergence", &options.convergence}};
  for (const auto& [name, file] : files) {
    if (*file && !hasFramePlace((*file)->string())) throwShared(name, **file);
  }
  for (const auto& scene : options.scenes) {
    if (scene == "-") throw SceneError({}, "--frames: standard input can be read once only; name a file");
  }
  if (options.outfile) return;
  const std::vector<std::string> first = imagesOf(options, frames.first),
                                 second = imagesOf(options, frames.first + frames.step);
  for (const std::string& name : first) {
    if (std::find(second.begin(), second.end(), name) != second.end()) throwShared("the image", name);
  }
}

}  // namespace pbrtmedia
