// SPDX-License-Identifier: BSD-2-Clause
#include "mpi/message_pattern.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <vector>

#include "render/pass_shares.h"
#include "render/sample_delivery.h"

namespace pbrtmedia {
namespace {

constexpr int kWidth = 1920, kHeight = 1080, kReach = 2;  // pixels; a filter of radius 2
constexpr std::uint64_t kThreads = 16;                    ///< of a rank
constexpr double kSampleSeconds = 20e-6;                  ///< of one thread, a mean
// Of a network: seconds for a message, and bytes a second into one rank.
constexpr double kLatency = 2e-6, kBandwidth = 10e9;

/// Of a tile: the middle of the picture costs 30 times as much as its edges.
std::uint64_t costOf(const Bounds2i& tile) {
  const double x = (tile.min.x + tile.max.x) * .5 / kWidth - .5,
               y = (tile.min.y + tile.max.y) * .5 / kHeight - .5;
  return static_cast<std::uint64_t>(static_cast<double>(tile.area()) *
                                    (1 + 29 * std::exp(-20 * (x * x + y * y))) * 1000);
}

/// The largest load of a rank over the mean.
double imbalance(const PassShares& shares, const std::vector<std::uint64_t>& costs) {
  double largest = 0, sum = 0;
  for (std::size_t rank = 0; rank < shares.ranks(); ++rank) {
    double load = 0;
    for (const std::size_t tile : shares.takenBy(rank)) load += static_cast<double>(costs[tile]);
    largest = std::max(largest, load);
    sum += load;
  }
  return largest * static_cast<double>(shares.ranks()) / sum;
}

void addRow(std::ostream& out, std::size_t ranks) {
  const Bounds2i film{{0, 0}, {kWidth, kHeight}},
      samples{{-kReach, -kReach}, {kWidth + kReach, kHeight + kReach}};
  const int edge = ranks == 1 ? 16 : PassShares::tileEdge(samples, 16, ranks * kThreads);
  PassShares shares({.ranks = ranks,
                     .tiles = PassShares::tilesOf(samples, edge),
                     .film = film,
                     .firstNeighbour = -kReach,
                     .lastNeighbour = kReach});
  std::vector<std::uint64_t> costs;
  for (const Bounds2i& tile : shares.tiles()) costs.push_back(costOf(tile));
  const double dealt = imbalance(shares, costs);
  shares.balance(costs);
  const double balanced = imbalance(shares, costs);
  double bytes = 0, mostIn = 0, mostMessages = 0;
  for (std::size_t to = 0; to < ranks; ++to) {
    double in = 0, messages = 0;
    for (std::size_t from = 0; from < ranks; ++from) {
      double pixels = 0;
      for (const Bounds2i& part : shares.sent(from, to)) pixels += static_cast<double>(part.area());
      in += pixels * static_cast<double>(bytesOfSample(0));
      messages += pixels > 0 ? 1 : 0;
    }
    bytes += in;
    mostIn = std::max(mostIn, in);
    mostMessages = std::max(mostMessages, messages);
  }
  const double taking =
      static_cast<double>(samples.area()) * kSampleSeconds / static_cast<double>(ranks * kThreads) * balanced;
  const double common = ranks == 1 ? 0 : 4 * kLatency * std::ceil(std::log2(static_cast<double>(ranks)));
  const double moving = mostIn / kBandwidth + mostMessages * kLatency + common;
  out << "| " << ranks << " | " << edge << std::fixed << std::setprecision(2) << " | " << dealt << " | "
      << balanced << " | " << bytes / 1e6 << " | " << mostIn / 1e6 << std::setprecision(0) << " | "
      << mostMessages << std::setprecision(2) << " | " << taking * 1e3 << " | " << moving * 1e3
      << std::setprecision(0) << " | " << 100 * taking / balanced / (taking + moving) << " |\n";
}

}  // namespace

std::string messagePattern() {
  std::ostringstream out;
  out << "| ranks | tile | dealt out | balanced | MB moved | MB into one rank | messages to it | ms of "
         "samples | ms of "
         "moving | % of ideal |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const std::size_t ranks : {1u, 2u, 4u, 16u, 64u, 256u, 1024u}) addRow(out, ranks);
  return out.str();
}

}  // namespace pbrtmedia
