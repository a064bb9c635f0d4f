// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/power_law.h"

#include <bit>
#include <cmath>
#include <stdexcept>

#include "base/hash.h"
#include "base/parallel.h"
#include "base/parameters.h"
#include "base/rng.h"
#include "tools/medialab/fit.h"
#include "tools/medialab/moments.h"

namespace pbrtmedia {
namespace {

/// Errors of the means of 2^d samples, d = 0 .. doublings.
std::vector<Moments> errorsOf(const PowerLawOptions& o, double alpha, const StopSignal& stop) {
  constexpr std::uint64_t kChunk = 16;
  const std::size_t sizes = o.doublings + 1;
  std::vector<std::vector<Moments>> chunks(static_cast<std::size_t>((o.trials + kChunk - 1) / kChunk),
                                           std::vector<Moments>(sizes));
  const std::uint64_t seed = hashCombine(o.lab.seed, std::bit_cast<std::uint64_t>(alpha));
  parallelFor(chunks.size(), [&](std::size_t i) {
    Rng rng(hashCombine(seed, i));
    for (std::uint64_t t = i * kChunk; t < std::min(o.trials, (i + 1) * kChunk) && !stop; ++t) {
      double sum = 0;
      std::uint64_t n = 0;
      for (unsigned d = 0; d < sizes; ++d) {
        for (; n < std::uint64_t{1} << d; ++n) sum += std::pow(1 - rng.uniformDouble(), -alpha);  // of (0, 1]
        chunks[i][d].add(std::abs(sum / static_cast<double>(n) * (1 - alpha) - 1));
      }
    }
  });
  std::vector<Moments> all(sizes);
  for (const auto& chunk : chunks) {
    for (std::size_t d = 0; d < sizes; ++d) all[d].add(chunk[d]);
  }
  return all;
}

}  // namespace

LabTable powerLawTable(const PowerLawOptions& o, const StopSignal& stop) {
  LabTable table(o.lab.command, {"alpha", "samples", "trials", "error", "error_stderr", "slope",
                                 "slope_stderr", "expected_slope"});
  LabProgress progress("medialab power-law", o.alphas.size(), o.lab.quiet);
  std::size_t done = 0;
  for (const double alpha : o.alphas) {
    if (!(alpha >= 0 && alpha < 1)) {
      throw std::runtime_error("--alpha: expected numbers from 0 to below 1, whose integrals exist, found " +
                               formatNumber(alpha));
    }
    const std::vector<Moments> errors = errorsOf(o, alpha, stop);
    if (stop) {
      table.markStopped();
      return table;
    }
    std::vector<LogPoint> points;
    for (unsigned d = o.doublings / 2; d <= o.doublings; ++d) {
      points.push_back({std::exp2(d), errors[d].mean(), errors[d].meanError()});
    }
    const LogSlope slope = fitLogSlope(points);
    for (unsigned d = 0; d <= o.doublings; ++d) {
      table.add({alpha, std::uint64_t{1} << d, errors[d].count(), errors[d].mean(), errors[d].meanError(),
                 slope.slope, slope.error, std::max(alpha - 1, -0.5)});
    }
    progress.update(++done, "alpha " + formatNumber(alpha));
  }
  return table;
}

int runPowerLaw(const PowerLawOptions& options) {
  checkOutput(options.lab);
  const ThreadLimit limit(options.lab.threads);
  const StopSignal stop;
  writeTable(powerLawTable(options, stop), options.lab);
  return 0;
}

}  // namespace pbrtmedia
