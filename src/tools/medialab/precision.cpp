// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/precision.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/parameters.h"
#include "base/rng.h"
#include "fields/canonical_function.h"
#include "tools/medialab/moments.h"

namespace pbrtmedia {
namespace {

/// One walk of ratio tracking over [offset, offset + 1] under a constant control, all of it in `Real`.
template <class Real>
struct Walk {
  Real weight = 1;
  Real position = 0;  ///< of the last collision, from the start
  std::uint64_t collisions = 0;
  bool isStuck = false;  ///< steps below the resolution of positions: it would never end
};

template <class Real>
Walk<Real> ratioWalk(const CanonicalFunction& f, double depth, double control, double offset, Rng rng) {
  Walk<Real> walk;
  const double top = f.range().max, sigma = depth / f.integral();
  const Real majorant = static_cast<Real>(sigma * top * control), begin = static_cast<Real>(offset),
             end = begin + 1;
  const std::uint64_t most = 200 + 4 * static_cast<std::uint64_t>(sigma * top * control);
  for (Real at = begin;;) {
    at += static_cast<Real>(rng.exponential()) / majorant;
    if (at >= end) return walk;
    walk.isStuck = walk.collisions >= most;
    if (walk.isStuck) return walk;
    walk.position = at - begin;
    ++walk.collisions;
    const Real extinction = static_cast<Real>(sigma * f(static_cast<double>(at - begin)));
    walk.weight *= 1 - extinction / majorant;
  }
}

void addWalks(LabTable& table, const LabOptions& o) {
  constexpr int kWalks = 300;
  const CanonicalFunction f = findCanonicalFunction("cosine").value();
  for (const double offset : {0.0, 1e3, 1e6}) {
    for (const double control : {1.0, 1e2, 1e4}) {
      Moments inFloat, inDouble;
      double worstPosition = 0;
      std::uint64_t otherCounts = 0, stuck = 0;
      for (int i = 0; i < kWalks; ++i) {
        const Rng rng(o.seed + static_cast<std::uint64_t>(i));
        const auto a = ratioWalk<float>(f, 1, control, offset, rng);
        const auto b = ratioWalk<double>(f, 1, control, offset, rng);
        stuck += a.isStuck ? 1 : 0;
        inFloat.add(static_cast<double>(a.weight));
        inDouble.add(b.weight);
        if (a.collisions == b.collisions) {
          worstPosition = std::max(worstPosition, std::abs(static_cast<double>(a.position) - b.position));
        } else {
          ++otherCounts;
        }
      }
      const double freePath = f.integral() / (f.range().max * control);
      const std::string setting =
          "depth 1, control x " + formatNumber(control) + ", offset " + formatNumber(offset);
      table.add({std::string("ratio walk: mean"), setting, std::exp(-1.0), inDouble.mean() - std::exp(-1.0),
                 inFloat.mean() - std::exp(-1.0)});
      table.add({std::string("ratio walk: largest error of the last position, free paths"), setting, 0.0, 0.0,
                 otherCounts < kWalks ? worstPosition / freePath : std::nan("")});
      table.add({std::string("ratio walk: share of walks with another number of collisions"), setting, 0.0,
                 0.0, static_cast<double>(otherCounts) / kWalks});
      table.add({std::string("ratio walk: share of walks that would never end"), setting, 0.0, 0.0,
                 static_cast<double>(stuck) / kWalks});
    }
  }
}

template <class Real>
double marchedDepth(const CanonicalFunction& f, std::uint64_t steps) {
  const Real step = Real(1) / static_cast<Real>(steps);
  Real sum = 0, at = step / 2;
  for (std::uint64_t i = 0; i < steps; ++i) {
    sum += static_cast<Real>(f(static_cast<double>(at))) * step;
    at += step;
  }
  return static_cast<double>(sum);
}

void addMarches(LabTable& table) {
  const CanonicalFunction f = findCanonicalFunction("cosine").value();
  for (const std::uint64_t steps : {100u, 10000u, 1000000u}) {
    table.add({std::string("ray march: optical depth"), std::to_string(steps) + " steps", f.integral(),
               marchedDepth<double>(f, steps) - f.integral(), marchedDepth<float>(f, steps) - f.integral()});
  }
}

/// Product of n equal factors against its closed form.
void addProducts(LabTable& table) {
  for (const std::uint64_t n : {100u, 10000u, 1000000u}) {
    const double rest = 1 / static_cast<double>(n),
                 exact = std::exp(static_cast<double>(n) * std::log1p(-rest));
    double inDouble = 1;
    float inFloat = 1;
    for (std::uint64_t i = 0; i < n; ++i) {
      inDouble *= 1 - rest;
      inFloat *= 1 - static_cast<float>(rest);
    }
    table.add({std::string("weight: product of n factors 1 - 1/n"), std::to_string(n) + " factors", exact,
               inDouble - exact, static_cast<double>(inFloat) - exact});
  }
}

void addThin(LabTable& table) {
  for (const double depth : {1e-3, 1e-6, 1e-8}) {
    const double exact = -std::expm1(-depth);
    table.add({std::string("1 - exp(-depth)"), "depth " + formatNumber(depth), exact,
               (1 - std::exp(-depth)) - exact,
               static_cast<double>(1 - std::exp(-static_cast<float>(depth))) - exact});
  }
}

}  // namespace

LabTable precisionTable(const LabOptions& o) {
  LabTable table(o.command, {"quantity", "setting", "exact", "error_double", "error_float"});
  table.note(
      "the same random numbers and order of operations in both; errors against the exact value; nan: no "
      "two walks are alike");
  addWalks(table, o);
  addMarches(table);
  addProducts(table);
  addThin(table);
  return table;
}

int runPrecision(const LabOptions& options) {
  checkOutput(options);
  writeTable(precisionTable(options), options);
  return 0;
}

}  // namespace pbrtmedia
