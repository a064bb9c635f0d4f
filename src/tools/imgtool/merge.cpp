// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/merge.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "tools/imgtool/layers.h"
#include "tools/imgtool/merge_ranges.h"

namespace pbrtmedia {
namespace {

/// Seeds of a render, or of an earlier merge: "3" or "3,4,7".
std::vector<std::uint64_t> seedsOf(const NamedImage& input) {
  const std::string text = requiredMetadata(input, "seed");
  std::vector<std::uint64_t> seeds;
  std::istringstream in(text + ",");
  for (std::string word; std::getline(in, word, ',');) {
    std::uint64_t seed = 0;
    const char* const end = word.data() + word.size();
    const auto [at, status] = std::from_chars(word.data(), end, seed);
    if (status != std::errc() || at != end)
      failMerge(input.name, "metadata \"seed\" should be whole numbers, found \"" + text + "\"");
    seeds.push_back(seed);
  }
  return seeds;
}

void addWeighted(std::vector<double>& sum, const NamedImage& input, double weight) {
  const std::vector<float>& values = input.image.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) {
      const std::size_t pixel = i / input.image.channelCount();
      const std::size_t width = static_cast<std::size_t>(input.image.width());
      failMerge(input.name, "the value at pixel (" + std::to_string(pixel % width) + ", " +
                                std::to_string(pixel / width) + ") is not finite");
    }
    sum[i] += weight * static_cast<double>(values[i]);
  }
}

}  // namespace

Image mergeRenders(const std::vector<NamedImage>& inputs) {
  if (inputs.empty()) throw std::runtime_error("nothing to merge");
  std::map<std::uint64_t, std::string> owners;
  std::string seedList;
  double totalSamples = 0;
  std::vector<double> samplesOfEach;
  std::vector<double> sum(inputs.front().image.data().size());
  for (const NamedImage& input : inputs) {
    requireSameScene(inputs.front(), input);
    if (inputs.size() > 1) requireKnownBounds(input);
    for (const std::uint64_t seed : seedsOf(input)) {
      const auto [owner, isNew] = owners.emplace(seed, input.name);
      if (!isNew) {
        failMerge(owner->second + " and " + input.name,
                  "both used seed " + std::to_string(seed) + ", so they hold the same samples");
      }
      if (!seedList.empty()) seedList += ',';
      seedList += std::to_string(seed);
    }
    const double samples = samplesOf(input);
    totalSamples += samples;
    samplesOfEach.push_back(samples);
    addWeighted(sum, input, samples);
  }
  Image out = inputs.front().image;
  for (std::size_t i = 0; i < sum.size(); ++i) out.data()[i] = static_cast<float>(sum[i] / totalSamples);
  mergeLayers(inputs, samplesOfEach, out);
  out.metadata = mergedMetadata(inputs);
  out.metadata["seed"] = seedList;
  return out;
}

int runMerge(const MergeOptions& options) {
  requireWritable(options.outfile);
  std::vector<NamedImage> inputs;
  for (const std::string& file : options.inputs) {
    LoadedImage loaded = loadLinear(file);
    if (loaded.format != ImageFormat::Exr) failMerge(file, "only EXR renders can be merged");
    inputs.push_back({file, std::move(loaded.image)});
  }
  const Image merged = std::any_of(inputs.begin(), inputs.end(), isRange) ? mergeRanges(std::move(inputs))
                                                                          : mergeRenders(inputs);
  if (merged.metadata.contains("sampleRange") && options.write.pixelType == PixelType::Half)
    failMerge(options.outfile, "a part of a render's samples is kept as 32-bit values: --pixeltype float");
  writeImage(options.outfile, merged, options.write);
  std::cout << options.outfile << ": " << options.inputs.size() << " renders, "
            << merged.metadata.at("samples") << " samples per pixel\n";
  return 0;
}

}  // namespace pbrtmedia
