// SPDX-License-Identifier: BSD-2-Clause
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "base/hash.h"
#include "base/math.h"
#include "fields/canonical_function.h"

// The list behind canonicalFunctionNames(): one builder for each function.

namespace pbrtmedia {
namespace {

using Stretch = CanonicalFunction::Stretch;
using Wave = CanonicalFunction::Wave;
constexpr double kQuarterTurn = std::numbers::pi / 2;

/// The same shape with mean 1 over its domain.
CanonicalFunction withMeanOne(CanonicalFunction::About about, std::vector<Stretch> stretches) {
  const CanonicalFunction raw(about, stretches);
  const double factor = raw.width() / raw.integral();
  for (Stretch& s : stretches) {
    s.constant *= factor;
    s.slope *= factor;
    s.square *= factor;
    s.cube *= factor;
    for (auto& w : s.waves) w.amplitude *= factor;
    for (auto& b : s.bumps) b.height *= factor;
  }
  return {std::move(about), std::move(stretches)};
}

CanonicalFunction constant() {
  return {{"constant", "1", "Georgiev et al. 2019; Misso et al. 2023", 0.95}, {{.end = 1, .constant = 1}}};
}

CanonicalFunction cosine() {
  return {{"cosine", "1 + cos(20 x + 0.8)", "Georgiev et al. 2019", 0.45},
          {{.end = 1, .constant = 1, .waves = {{1, 20, 0.8}}}}};
}

CanonicalFunction gaussian() {
  return withMeanOne({"gaussian", "h exp(-(x - 0.32)^2 / (2 0.05^2)), mean 1", "Georgiev et al. 2019", 0.12},
                     {{.end = 1, .bumps = {{1, 0.32, 0.05}}}});
}

CanonicalFunction hole() {
  return withMeanOne(
      {"hole", "h (1 - exp(-(x - 0.32)^2 / (2 0.05^2))), mean 1", "Georgiev et al. 2019", 0.85},
      {{.end = 1, .constant = 1, .bumps = {{-1, 0.32, 0.05}}}});
}

CanonicalFunction linearUp() {
  return {{"linear-up", "2 x", "Georgiev et al. 2019; Misso et al. 2023", 0.45}, {{.end = 1, .slope = 2}}};
}

CanonicalFunction linearDown() {
  return {{"linear-down", "2 (1 - x)", "Georgiev et al. 2019", 0.45},
          {{.end = 1, .constant = 2, .slope = -2}}};
}

CanonicalFunction sine() {
  return {{"sine", "1 + sin(2 pi x)", "Misso et al. 2022; equidistant combs of two or more teeth are exact"},
          {{.end = 1, .constant = 1, .waves = {{1, kTwoPi, -kQuarterTurn}}}}};
}

CanonicalFunction gaussianM22() {
  return withMeanOne({"gaussian-m22", "h exp(-(x - 0.4)^2 / (2 0.1^2)), mean 1", "Misso et al. 2022"},
                     {{.end = 1, .bumps = {{1, 0.4, 0.1}}}});
}

CanonicalFunction gaussianM23() {
  return {{"gaussian-m23", "2.0627 exp(-(x - 0.63)^2 / (2 0.2^2))", "Misso et al. 2023"},
          {{.end = 1, .bumps = {{2.0627, 0.63, 0.2}}}}};
}

/// Sines of the composite function: (A/2)(1 + sin(2 pi x / period + phase)).
struct Sine {
  double period, phase, amplitude;
};
constexpr std::array<Sine, 10> kCompositeSines{{{.459536, 3.835247, .373294},
                                                {.366002, 1.978004, .421999},
                                                {.495886, 1.230734, .306225},
                                                {.334674, 3.250040, .052114},
                                                {.179380, 1.203935, .205598},
                                                {.472080, 2.554358, .129045},
                                                {.211228, 3.173115, .041064},
                                                {.094325, 2.238707, .233507},
                                                {.458915, 1.589567, .121171},
                                                {.052476, 1.855387, .169688}}};

void addSine(Stretch& s, const Sine& sine, double amplitude) {
  s.constant += amplitude / 2;
  s.waves.push_back({amplitude / 2, kTwoPi / sine.period, sine.phase - kQuarterTurn});
}

CanonicalFunction compositeSine() {
  Stretch s{.end = 1};
  for (const Sine& sine : kCompositeSines) addSine(s, sine, sine.amplitude);
  return {{"composite-sine", "sum of ten sines (A/2)(1 + sin(2 pi x / P + phase))", "Misso et al. 2023"},
          {s}};
}

/// The generator that the code published with Misso et al. 2022 draws its noise from: PCG-XSH-RR 64/32
/// (O'Neill 2014), state 0x12312, stream 0xadcd, 32 bits to a number.
class NoiseNumbers {
 public:
  /// Uniform in [low, high).
  double uniform(double low, double high) { return low + (high - low) * (next() * 0x1p-32); }

