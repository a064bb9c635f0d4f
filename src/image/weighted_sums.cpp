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
#include "image/channels.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kParts = 3;  // 24 bits each, of 53
constexpr std::array<double WeightedSums::*, 4> kMembers = {&WeightedSums::r, &WeightedSums::g,
                                                            &WeightedSums::b, &WeightedSums::weight};
constexpr std::array<const char*, kMembers.size()> kNames = {"sums.r.", "sums.g.", "sums.b.", "sums.weight."};

std::string channelName(std::size_t number, std::size_t part) {
  std::string name =
      number < kMembers.size() ? kNames[number] : "sums." + std::to_string(number - kMembers.size()) + '.';
  return name += static_cast<char>('0' + part);
}

bool isSums(const std::string& channel) { return channel.starts_with("sums."); }

std::vector<std::string> otherChannels(const Image& image) {
  std::vector<std::string> names;
  for (const std::string& name : image.channels()) {
    if (!isSums(name)) names.push_back(name);
  }
  return names;
}

/// Of the sums of the colours, then of as many others as there are; `kParts` each. Nothing without colours.
std::optional<std::vector<std::size_t>> channelsOf(const Image& image) {
  std::vector<std::size_t> channels;
  for (std::size_t number = 0;; ++number) {
    for (std::size_t part = 0; part < kParts; ++part) {
      const std::optional<std::size_t> channel = image.channelIndex(channelName(number, part));
      if (!channel && number >= kMembers.size() && part == 0) return channels;
      if (!channel) return std::nullopt;
      channels.push_back(*channel);
    }
  }
}

/// Of the values as they are stored.
std::string hashOf(const Image& image, const std::vector<std::size_t>& channels) {
  std::uint64_t hash = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      for (const std::size_t c : channels)
        hash = hashCombine(hash, std::bit_cast<std::uint32_t>(image.at(x, y, c)));
    }
  }
  return std::to_string(hash);
}

/// As the sum of floats, largest first.
void put(double sum, float* parts) {
  for (std::size_t part = 0; part < kParts; ++part) {
    parts[part] = static_cast<float>(sum);
    sum -= static_cast<double>(parts[part]);  // exact
  }
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

Image withSums(const Image& image, std::span<const WeightedSums> sums, const Development& development,
               std::span<const double> others) {
  const auto pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  if (sums.size() != pixels || pixels == 0 || others.size() % pixels != 0)
    throw std::invalid_argument("withSums: one sum for each pixel");
  const std::size_t more = others.size() / pixels;
  std::vector<std::string> room;
  for (std::size_t number = 0; number < kMembers.size() + more; ++number) {
    for (std::size_t part = 0; part < kParts; ++part) room.push_back(channelName(number, part));
  }
  const std::vector<std::string> kept = otherChannels(image);
  Image out = withChannels(image, kept, room);
  std::size_t i = 0;
  for (int y = 0; y < out.height(); ++y) {
    for (int x = 0; x < out.width(); ++x, ++i) {
      float* parts = &out.at(x, y, kept.size());
      for (const auto member : kMembers) {
        put(sums[i].*member, parts);
        parts += kParts;
      }
      for (const double sum : others.subspan(i * more, more)) {
        put(sum, parts);
        parts += kParts;
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

std::optional<PixelSums> sumsOf(const Image& image) {
  const std::optional<std::vector<std::size_t>> channels = channelsOf(image);
  const auto hash = image.metadata.find("sumsHash");
  if (!channels || hash == image.metadata.end() || hash->second != hashOf(image, *channels))
    return std::nullopt;
  const auto pixels = static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
  const std::size_t count = channels->size() / kParts;
  PixelSums sums;
  sums.colours.reserve(pixels);
  sums.others.reserve(pixels * (count - kMembers.size()));
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      WeightedSums& colour = sums.colours.emplace_back();
      for (std::size_t number = 0; number < count; ++number) {
        double& sum = number < kMembers.size() ? colour.*kMembers[number] : sums.others.emplace_back(0);
        // The smallest first, so that nothing is rounded away on the way.
        for (std::size_t part = kParts; part-- > 0;)
          sum += static_cast<double>(image.at(x, y, (*channels)[number * kParts + part]));
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
  Image out = withChannels(image, otherChannels(image));
  for (const char* key : {"filmScale", "keepsNegatives", "sumsHash"}) out.metadata.erase(key);
  return out;
}

}  // namespace pbrtmedia
