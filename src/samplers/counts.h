// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <bit>
#include <cstdint>
#include <string>
#include <string_view>

#include "base/diagnostics.h"

namespace pbrtmedia {

/// `value`, or SceneError when it is outside [least, most].
inline std::int64_t checkedCount(std::string_view sampler, std::string_view name, std::int64_t value,
                                 std::int64_t least, std::int64_t most = std::int64_t{1} << 31) {
  if (value >= least && value <= most) return value;
  throw SceneError({}, "sampler \"" + std::string(sampler) + "\": " + std::string(name) + " is " +
                           std::to_string(value) + "; expected " + std::to_string(least) + " to " +
                           std::to_string(most));
}

/// Smallest power of two >= value, value >= 1.
inline std::int64_t roundUpToPowerOfTwo(std::int64_t value) {
  return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(value)));
}

}  // namespace pbrtmedia
