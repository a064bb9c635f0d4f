// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "base/vec.h"

namespace pbrtmedia {

struct Primitive;

/// A crossing where a boundary contradicts the ray's current medium; the first few are shown to the user.
struct MediumMismatch {
  Point2i pixel;
  std::int64_t sample = 0;
  Point3f p;  ///< world
  std::string believed, named;
  const Primitive* boundary = nullptr;  ///< of the scene
  /// pixel 3 4, sample 0: a boundary at (...) has "fog" on the side of a ray that is in "smoke"
  std::string toString() const;
};

/// Where the first mismatches of one pixel sample or of a tile are noted down. Not thread-safe.
struct MismatchLog {
  Point2i pixel;
  std::int64_t sample = 0;
  std::size_t capacity = 4;
  std::vector<MediumMismatch> entries;
};

}  // namespace pbrtmedia
