// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/same_scene.h"

#include <charconv>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace pbrtmedia {
namespace {

constexpr double kMaxSamples = 0x1p53;  // counts above are no longer exact as double

std::optional<std::string> metadata(const Image& image, const std::string& key) {
  const auto found = image.metadata.find(key);
  if (found == image.metadata.end()) return std::nullopt;
  return found->second;
}

template <class T>
std::optional<T> parseWhole(const std::string& text) {
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// "name value" lines.
std::map<std::string, std::string> variablesOf(const Image& image) {
  std::map<std::string, std::string> variables;
  std::istringstream in(metadata(image, "sceneVariables").value_or(""));
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    if (space != std::string::npos) variables[line.substr(0, space)] = line.substr(space + 1);
  }
  return variables;
}

/// "hash name" lines as name -> hash.
std::map<std::string, std::string> filesOf(const Image& image) {
  std::map<std::string, std::string> files;
  std::istringstream in(metadata(image, "sceneFiles").value_or(""));
  for (std::string line; std::getline(in, line);) {
    const std::size_t space = line.find(' ');
    if (space != std::string::npos) files[line.substr(space + 1)] = line.substr(0, space);
  }
  return files;
}

/// What tells two scenes apart, as far as their headers say.
std::string sceneDifference(const Image& a, const Image& b) {
  std::vector<std::string> parts;
  const auto quoted = [](const std::optional<std::string>& text) {
    return text ? "'" + *text + "'" : std::string("none");
  };
  if (metadata(a, "sceneText") != metadata(b, "sceneText")) parts.emplace_back("the text of the scene files");
  const std::map<std::string, std::string> variables = variablesOf(b);
  for (const auto& [name, value] : variablesOf(a)) {
    const auto other = variables.find(name);
    if (other == variables.end() || other->second == value) continue;
    std::string& part = parts.emplace_back("the variable $");
    part.append(name).append(" (").append(value).append(" and ").append(other->second).append(")");
  }
  const auto paramsA = metadata(a, "mediumParams"), paramsB = metadata(b, "mediumParams");
  if (paramsA != paramsB)
    parts.push_back("--mediumparams (" + quoted(paramsA) + " and " + quoted(paramsB) + ")");
  std::map<std::string, std::string> others = filesOf(b);
  for (const auto& [name, hash] : filesOf(a)) {
    const auto other = others.find(name);
    if (other == others.end()) {
      parts.push_back("the file " + name + " (only in the first)");
    } else {
      if (other->second != hash) parts.push_back("the content of " + name);
      others.erase(other);
    }
  }
  for (const auto& [name, hash] : others) parts.push_back("the file " + name + " (only in the second)");
  if (parts.empty()) return "metadata \"sceneHash\" differs, and nothing else says in what";
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : ", ") + part;
  return text + (parts.size() == 1 ? " differs" : " differ");
}

std::string countText(double v) {
  std::ostringstream out;
  out.precision(17);
  out << v;
  return out.str();
}

/// Values of a key that all inputs agree on.
void keepCommon(const std::vector<NamedImage>& inputs, const std::string& key, Image& out) {
  const auto first = metadata(inputs.front().image, key);
  for (const NamedImage& input : inputs) {
    if (metadata(input.image, key) != first) return;
  }
  if (first) out.metadata[key] = *first;
}

void sumSeconds(const std::vector<NamedImage>& inputs, Image& out) {
  double sum = 0;
  for (const NamedImage& input : inputs) {
    const auto text = metadata(input.image, "seconds");
    const auto seconds = text ? parseWhole<double>(*text) : std::nullopt;
    if (!seconds) return;
    sum += *seconds;
  }
  std::ostringstream text;
  text << sum;
  out.metadata["seconds"] = text.str();
}

}  // namespace

void failMerge(const std::string& name, const std::string& message) {
  throw std::runtime_error(name + ": " + message);
}

std::string requiredMetadata(const NamedImage& input, const std::string& key) {
  const auto value = metadata(input.image, key);
  if (!value)
    failMerge(input.name, "no metadata \"" + key + "\"; only renders that were not processed can be merged");
  return *value;
}

double samplesOf(const NamedImage& input) {
  const std::string text = requiredMetadata(input, "samples");
  const std::optional<double> samples = parseWhole<double>(text);
  if (!samples || !(*samples > 0) || !(*samples < kMaxSamples)) {
    failMerge(input.name, "metadata \"samples\" should be a count above 0, found \"" + text + "\"");
  }
  return *samples;
}

void requireSameScene(const NamedImage& first, const NamedImage& other) {
  const Image &a = first.image, &b = other.image;
  const std::string pair = first.name + " and " + other.name;
  if (a.width() != b.width() || a.height() != b.height()) failMerge(pair, "different sizes");
  if (!(a.dataWindow == b.dataWindow) || !(a.displayWindow == b.displayWindow))
    failMerge(pair, "different windows");
  if (a.channels() != b.channels()) failMerge(pair, "different channels");
  if (requiredMetadata(first, "sceneHash") != requiredMetadata(other, "sceneHash")) {
    failMerge(pair, "different scenes: " + sceneDifference(a, b));
  }
}

void requireKnownBounds(const NamedImage& input) {
  if (metadata(input.image, "boundsState").value_or("") != "rising") return;
  failMerge(
      input.name,
      "its progressive bounds were still rising (metadata \"boundsState\"), and an average of such parts "
      "stays wrong: let one render learn them with pbrt --bounds-cache FILE, then render the parts with it");
}

std::map<std::string, std::string> mergedMetadata(const std::vector<NamedImage>& inputs) {
  Image out;
  for (const char* key :
       {"sceneHash", "sceneText", "sceneVariables", "mediumParams", "sceneFiles", "boundsState", "layers"})
    keepCommon(inputs, key, out);
  std::vector<const Image*> images;
  for (const NamedImage& input : inputs) images.push_back(&input.image);
  for (const char* key : {"command", "version"}) {
    if (const std::string lines = eachOf(images, key); !lines.empty()) out.metadata[key] = lines;
  }
  sumSeconds(inputs, out);
  double samples = 0;
  for (const NamedImage& input : inputs) {
    samples += samplesOf(input);
    const auto stopped = input.image.metadata.find("stoppedBy");
    if (stopped != input.image.metadata.end()) out.metadata.insert(*stopped);
  }
  out.metadata["samples"] = countText(samples);
  return out.metadata;
}

}  // namespace pbrtmedia
