// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/merge_ranges.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "image/weighted_sums.h"
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

std::vector<WeightedSums> requiredSums(const NamedImage& input) {
  std::optional<std::vector<WeightedSums>> sums = sumsOf(input.image);
  if (!sums) failMerge(input.name, "no channels \"sums...\"; ranges are merged as pbrt --samples wrote them");
  return std::move(*sums);
}

/// Channels that have no sums (layers): means, weighted by the pixels' weights.
void averageOthers(const std::vector<NamedImage>& inputs, const std::vector<std::vector<WeightedSums>>& parts,
                   Image& out) {
  for (std::size_t c = 0; c < out.channelCount(); ++c) {
    const std::string& name = out.channels()[c];
    if (name == "R" || name == "G" || name == "B") continue;
    std::size_t i = 0;
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x, ++i) {
        double sum = 0, weight = 0;
        for (std::size_t k = 0; k < inputs.size(); ++k) {
          const double w = parts[k][i].weight;
          sum += w * static_cast<double>(inputs[k].image.at(x, y, *inputs[k].image.channelIndex(name)));
          weight += w;
        }
        out.at(x, y, c) = weight != 0 ? static_cast<float>(sum / weight) : 0;
      }
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
  std::vector<std::vector<WeightedSums>> parts;
  for (const NamedImage& input : inputs) parts.push_back(requiredSums(input));
  std::vector<WeightedSums> sums(parts.front().size());
  for (const std::vector<WeightedSums>& part : parts) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += part[i];
  }
  const Development development = developmentOf(inputs.front().image);
  Image out = withoutSums(inputs.front().image);
  std::size_t i = 0;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x) out.setRgb(x, y, development.colour(sums[i++]));
  }
  averageOthers(inputs, parts, out);
  out.metadata = mergedMetadata(inputs);
  out.metadata["seed"] = requiredMetadata(inputs.front(), "seed");
  const std::string planned = requiredMetadata(inputs.front(), "samplesPlanned"), text = textOf(ranges);
  if (text == std::string("0:").append(planned)) return out;
  out.metadata["samplesPlanned"] = planned;
  out.metadata["sampleRange"] = text;
  return withSums(out, sums, development);
}

}  // namespace pbrtmedia
