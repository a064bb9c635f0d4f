// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

struct HeatmapOptions {
  /// outfile: what the names of all files begin with, .csv or .json behind it being the table's format;
  /// empty: the table alone
  LabOptions lab;
  EstimatorSelection selection;
  FunctionSelection function{.words = {"cosine"}, .ray = {}, .grid = {}};
  ProblemOptions problem;  ///< depths, controls and efficiencies are those of the map
  TrialPlan plan;
  int width = 64, height = 64;
  double topEfficiency = 0;       ///< 0: the function's own
  std::uint64_t lookups = 16384;  ///< per pixel and estimator
  std::uint64_t trials = 0;       ///< per pixel and estimator, in place of `lookups`
};

/// A map over transmittance and efficiency of the control. Georgiev et al. 2019, figure 7: transmittance from
/// 0.99 at the left to 0.01 at the right, depth / depth of the control from 0.01 at the bottom upwards. The
/// transmittance is that of the law of the estimators, at the depth as given (ProblemOptions::isPaperDepth).
struct Heatmap {
  enum class Measure { Variance, VarianceLookups, VarianceSeconds };
  struct Pixel {
    double exact = kUnknown, mean = kUnknown, meanError = kUnknown, variance = kUnknown, lookups = kUnknown,
           seconds = kUnknown;
    std::uint64_t trials = 0, nonFinite = 0;

    /// NaN where nothing was measured.
    double value(Measure measure) const;

   private:
    static constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  };
  struct Layer {
    std::string estimator;
    std::vector<Pixel> pixels;  ///< top row first
    bool isUnbiased = true;     ///< only these can be best: a variance says little beside a bias
  };
  static constexpr std::size_t kNoBest = static_cast<std::size_t>(-1);

  int width = 0, height = 0;
  double topEfficiency = 0;
  std::vector<Layer> layers;
  std::string law = {};  ///< of all layers, with its parameters

  double transmittance(int x) const;
  double efficiency(int y) const;  ///< y = 0: the top
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  /// The unbiased layer with the least value at a pixel; kNoBest where nothing was measured. Variances below
  /// (1e-9 T)^2 are rounding and count as equal: then fewer look-ups win. One so low beside a mean that is
  /// off has missed rare events and does not count.
  std::size_t best(std::size_t pixel, Measure measure) const;
};

/// Measures all pixels; on a stop, rows of pixels are missing.
Heatmap measureHeatmap(const HeatmapOptions& options, std::vector<LabTable::Skipped>& skipped,
                       const StopSignal& stop);

/// `medialab heatmap`.
int runHeatmap(const HeatmapOptions& options);

}  // namespace pbrtmedia
