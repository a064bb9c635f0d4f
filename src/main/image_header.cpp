// SPDX-License-Identifier: BSD-2-Clause
#include "main/image_header.h"

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>

#include "main/warnings.h"
#include "tools/build_info.h"

namespace pbrtmedia {
namespace {

/// Samples per pixel that the image holds: a mean when it was stopped early.
std::string samplesPerPixelText(const RenderStatistics& s) {
  if (!s.interrupted || s.samplesPlanned == 0) return std::to_string(s.samplesPerPixel);
  std::ostringstream mean;
  mean << static_cast<double>(s.samplesTaken) / static_cast<double>(s.samplesPlanned) *
              static_cast<double>(s.samplesPerPixel);
  return mean.str();
}

std::string hexadecimal(std::uint64_t value) {
  std::ostringstream text;
  text << std::hex << value;
  return text.str();
}

/// "sceneHash" says whether renders may be merged, the others what differs where they may not.
void addIdentity(Image& image, const SceneIdentity& identity) {
  image.metadata["sceneHash"] = hexadecimal(identity.hash());
  image.metadata["sceneText"] = hexadecimal(identity.text);
  if (!identity.derivative.empty()) image.metadata["derivative"] = identity.derivative;
  std::string variables;
  for (const auto& [name, value] : identity.variables) {
    if (!variables.empty()) variables += '\n';
    variables.append(name).append(1, ' ').append(value);
  }
  if (!variables.empty()) image.metadata["sceneVariables"] = variables;
  if (!identity.mediumParams.empty()) image.metadata["mediumParams"] = identity.mediumParams;
  // A header is no place for thousands of names.
  constexpr std::size_t kMostFiles = 64;
  std::string files;
  for (std::size_t i = 0; i < identity.files.size() && i < kMostFiles; ++i) {
    if (i > 0) files += '\n';
    files += hexadecimal(identity.files[i].content) + ' ' + identity.files[i].name;
  }
  if (!files.empty()) image.metadata["sceneFiles"] = files;
}

}  // namespace

Image withHeader(Image image, const RenderStatistics& statistics, const Options& options,
                 const SceneIdentity& identity) {
  std::ostringstream seconds;
  seconds << statistics.render.wall;
  image.metadata["command"] = options.commandLine;
  image.metadata["version"] = buildText();
  image.metadata["seed"] = std::to_string(options.seed);
  image.metadata["samples"] = samplesPerPixelText(statistics);
  image.metadata["seconds"] = seconds.str();
  if (statistics.parts.size() > 1) image.metadata["parts"] = formatParts(statistics.parts);
  if (!statistics.stoppedBy.empty()) image.metadata["stoppedBy"] = statistics.stoppedBy;
  addIdentity(image, identity);
  const std::string bounds = boundsState(statistics.learning);
  if (!bounds.empty()) image.metadata["boundsState"] = bounds;
  return image;
}

}  // namespace pbrtmedia
