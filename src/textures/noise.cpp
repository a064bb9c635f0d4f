// SPDX-License-Identifier: BSD-2-Clause
#include "textures/noise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/math.h"

namespace pbrtmedia {

namespace {

// clang-format off
constexpr std::array<std::uint8_t, 256> kPermutation{
    151, 160, 137, 91, 90, 15, 131, 13, 201, 95, 96, 53, 194, 233, 7, 225, 140, 36, 103, 30,
    69, 142, 8, 99, 37, 240, 21, 10, 23, 190, 6, 148, 247, 120, 234, 75, 0, 26, 197, 62,
    94, 252, 219, 203, 117, 35, 11, 32, 57, 177, 33, 88, 237, 149, 56, 87, 174, 20, 125, 136,
    171, 168, 68, 175, 74, 165, 71, 134, 139, 48, 27, 166, 77, 146, 158, 231, 83, 111, 229, 122,
    60, 211, 133, 230, 220, 105, 92, 41, 55, 46, 245, 40, 244, 102, 143, 54, 65, 25, 63, 161,
    1, 216, 80, 73, 209, 76, 132, 187, 208, 89, 18, 169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3, 64, 52, 217, 226, 250, 124, 123, 5, 202, 38, 147, 118, 126,
    255, 82, 85, 212, 207, 206, 59, 227, 47, 16, 58, 17, 182, 189, 28, 42, 223, 183, 170, 213,
    119, 248, 152, 2, 44, 154, 163, 70, 221, 153, 101, 155, 167, 43, 172, 9, 129, 22, 39, 253,
    19, 98, 108, 110, 79, 113, 224, 232, 178, 185, 112, 104, 218, 246, 97, 228, 251, 34, 242, 193,
    238, 210, 144, 12, 191, 179, 162, 241, 81, 51, 145, 235, 249, 14, 239, 107, 49, 192, 214, 31,
    181, 199, 106, 157, 184, 84, 204, 176, 115, 121, 50, 45, 127, 4, 150, 254, 138, 236, 205, 93,
    222, 114, 67, 29, 24, 72, 243, 141, 128, 195, 78, 66, 215, 61, 156, 180};
// clang-format on

std::uint8_t permute(unsigned i) { return kPermutation[i & 255u]; }

/// A coordinate as lattice cell (mod 256) and offset in [0, 1].
struct Cell {
  unsigned index;
  float offset;
  explicit Cell(float x) {
    const float whole = std::floor(x);
    index = static_cast<unsigned>(whole - 256 * std::floor(whole / 256));  // exact: a power of two
    offset = x - whole;
  }
};

/// The gradient of a lattice point times the offset from it.
float gradientTerm(unsigned x, unsigned y, unsigned z, float dx, float dy, float dz) {
  const unsigned h = permute(permute(permute(x) + y) + z) & 15u;
  const bool isSpecial = h == 12 || h == 13;
  const float u = h < 8 || isSpecial ? dx : dy;
  const float v = h < 4 || isSpecial ? dy : dz;
  return ((h & 1u) != 0 ? -u : u) + ((h & 2u) != 0 ? -v : v);
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

float smoothStep(float lo, float hi, float x) {
  const float t = std::clamp((x - lo) / (hi - lo), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

/// Ratio of the frequencies of neighbouring octaves: not 2, so that lattices do not fall together.
constexpr float kLacunarity = 1.99f;

/// How many octaves have periods of at least two footprints; fractional.
float visibleOctaves(Vector3f dpdx, Vector3f dpdy, int octaves) {
  const float footprint2 = std::max(lengthSquared(dpdx), lengthSquared(dpdy));
  const float most = static_cast<float>(std::max(octaves, 0));
  if (!(footprint2 > 0)) return most;
  return std::clamp(-1 - 0.5f * std::log2(footprint2), 0.0f, most);
}

}  // namespace

float noise(Point3f p) {
  // Larger numbers are all integers, where noise is 0; this also answers infinities and NaN.
  constexpr float kLargest = 0x1p24f;
  if (!(std::abs(p.x) < kLargest && std::abs(p.y) < kLargest && std::abs(p.z) < kLargest)) return 0;
  const Cell x(p.x), y(p.y), z(p.z);
  const float dx = x.offset, dy = y.offset, dz = z.offset;
  const auto corner = [&](unsigned i, unsigned j, unsigned k) {
    return gradientTerm(x.index + i, y.index + j, z.index + k, dx - static_cast<float>(i),
                        dy - static_cast<float>(j), dz - static_cast<float>(k));
  };
  const float wx = fade(dx), wy = fade(dy), wz = fade(dz);
  const auto alongX = [&](unsigned j, unsigned k) { return lerp(wx, corner(0, j, k), corner(1, j, k)); };
  return lerp(wz, lerp(wy, alongX(0, 0), alongX(1, 0)), lerp(wy, alongX(0, 1), alongX(1, 1)));
}

float fbm(Point3f p, Vector3f dpdx, Vector3f dpdy, const FractalParams& params) {
  const float n = visibleOctaves(dpdx, dpdy, params.octaves), whole = std::floor(n);
  float sum = 0, frequency = 1, weight = 1;
  for (int i = 0; i < static_cast<int>(whole); ++i) {
    sum += weight * noise(frequency * p);
    frequency *= kLacunarity;
    weight *= params.roughness;
  }
  const float share = smoothStep(0.3f, 0.7f, n - whole);
  return share > 0 ? sum + weight * share * noise(frequency * p) : sum;
}

float turbulence(Point3f p, Vector3f dpdx, Vector3f dpdy, const FractalParams& params) {
  constexpr float kMeanAbsNoise = 0.2f;
  const float n = visibleOctaves(dpdx, dpdy, params.octaves), whole = std::floor(n);
  float sum = 0, frequency = 1, weight = 1;
  for (int i = 0; i < static_cast<int>(whole); ++i) {
    sum += weight * std::abs(noise(frequency * p));
    frequency *= kLacunarity;
    weight *= params.roughness;
  }
  const float share = smoothStep(0.3f, 0.7f, n - whole);
  sum += weight * (share > 0 ? lerp(share, kMeanAbsNoise, std::abs(noise(frequency * p))) : kMeanAbsNoise);
  // As in PBRT-v3 the octave that was just faded out is counted again from here.
  for (int i = static_cast<int>(whole); i < params.octaves; ++i) {
    sum += kMeanAbsNoise * weight;
    weight *= params.roughness;
  }
  return sum;
}

}  // namespace pbrtmedia
