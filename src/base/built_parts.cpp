// SPDX-License-Identifier: BSD-2-Clause
#include "base/built_parts.h"

#include <atomic>

namespace pbrtmedia {
namespace {

constexpr std::array<std::string_view, kPartCount> kNames = {"media",
                                                             "chromaticMedia",
                                                             "superVoxelGrids",
                                                             "learnedBounds",
                                                             "textures",
                                                             "rayDifferentials",
                                                             "lightDistributions",
                                                             "rayTrees",
                                                             "subsurfaceTables",
                                                             "photonMaps",
                                                             "layers",
                                                             "filmHalves",
                                                             "splatBuffers"};

/// Of the process: what is built belongs to many owners, and nobody reads it but statistics.
std::array<std::atomic<std::uint64_t>, kPartCount>& counts() {
  static std::array<std::atomic<std::uint64_t>, kPartCount> all{};
  return all;
}

}  // namespace

BuiltParts BuiltParts::operator-(const BuiltParts& earlier) const {
  BuiltParts r;
  for (std::size_t i = 0; i < kPartCount; ++i) r.counts[i] = counts[i] - earlier.counts[i];
  return r;
}

std::string_view nameOf(Part part) { return kNames.at(static_cast<std::size_t>(part)); }

void countBuilt(Part part, std::uint64_t n) {
  counts()[static_cast<std::size_t>(part)].fetch_add(n, std::memory_order_relaxed);
}

BuiltParts builtParts() {
  BuiltParts r;
  for (std::size_t i = 0; i < kPartCount; ++i) r.counts[i] = counts()[i].load(std::memory_order_relaxed);
  return r;
}

}  // namespace pbrtmedia
