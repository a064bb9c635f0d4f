// SPDX-License-Identifier: BSD-2-Clause
#include "render/sample_delivery.h"

#include <glog/logging.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace pbrtmedia {
namespace {

static_assert(std::is_trivially_copyable_v<SamplePass::Sample> && std::is_trivially_copyable_v<Splat>);

/// Calls visit(first sample, its layers, pixels) for each row of the parts, one after the other in memory.
template <class Visit>
void visitRows(SamplePass& samples, std::span<const Bounds2i> parts, const Visit& visit) {
  for (const Bounds2i& part : parts) {
    for (int s = 0; s < samples.samplesPerPixel(); ++s) {
      for (int y = part.min.y; y < part.max.y; ++y) {
        visit(&samples.at({part.min.x, y}, s), samples.layerValues({part.min.x, y}, s),
              static_cast<std::size_t>(part.width()));
      }
    }
  }
}

void put(std::string& text, const void* values, std::size_t bytes) {
  if (bytes > 0) text.append(static_cast<const char*>(values), bytes);
}

void take(std::string_view& text, void* values, std::size_t bytes) {
  CHECK_LE(bytes, text.size()) << "ranks that do not agree who takes what";
  if (bytes > 0) std::memcpy(values, text.data(), bytes);
  text.remove_prefix(bytes);
}

std::string packed(SamplePass& samples, std::span<const Bounds2i> parts) {
  std::string text;
  const std::size_t layerSize = samples.layerSize();
  visitRows(samples, parts, [&](const SamplePass::Sample* row, const float* layers, std::size_t pixels) {
    put(text, row, pixels * sizeof(SamplePass::Sample));
    put(text, layers, pixels * layerSize * sizeof(float));
  });
  return text;
}

void unpack(std::string_view& text, SamplePass& samples, std::span<const Bounds2i> parts) {
  const std::size_t layerSize = samples.layerSize();
  visitRows(samples, parts, [&](SamplePass::Sample* row, float* layers, std::size_t pixels) {
    take(text, row, pixels * sizeof(SamplePass::Sample));
    take(text, layers, pixels * layerSize * sizeof(float));
  });
}

/// Those that reach a rank's rows, with their number before them.
void putSplats(std::string& text, const PassShares& shares, std::size_t rank,
               const std::vector<SplatBuffer>& units) {
  std::vector<Splat> reaching;
  for (const SplatBuffer& unit : units) {
    for (const Splat& splat : unit.splats()) {
      const float row = std::floor(splat.film.y);
      // Beyond that there is no film, and no whole number perhaps.
      if (std::abs(row) < 0x1p30f && shares.needs(rank, static_cast<int>(row))) reaching.push_back(splat);
    }
  }
  const std::uint64_t count = reaching.size();
  put(text, &count, sizeof count);
  put(text, reaching.data(), reaching.size() * sizeof(Splat));
}

SplatBuffer takeSplats(std::string_view& text) {
  std::uint64_t count = 0;
  take(text, &count, sizeof count);
  SplatBuffer buffer;
  for (; count > 0; --count) {
    Splat splat;
    take(text, &splat, sizeof splat);
    buffer.begin(splat.order, splat.isOdd);
    buffer.add(splat.film, splat.value);
  }
  return buffer;
}

}  // namespace

std::vector<SplatBuffer> deliver(Ranks& ranks, const PassShares& shares, SamplePass& samples,
                                 const std::vector<SplatBuffer>* splats) {
  std::vector<std::string> outgoing(ranks.count());
  for (std::size_t to = 0; to < ranks.count(); ++to) {
    if (to == ranks.rank()) continue;
    outgoing[to] = packed(samples, shares.sent(ranks.rank(), to));
    if (splats) putSplats(outgoing[to], shares, to, *splats);
  }
  std::vector<std::size_t> senders = shares.sendersTo(ranks.rank());
  if (splats) {  // may go from everywhere to everywhere
    senders.clear();
    for (std::size_t from = 0; from < ranks.count(); ++from) {
      if (from != ranks.rank()) senders.push_back(from);
    }
  }
  const std::vector<std::string> incoming = ranks.exchange(outgoing, senders);
  std::vector<SplatBuffer> buffers;
  for (std::size_t i = 0; i < senders.size(); ++i) {
    std::string_view text = incoming[i];
    unpack(text, samples, shares.sent(senders[i], ranks.rank()));
    if (splats) buffers.push_back(takeSplats(text));
    CHECK(text.empty()) << "ranks that do not agree who takes what";
  }
  return buffers;
}

}  // namespace pbrtmedia
