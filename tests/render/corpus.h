// SPDX-License-Identifier: BSD-2-Clause
#pragma once

// What PBRT-v3 renders in spite of a mistake, one small scene for each construct, with the colours it gives.
// To add one: a line in the section of its kind.
#include <array>
#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

namespace pbrtmedia::test {

/// The mean of one of 4 x 4 blocks of the image of 16 x 16 pixels; block (0, 0) is the upper left one.
struct ExpectedBlock {
  int x, y;
  std::array<double, 3> rgb;
};

struct CorpusScene {
  const char* name;
  /// Without "WorldBegin": the world under an infinite light of radiance 0.5, seen by a camera at the origin
  /// of 40 degrees that looks along +z. With it: all but film and sampler, and no light is added.
  std::string text;
  /// A part of the message: a warning, with --strict an error. "": nothing is said.
  std::string said;
  std::vector<ExpectedBlock> blocks;
  std::int64_t samples = 16;  ///< of a pixel, for each of the seeds

  friend std::ostream& operator<<(std::ostream& os, const CorpusScene& scene) { return os << scene.name; }
};

/// A sphere in the middle of the image, its inner blocks (1, 1) to (2, 2) covered, the corners free.
inline const std::string kBall = "Translate 0 0 4 Shape \"sphere\"\n";
/// What a block shows of the ball by default (Kd 0.5), and of the sky.
inline constexpr std::array<double, 3> kGrey{.25, .25, .25}, kSky{.5, .5, .5};
/// The image of `kBall` alone.
inline const std::vector<ExpectedBlock> kBallOnly{{1, 1, kGrey}, {2, 2, kGrey}, {0, 0, kSky}, {3, 3, kSky}};
/// The image of nothing but the sky.
inline const std::vector<ExpectedBlock> kSkyOnly{{1, 1, kSky}, {2, 2, kSky}, {0, 0, kSky}};

inline std::vector<CorpusScene> corpus() {
  return {
      // ---- Text and graphics state.
      {"ball", kBall, "", kBallOnly},

      // ---- Media and their boundaries.

      // ---- Lights and shapes.

      // ---- Parameters of plugins: textures, materials, meshes, maps.

  };
}

/// The scenes of ../shared/cases that PBRT-v3 rendered: each is compared with its image.
inline std::vector<const char*> renderedCases() {
  return {
      // ---- Text and graphics state.

      // ---- Media and their boundaries.
      "medium-of-instance-direct",

      // ---- Lights and shapes.

      // ---- Parameters of plugins: textures, materials, meshes, maps.

  };
}

}  // namespace pbrtmedia::test
