// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "tools/medialab/problems.h"
#include "tools/medialab/selection.h"
#include "tools/medialab/session.h"

namespace pbrtmedia {

/// What the rows of a map run over.
enum class HeatmapRows {
  Efficiency,  ///< depth / depth of the control, as Georgiev et al. 2019, figure 7
  Control,     ///< upper control / largest density, as the maps of Misso et al. 2022
  Depth        ///< of the members of a family, as Kettunen et al. 2021, figures 14 and 15
};

/// The values at the centres of the first and of the last pixel of an axis.
struct HeatmapAxis {
  double first, last;

  /// Pixel i of n >= 1.
  double at(int i, int n) const { return n > 1 ? first + (last - first) * i / (n - 1) : first; }
};

struct HeatmapOptions {
  /// outfile: what the names of all files begin with, .csv or .json behind it being the table's format;
  /// empty: the table alone
  LabOptions lab;
  EstimatorSelection selection;
  FunctionSelection function{.words = {"cosine"}, .ray = {}, .grid = {}};
  ProblemOptions problem;  ///< depths, controls and efficiencies are those of the map
  TrialPlan plan;
  int width = 64, height = 64;
  HeatmapAxis answers{0.99, 0.01};  ///< transmittance or reciprocal, left and right
  HeatmapRows rows = HeatmapRows::Efficiency;
  /// Not empty: columns run over the members of this family (findDensityFamily) in place of answers, rows
  /// over depths from 0 to 9.9. The control is the first of problem.controls times the largest density of the
  /// column's member, or of all members.
  std::string family = {};
  bool isControlShared = false;
  /// Bottom and top; nothing: for efficiencies 0.01 and the function's own, for controls 1 and 2.
  std::optional<HeatmapAxis> rowRange = {};
  std::uint64_t lookups = 16384;  ///< per pixel and estimator
  std::uint64_t trials = 0;       ///< per pixel and estimator, in place of `lookups`
};

/// A map over the answer and the control. Georgiev et al. 2019, figure 7: transmittance from 0.99 at the left
/// to 0.01 at the right, depth / depth of the control from 0.01 at the bottom upwards. The answer is that of
/// the estimators' quantity and law, at the depth as given (ProblemOptions::isPaperDepth).
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
  HeatmapAxis answers{0.99, 0.01};  ///< left, right
  HeatmapRows rows = HeatmapRows::Efficiency;
  HeatmapAxis rowRange{0.01, 1};  ///< bottom, top
  std::vector<Layer> layers = {};
  Quantity quantity = Quantity::Transmittance;
  std::string law = {};     ///< of all layers, with its parameters; that of transmittance
  std::string family = {};  ///< over whose members columns run; empty: over answers

  /// The answer of a column, or where in the family its member is.
  double column(int x) const {
    return family.empty() ? answers.at(x, width) : HeatmapAxis{0, 1}.at(x, width);
  }
  double row(int y) const {
    return height > 1 ? rowRange.at(height - 1 - y, height) : rowRange.last;
  }  ///< y = 0: top
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
