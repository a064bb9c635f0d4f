// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "film/sample_pass.h"
#include "film/splat_buffer.h"
#include "render/pass_shares.h"
#include "render/ranks.h"

namespace pbrtmedia {

/// Bytes of one sample on its way to another rank, with so many numbers of layers.
inline std::size_t bytesOfSample(std::size_t layerSize) {
  return sizeof(SamplePass::Sample) + layerSize * sizeof(float);
}

/// Brings the samples of a pass to the ranks that sum them: afterwards `samples` has, for the rows that this
/// rank needs, what all ranks have taken. To be called by all; they run the same program on the same kind of
/// machine. `splats`: of this rank's units; null where there are none on any rank. Answers those of other
/// ranks that reach this rank's rows, a buffer for each.
std::vector<SplatBuffer> deliver(Ranks& ranks, const PassShares& shares, SamplePass& samples,
                                 const std::vector<SplatBuffer>* splats);

}  // namespace pbrtmedia
