// SPDX-License-Identifier: BSD-2-Clause
#include "render/bounds_learning.h"

#include <algorithm>
#include <utility>

#include "base/hash.h"
#include "base/parallel.h"
#include "fields/exploration.h"
#include "media/medium.h"
#include "render/shared_report.h"
#include "world/scene.h"

namespace pbrtmedia {
namespace {

/// "warm" in ASCII: keeps the random numbers of the exploration apart from other uses of the same seed.
constexpr std::uint64_t kWarmUpTag = 0x7761726d;
/// One thread explores this many blocks of super-voxels at a time, or a share of all.
constexpr std::size_t kLeastBlocks = 64, kMostChunks = 4096;
/// Look-ups to explore the bounds of all media, for each camera sample of the render: a small part of what a
/// sample in a medium makes itself (10 to 100).
constexpr std::uint64_t kWarmUpPerSample = 4;
/// But as many for one medium may be made in any case: four passes over 32 x 32 x 32 super-voxels, a
/// fraction of a second.
constexpr std::uint64_t kLeastWarmUp = std::uint64_t{1} << 21;

}  // namespace

BoundsLearning::BoundsLearning(const Scene& scene, bool isFixed, Ranks& ranks, RenderResult& result)
    : learners_(scene.learners()), isFixed_(isFixed), ranks_(ranks), result_(result) {
  if (!result_.learning.empty()) return;
  for (Medium* learner : learners_) {
    LearningRecord record;
    record.medium = learner->name();
    record.restored = learner->learnedBounds()->isRestored();
    result_.learning.push_back(std::move(record));
  }
}

std::uint64_t BoundsLearning::warmUpBudget() const {
  return std::max(kLeastWarmUp, kWarmUpPerSample * result_.samplesTotal / learners_.size());
}

void BoundsLearning::warmUp(std::uint64_t seed, const std::function<bool()>& shouldStop) {
  if (!isNeeded()) return;
  for (std::size_t i = 0; i < learners_.size(); ++i) {
    if (learners_[i]->learnedBounds()->warmUpPasses() == 0) continue;
    explore(i, hashCombine(seed, kWarmUpTag, static_cast<std::uint64_t>(i)), shouldStop);
  }
}

void BoundsLearning::explore(std::size_t learner, std::uint64_t seed,
                             const std::function<bool()>& shouldStop) {
  const Medium& medium = *learners_[learner];
  LearnedBounds& bounds = *learners_[learner]->learnedBounds();
  LearningRecord& record = result_.learning[learner];
  const auto planned = [&](int passes) {
    return planExploration(bounds.inForce().shape(), passes,
                           bounds.params().warmUpLookups.value_or(warmUpBudget()));
  };
  const int wanted = bounds.warmUpPasses();
  const Exploration plan = planned(wanted);
  record.warmUpIsLimited = plan.blockEdge > 1 || planned(plan.passes + 1).passes == plan.passes;
  record.warmUpPasses = plan.passes;
  record.warmUpBlockEdge = plan.blockEdge;
  if (plan.passes == 0) return;
  const std::size_t blocks = plan.blockCount();
  const std::size_t chunk = std::max(kLeastBlocks, blocks / kMostChunks),
                    chunks = (blocks + chunk - 1) / chunk;
  // Chunks are dealt out to the ranks one by one.
  std::vector<RenderCounters> counters((chunks + ranks_.count() - 1 - ranks_.rank()) / ranks_.count());
  parallelFor(counters.size(), [&](std::size_t i) {
    if (shouldStop()) return;
    const std::size_t c = i * ranks_.count() + ranks_.rank();
    medium.exploreBounds(plan, c * chunk, std::min(blocks, (c + 1) * chunk), seed, counters[i]);
  });
  RenderCounters explored;
  for (const RenderCounters& c : counters) explored.add(c);
  addUp(ranks_, explored);
  record.warmUpLookups += explored.densityLookups;
  result_.counters.add(explored);
  publish(bounds);
  record.warmUp = bounds.progress();
}

void BoundsLearning::publish(LearnedBounds& bounds) {
  LearnedBounds::Tally tally = bounds.takeTally();
  if (!ranks_.isAlone()) {
    std::vector<float> proposals = bounds.proposals();
    ranks_.takeLargest(proposals);
    bounds.addProposals(proposals);
    std::uint64_t sums[] = {tally.cut, tally.depthFound, tally.depthCut};
    ranks_.addUp(sums);
    tally = {sums[0], sums[1], sums[2]};
  }
  bounds.publish(tally);
}

void BoundsLearning::publish(std::uint64_t samples) {
  if (!isNeeded()) return;
  for (std::size_t i = 0; i < learners_.size(); ++i) {
    LearnedBounds& bounds = *learners_[i]->learnedBounds();
    LearningRecord& record = result_.learning[i];
    publish(bounds);
    record.passes.push_back(bounds.progress());
    record.shortfallOfSamples += bounds.progress().shortfall * static_cast<double>(samples);
    if (result_.samplesTaken > 0)
      record.shortfall = record.shortfallOfSamples / static_cast<double>(result_.samplesTaken);
  }
}

}  // namespace pbrtmedia
