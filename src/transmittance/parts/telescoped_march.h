// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "base/parameters.h"
#include "fields/density_line.h"
#include "transmittance/estimate.h"
#include "transmittance/parts/comb.h"
#include "transmittance/parts/nested_march.h"
#include "transmittance/parts/telescoping_levels.h"
#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// Debiasing of any function g of an integral by telescoping over ever finer marches, g(F) = I(k) + sum_{j >=
/// k} Delta_j, where I(j) is the mean of g over marches of level j and
///   Delta_j = g(F) - (g(F_1) + g(F_2)) / 2,  F = (F_1 + F_2) / 2,
/// F_1 and F_2 the marches of level j that one march of level j + 1 splits into (NestedMarch). Misso et al.
/// 2022, doi:10.1145/3528223.3530160, Eqs. (12), (22). Both forms are functions of the density integral
/// alone: what they call `add(column, factor)` with is to be summed as factor g(column).
///
/// Bias: none where all I(j) exist (TelescopingLevels on its end; mostLookups).
struct TelescopedMarch {
  std::uint64_t n = 1;                     ///< look-ups at level 0
  std::uint64_t levels = 2;                ///< k, the level of the coarse march
  double rate = TelescopingLevels::kRate;  ///< of the geometric level
  Comb comb = Comb::Equidistant;
  bool reuse = true;              ///< the coarse march is part of that of the correction
  std::uint64_t mostLookups = 0;  ///< 0: no limit but that of TelescopingLevels

  /// The parameters of these names that an estimator over such marches has, in two groups, between which
  /// there may be others.
  template <class Estimator>
  static constexpr auto marchParameters() {
    using L = TelescopingLevels;
    return std::tuple{Parameter{"n", &Estimator::n, L::kCountHelp, 1, L::kMostBaseTeeth},
                      Parameter{"levels", &Estimator::levels, L::kBaseHelp, 0, L::kMostBaseLevel},
                      Parameter{"rate", &Estimator::rate, L::kRateHelp, L::kLeastRate, L::kLargestRate},
                      Parameter{"comb", &Estimator::comb, CombSettings::kCombHelp}};
  }
  template <class Estimator>
  static constexpr auto costParameters() {
    return std::tuple{Parameter{"reuse", &Estimator::reuse,
                                "read the coarse estimate off the march of the correction, for no look-up"},
                      Parameter{"maxlookups", &Estimator::maxLookups, TelescopingLevels::kLimitHelp, 0}};
  }

  /// I(k) + Delta_j / p(j), Eq. (14). Cost: n 2^k (1 + 2 r / (2 r - 1)) look-ups on average, without the 1
  /// under reuse.
  template <DensityLine Line, class Add>
  void single(const Line& line, SampleStream& stream, LookupTally& tally, const Add& add) const {
    const std::uint64_t teeth = TelescopingLevels::baseTeeth(n, levels, mostLookups);
    const TelescopingLevels all(teeth, rate, mostLookups, reuse ? 0 : teeth);
    const unsigned level = all.draw(stream.uniformAboveZero());
    const bool corrects = level < all.count();
    if (!corrects) tally.capped = 1;
    if (!reuse || !corrects) {
      NestedMarch(comb, teeth, 0)(line, stream, tally, [&](double column) { add(column, 1); });
    }
    if (!corrects) return;

    const double weight = 1 / all.probability(level);
    // Two halves, or if they are read off these, as many parts as there are coarse marches in them.
    const NestedMarch march(comb, reuse ? teeth : teeth << level, reuse ? level + 1 : 1);
    const std::uint64_t parts = std::uint64_t{1} << (reuse ? level + 1 : 1);
    double half[2] = {0, 0};
    std::uint64_t part = 0;
    march(line, stream, tally, [&](double column) {
      if (reuse) add(column, 1 / static_cast<double>(parts));
      half[2 * part++ / parts] += column;
    });
    for (double& column : half) column *= 2 / static_cast<double>(parts);
    add((half[0] + half[1]) / 2, weight);
    for (const double column : half) add(column, -weight / 2);
  }

  /// I(k) + sum_{i=k}^{j} (A_{i+1} - A_i) / Pr{J >= i}, Eq. (15). One march of level j + 1 serves all terms:
  /// A_i is the mean of g over its parts of level i; I(k) is A_k under reuse, else a march of its own. Cost:
  /// as above; g is evaluated twice per coarse march.
  template <DensityLine Line, class Add>
  void prefix(const Line& line, SampleStream& stream, LookupTally& tally, const Add& add) const {
    const std::uint64_t teeth = TelescopingLevels::baseTeeth(n, levels, mostLookups);
    const TelescopingLevels all(teeth, rate, mostLookups, reuse ? 0 : teeth);
    const unsigned level = all.draw(stream.uniformAboveZero());
    if (level >= all.count()) tally.capped = 1;
    const unsigned top = std::min(level + 1, all.count());  // the march is of this level
    if (!reuse) {
      NestedMarch(comb, teeth, 0)(line, stream, tally, [&](double column) { add(column, 1); });
      if (top == 0) return;
    }
    // A_i enters with 1 / Pr{J >= i - 1} - 1 / Pr{J >= i}; of these the first is 1 for i = 0 under reuse and
    // else 0, and the second is missing at the top.
    std::array<double, kMostLevels> factor{};
    for (unsigned i = 0; i <= top; ++i) {
      const double finer = i > 0 ? 1 / all.reaching(i - 1) : reuse ? 1 : 0;
      factor[i] = finer - (i < top ? 1 / all.reaching(i) : 0);
      factor[i] /= static_cast<double>(std::uint64_t{1} << (top - i));  // marches of this level
    }
    // Leaves join like the carries of a binary counter: pending[i] is a march of level i that waits for its
    // other half.
    std::array<double, kMostLevels> pending;
    std::uint64_t leaves = 0;
    NestedMarch(comb, teeth, top)(line, stream, tally, [&](double column) {
      unsigned i = 0;
      for (std::uint64_t count = leaves++;; count >>= 1, ++i) {
        add(column, factor[i]);
        if ((count & 1) == 0) break;
        column = (pending[i] + column) / 2;
      }
      pending[i] = column;
    });
  }

 private:
  static constexpr std::size_t kMostLevels = 64;
};

}  // namespace pbrtmedia
