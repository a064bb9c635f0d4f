// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "integrators/render_loop.h"
#include "integrators/scene.h"
#include "main/options.h"

namespace pbrtmedia {

/// What went wrong while rendering, as loud text for standard error: dropped samples by cause with the first
/// of them (pixel, sample, seed), violated density bounds, boundaries that contradict each other. Empty when
/// all was well.
std::string describeFaults(const RenderResult& result, const Options& options);

/// What was wrong with the densities of media, a warning each. Empty when nothing was.
std::string describeComplaints(const Scene& scene);

}  // namespace pbrtmedia
