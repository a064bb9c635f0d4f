// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "base/transform.h"

// Small .nvdb files made for tests by NanoVDB's own builder, so that reader and writer are of different
// hands.
namespace pbrtmedia::test {

using Ijk = std::array<int, 3>;

/// How the builder stores values.
enum class NanoVdbStorage { Float, Double, Fp4, Fp8, Fp16, FpN };
enum class NanoVdbCodec { None, Zip, Blosc };
enum class NanoVdbSums { None, Partial, Full };

struct NanoVdbSample {
  std::string name = "density";
  NanoVdbStorage storage = NanoVdbStorage::Float;
  NanoVdbSums sums = NanoVdbSums::Full;
  double background = 0;
  bool isLevelSet = false;
  /// Values are asked for in this box, both ends included; whole bricks and blocks of one value become tiles,
  /// and what equals the background is inactive.
  Ijk min{0, 0, 0}, max{0, 0, 0};
  std::function<double(Ijk)> valueAt = [](Ijk) { return 1.0; };
  /// Instead of the box where not empty: single voxels, active whatever their value.
  std::vector<std::pair<Ijk, double>> voxels{};
  Transform worldFromIndex{};
};

/// Writes the grids into one file of one segment.
void writeNanoVdb(const std::filesystem::path& file, const std::vector<NanoVdbSample>& grids,
                  NanoVdbCodec codec = NanoVdbCodec::None);
/// A file with a grid of vectors called "velocity" and one of floats called "density".
void writeNanoVdbWithVectors(const std::filesystem::path& file);
/// What NanoVDB's own reader and trilinear sampler find at points of world space. `grid`: number in the file.
std::vector<double> sampledByNanoVdb(const std::filesystem::path& file, unsigned grid,
                                     const std::vector<Vec3d>& world);
/// Whether the test program can write blosc.
bool hasBlosc();

}  // namespace pbrtmedia::test