 private:
  static constexpr std::uint64_t kFactor = 6364136223846793005u, kIncrement = 2 * 0xadcd + 1;
  std::uint32_t next() {
    const std::uint64_t old = state_;
    state_ = old * kFactor + kIncrement;
    return std::rotr(static_cast<std::uint32_t>((old >> 18 ^ old) >> 27), static_cast<int>(old >> 59));
  }
  std::uint64_t state_ = (kIncrement + 0x12312) * kFactor + kIncrement;
};

/// Of which the first ten sines are those of composite-sine, to six digits.
CanonicalFunction noise30() {
  NoiseNumbers numbers;
  Stretch s{.end = 1};
  for (int i = 0; i < 30; ++i) {
    const double period = numbers.uniform(0.01, 0.5), phase = numbers.uniform(0, 4);
    const double amplitude = numbers.uniform(0.1, 2);
    addSine(s, {period, phase, amplitude}, amplitude);
  }
  return withMeanOne(
      {"noise-30", "sum of thirty random sines (A/2)(1 + sin(2 pi x / P + phase)), mean 1",
       "Misso et al. 2022, the noise of its reciprocals; composite-sine is that of its other maps"},
      {s});
}

/// ((cos(3 z / 2) + 1) / 2)^5 (sin(z / 2) + 2) / 3 as a sum of waves: with t = 3 z / 2 the power is cos^10(t
/// / 2) = 2^-10 (C(10, 5) + 2 sum_k C(10, 5 - k) cos(k t)).
CanonicalFunction szirmayKalos() {
  constexpr std::array kBinomials{252., 210., 120., 45., 10., 1.};
  Stretch s{.end = 20};
  for (std::size_t k = 0; k < kBinomials.size(); ++k) {
    const double weight = kBinomials[k] * (k > 0 ? 2 : 1) / 1024, frequency = 1.5 * static_cast<double>(k);
    if (k == 0) {
      s.constant = weight * 2 / 3;
      s.waves.push_back({weight / 3, 0.5, -kQuarterTurn});
      continue;
    }
    s.waves.push_back({weight * 2 / 3, frequency, 0});
    // cos(k t) sin(z / 2) = (sin((1.5 k + 0.5) z) - sin((1.5 k - 0.5) z)) / 2
    s.waves.push_back({weight / 6, frequency + 0.5, -kQuarterTurn});
    s.waves.push_back({weight / 6, frequency - 0.5, kQuarterTurn});
  }
  return {{"szirmay-kalos", "((cos(3 z / 2) + 1) / 2)^5 (sin(z / 2) + 2) / 3 on [0, 20]",
           "Szirmay-Kalos et al. 2017 (21), the central ray; its depth is 3.415684"},
          {s}};
}

CanonicalFunction stepSine() {
  constexpr std::array<double, 5> kAmplitudes{.061865, .069937, .050750, .008637, .034073};
  Stretch thin{.end = 1, .constant = 0.1}, thick{.end = 5, .constant = 3};
  for (std::size_t i = 0; i < kAmplitudes.size(); ++i) {
    addSine(thin, kCompositeSines[i], kAmplitudes[i]);
    addSine(thick, kCompositeSines[i], kAmplitudes[i]);
  }
  return {{"step-sine", "sum of five sines + (x < 1 ? 0.1 : 3) on [0, 5]", "Misso et al. 2023"},
          {thin, thick}};
}

CanonicalFunction step() {
  return {{"step", "x < 0.6 ? 0.2 : 2.2", "ours: one jump"},
          {{.end = 0.6, .constant = 0.2}, {.end = 1, .constant = 2.2}}};
}

CanonicalFunction spike() {
  return {
      {"spike", "1/2, and 128.5 in [0.6, 0.6 + 1/256)", "ours: half of the depth in 1/256 of the length"},
      {{.end = 0.6, .constant = 0.5}, {.end = 0.6 + 0x1p-8, .constant = 128.5}, {.end = 1, .constant = 0.5}}};
}

/// F(x) = sum over k < 8 of 2^(-k/2) cos(2 pi 2^k 1.37 x + 0.7 k^2), times a factor.
void addFractal(Stretch& s, double factor) {
  for (int k = 0; k < 8; ++k) {
    s.waves.push_back({factor * std::exp2(-0.5 * k), kTwoPi * 1.37 * std::exp2(k), 0.7 * k * k});
  }
}

CanonicalFunction fractalA() {
  Stretch s{.end = 1, .constant = 2.2};
  addFractal(s, 1);
  return withMeanOne({"fractal-a", "max(0, 2.2 + F(x)), mean 1; F: eight octaves, amplitudes 2^(-k/2)",
                      "stands for the fractal density of Kettunen et al. 2021, figures 12 and 13"},
                     {s});
}

CanonicalFunction fractalB() {
  Stretch s{.end = 1, .constant = 0.8, .slope = 6};
  addFractal(s, 0.3);
  return withMeanOne({"fractal-b", "max(0, 0.8 + 6 x + 0.3 F(x)), mean 1; F as in fractal-a",
                      "stands for the density of unequal ends of Kettunen et al. 2021, figure 13"},
                     {s});
}

CanonicalFunction piecewiseRandom() {
  constexpr int kCells = 32;
  std::vector<Stretch> cells;
  for (int i = 0; i < kCells; ++i) {
    const double u = static_cast<double>(mix64(static_cast<std::uint64_t>(i) + 1) >> 11) * 0x1p-53;
    cells.push_back({.end = (i + 1) / static_cast<double>(kCells), .constant = u < 0.25 ? 0 : -std::log(u)});
  }
  return withMeanOne({"piecewise-random", "32 constant cells, hashed: 0 or exponentially distributed, mean 1",
                      "ours: many jumps, empty cells"},
                     std::move(cells));
}

/// max(0, 2.2 + sum over k < 8 of 2^(-k H) cos(2 pi 2^k 1.37 t + 0.7 k^2 + 3 u)), H from 2 at u = 0 to 0.2 at
/// u = 1.
CanonicalFunction slab(double u) {
  const double roughness = 2 + (0.2 - 2) * u;
  Stretch s{.end = 1, .constant = 2.2};
  for (int k = 0; k < 8; ++k) {
    s.waves.push_back({std::exp2(-roughness * k), kTwoPi * 1.37 * std::exp2(k), 0.7 * k * k + 3 * u});
  }
  return withMeanOne({"slab", "max(0, 2.2 + eight octaves of cosines, amplitudes 2^(-k H)), mean 1",
                      "stands for the slab of Kettunen et al. 2021, figures 14 and 15"},
                     {s});
}

struct Family {
  std::string_view name;
  CanonicalFunction (*build)(double u);
};
constexpr std::array kFamilies{Family{"slab", slab}};

struct Entry {
  std::string_view name;
  CanonicalFunction (*build)();
};
constexpr std::array kFunctions{Entry{"constant", constant},
                                Entry{"cosine", cosine},
                                Entry{"gaussian", gaussian},
                                Entry{"hole", hole},
                                Entry{"linear-up", linearUp},
                                Entry{"linear-down", linearDown},
                                Entry{"sine", sine},
                                Entry{"gaussian-m22", gaussianM22},
                                Entry{"gaussian-m23", gaussianM23},
                                Entry{"composite-sine", compositeSine},
                                Entry{"step-sine", stepSine},
                                Entry{"step", step},
                                Entry{"spike", spike},
                                Entry{"fractal-a", fractalA},
                                Entry{"fractal-b", fractalB},
                                Entry{"piecewise-random", piecewiseRandom},
                                Entry{"noise-30", noise30},
                                Entry{"szirmay-kalos", szirmayKalos}};

}  // namespace

std::vector<std::string_view> canonicalFunctionNames() {
  std::vector<std::string_view> names;
  for (const Entry& entry : kFunctions) names.push_back(entry.name);
  return names;
}

std::vector<std::string_view> densityFamilyNames() {
  std::vector<std::string_view> names;
  for (const Family& family : kFamilies) names.push_back(family.name);
  return names;
}

std::optional<CanonicalFunction> findDensityFamily(std::string_view name, double u) {
  for (const Family& family : kFamilies) {
    if (family.name == name) return family.build(u);
  }
  return std::nullopt;
}

std::optional<CanonicalFunction> findCanonicalFunction(std::string_view name) {
  for (const Entry& entry : kFunctions) {
    if (entry.name == name) return entry.build();
  }
  return std::nullopt;
}

}  // namespace pbrtmedia
