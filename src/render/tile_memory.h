// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

namespace pbrtmedia {

/// What the samples of one tile of pixels share, so that it is found once: only what is a function of scene,
/// camera, seed and place on the film, for a sample must not depend on which were taken before it, or on
/// which tile it is in. Each integrator has its own kind, or none. Of one thread.
class TileMemory {
 public:
  virtual ~TileMemory() = default;
  /// Density look-ups that filling it took, which are no single sample's.
  virtual std::uint64_t lookups() const = 0;
};

}  // namespace pbrtmedia
