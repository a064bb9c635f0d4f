// SPDX-License-Identifier: BSD-2-Clause
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>

// Writes plume.vdb, a volume of our own making, small unless a height in voxels (160) says other, and
// plume-scene.pbrt, a scene that shows it:
//
//   example_volume FOLDER [HEIGHT] && cd FOLDER
//   vdb2pbrt plume.vdb --sigma-a 1 1 1 --sigma-s 25 25 25 && pbrt plume-scene.pbrt

namespace {

double fractOf(double x) { return x - std::floor(x); }

/// A number in [0, 1) for a whole point; the same on every machine.
double latticeNoise(std::int64_t x, std::int64_t y, std::int64_t z) {
  auto h = static_cast<std::uint64_t>(x * 73856093 ^ y * 19349663 ^ z * 83492791);
  h = (h ^ (h >> 31)) * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 29)) * 0xbf58476d1ce4e5b9u;
  return static_cast<double>(h >> 40) * 0x1p-24;
}

/// Interpolated lattice noise in [0, 1).
double noise(double x, double y, double z) {
  const auto ix = static_cast<std::int64_t>(std::floor(x)), iy = static_cast<std::int64_t>(std::floor(y)),
             iz = static_cast<std::int64_t>(std::floor(z));
  const auto smooth = [](double t) { return t * t * (3 - 2 * t); };
  const double w[3] = {smooth(fractOf(x)), smooth(fractOf(y)), smooth(fractOf(z))};
  double sum = 0;
  for (int i = 0; i < 8; ++i) {
    const int dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
    sum += (dx != 0 ? w[0] : 1 - w[0]) * (dy != 0 ? w[1] : 1 - w[1]) * (dz != 0 ? w[2] : 1 - w[2]) *
           latticeNoise(ix + dx, iy + dy, iz + dz);
  }
  return sum;
}

/// A rising plume: a column that widens and sways, eaten at by four octaves of noise. z in [0, 1] from the
/// source up, x and y in the same unit.
double plume(double x, double y, double z) {
  const double sway = 0.1 * std::sin(5 * z), radius = 0.06 + 0.2 * z;
  const double r = std::hypot(x - sway * z, y + 0.7 * sway * z) / radius;
  if (r > 1.1 + 1.6 * 0.46875) return 0;  // the most that the octaves below come to
  double turbulence = 0, amplitude = 0.5, frequency = 9;
  for (int octave = 0; octave < 4; ++octave, amplitude /= 2, frequency *= 2.1) {
    turbulence += amplitude * (noise(frequency * x, frequency * y, frequency * z - 3) - 0.5);
  }
  const double body = 1.1 - r + 1.6 * turbulence;
  const double ends = std::min(1.0, std::min(z / 0.04, (1 - z) / 0.3));
  return std::clamp(4 * body, 0.0, 1.0) * ends;
}

/// Of `height` + 1 voxels upward, and three quarters of that to each side; most are empty.
openvdb::FloatGrid::Ptr makePlume(int height) {
  const int halfWidth = height * 3 / 8;
  openvdb::FloatGrid::Ptr grid = openvdb::FloatGrid::create(0.0f);
  grid->setName("density");
  grid->setGridClass(openvdb::GRID_FOG_VOLUME);
  auto to = grid->getAccessor();
  for (int i = -halfWidth; i <= halfWidth; ++i) {
    for (int j = -halfWidth; j <= halfWidth; ++j) {
      for (int k = 0; k <= height; ++k) {
        const double density = plume(static_cast<double>(i) / height, static_cast<double>(j) / height,
                                     static_cast<double>(k) / height);
        if (density > 0) to.setValue(openvdb::Coord(i, j, k), static_cast<float>(density));
      }
    }
  }
  openvdb::tools::pruneTiles(grid->tree());
  grid->setTransform(openvdb::math::Transform::createLinearTransform(2.0 / height));  // 2 units high
  return grid;
}

constexpr const char* kScene = R"(# Shows plume.pbrt, which vdb2pbrt makes of plume.vdb.
LookAt 0 -4.4 1.3  0 0 1  0 0 1
Camera "perspective" "float fov" 32
Film "image" "integer xresolution" 320 "integer yresolution" 400 "string filename" "plume.exr"
Sampler "random" "integer pixelsamples" 64
Integrator "volpath" "integer maxdepth" 24
WorldBegin
LightSource "infinite" "rgb L" [ .25 .32 .45 ]
LightSource "distant" "point from" [ -3 -2 4 ] "point to" [ 0 0 0 ] "rgb L" [ 3 2.7 2.2 ]
Material "matte" "rgb Kd" [ .35 .3 .25 ]
Shape "trianglemesh" "integer indices" [ 0 1 2 0 2 3 ] "point P" [ -20 -20 -.05  20 -20 -.05  20 20 -.05  -20 20 -.05 ]
# Scattering 25 and absorption 1 per unit of length at density 1, as said to vdb2pbrt.
Include "plume.pbrt"
WorldEnd
)";

int run(const std::filesystem::path& folder, int height) {
  openvdb::initialize();
  openvdb::io::File((folder / "plume.vdb").string()).write({makePlume(height)});
  std::ofstream scene(folder / "plume-scene.pbrt");
  scene << kScene;
  scene.close();
  if (!scene) throw std::runtime_error("cannot write " + (folder / "plume-scene.pbrt").string());
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  const int height = argc == 3 ? std::atoi(argv[2]) : 160;
  if (argc < 2 || argc > 3 || first.starts_with("-") || height < 1) {
    std::cerr << "usage: example_volume FOLDER [HEIGHT]\n"
                 "Writes plume.vdb, 160 or HEIGHT voxels high, and plume-scene.pbrt; then, in that folder:\n"
                 "  vdb2pbrt plume.vdb --sigma-a 1 1 1 --sigma-s 25 25 25 && pbrt plume-scene.pbrt\n";
    return first == "--help" ? 0 : 1;
  }
  try {
    return run(first, height);
  } catch (const std::exception& e) {
    std::cerr << "example_volume: error: " << e.what() << '\n';
    return 1;
  }
}
