// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>

#include "base/bounds.h"
#include "base/vec.h"
#include "fields/interval.h"

namespace pbrtmedia {

/// A density given by a rule instead of samples, in the space of the medium. Immutable, thread-safe; the
/// virtual call is small against what such a density costs.
class DensityFunction {
 public:
  virtual ~DensityFunction() = default;
  /// >= 0, finite for finite p.
  virtual float at(Vec3d p) const = 0;
  /// A range that holds every value of `at` over the closed box; nothing when the rule knows none.
  virtual std::optional<Interval> range(const Bounds3d& box) const = 0;
  /// A few words for --verbose.
  virtual std::string describe() const = 0;
  /// What was wrong with values so far, for a warning; empty: nothing.
  virtual std::string complaint() const { return {}; }
};

}  // namespace pbrtmedia
