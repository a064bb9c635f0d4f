// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "construct/scene_identity.h"
#include "image/image.h"
#include "main/options.h"
#include "main/statistics_report.h"

namespace pbrtmedia {

/// An image with what tells where it is from: command, version, seed, samples, seconds, what stopped it
/// early, the scene's identity, and where learned bounds stand.
Image withHeader(Image image, const RenderStatistics& statistics, const Options& options,
                 const SceneIdentity& identity);

}  // namespace pbrtmedia
