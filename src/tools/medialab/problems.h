// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tools/medialab/trials.h"

namespace pbrtmedia {

/// The lines that a command asks for.
struct ProblemOptions {
  static constexpr unsigned kMostSuperVoxels = 1000000;

  std::vector<double> depths{1};    ///< optical depths, >= 0
  std::vector<double> controls{1};  ///< upper bound / largest density, > 0
  std::vector<double>
      efficiencies{};             ///< in place of controls: depth as given / optical depth of the control
  std::vector<double> lowers{0};  ///< lower bound / smallest density, >= 0
  /// In place of lowers: optical depths of a constant lower control, also above the function.
  std::vector<double> lowerDepths{};
  unsigned superVoxels = 1;  ///< at most kMostSuperVoxels
  double length = 0;         ///< of the segment; 0: the width of the function's domain
  double offset = 0;
  /// Depths are the numbers that the papers put before their formulas, although the cosine of Georgiev et al.
  /// integrates to 1.010572 times that. Otherwise a depth is the true optical depth.
  bool isPaperDepth = false;
  bool noMeans = false;  ///< super-voxels know no mean

  /// Throws std::runtime_error for numbers out of range.
  void check() const;
};

/// One combination of a function with depth, control and lower control.
struct ProblemChoice {
  double depth;    ///< as given
  double control;  ///< upper bound / largest density
  double lower;    ///< lower bound / smallest density, or optical depth of the lower control
};
std::vector<ProblemChoice> problemChoices(const ProblemOptions& options, const CanonicalFunction& function);
LabProblem makeProblem(const ProblemOptions& options, const CanonicalFunction& function,
                       const ProblemChoice& choice);

/// Largest density over mean density, times the depth: what the tight control's optical depth is for a depth
/// as given.
double tightControlDepth(const ProblemOptions& options, const CanonicalFunction& function, double depth);

/// A seed of its own for each row, whatever other rows there are.
std::uint64_t rowSeed(std::uint64_t seed, std::string_view estimator, std::string_view function,
                      const ProblemChoice& choice);

}  // namespace pbrtmedia
