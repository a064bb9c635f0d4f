// SPDX-License-Identifier: BSD-2-Clause
#include "fields/learned_bounds.h"

#include <glog/logging.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/built_parts.h"
#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

constexpr float kUnseen = std::numeric_limits<float>::infinity();

const LearnedBounds::Params& checked(const LearnedBounds::Params& p) {
  const auto require = [](bool holds, const char* what, float found) {
    if (holds) return;
    throw SceneError(SourceLocation{},
                     std::string("learned bounds: ") + what + "; found " + std::to_string(found));
  };
  require(p.initial > 0 && std::isfinite(p.initial), "the first bound must be a number above 0", p.initial);
  require(p.epsilon > 0 && std::isfinite(p.epsilon), "epsilon must be a number above 0", p.epsilon);
  if (p.warmUpPasses < 0) {
    throw SceneError(SourceLocation{}, "learned bounds: passes of warm-up must be 0 or more; found " +
                                           std::to_string(p.warmUpPasses));
  }
  require(p.slack >= 0 && std::isfinite(p.slack), "the slack must be a number of at least 0", p.slack);
  return p;
}

}  // namespace

LearnedBounds::LearnedBounds(const SuperVoxelLattice& cells, const Params& params)
    : params_(checked(params)),
      inForce_(cells, SuperVoxel{params.initial, 0, SuperVoxel::kUnknownMean}),
      most_(std::make_unique<std::atomic<float>[]>(inForce_.storedCells())),
      least_(std::make_unique<std::atomic<float>[]>(inForce_.storedCells())),
      cut_(std::make_unique<std::atomic<std::uint32_t>[]>(inForce_.storedCells())),
      probes_(std::make_unique<ProbeSum[]>(kProbeSlots)) {
  for (std::size_t i = 0; i < inForce_.storedCells(); ++i) {
    most_[i].store(params.initial, std::memory_order_relaxed);
    least_[i].store(kUnseen, std::memory_order_relaxed);
  }
  countBuilt(Part::LearnedBounds);
  progress_.cells = inForce_.cellCount();
  progress_.maximum = params.initial;
}

void LearnedBounds::probe(Vec3d local, float density, double depthPerDensity) const {
  const double depth = std::min(static_cast<double>(density) * depthPerDensity, kMostDepth);
  const double share = static_cast<double>(bounded(local, density)) / static_cast<double>(density);
  if (!(depth > 0)) return;
  ProbeSum& sum = probes_[inForce_.cellAt(local) % kProbeSlots];
  sum.found.fetch_add(static_cast<std::uint64_t>(depth / kDepthUnit), std::memory_order_relaxed);
  if (share < 1) {
    sum.cut.fetch_add(static_cast<std::uint64_t>((1 - share) * depth / kDepthUnit),
                      std::memory_order_relaxed);
  }
}

LearnedBounds::Tally LearnedBounds::takeTally() {
  Tally tally = std::exchange(elsewhere_, {});
  for (std::size_t i = 0; i < inForce_.storedCells(); ++i)
    tally.cut += cut_[i].exchange(0, std::memory_order_relaxed);
  for (std::size_t i = 0; i < kProbeSlots; ++i) {
    tally.depthFound += probes_[i].found.exchange(0, std::memory_order_relaxed);
    tally.depthCut += probes_[i].cut.exchange(0, std::memory_order_relaxed);
  }
  return tally;
}

void LearnedBounds::addTally(const Tally& tally) {
  elsewhere_.cut += tally.cut;
  elsewhere_.depthFound += tally.depthFound;
  elsewhere_.depthCut += tally.depthCut;
}

std::vector<float> LearnedBounds::proposals() const {
  std::vector<float> numbers;
  numbers.reserve(2 * inForce_.cellCount());
  visitCells([&](std::size_t cell) {
    numbers.push_back(most_[cell].load(std::memory_order_relaxed));
    numbers.push_back(-least_[cell].load(std::memory_order_relaxed));
  });
  return numbers;
}

void LearnedBounds::addProposals(std::span<const float> proposals) {
  CHECK_EQ(proposals.size(), 2 * inForce_.cellCount());
  std::size_t next = 0;
  visitCells([&](std::size_t cell) {
    const float most = proposals[next], least = -proposals[next + 1];
    next += 2;
    if (most > most_[cell].load(std::memory_order_relaxed))
      most_[cell].store(most, std::memory_order_relaxed);
    if (least < least_[cell].load(std::memory_order_relaxed))
      least_[cell].store(least, std::memory_order_relaxed);
  });
}

