// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "base/statistics.h"
#include "base/vec.h"
#include "cameras/camera.h"
#include "singlescattering/main_part.h"
#include "world/media_topology.h"

namespace pbrtmedia {

/// Explorers that the camera rays of neighbouring pixels have in common, kBlock x kBlock of them. Those of a
/// block lie on the camera ray through its middle, and serve another ray of the block at the same distance
/// from the camera. How far they are from what other rays meet is seen on rays through the block's quarters.
/// Szirmay-Kalos et al. 2017, sections 4 and 4.3.
///
/// The paper's rays take what rays before them have left. Here explorers are a function of scene, camera,
/// seed and block, whoever asks first: so images depend on no order of pixels, on no thread and no pass, and
/// several of these objects give the same answers. Not thread-safe; each tile of pixels has one.
class SharedExplorers {
 public:
  static constexpr int kBlock = 4;  ///< pixels
  /// Borrows all.
  SharedExplorers(const MediaTopology& media, const Camera& camera, std::uint64_t seed)
      : media_(media), camera_(camera), seed_(seed) {}

  /// Of the block that a pixel lies in, in order of distance. Found when it is asked for first, and counted
  /// in `lookups`, for the samples of all its pixels profit.
  std::span<const Explorer> of(Point2i pixel);
  std::uint64_t lookups() const { return lookups_; }

 private:
  std::vector<Explorer> exploreBlock(Point2i block);
  template <class Visit>
  void visitStretches(Point2f film, RenderCounters& counters, Visit&& visit) const;

  const MediaTopology& media_;
  const Camera& camera_;
  std::uint64_t seed_;
  std::uint64_t lookups_ = 0;
  std::unordered_map<std::uint64_t, std::vector<Explorer>> blocks_;
};

/// Those between two distances, ends included.
std::span<const Explorer> explorersBetween(std::span<const Explorer> explorers, double tMin, double tMax);

}  // namespace pbrtmedia
