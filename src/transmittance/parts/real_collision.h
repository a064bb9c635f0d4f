// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>

#include "transmittance/estimate.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Decides by one number of the stream whether a tentative collision is real: in channel c with probability
/// share[c] * ratio, ratio being real / tentative extinction of the largest channel, whose share is 1. So
/// each channel alone is tracked as if it were the only one. The values of channels that collide are
/// multiplied by `keep`. Answers whether anything is left in a channel that has extinction.
template <std::size_t N>
bool passCollision(Channels<N>& value, const Channels<N>& share, double ratio, double keep,
                   SampleStream& stream, LookupTally& tally) {
  const double u = stream.uniform();
  bool anyLeft = false;
  for (std::size_t c = 0; c < N; ++c) {
    if (u < share[c] * ratio) value[c] *= keep;
    anyLeft = anyLeft || (value[c] > 0 && share[c] > 0);
  }
  if (!(u < ratio)) ++tally.nullCollisions;
  return anyLeft;
}

}  // namespace pbrtmedia
