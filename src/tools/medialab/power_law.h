// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "tools/medialab/session.h"

namespace pbrtmedia {

struct PowerLawOptions {
  static constexpr unsigned kMostDoublings = 26;

  LabOptions lab;
  std::vector<double> alphas{0.4, 0.6, 0.8, 0.9};  ///< in [0, 1)
  unsigned doublings = 14;
  std::uint64_t trials = 1000;
};

/// Misso et al. 2022, figure 3: the mean relative absolute error of means of 1, 2, 4, ... uniform samples of
/// the integrand x^-alpha on (0, 1), whose integral is 1 / (1 - alpha). Means of one trial share their
/// samples.
LabTable powerLawTable(const PowerLawOptions& options, const StopSignal& stop);

/// `medialab power-law`.
int runPowerLaw(const PowerLawOptions& options);

}  // namespace pbrtmedia
