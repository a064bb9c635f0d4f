// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/merge.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <map>
#include <optional>
#include <sstream>
#include <stdexcept>

namespace pbrtmedia {
namespace {

constexpr double kMaxSamples = 0x1p53;  // counts above are no longer exact as double

[[noreturn]] void fail(const std::string& name, const std::string& message) {
  throw std::runtime_error(name + ": " + message);
}

std::optional<std::string> metadata(const Image& image, const std::string& key) {
  const auto found = image.metadata.find(key);
  if (found == image.metadata.end()) return std::nullopt;
  return found->second;
}

std::string required(const NamedImage& input, const std::string& key) {
  const auto value = metadata(input.image, key);
  if (!value)
    fail(input.name, "no metadata \"" + key + "\"; only renders that were not processed can be merged");
  return *value;
}

template <class T>
std::optional<T> parseWhole(const std::string& text) {
  T value{};
  const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (status != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

double samplesOf(const NamedImage& input) {
  const std::string text = required(input, "samples");
  const std::optional<double> samples = parseWhole<double>(text);
  if (!samples || !(*samples > 0) || !(*samples < kMaxSamples)) {
    fail(input.name, "metadata \"samples\" should be a count above 0, found \"" + text + "\"");
  }
  return *samples;
}

/// Seeds of a render, or of an earlier merge: "3" or "3,4,7".
std::vector<std::uint64_t> seedsOf(const NamedImage& input) {
  const std::string text = required(input, "seed");
  std::vector<std::uint64_t> seeds;
  std::istringstream in(text + ",");
  for (std::string word; std::getline(in, word, ',');) {
    const std::optional<std::uint64_t> seed = parseWhole<std::uint64_t>(word);
    if (!seed) fail(input.name, "metadata \"seed\" should be whole numbers, found \"" + text + "\"");
    seeds.push_back(*seed);
  }
  return seeds;
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

void requireSameScene(const NamedImage& first, const NamedImage& other) {
  const Image &a = first.image, &b = other.image;
  const std::string pair = first.name + " and " + other.name;
  if (a.width() != b.width() || a.height() != b.height()) fail(pair, "different sizes");
  if (!(a.dataWindow == b.dataWindow) || !(a.displayWindow == b.displayWindow))
    fail(pair, "different windows");
  if (a.channels() != b.channels()) fail(pair, "different channels");
  if (required(first, "sceneHash") != required(other, "sceneHash")) {
    fail(pair, "different scenes: " + sceneDifference(a, b));
  }
}

/// Parts that each began with unknown bounds lack the same extinction, and so does their average, however
/// many there are: one long render would have grown out of it.
void requireKnownBounds(const NamedImage& input) {
  if (metadata(input.image, "boundsState").value_or("") != "rising") return;
  fail(input.name,
       "its progressive bounds were still rising (metadata \"boundsState\"), and an average of such parts "
       "stays wrong: let one render learn them with pbrt --bounds-cache FILE, then render the parts with it");
}

void addWeighted(std::vector<double>& sum, const NamedImage& input, double weight) {
  const std::vector<float>& values = input.image.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      const std::size_t pixel = i / input.image.channelCount();
      const std::size_t width = static_cast<std::size_t>(input.image.width());
      fail(input.name, "the value at pixel (" + std::to_string(pixel % width) + ", " +
                           std::to_string(pixel / width) + ") is not finite");
    }
    sum[i] += weight * static_cast<double>(values[i]);
  }
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

Image mergeRenders(const std::vector<NamedImage>& inputs) {
  if (inputs.empty()) throw std::runtime_error("nothing to merge");
  std::map<std::uint64_t, std::string> owners;
  std::string seedList;
  double totalSamples = 0;
  std::vector<double> sum(inputs.front().image.data().size());
  for (const NamedImage& input : inputs) {
    requireSameScene(inputs.front(), input);
    if (inputs.size() > 1) requireKnownBounds(input);
    for (const std::uint64_t seed : seedsOf(input)) {
      const auto [owner, isNew] = owners.emplace(seed, input.name);
      if (!isNew) {
        fail(owner->second + " and " + input.name,
             "both used seed " + std::to_string(seed) + ", so they hold the same samples");
      }
      if (!seedList.empty()) seedList += ',';
      seedList += std::to_string(seed);
    }
    const double samples = samplesOf(input);
    totalSamples += samples;
    addWeighted(sum, input, samples);
  }
  Image out = inputs.front().image;
  for (std::size_t i = 0; i < sum.size(); ++i) out.data()[i] = static_cast<float>(sum[i] / totalSamples);
  out.metadata.clear();
  for (const char* key : {"sceneHash", "sceneText", "mediumParams", "sceneFiles", "boundsState"})
    keepCommon(inputs, key, out);
  std::vector<const Image*> images;
  for (const NamedImage& input : inputs) images.push_back(&input.image);
  for (const char* key : {"command", "version"}) {
    if (const std::string lines = eachOf(images, key); !lines.empty()) out.metadata[key] = lines;
  }
  sumSeconds(inputs, out);
  out.metadata["samples"] = countText(totalSamples);
  out.metadata["seed"] = seedList;
  return out;
}

int runMerge(const MergeOptions& options) {
  requireWritable(options.outfile);
  std::vector<NamedImage> inputs;
  for (const std::string& file : options.inputs) {
    LoadedImage loaded = loadLinear(file);
    if (loaded.format != ImageFormat::Exr) fail(file, "only EXR renders can be merged");
    inputs.push_back({file, std::move(loaded.image)});
  }
  const Image merged = mergeRenders(inputs);
  writeImage(options.outfile, merged, options.write);
  std::cout << options.outfile << ": " << inputs.size() << " renders, " << merged.metadata.at("samples")
            << " samples per pixel\n";
  return 0;
}

}  // namespace pbrtmedia
