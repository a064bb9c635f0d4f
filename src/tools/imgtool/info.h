// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/imgtool/common.h"

namespace pbrtmedia {

/// Statistics of one channel over its finite values; min, max and mean are 0 when there is none.
struct ChannelStatistics {
  std::string name;
  std::int64_t nans = 0, infinities = 0;
  double min = 0, max = 0, mean = 0;
};

std::vector<ChannelStatistics> channelStatistics(const Image& image);

/// exp(mean(log(1e-6 + Y))) over pixels with a finite luminance Y, negative ones taken as 0; 0 when there is
/// none. Needs `hasRgb`.
double logAverageLuminance(const Image& image);

struct InfoOptions {
  std::vector<std::string> files;
  std::string layer;  ///< "": all channels
  bool json = false;
};

/// `imgtool info`: prints what the files hold. Returns 0.
int runInfo(const InfoOptions& options);

}  // namespace pbrtmedia
