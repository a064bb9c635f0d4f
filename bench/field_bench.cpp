// SPDX-License-Identifier: BSD-2-Clause
// Look-ups, walks, transmittances and free flights on a density grid of 100 x 100 x 40 samples with sigma_t =
// 100. PBRT_MEDIA_DENSITY=<file.pbrt> measures the "float density" of a file of that shape; without it, blobs
// of smoke.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "base/files.h"
#include "base/rng.h"
#include "base/warp.h"
#include "fields/grid_field.h"
#include "media/field_kernel.h"
#include "media/field_medium.h"
#include "media/grid_medium.h"

namespace pbrtmedia {
namespace {

constexpr int kNx = 100, kNy = 100, kNz = 40;
constexpr std::uint64_t kSeed = 7;
constexpr std::size_t kRays = 1 << 14;

std::vector<float> readDensity(const std::string& path) {
  const FileBytes file = FileBytes::open(path);
  const std::string_view text = file.text();
  const std::size_t key = text.find("float density"), open = text.find('[', key);
  if (key == std::string_view::npos || open == std::string_view::npos) {
    throw std::runtime_error(path + ": no \"float density\" in it");
  }
  const std::string numbers(text.substr(open + 1, text.find(']', open) - open - 1));
  std::vector<float> values;
  const char* at = numbers.c_str();
  for (char* end = nullptr;; at = end) {
    const float value = std::strtof(at, &end);
    if (end == at) return values;
    values.push_back(value);
  }
}

/// A few soft balls around a mostly empty box, like smoke: 30 % of the samples above 0, 5 % on average.
std::vector<float> smokeBlobs() {
  Rng rng(kSeed);
  std::vector<float> values(std::size_t{kNx} * kNy * kNz);
  for (int blob = 0; blob < 40; ++blob) {
    const Vec3d centre(kNx * rng.uniform(), kNy * rng.uniform(), kNz * rng.uniform());
    const double radius = 4 + 8 * rng.uniformDouble(), peak = rng.uniformDouble();
    std::size_t i = 0;
    for (int z = 0; z < kNz; ++z) {
      for (int y = 0; y < kNy; ++y) {
        for (int x = 0; x < kNx; ++x, ++i) {
          const double r = length(Vec3d(x, y, z) - centre) / radius;
          if (r < 1) values[i] = std::max(values[i], static_cast<float>(peak * sqr(1 - r * r)));
        }
      }
    }
  }
  return values;
}

GridField::Params gridParams() {
  const char* path = std::getenv("PBRT_MEDIA_DENSITY");
  return {kNx,
          kNy,
          kNz,
          path ? readDensity(path) : smokeBlobs(),
          {.01f, .01f, .01f},
          {1.99f, 1.99f, .79f},
          GridBorder::Zero};
}

GridMediumParams mediumParams() {
  GridMediumParams params;
  params.sigmaA = Rgb(90);
  params.sigmaS = Rgb(10);
  params.grid = gridParams();
  return params;
}

std::unique_ptr<Medium> makeMedium(int power, AnyEstimator estimator = {}) {
  GridMediumParams params = mediumParams();
  params.estimator = estimator;
  GridField field(params.grid, Transform());
  FieldBounds bounds = FieldBounds::proven(field.superVoxels(power));
  return std::make_unique<FieldMedium>(
      params, "heterogeneous", std::make_unique<FieldKernel<GridField>>(std::move(field), std::move(bounds)));
}

/// Unit directions through random points of the box, from outside.
std::vector<Segment> crossingSegments() {
  Rng rng(kSeed);
  std::vector<Segment> rays(kRays);
  for (Segment& ray : rays) {
    const Point3f through(2 * rng.uniform(), 2 * rng.uniform(), .8f * rng.uniform());
    ray.d = sampleUniformSphere({rng.uniform(), rng.uniform()});
    ray.o = through - 4.0f * ray.d;
    ray.tMax = kInfinity;
  }
  return rays;
}

/// Random directions from points where free flights scatter: the shadow rays of single scattering.
std::vector<Segment> shadowSegments(const Medium& medium) {
  Rng rng(kSeed + 1);
  RenderCounters counters;
  std::vector<Segment> rays;
  while (rays.size() < kRays) {
    for (const Segment& ray : crossingSegments()) {
      const FreeFlight flight = medium.sampleFreeFlight(ray, Rgb(1.0f), rng, counters);
      if (!flight.collided) continue;
      rays.push_back({ray.at(flight.t), sampleUniformSphere({rng.uniform(), rng.uniform()}), 0, kInfinity});
    }
  }
  rays.resize(kRays);
  return rays;
}

void finish(benchmark::State& state, const RenderCounters& counters) {
  const auto perRay = [](std::uint64_t n) {
    return benchmark::Counter(static_cast<double>(n), benchmark::Counter::kAvgIterations);
  };
  state.counters["lookups"] = perRay(counters.densityLookups);
  if (counters.boundViolations > 0) state.SkipWithError("a bound does not bound");
}

void lookup(benchmark::State& state) {
  const GridField field(gridParams(), Transform());
  Rng rng(kSeed);
  std::vector<Vec3d> points(1 << 14);
  for (Vec3d& p : points) {
    p = {.5 + kNx * rng.uniformDouble(), .5 + kNy * rng.uniformDouble(), .5 + kNz * rng.uniformDouble()};
  }
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(field.density(points[i++ % points.size()]));
}
BENCHMARK(lookup);

void buildBounds(benchmark::State& state) {
  const GridField field(gridParams(), Transform());
  for (auto _ : state) {
    benchmark::DoNotOptimize(field.superVoxels(static_cast<int>(state.range(0))).maximum());
  }
}
BENCHMARK(buildBounds)->Arg(1)->Arg(2)->Arg(3)->Unit(benchmark::kMillisecond);

void walkBounds(benchmark::State& state) {
  const GridField field(gridParams(), Transform());
  const FieldBounds bounds = FieldBounds::proven(field.superVoxels(static_cast<int>(state.range(0))));
  const auto rays = crossingSegments();
  std::size_t i = 0;
  for (auto _ : state) {
    const auto line = FieldLine<GridField>::clip(field, bounds, rays[i++ % kRays]);
    double sum = 0;
    if (line) {
      line->walk([&](double a, double b, const SuperVoxel& bound) {
        sum += (b - a) * static_cast<double>(bound.upper);
        return true;
      });
    }
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(walkBounds)->DenseRange(0, 4);

/// Argument: samples per super-voxel and axis, as a power of 2; 7 puts the whole grid under one bound.
void freeFlight(benchmark::State& state) {
  const auto medium = makeMedium(static_cast<int>(state.range(0)));
  const auto rays = crossingSegments();
  Rng rng(kSeed);
  RenderCounters counters;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(medium->sampleFreeFlight(rays[i++ % kRays], Rgb(1.0f), rng, counters));
  }
  finish(state, counters);
}
BENCHMARK(freeFlight)->DenseRange(0, 4)->Arg(7);

void transmittance(benchmark::State& state, AnyEstimator estimator, bool shadow) {
  const int power = static_cast<int>(state.range(0));
  const auto medium = makeMedium(power, estimator);
  const auto rays = shadow ? shadowSegments(*medium) : crossingSegments();
  Rng rng(kSeed);
  RenderCounters counters;
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(medium->transmittance(rays[i++ % kRays], rng, counters));
  }
  finish(state, counters);

  const auto exact = makeMedium(power, RegularTracking{});
  RenderCounters unused;
  double squares = 0, sum = 0;
  constexpr std::size_t kRepeats = 16;
  for (const Segment& ray : rays) {
    const double truth = exact->transmittance(ray, rng, unused).r;
    for (std::size_t n = 0; n < kRepeats; ++n) {
      const double error = medium->transmittance(ray, rng, unused).r - truth;
      sum += error;
      squares += error * error;
    }
  }
  const double n = static_cast<double>(kRays * kRepeats);
  state.counters["variance"] = squares / n;
  if (std::abs(sum / n) > 6 * std::sqrt(squares / n / n) + 1e-6) state.SkipWithError("the mean is wrong");
}
void shadowRatio(benchmark::State& state, double threshold) {
  transmittance(state, RatioTracking{threshold}, true);
}
void crossingRatio(benchmark::State& state, double threshold) {
  transmittance(state, RatioTracking{threshold}, false);
}
BENCHMARK_CAPTURE(shadowRatio, roulette_0, 0.0)->DenseRange(0, 4)->Arg(7);
BENCHMARK_CAPTURE(shadowRatio, roulette_0_02, 0.02)->DenseRange(0, 4);
BENCHMARK_CAPTURE(shadowRatio, roulette_0_1, 0.1)->DenseRange(0, 4)->Arg(7);
BENCHMARK_CAPTURE(shadowRatio, roulette_0_3, 0.3)->DenseRange(0, 4);
BENCHMARK_CAPTURE(crossingRatio, roulette_0_1, 0.1)->DenseRange(0, 4)->Arg(7);
void shadowRegular(benchmark::State& state) { transmittance(state, RegularTracking{}, true); }
BENCHMARK(shadowRegular)->DenseRange(1, 3);

}  // namespace
}  // namespace pbrtmedia

BENCHMARK_MAIN();
