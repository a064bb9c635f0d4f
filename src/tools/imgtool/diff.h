// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>

#include "image/flip.h"
#include "image/metrics.h"
#include "tools/imgtool/common.h"

namespace pbrtmedia {

struct DiffOptions {
  std::string test, reference;
  std::string layer;              ///< "": all channels
  std::string outfile;            ///< image of absolute differences, written when the images differ
  std::string flipMap;            ///< the map of FLIP errors, always written unless empty
  std::optional<double> diffTol;  ///< percent by which the means may differ
  std::optional<double> maxMse, maxRelativeMse, maxAbs, maxFlip;
  double epsilon = kRelativeMseEpsilon;
  bool flip = false;
  double pixelsPerDegree = kFlipPixelsPerDegree;
  bool json = false;
};

/// `imgtool diff`. 0 when the images agree, else 1. With thresholds they agree when none is exceeded, without
/// when they are identical. Images that cannot be compared (size, channels, windows, NaN, infinity) never
/// agree.
int runDiff(const DiffOptions& options);

}  // namespace pbrtmedia
