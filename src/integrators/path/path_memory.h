// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "render/tile_memory.h"
#include "singlescattering/shared_explorers.h"

namespace pbrtmedia {

/// What paths that start in neighbouring pixels share.
class PathMemory final : public TileMemory {
 public:
  PathMemory(const MediaTopology& media, const Camera& camera, std::uint64_t seed)
      : explorers_(media, camera, seed) {}
  std::uint64_t lookups() const override { return explorers_.lookups(); }
  SharedExplorers& explorers() { return explorers_; }

 private:
  SharedExplorers explorers_;
};

}  // namespace pbrtmedia
