// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "fields/lattice_walk.h"
#include "fields/super_voxels.h"

namespace pbrtmedia {

/// How far learning is; counts of cells.
struct LearningProgress {
  std::uint64_t passes = 0;  ///< published so far
  std::size_t cells = 0;
  std::size_t raised = 0;   ///< by the last publication
  std::size_t visited = 0;  ///< ever looked up in
  std::uint64_t cut = 0;    ///< look-ups of the last pass that found more than their bound and its slack
  double shortfall =
      0;              ///< of the extinction that the last pass probed (LearnedBounds::probe): the share cut
  float maximum = 0;  ///< largest bound
};

/// Super-voxel bounds that are learned while rendering: progressive null-tracking, Misso et al. 2023, section
/// 4. Every density looked up is cut to its cell's present bound, and proposes max(bound, density + epsilon)
/// for the next pass. Bounds in force change only in `publish`, between passes, and a maximum does not depend
/// on the order of its arguments: so what a pass computes is the same for any number of threads.
///
/// Each pass is unbiased for the density cut to the bounds in force; the average over passes is consistent,
/// as every visited cell ends up bounding. Lower bounds are learned as the least density seen minus epsilon;
/// they are controls only and cut nothing.
///
/// The paper starts rendering at once, so its first passes see little of the medium. Whoever renders may
/// explore before: bounds are then proposed from look-ups in every cell or in blocks of them (Exploration),
/// and put into force.
///
/// With a slack s > 0 densities up to (1 + s) times the bound pass uncut: trackers whose weights allow a
/// bound slightly too low stay unbiased there, and the bounds themselves stay lower by the same factor.
class LearnedBounds {
 public:
  struct Params {
    float initial = 0.01f;  ///< bound of every cell before the first pass, > 0
    float epsilon = 0.01f;  ///< added to a density that is proposed as a bound, > 0
    float slack = 0;        ///< >= 0
    int warmUpPasses = 0;   ///< of exploration before the first pass, at most; >= 0; the paper: none
    /// Look-ups for them, at most. Nothing: whoever renders chooses.
    std::optional<std::uint64_t> warmUpLookups{};
  };

  /// Everything between two passes: bounds in force, what is proposed so far, how far learning is.
  struct State {
    std::vector<float> upper, lower;  ///< in force, cell by cell, x fastest
    std::vector<float> most, least;   ///< proposals
    LearningProgress progress;
    bool isRestored = false;
  };

  /// Throws SceneError (location unknown) when a parameter is out of range.
  LearnedBounds(const SuperVoxelLattice& cells, const Params& params);

  const Params& params() const { return params_; }
  /// The bounds in force.
  const SuperVoxels& inForce() const { return inForce_; }
  /// The density that trackers see at a local point: cut to the bound. Notes what was found. Thread-safe.
  float bounded(Vec3d local, float density) const {
    const std::size_t cell = inForce_.cellAt(local);
    const float bound = inForce_.upperOf(cell);
    propose(cell, density);
    const float limit = bound * (1 + params_.slack);
    if (!(density > limit)) return density;
    cut_[cell].fetch_add(1, std::memory_order_relaxed);
    return limit;
  }
  /// Notes the density at a random point of a segment, uniform on it: it proposes a bound as any other, and
  /// tells how much of the extinction the bounds in force cut away. `depthPerDensity` > 0: optical depth of
  /// the segment, if this were its density, per density. Thread-safe.
  void probe(Vec3d local, float density, double depthPerDensity) const;
  /// Notes a density found in a stored cell, whatever its bound. Thread-safe.
  void propose(std::size_t cell, float density) const;
  /// How often to explore before the first pass: not at all for what has learned already.
  int warmUpPasses() const { return hasStarted() ? 0 : params_.warmUpPasses; }
  /// Something was published, or restored.
  bool hasStarted() const { return progress_.passes > 0 || isRestored_; }
  /// Started from the numbers of another render.
  bool isRestored() const { return isRestored_; }
  /// Nothing was published yet, or the last publication raised some bound.
  bool isExploring() const { return progress_.passes == 0 || progress_.raised > 0; }
  /// What look-ups since the last publication came to, besides proposals; sums.
  struct Tally {
    std::uint64_t cut = 0;                       ///< LearningProgress::cut
    std::uint64_t depthFound = 0, depthCut = 0;  ///< by probes, in units of their own
  };
  /// Puts what was proposed into force. Not thread-safe.
  void publish() { publish(takeTally()); }
  /// The same with the tally of all who took part, and whose proposals are here (addProposals).
  void publish(const Tally& tally);
  /// Counting starts anew. Not thread-safe.
  Tally takeTally();
  /// Look-ups that were made elsewhere under the bounds in force count here, too. Not thread-safe.
  void addTally(const Tally& tally);
  /// Proposals so far as numbers, the larger the more telling: what is proposed by several, each for a part
  /// of the look-ups, is the largest of their numbers at each place.
  std::vector<float> proposals() const;
  /// Takes such numbers in. Not thread-safe.
  void addProposals(std::span<const float> proposals);
  LearningProgress progress() const { return progress_; }
  std::size_t bytesOfProposals() const {
    return inForce_.storedCells() * (2 * sizeof(float) + sizeof(std::uint32_t)) +
           kProbeSlots * sizeof(ProbeSum);
  }

  /// The bounds in force as numbers, cell by cell, x fastest: upper then lower; for a cache.
  std::vector<float> save() const;
  /// Starts from such numbers instead. False, changing nothing, when their count or a value does not fit.
  bool restore(const std::vector<float>& saved);

  /// To go on elsewhere as if nothing had happened, after a publication. Not thread-safe.
  State state() const;
  /// Whether a state has as many cells, and numbers in them that bounds can be.
  bool fits(const State& state) const;
  /// A state that fits. Not thread-safe.
  void restore(const State& state);

 private:
  /// Optical depths of probes, in whole units, so that their sums do not depend on the order.
  struct ProbeSum {
    std::atomic<std::uint64_t> found{0}, cut{0};
  };
  static constexpr double kDepthUnit = 0x1p-24, kMostDepth = 64;  ///< a probe of more counts as that much
  static constexpr std::size_t kProbeSlots = 1024;                ///< threads would queue for a common sum

  /// Calls visit(stored cell) for each cell of the lattice, x fastest.
  template <class Visit>
  void visitCells(const Visit& visit) const;

  Params params_;
  SuperVoxels inForce_;
  std::unique_ptr<std::atomic<float>[]> most_, least_;  ///< proposals, one per stored cell
  /// Look-ups cut in this pass. One counter a cell, as threads would queue for a common one.
  std::unique_ptr<std::atomic<std::uint32_t>[]> cut_;
  std::unique_ptr<ProbeSum[]> probes_;  ///< by stored cell modulo kProbeSlots
  Tally elsewhere_;
  LearningProgress progress_;
  bool isRestored_ = false;
};

inline void LearnedBounds::propose(std::size_t cell, float density) const {
  const float wanted = (density + params_.epsilon) / (1 + params_.slack);
  std::atomic<float>& most = most_[cell];
  for (float seen = most.load(std::memory_order_relaxed);
       wanted > seen && !most.compare_exchange_weak(seen, wanted, std::memory_order_relaxed);) {
  }
  std::atomic<float>& least = least_[cell];
  for (float seen = least.load(std::memory_order_relaxed);
       density < seen && !least.compare_exchange_weak(seen, density, std::memory_order_relaxed);) {
  }
}

}  // namespace pbrtmedia
