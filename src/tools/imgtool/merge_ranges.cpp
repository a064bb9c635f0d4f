// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/merge_ranges.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "film/pixel_sums.h"
#include "image/splat_sums.h"
#include "image/weighted_sums.h"
#include "tools/imgtool/layers.h"
#include "tools/imgtool/same_scene.h"

namespace pbrtmedia {
namespace {

using Range = std::pair<std::int64_t, std::int64_t>;  ///< sample indices, the upper end exclusive

/// "0:16,32:64", in order and apart.
std::vector<Range> rangesOf(const NamedImage& input) {
  std::vector<Range> ranges;
  const std::string text = requiredMetadata(input, "sampleRange");
  std::istringstream in(text + ",");
  for (std::string word; std::getline(in, word, ',');) {
    Range r;
    const char* const end = word.data() + word.size();
    const auto first = std::from_chars(word.data(), end, r.first);
    const bool hasColon = first.ec == std::errc() && first.ptr != end && *first.ptr == ':';
    const auto last = hasColon ? std::from_chars(first.ptr + 1, end, r.second) : first;
    if (!hasColon || last.ec != std::errc() || last.ptr != end || r.first < 0 || r.second <= r.first)
      failMerge(input.name, "metadata \"sampleRange\" should be ranges, found \"" + text + "\"");
    ranges.push_back(r);
  }
  return ranges;
}

/// Neighbours joined.
std::string textOf(const std::vector<Range>& ranges) {
  std::vector<Range> joined;
  for (const Range& r : ranges) {
    if (!joined.empty() && joined.back().second == r.first) {
      joined.back().second = r.second;
    } else {
      joined.push_back(r);
    }
  }
  std::ostringstream text;
  for (std::size_t i = 0; i < joined.size(); ++i)
    text << (i > 0 ? "," : "") << joined[i].first << ':' << joined[i].second;
  return text.str();
}

/// All ranges in order; throws where two overlap.
std::vector<Range> apart(const std::vector<NamedImage>& inputs) {
  std::vector<std::pair<Range, const NamedImage*>> all;
  for (const NamedImage& input : inputs) {
    for (const Range& r : rangesOf(input)) all.emplace_back(r, &input);
  }
  std::sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Range> ranges;
  for (const auto& [range, input] : all) {
    if (!ranges.empty() && range.first < ranges.back().second)
      failMerge(
          input->name,
          std::string("its samples ").append(textOf({range})).append(" are in another of the images too"));
    ranges.push_back(range);
  }
  return ranges;
}

void requireSameRender(const NamedImage& first, const NamedImage& other) {
  requireSameScene(first, other);
  for (const char* key : {"seed", "samplesPlanned", "filmScale", "keepsNegatives"}) {
    const std::string a = requiredMetadata(first, key), b = requiredMetadata(other, key);
    if (a == b) continue;
    std::string what = "ranges of one render have the same \"";
    what.append(key).append("\"; found ").append(a).append(" and ").append(b);
    failMerge(first.name + " and " + other.name, what);
  }
  requireKnownBounds(other);
}

PixelSums requiredSums(const NamedImage& input, const OtherSums& order) {
  std::optional<PixelSums> sums = sumsOf(input.image);
  if (!sums || sums->others.size() != sums->colours.size() * order.count())
    failMerge(input.name, "no channels \"sums...\"; ranges are merged as pbrt --samples wrote them");
  return std::move(*sums);
}

/// The light paths behind the splats of all ranges; none where there are no splats.
SplatPaths pathsOf(const std::vector<NamedImage>& inputs) {
  SplatPaths all;
  if (!hasSplatPaths(inputs.front().image)) return all;
  for (const NamedImage& input : inputs) {
    try {
      const SplatPaths paths = splatPathsOf(input.image);
      if (all.count > 0 && paths.area != all.area)
        throw std::invalid_argument("metadata \"splatArea\" is not that of the other ranges");
      all = {all.count + paths.count, paths.area};
    } catch (const std::invalid_argument& e) {
      failMerge(input.name, e.what());
    }
  }
  return all;
}

PixelSums added(const std::vector<NamedImage>& inputs, const OtherSums& order) {
  PixelSums sums;
  for (const NamedImage& input : inputs) {
    PixelSums part = requiredSums(input, order);
    if (sums.colours.empty()) {
      sums = std::move(part);
      continue;
    }
    for (std::size_t i = 0; i < sums.colours.size(); ++i) sums.colours[i] += part.colours[i];
    for (std::size_t i = 0; i < sums.others.size(); ++i) sums.others[i] += part.others[i];
  }
  return sums;
}

void develop(const PixelSums& sums, const LayerSet& layers, const OtherSums& order, const SplatPaths& paths,
             const Development& development, Image& out) {
  std::vector<std::string> names = {"R", "G", "B"};
  names.insert(names.end(), layers.channelNames().begin(), layers.channelNames().end());
  std::vector<float> values(names.size());
  std::vector<std::size_t> channels;
  for (const std::string& name : names) channels.push_back(out.channelIndex(name).value());
  std::size_t i = 0;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x, ++i) {
      const auto others = std::span(sums.others).subspan(i * order.count(), order.count());
      developPixel(order.parts(sums.colours[i], others), layers, paths, development, values.data());
      for (std::size_t c = 0; c < channels.size(); ++c) out.at(x, y, channels[c]) = values[c];
    }
  }
}

}  // namespace

bool isRange(const NamedImage& input) { return input.image.metadata.contains("sampleRange"); }

Image mergeRanges(std::vector<NamedImage> inputs) {
  for (const NamedImage& input : inputs) {
    if (!isRange(input))
      failMerge(input.name, "no range of samples, unlike the others; merge the ranges first");
    requireSameRender(inputs.front(), input);
  }
  const std::vector<Range> ranges = apart(inputs);
  std::sort(inputs.begin(), inputs.end(),
            [](const NamedImage& a, const NamedImage& b) { return rangesOf(a) < rangesOf(b); });
  const LayerSet layers = layersOf(inputs.front());
  const SplatPaths paths = pathsOf(inputs);
  const OtherSums order(layers, paths.count > 0);
  const PixelSums sums = added(inputs, order);
  const Development development = developmentOf(inputs.front().image);
  Image out = withoutSums(inputs.front().image);
  develop(sums, layers, order, paths, development, out);
  out.metadata = mergedMetadata(inputs);
  out.metadata["seed"] = requiredMetadata(inputs.front(), "seed");
  const std::string planned = requiredMetadata(inputs.front(), "samplesPlanned"), text = textOf(ranges);
  if (text == std::string("0:").append(planned)) return out;
  out.metadata["samplesPlanned"] = planned;
  out.metadata["sampleRange"] = text;
  out = withSums(out, sums.colours, development, sums.others);
  if (paths.count > 0) putSplatPaths(paths, out);
  return out;
}

}  // namespace pbrtmedia
