// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <span>

#include "base/rng.h"
#include "base/statistics.h"
#include "singlescattering/lit_stretch.h"
#include "singlescattering/main_part.h"

namespace pbrtmedia {

/// A lit stretch with a main part of its extinction: that through explorers which others have found nearby,
/// or through its own where there are none.
struct ExploredStretch {
  const LitStretch& lit;
  MainPart mainPart;
  /// Of the points that sample the difference to the main part, 1/length: the largest difference seen, and at
  /// least a share of what the main part and the bounds say. > 0.
  double rate;

  /// Nothing for a stretch without end. `near`: in order of t; may be empty.
  static std::optional<ExploredStretch> over(const LitStretch& stretch, std::span<const Explorer> near,
                                             RenderCounters& counters);
};

/// A walk along an explored stretch that estimates, without bias, the transmittance from its start to any
/// distance on the way: exp of the main part, times 1 - difference / rate at each point of a Poisson process.
/// Szirmay-Kalos et al. 2017, sections 3.3, 4.2 and 4.3: the double particle model. Values may leave [0, 1].
/// Where little is left, the walk ends with a chance of one half at each point, so that it costs no more
/// than the ray is deep. Not thread-safe.
class ExploredWalk {
 public:
  /// Points of the process have this density per length.
  ExploredWalk(const ExploredStretch& stretch, double rate, Rng& rng, RenderCounters& counters);

  struct Step {
    double t;     ///< of a point of the process
    Rgb through;  ///< the transmittance to it, independent of what is found there
    MediaStretch::Coefficients there;
  };
  /// The next point; nothing when there is no further one, or nothing is left.
  std::optional<Step> next() { return stepBefore(stretch_.mainPart.tMax()); }
  /// The transmittance from the start to `t`, not before where the walk has come to.
  Rgb transmittanceTo(double t);

 private:
  std::optional<Step> stepBefore(double t);
  Rgb through(const MainPart::Value& value) const;

  const ExploredStretch& stretch_;
  double rate_;
  Rng& rng_;
  RenderCounters& counters_;
  MainPart::Channels weight_{1, 1, 1};
  double ahead_;  ///< the next point
  bool isOver_ = false;
};

}  // namespace pbrtmedia