void LearnedBounds::publish(const Tally& tally) {
  progress_.raised = progress_.visited = 0;
  inForce_.update([&](std::size_t cell, const SuperVoxel& old) {
    const float upper = most_[cell].load(std::memory_order_relaxed);
    const float least = least_[cell].load(std::memory_order_relaxed);
    progress_.raised += upper > old.upper;
    progress_.visited += least < kUnseen;
    const float lower = least < kUnseen ? std::max(0.0f, least - params_.epsilon) : 0.0f;
    return SuperVoxel{std::max(upper, old.upper), lower, SuperVoxel::kUnknownMean};
  });
  progress_.cut = tally.cut;
  const auto found = static_cast<double>(tally.depthFound);
  progress_.shortfall = found > 0 ? static_cast<double>(tally.depthCut) / found : 0;
  progress_.maximum = inForce_.maximum();
  ++progress_.passes;
}

template <class Visit>
void LearnedBounds::visitCells(const Visit& visit) const {
  const auto& n = inForce_.shape().count;
  for (std::int64_t k = 0; k < n.z; ++k) {
    for (std::int64_t j = 0; j < n.y; ++j) {
      for (std::int64_t i = 0; i < n.x; ++i) visit(static_cast<std::size_t>(inForce_.shape().index(i, j, k)));
    }
  }
}

std::vector<float> LearnedBounds::save() const {
  std::vector<float> numbers;
  visitCells([&](std::size_t cell) {
    numbers.push_back(inForce_.upperOf(cell));
    numbers.push_back(inForce_.lowerOf(cell));
  });
  return numbers;
}

bool LearnedBounds::restore(const std::vector<float>& saved) {
  if (saved.size() != 2 * inForce_.cellCount()) return false;
  for (std::size_t i = 0; i < saved.size(); i += 2) {
    const float upper = saved[i], lower = saved[i + 1];
    if (!(upper > 0 && std::isfinite(upper) && lower >= 0 && lower <= upper)) return false;
  }
  std::size_t next = 0;
  inForce_.update([&](std::size_t cell, const SuperVoxel&) {
    const float upper = saved[next], lower = saved[next + 1];
    next += 2;
    most_[cell].store(upper, std::memory_order_relaxed);
    if (lower > 0) least_[cell].store(lower + params_.epsilon, std::memory_order_relaxed);
    return SuperVoxel{upper, lower, SuperVoxel::kUnknownMean};
  });
  progress_.maximum = inForce_.maximum();
  isRestored_ = true;
  return true;
}

LearnedBounds::State LearnedBounds::state() const {
  State state;
  for (std::vector<float>* numbers : {&state.upper, &state.lower, &state.most, &state.least})
    numbers->reserve(inForce_.cellCount());
  visitCells([&](std::size_t cell) {
    state.upper.push_back(inForce_.upperOf(cell));
    state.lower.push_back(inForce_.lowerOf(cell));
    state.most.push_back(most_[cell].load(std::memory_order_relaxed));
    state.least.push_back(least_[cell].load(std::memory_order_relaxed));
  });
  state.progress = progress_;
  state.isRestored = isRestored_;
  return state;
}

bool LearnedBounds::fits(const State& state) const {
  const std::size_t cells = inForce_.cellCount();
  if (state.upper.size() != cells || state.lower.size() != cells || state.most.size() != cells ||
      state.least.size() != cells)
    return false;
  const auto isBound = [](float x) { return x > 0 && std::isfinite(x); };
  return std::all_of(state.upper.begin(), state.upper.end(), isBound) &&
         std::all_of(state.most.begin(), state.most.end(), isBound) &&
         std::all_of(state.lower.begin(), state.lower.end(),
                     [](float x) { return x >= 0 && std::isfinite(x); }) &&
         std::all_of(state.least.begin(), state.least.end(), [](float x) { return x >= 0; });
}

void LearnedBounds::restore(const State& state) {
  CHECK(fits(state));
  std::size_t next = 0;
  inForce_.update([&](std::size_t cell, const SuperVoxel&) {
    const std::size_t i = next++;
    most_[cell].store(state.most[i], std::memory_order_relaxed);
    least_[cell].store(state.least[i], std::memory_order_relaxed);
    return SuperVoxel{state.upper[i], state.lower[i], SuperVoxel::kUnknownMean};
  });
  progress_ = state.progress;
  isRestored_ = state.isRestored;
}

}  // namespace pbrtmedia
