// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/problems.h"

#include <bit>
#include <cmath>
#include <stdexcept>

#include "base/hash.h"

namespace pbrtmedia {
namespace {

void require(bool holds, const char* what, double found) {
  if (holds) return;
  std::string text = what;
  text += ", found ";
  text += formatNumber(found);
  throw std::runtime_error(text);
}

double trueDepth(const ProblemOptions& options, const CanonicalFunction& function, double depth) {
  return options.isPaperDepth ? depth * function.integral() : depth;
}

}  // namespace

void ProblemOptions::check() const {
  for (const double v : depths) {
    require(v >= 0 && std::isfinite(v), "--depth: expected finite numbers, at least 0", v);
  }
  for (const double v : controls) {
    require(v > 0 && std::isfinite(v), "--control: expected finite numbers above 0", v);
  }
  for (const double v : efficiencies) {
    require(v > 0 && std::isfinite(v), "--efficiency: expected finite numbers above 0", v);
  }
  for (const double v : lowers) {
    require(v >= 0 && std::isfinite(v), "--lower: expected finite numbers, at least 0", v);
  }
  for (const double v : lowerDepths) {
    require(v >= 0 && std::isfinite(v), "--lower-depth: expected finite numbers, at least 0", v);
  }
  require(length >= 0 && std::isfinite(length), "--length: expected a finite number above 0", length);
  require(std::isfinite(offset), "--offset: expected a finite number", offset);
  require(superVoxels >= 1 && superVoxels <= kMostSuperVoxels,
          "--supervoxels: expected a number from 1 to 1000000", superVoxels);
}

double tightControlDepth(const ProblemOptions& options, const CanonicalFunction& function, double depth) {
  return trueDepth(options, function, depth) * function.range().max * function.width() / function.integral();
}

std::vector<ProblemChoice> problemChoices(const ProblemOptions& options, const CanonicalFunction& function) {
  std::vector<ProblemChoice> choices;
  for (const double depth : options.depths) {
    std::vector<double> controls = options.controls;
    if (!options.efficiencies.empty()) {
      controls.clear();
      // The tight control of unit depth stands for that of any depth, 0 too.
      for (const double e : options.efficiencies) {
        controls.push_back(1 / (e * tightControlDepth(options, function, 1)));
      }
    }
    for (const double control : controls) {
      for (const double lower : options.lowerDepths.empty() ? options.lowers : options.lowerDepths)
        choices.push_back({depth, control, lower});
    }
  }
  return choices;
}

LabProblem makeProblem(const ProblemOptions& options, const CanonicalFunction& function,
                       const ProblemChoice& choice) {
  CanonicalLine::Setup setup{.length = options.length > 0 ? options.length : function.width(),
                             .offset = options.offset,
                             .control = choice.control,
                             .lower = choice.lower,
                             .superVoxels = options.superVoxels,
                             .hasMeans = !options.noMeans};
  const double sigmaT =
      trueDepth(options, function, choice.depth) / CanonicalLine(function, setup).integral();
  if (!options.lowerDepths.empty()) {
    setup.lower = 0;
    setup.lowerDensity = sigmaT > 0 ? choice.lower / (sigmaT * setup.length) : 0;
  }
  return {CanonicalLine(function, setup), sigmaT};
}

std::uint64_t rowSeed(std::uint64_t seed, std::string_view estimator, std::string_view function,
                      const ProblemChoice& choice) {
  return hashCombine(seed, hashBytes(estimator), hashBytes(function),
                     std::bit_cast<std::uint64_t>(choice.depth), std::bit_cast<std::uint64_t>(choice.control),
                     std::bit_cast<std::uint64_t>(choice.lower));
}

}  // namespace pbrtmedia
