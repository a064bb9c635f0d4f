// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/layers.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "base/diagnostics.h"
#include "image/channels.h"

namespace pbrtmedia {
namespace {

/// "N" of "N.X", "" of "R".
std::string groupOf(const std::string& channel) {
  const std::size_t dot = channel.rfind('.');
  return dot == std::string::npos ? std::string() : channel.substr(0, dot);
}

bool hasAll(const Image& image, const LayerInfo& info) {
  return std::all_of(info.channels.begin(),
                     info.channels.begin() + static_cast<std::ptrdiff_t>(info.channelCount()),
                     [&](std::string_view name) { return image.channelIndex(name).has_value(); });
}

std::vector<std::string> channelsOf(const LayerInfo& info) {
  return {info.channels.begin(), info.channels.begin() + static_cast<std::ptrdiff_t>(info.channelCount())};
}

/// R before G, G before B; X, Y, Z are in order already.
void orderColours(std::vector<std::string>& channels) {
  constexpr std::string_view kOrder = "RGBA";
  const auto rank = [&](const std::string& name) { return kOrder.find(name.back()); };
  std::stable_sort(channels.begin(), channels.end(),
                   [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
}

/// What `--layer` may be for an image.
std::vector<std::string> layerNamesOf(const Image& image) {
  std::vector<std::string> names;
  if (image.channelIndex("R")) names.emplace_back("colour");
  for (const LayerInfo& info : kLayers) {
    if (hasAll(image, info)) names.emplace_back(info.name);
  }
  for (const std::string& channel : image.channels()) {
    const std::string group = groupOf(channel);
    if (!group.empty() && group != "sums" && std::find(names.begin(), names.end(), group) == names.end())
      names.push_back(group);
  }
  return names;
}

double sumOver(const std::vector<NamedImage>& inputs, int x, int y, const std::string& channel,
               const std::vector<double>& factors) {
  double sum = 0;
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const Image& image = inputs[k].image;
    sum += factors[k] * static_cast<double>(image.at(x, y, *image.channelIndex(channel)));
  }
  return sum;
}

/// Which renders have a value there at all: their samples, or 0.
std::vector<double> samplesWithValue(const std::vector<NamedImage>& inputs, int x, int y,
                                     const std::vector<std::string>& channels,
                                     const std::vector<double>& samples) {
  std::vector<double> with(inputs.size());
  for (std::size_t k = 0; k < inputs.size(); ++k) {
    const Image& image = inputs[k].image;
    const bool any = std::any_of(channels.begin(), channels.end(), [&](const std::string& name) {
      return image.at(x, y, *image.channelIndex(name)) != 0;
    });
    with[k] = any ? samples[k] : 0;
  }
  return with;
}

double sumOf(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum;
}

}  // namespace

LayerSet layersOf(const NamedImage& render) {
  LayerMask mask;
  const auto found = render.image.metadata.find("layers");
  std::istringstream in(found == render.image.metadata.end() ? std::string() : found->second);
  for (std::string name; std::getline(in, name, ',');) {
    const std::optional<Layer> layer = layerOfName(name);
    if (!layer)
      failMerge(render.name, "metadata \"layers\" names \"" + name + "\", which this program does not know");
    if (!hasAll(render.image, infoOf(*layer)))
      failMerge(render.name, "the channels of layer \"" + name + "\" are not there");
    mask.set(static_cast<std::size_t>(*layer));
  }
  return LayerSet(mask);
}

void mergeLayers(const std::vector<NamedImage>& inputs, const std::vector<double>& samples, Image& out) {
  const double all = sumOf(samples);
  const std::vector<double> ones(inputs.size(), 1.0);
  std::vector<double> shares2(inputs.size());
  for (std::size_t k = 0; k < inputs.size(); ++k) shares2[k] = (samples[k] / all) * (samples[k] / all);
  const LayerSet layers = layersOf(inputs.front());
  for (const Layer layer : layers.layers()) {
    const LayerInfo& info = infoOf(layer);
    if (info.kind == LayerKind::Mean || info.kind == LayerKind::Radiance) continue;
    const std::vector<std::string> channels = channelsOf(info);
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) {
        std::vector<double> factors = info.kind == LayerKind::Total ? ones : shares2;
        double whole = 1;
        if (info.kind == LayerKind::Weighted) {
          factors = samplesWithValue(inputs, x, y, channels, samples);
          whole = std::max(sumOf(factors), 1e-300);
        }
        for (const std::string& channel : channels) {
          out.at(x, y, *out.channelIndex(channel)) =
              static_cast<float>(sumOver(inputs, x, y, channel, factors) / whole);
        }
      }
    }
  }
}

std::vector<std::string> channelsOfLayer(const std::string& file, const Image& image,
                                         const std::string& name) {
  if (name == "colour") {
    std::vector<std::string> colours;
    for (const char* channel : {"R", "G", "B"}) {
      if (image.channelIndex(channel)) colours.emplace_back(channel);
    }
    if (!colours.empty()) return colours;
  }
  if (const std::optional<Layer> layer = layerOfName(name); layer && hasAll(image, infoOf(*layer)))
    return channelsOf(infoOf(*layer));
  if (image.channelIndex(name)) return {name};
  std::vector<std::string> channels;
  for (const std::string& channel : image.channels()) {
    if (groupOf(channel) == name) channels.push_back(channel);
  }
  if (!name.empty() && !channels.empty()) {
    orderColours(channels);
    return channels;
  }
  const std::vector<std::string> names = layerNamesOf(image);
  const std::vector<std::string_view> known(names.begin(), names.end());
  throw std::runtime_error(file + ": there is no layer \"" + name + '"' + suggestion(name, known));
}

Image layerAlone(const std::string& file, const Image& image, const std::string& name) {
  const auto own = image.metadata.find("layer");
  if (own != image.metadata.end() && own->second == name) return image;
  const std::vector<std::string> from = channelsOfLayer(file, image, name);
  std::vector<std::string> to = {"Y"};
  if (from.size() == 3) to = {"R", "G", "B"};
  if (from.size() == 4) to = {"R", "G", "B", "A"};
  if (from.size() == 2 || from.size() > 4)
    throw std::runtime_error(file + ": layer \"" + name + "\" has " + std::to_string(from.size()) +
                             " channels; name one of them: " + from[0] + ", " + from[1] + ", ...");
  const Image picked = withChannels(image, from);
  Image out(image.width(), image.height(), to, picked.data());
  out.dataWindow = image.dataWindow;
  out.displayWindow = image.displayWindow;
  out.metadata = image.metadata;
  out.metadata["layer"] = name;
  out.metadata.erase("layers");
  // No render any more: a merge would average what is to be added.
  for (const char* key : {"sampleRange", "sumsHash", "samples", "seed"}) out.metadata.erase(key);
  return out;
}

bool isDataLayer(const std::string& name) {
  if (const auto layer = layerOfName(name)) return !isColour(infoOf(*layer).channels[0]);
  if (name == "colour") return false;
  // A channel, or what channels begin with.
  const auto ofChannel = [&](std::string_view channel) {
    return !channel.empty() && (channel == name || channel.substr(0, channel.find('.')) == name);
  };
  for (const LayerInfo& info : kLayers) {
    for (const std::string_view channel : info.channels) {
      if (ofChannel(channel)) return !isColour(channel);
    }
  }
  return !isColour(name);
}

}  // namespace pbrtmedia
