// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "fields/density_function.h"
#include "fields/gradient_noise.h"

namespace pbrtmedia {

/// Fractal noise as a density in [0, 1]: with n = sum_i gain^i noise(frequency lacunarity^i p) / sum_i
/// gain^i,
///   density = clamp(((1 + n) / 2 - threshold) / (1 - threshold), 0, 1).
/// Each octave has a seed of its own, so that no two share their zeros. Octaves that cannot lift the density
/// above 0 or below 1 any more are left out, which changes no value.
class PerlinDensity final : public DensityFunction {
 public:
  struct Params {
    int octaves = 6;        ///< 1 to 32
    double lacunarity = 2;  ///< frequency of an octave over that of the one before, in [1, 16]
    double gain = 0.5;      ///< weight of an octave over that of the one before, in (0, 1]
    double frequency = 1;   ///< lattice cells of the first octave per unit of medium space, > 0
    std::uint32_t seed = 0;
    double threshold = 0.5;  ///< densities below this share of the full range are 0, in [0, 1)
  };

  /// Throws SceneError (location unknown) that names a parameter out of range.
  explicit PerlinDensity(const Params& params);

  float at(Vec3d p) const override;
  std::optional<Interval> range(const Bounds3d& box) const override;
  std::string describe() const override;

 private:
  struct Octave {
    GradientNoise noise;
    double frequency;
    double weight;  ///< of the normalised sum
    double rest;    ///< the most that it and the finer ones can add or take
  };
  double densityOf(double n) const { return ((1 + n) / 2 - threshold_) / (1 - threshold_); }

  std::vector<Octave> octaves_;              ///< coarsest first
  double threshold_, zeroBelow_, oneAbove_;  ///< n where the density leaves 0, reaches 1
};

}  // namespace pbrtmedia
