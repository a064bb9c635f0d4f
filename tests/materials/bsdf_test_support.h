// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "base/math.h"
#include "base/rng.h"
#include "base/warp.h"
#include "materials/bsdf.h"
#include "support/statistics.h"

namespace pbrtmedia::test {

/// Unit direction from polar angle and azimuth in degrees, around +z.
inline Vector3f polar(float thetaDegrees, float phiDegrees) {
  const float theta = radians(thetaDegrees), phi = radians(phiDegrees);
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The surface z = 0 with its normal along +z and (u, v) = (x, y).
inline SurfaceInteraction flatSurface() {
  SurfaceInteraction si;
  si.n = si.shading.n = {0, 0, 1};
  si.dpdu = si.shading.dpdu = {1, 0, 0};
  si.dpdv = si.shading.dpdv = {0, 1, 0};
  si.wo = {0, 0, 1};
  return si;
}

/// What a scattering law looks like from one wo: local or world, lobe or BSDF.
struct ScatteringView {
  std::function<LobeSample(Point2f)> sample;  ///< non-specular
  std::function<float(Vector3f)> pdf;
  std::function<Rgb(Vector3f)> f;
  Vector3f normal{0, 0, 1};  ///< of the cosine
};

/// A lobe on a surface whose geometric normal is the shading normal: only its own side counts.
inline ScatteringView viewOf(const Lobe& lobe, Vector3f wo) {
  return {[=](Point2f u) { return lobe.sample(wo, u); }, [=](Vector3f wi) { return lobe.pdf(wo, wi); },
          [=](Vector3f wi) {
            const BsdfFlags side = isSameHemisphere(wo, wi) ? BsdfFlags::Reflection : BsdfFlags::Transmission;
            return any(lobe.flags() & side) ? lobe.f(wo, wi) : Rgb();
          },
          Vector3f{0, 0, 1}};
}

/// Without specular lobes.
inline ScatteringView viewOf(const Bsdf& bsdf, Vector3f wo) {
  return {[=](Point2f u) {
            const BsdfSample s = bsdf.sample(wo, u, BsdfFlags::AllButSpecular);
            return LobeSample{s.f, s.wi, s.pdf, s.flags};
          },
          [=](Vector3f wi) { return bsdf.pdf(wo, wi, BsdfFlags::AllButSpecular); },
          [=](Vector3f wi) { return bsdf.f(wo, wi, BsdfFlags::AllButSpecular); }, bsdf.shadingNormal()};
}

/// Counts of `sample` in 8 x 16 equal bins of the sphere around +z, and one bin for "no sample", against the
/// integral of `pdf` (4-point Gauss-Legendre on 24 x 24 cells of every bin). `pdfFactor` != 1 makes a
/// negative control.
inline ChiSquareTest directionTest(const ScatteringView& view, std::uint64_t seed, double pdfFactor = 1) {
  constexpr int kBinsZ = 8, kBinsPhi = 16, kCells = 24, kSamples = 20000;
  constexpr std::array<double, 4> kNode{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                                        0.8611363115940526};
  constexpr std::array<double, 4> kWeight{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                          0.3478548451374538};
  std::vector<double> observed(kBinsZ * kBinsPhi + 1), expected(kBinsZ * kBinsPhi + 1);
  Rng rng(seed);
  for (int i = 0; i < kSamples; ++i) {
    const float u = rng.uniform(), v = rng.uniform();
    const LobeSample s = view.sample({u, v});
    if (!(s.pdf > 0)) {
      ++observed.back();
      continue;
    }
    const double phi = std::atan2(s.wi.y, s.wi.x) / (2 * std::numbers::pi) + 0.5;
    const int z = std::clamp(static_cast<int>((double{s.wi.z} * 0.5 + 0.5) * kBinsZ), 0, kBinsZ - 1);
    const int p = std::clamp(static_cast<int>(phi * kBinsPhi), 0, kBinsPhi - 1);
    ++observed[static_cast<std::size_t>(z * kBinsPhi + p)];
  }
  const double dz = 2.0 / (kBinsZ * kCells), dphi = 2 * std::numbers::pi / (kBinsPhi * kCells);
  double total = 0;
  for (int zi = 0; zi < kBinsZ * kCells; ++zi) {
    for (int pi = 0; pi < kBinsPhi * kCells; ++pi) {
      double sum = 0;
      for (std::size_t a = 0; a < 4; ++a) {
        const double z = -1 + (zi + 0.5 + 0.5 * kNode[a]) * dz, r = std::sqrt(1 - z * z);
        for (std::size_t b = 0; b < 4; ++b) {
          const double phi = -std::numbers::pi + (pi + 0.5 + 0.5 * kNode[b]) * dphi;
          const Vector3f wi(Vec3d{r * std::cos(phi), r * std::sin(phi), z});
          sum += kWeight[a] * kWeight[b] * static_cast<double>(view.pdf(wi));
        }
      }
      const double mass = 0.25 * sum * dz * dphi * pdfFactor;
      expected[static_cast<std::size_t>(zi / kCells * kBinsPhi + pi / kCells)] += kSamples * mass;
      total += mass;
    }
  }
  expected.back() = kSamples * std::max(0.0, 1 - total);
  ChiSquareTest test = chiSquareTest(observed, expected);
  if (total > 1.001 && pdfFactor == 1) test.impossible = true;  // a density of more than one
  return test;
}

/// ∫ f |cos| dω (one channel) by sampling the law itself.
inline RunningStats albedoBySampling(const ScatteringView& view, std::size_t channel, std::uint64_t seed,
                                     int n) {
  Rng rng(seed);
  RunningStats stats;
  for (int i = 0; i < n; ++i) {
    const float u = rng.uniform(), v = rng.uniform();
    const LobeSample s = view.sample({u, v});
    stats.add(s.pdf > 0 ? static_cast<double>(s.f[channel] * absDot(s.wi, view.normal) / s.pdf) : 0.0);
  }
  return stats;
}

/// The same by uniform directions.
inline RunningStats albedoByUniform(const ScatteringView& view, std::size_t channel, std::uint64_t seed,
                                    int n) {
  Rng rng(seed);
  RunningStats stats;
  for (int i = 0; i < n; ++i) {
    const float u = rng.uniform(), v = rng.uniform();
    const Vector3f wi = sampleUniformSphere({u, v});
    stats.add(static_cast<double>(view.f(wi)[channel] * absDot(wi, view.normal)) * 4 * std::numbers::pi);
  }
  return stats;
}

}  // namespace pbrtmedia::test
