// SPDX-License-Identifier: BSD-2-Clause
#include "image/weighted_sums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/hash.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kParts = 3;  // 24 bits each, of 53
constexpr std::array<double WeightedSums::*, 4> kMembers = {&WeightedSums::r, &WeightedSums::g,
                                                            &WeightedSums::b, &WeightedSums::weight};
constexpr std::array<const char*, kMembers.size()> kNames = {"sums.r.", "sums.g.", "sums.b.", "sums.weight."};

std::string channelName(std::size_t member, std::size_t part) {
  return std::string(kNames[member]) += static_cast<char>('0' + part);
}

bool isSums(const std::string& channel) { return channel.starts_with("sums."); }

std::vector<std::string> otherChannels(const Image& image) {
  std::vector<std::string> names;
  for (const std::string& name : image.channels()) {
    if (!isSums(name)) names.push_back(name);
  }
  return names;
}

using Channels = std::array<std::size_t, kMembers.size() * kParts>;

std::optional<Channels> channelsOf(const Image& image) {
  Channels channels{};
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const std::optional<std::size_t> channel = image.channelIndex(channelName(i / kParts, i % kParts));
    if (!channel) return std::nullopt;
    channels[i] = *channel;
  }
  return channels;
}

/// Of the values as they are stored.
std::string hashOf(const Image& image, const Channels& channels) {
  std::uint64_t hash = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const std::size_t c : channels)
        hash = hashCombine(hash, std::bit_cast<std::uint32_t>(image.at(x, y, c)));
    }
  }
  return std::to_string(hash);
}

/// The image with these channels alone, and room for others, which are 0.
Image picked(const Image& image, const std::vector<std::string>& kept, const std::vector<std::string>& all) {
  Image out(image.width(), image.height(), all);
  out.dataWindow = image.dataWindow;
  out.displayWindow = image.displayWindow;
  out.metadata = image.metadata;
  for (const std::string& name : kept) {
    const std::size_t from = *image.channelIndex(name), to = *out.channelIndex(name);
    for (int y = 0; y < out.height(); ++y) {
      for (int x = 0; x < out.width(); ++x) out.at(x, y, to) = image.at(x, y, from);
    }
  }
  return out;
}

}  // namespace

float Development::value(double mean) const {
  constexpr double kMost = std::numeric_limits<float>::max();
  if (!keepsNegatives) mean = std::max(0.0, mean);
  return static_cast<float>(std::clamp(mean * scale, -kMost, kMost));
}

Rgb Development::colour(const WeightedSums& s) const {
  if (s.weight == 0) return Rgb(0);
  return {value(s.r / s.weight), value(s.g / s.weight), value(s.b / s.weight)};
}

Image withSums(const Image& image, std::span<const WeightedSums> sums, const Development& development) {
  if (sums.size() != static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()))
    throw std::invalid_argument("withSums: one sum for each pixel");
  std::vector<std::string> names = otherChannels(image);
  const std::vector<std::string> others = names;
  for (std::size_t m = 0; m < kMembers.size(); ++m) {
    for (std::size_t part = 0; part < kParts; ++part) names.push_back(channelName(m, part));
  }
  Image out = picked(image, others, names);
  std::size_t i = 0;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x, ++i) {
      for (std::size_t m = 0; m < kMembers.size(); ++m) {
        double rest = sums[i].*kMembers[m];
        for (std::size_t part = 0; part < kParts; ++part) {
          const auto next = static_cast<float>(rest);
          out.at(x, y, others.size() + m * kParts + part) = next;
          rest -= static_cast<double>(next);  // exact
        }
      }
    }
  }
  out.metadata["sumsHash"] = hashOf(out, *channelsOf(out));
  std::array<char, 32> text{};
  out.metadata["filmScale"] =
      std::string(text.data(), std::to_chars(text.data(), text.data() + text.size(), development.scale).ptr);
  out.metadata["keepsNegatives"] = std::string(1, development.keepsNegatives ? '1' : '0');
  return out;
}

std::optional<std::vector<WeightedSums>> sumsOf(const Image& image) {
  const std::optional<Channels> channels = channelsOf(image);
  const auto hash = image.metadata.find("sumsHash");
  if (!channels || hash == image.metadata.end() || hash->second != hashOf(image, *channels))
    return std::nullopt;
  std::vector<WeightedSums> sums;
  sums.reserve(static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      WeightedSums& s = sums.emplace_back();
      for (std::size_t m = 0; m < kMembers.size(); ++m) {
        // The smallest first, so that nothing is rounded away on the way.
        for (std::size_t part = kParts; part-- > 0;)
          s.*kMembers[m] += static_cast<double>(image.at(x, y, (*channels)[m * kParts + part]));
      }
    }
  }
  return sums;
}

Development developmentOf(const Image& image) {
  const auto text = [&](const char* key) {
    const auto found = image.metadata.find(key);
    return found == image.metadata.end() ? std::string() : found->second;
  };
  Development development;
  const std::string scale = text("filmScale"), negatives = text("keepsNegatives");
  const auto [end, status] = std::from_chars(scale.data(), scale.data() + scale.size(), development.scale);
  if (status != std::errc() || end != scale.data() + scale.size() || (negatives != "0" && negatives != "1"))
    throw std::invalid_argument("metadata \"filmScale\" or \"keepsNegatives\" is missing or senseless");
  development.keepsNegatives = negatives == "1";
  return development;
}

Image withoutSums(const Image& image) {
  Image out = picked(image, otherChannels(image), otherChannels(image));
  for (const char* key : {"filmScale", "keepsNegatives", "sumsHash"}) out.metadata.erase(key);
  return out;
}

}  // namespace pbrtmedia
