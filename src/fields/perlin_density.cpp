// SPDX-License-Identifier: BSD-2-Clause
#include "fields/perlin_density.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/diagnostics.h"
#include "base/hash.h"

namespace pbrtmedia {
namespace {

/// Rounding of sums of octaves, far above their error and far below any density that matters.
constexpr double kNoiseRounding = 1e-9;

void require(bool holds, const char* name, const char* expected, double found) {
  if (holds) return;
  std::ostringstream text;
  text << "parameter \"" << name << "\": found " << found << ", expected " << expected;
  throw SceneError(SourceLocation{}, text.str());
}

}  // namespace

PerlinDensity::PerlinDensity(const Params& params) : threshold_(params.threshold) {
  require(params.octaves >= 1 && params.octaves <= 32, "octaves", "1 to 32", params.octaves);
  require(params.lacunarity >= 1 && params.lacunarity <= 16, "lacunarity", "1 to 16", params.lacunarity);
  require(params.gain > 0 && params.gain <= 1, "gain", "above 0, at most 1", params.gain);
  require(params.frequency > 0 && params.frequency < 1e9, "frequency", "a number above 0", params.frequency);
  require(threshold_ >= 0 && threshold_ < 1, "threshold", "at least 0, below 1", threshold_);
  double sum = 0, weight = 1, frequency = params.frequency;
  for (int i = 0; i < params.octaves; ++i, weight *= params.gain, frequency *= params.lacunarity) {
    const std::uint64_t key = hashCombine(params.seed, static_cast<std::uint64_t>(i));
    octaves_.push_back({GradientNoise(static_cast<std::uint32_t>(key)), frequency, weight, 0});
    sum += weight;
  }
  double rest = 0;
  for (auto octave = octaves_.rbegin(); octave != octaves_.rend(); ++octave) {
    octave->weight /= sum;
    octave->rest = rest += octave->weight * GradientNoise::kLimit;
  }
  zeroBelow_ = 2 * threshold_ - 1;
  oneAbove_ = 1;
}

float PerlinDensity::at(Vec3d p) const {
  double n = 0;
  for (const Octave& octave : octaves_) {
    if (n + octave.rest < zeroBelow_) return 0;
    if (n - octave.rest > oneAbove_) return 1;
    n += octave.weight * octave.noise.at(p * octave.frequency);
  }
  return static_cast<float>(std::clamp(densityOf(n), 0.0, 1.0));
}

std::optional<Interval> PerlinDensity::range(const Bounds3d& box) const {
  Interval n;
  for (const Octave& octave : octaves_) {
    const Interval own = octave.noise.range({box.min * octave.frequency, box.max * octave.frequency});
    n = n + own * octave.weight;
  }
  return clamped({densityOf(n.lo - kNoiseRounding), densityOf(n.hi + kNoiseRounding)}, 0, 1);
}

std::string PerlinDensity::describe() const {
  std::ostringstream text;
  text << "Perlin noise, " << octaves_.size() << " octaves from frequency " << octaves_.front().frequency
       << ", threshold " << threshold_;
  return text.str();
}

}  // namespace pbrtmedia
