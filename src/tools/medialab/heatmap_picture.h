// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "image/image.h"
#include "tools/medialab/heatmap.h"

namespace pbrtmedia {

/// The numbers as an image: for each estimator channels "<name>.variance", "<name>.variance_lookups" and,
/// with seconds, "<name>.variance_seconds", NaN where nothing was measured; and "best.variance",
/// "best.variance_lookups", the index of the best estimator in the order of the metadata "estimators", or -1.
Image heatmapChannels(const Heatmap& map, const std::string& command, bool hasSeconds);

/// The map as a picture: a panel for each estimator in one logarithmic scale with its colour bar, axes, and
/// the map of the best estimator with a legend. Black: measured as 0; white: not measured or not finite.
Image heatmapPicture(const Heatmap& map, Heatmap::Measure measure, const std::string& function);

}  // namespace pbrtmedia
