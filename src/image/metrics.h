// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "base/vec.h"
#include "image/image.h"

namespace pbrtmedia {

inline constexpr double kRelativeMseEpsilon = 1e-2;
/// A robust mean leaves out the worst of so many pixels: the protocol of papers on path guiding.
inline constexpr std::size_t kPixelsPerWorst = 10000;

/// Errors of one channel, or of all together. All sums are in double.
struct ErrorSummary {
  double meanTest = 0, meanReference = 0;
  double meanSigned = 0;   ///< mean of test - reference
  double mse = 0;          ///< mean of (test - reference)^2
  double rmse = 0;         ///< sqrt(mse)
  double relativeMse = 0;  ///< mean of (test - reference)^2 / (reference^2 + eps)
  /// The same without the worst pixels by this error, a mean over the channels: one of kPixelsPerWorst,
  /// rounded up.
  double relativeMseRobust = 0;
  double smape = 0;   ///< mean of |test - reference| / ((|test| + |reference|) / 2), 0 where both are 0
  double maxAbs = 0;  ///< max of |test - reference|
  Point2i maxAt;      ///< pixel of the first such maximum, from the top left of the image
};

struct ChannelError : ErrorSummary {
  std::string channel;
};

struct ImageDifference {
  std::vector<ChannelError> channels;  ///< in the order of the reference
  ErrorSummary total;                  ///< over all pixels and channels
  std::string maxChannel;              ///< channel of total.maxAbs
  std::int64_t differingPixels = 0;    ///< pixels where any channel differs
  double epsilon = kRelativeMseEpsilon;
};

/// Why two images cannot be compared; a comparison that fails is never a pass.
struct ComparisonFailure {
  std::string reason;
};

/// Compares images of one size and the same set of channel names. Another size, a missing channel, an empty
/// image, or a value that is NaN or infinite in either is a failure, naming what and where. `epsilon` > 0.
std::variant<ImageDifference, ComparisonFailure> compareImages(const Image& test, const Image& reference,
                                                               double epsilon = kRelativeMseEpsilon);

}  // namespace pbrtmedia
