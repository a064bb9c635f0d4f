// SPDX-License-Identifier: BSD-2-Clause
// Look-ups in density grids: layouts and precisions, one by one and in batches, on combs of random rays and
// at random points. Usage: layout_bench [--json FILE] [samples per axis]...   (default 40 256 512)
//
// Every answer is checked: batches against their scalar twin bit for bit, layouts against each other, halves
// within their error. Next to the times stands a limit: the distinct cache lines a comb touches times what
// one independent random line costs on an array of that size.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "base/rng.h"
#include "base/warp.h"
#include "fields/grid_field.h"
#include "gather_loop.h"
#include "measure.h"

namespace pbrtmedia::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr std::size_t kTeeth = 32;  ///< of a comb
constexpr double kSpacing = 1.5;    ///< voxels between teeth
constexpr std::size_t kTrials = 15;
constexpr std::size_t kLookups = 1 << 19;  ///< a trial
constexpr std::size_t kLineBytes = 64;

struct Combs {
  std::vector<LocalLine> lines;
  std::vector<double> s;  ///< kTeeth each
};

/// Random lines that stay inside a grid of n^3, each with a comb of one random offset.
Combs randomCombs(int n, std::size_t count) {
  Rng rng(kSeed);
  Combs combs;
  const double spacing = std::min(kSpacing, .8 * n / kTeeth), length = kTeeth * spacing;
  while (combs.lines.size() < count) {
    const Vec3d d(sampleUniformSphere({rng.uniform(), rng.uniform()}));
    Vec3d o;
    for (std::size_t a = 0; a < 3; ++a) {
      const double room = n - std::abs(d[a]) * length;
      o[a] = .5 + room * rng.uniformDouble() - std::min(0.0, d[a] * length);
    }
    combs.lines.push_back({o, d, {1 / d.x, 1 / d.y, 1 / d.z}});
    const double u = rng.uniformDouble();
    for (std::size_t j = 0; j < kTeeth; ++j) combs.s.push_back((static_cast<double>(j) + u) * spacing);
  }
  return combs;
}

GridField makeField(int n, GridPrecision precision, GridLayout layout) {
  GridField::Params params{n, n, n, {}, {0, 0, 0}, {1, 1, 1}, GridBorder::Zero, precision, layout};
  Rng rng(kSeed);
  params.density.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) *
                        static_cast<std::size_t>(n));
  for (float& v : params.density) v = rng.uniform();
  return GridField(params, Transform());
}

/// Nanoseconds for one of many independent reads of random cache lines of an array as large as `bytes`.
double independentReadNs(std::size_t bytes) {
  const std::size_t lines = bytes / kLineBytes;
  std::vector<float, HugePageAllocator<float>> data(lines * (kLineBytes / sizeof(float)), 1.0f);
  std::vector<std::uint32_t> order(kLookups);
  Rng rng(kSeed);
  for (auto& i : order) i = rng.uniformInt(static_cast<std::uint32_t>(lines));
  Trials trials;
  for (std::size_t t = 0; t < kTrials; ++t) {
    const double start = threadSeconds();
    float sum = 0;
    for (const std::uint32_t i : order) sum += data[std::size_t{i} * (kLineBytes / sizeof(float))];
    keep(sum);
    trials.add((threadSeconds() - start) / static_cast<double>(kLookups) * 1e9);
  }
  return trials.median();
}

/// Distinct cache lines that the look-ups of a comb touch, per look-up.
double linesPerLookup(const GridField& field, const Combs& combs) {
  const SampleLayout& layout = field.samples().layout();
  const std::int64_t bytes = field.samples().view().halves ? 2 : 4;
  std::size_t total = 0;
  const std::size_t count = std::min<std::size_t>(combs.lines.size(), 1024);
  for (std::size_t ray = 0; ray < count; ++ray) {
    std::set<std::int64_t> touched;
    for (std::size_t j = 0; j < kTeeth; ++j) {
      const Vec3d p = combs.lines[ray].o + combs.s[ray * kTeeth + j] * combs.lines[ray].d;
      const std::int64_t at = layout.index(static_cast<std::int64_t>(p.x), static_cast<std::int64_t>(p.y),
                                           static_cast<std::int64_t>(p.z));
      for (int corner = 0; corner < 8; ++corner) {
        const std::int64_t sample =
            at + (corner & 1) + (corner >> 1 & 1) * layout.row() + (corner >> 2) * layout.slice();
        touched.insert(sample * bytes / static_cast<std::int64_t>(kLineBytes));
      }
    }
    total += touched.size();
  }
  return static_cast<double>(total) / static_cast<double>(count * kTeeth);
}

struct Variant {
  const char* name;
  GridField field;
  Trials scalar{}, batched{}, points{};
  std::vector<float> one{}, batch{};
};

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "error: %s\n", what.c_str());
  std::exit(EXIT_FAILURE);
}

template <class Run>
double nsPerLookup(std::size_t lookups, Run&& run) {
  const double start = threadSeconds();
  run();
  return (threadSeconds() - start) / static_cast<double>(lookups) * 1e9;
}

void measureOnce(Variant& v, const Combs& combs, const std::vector<Vec3d>& points) {
  const std::size_t rays = combs.lines.size();
  v.scalar.add(nsPerLookup(rays * kTeeth, [&] {
    for (std::size_t r = 0; r < rays; ++r) {
      const LocalLine& line = combs.lines[r];
      for (std::size_t j = r * kTeeth; j < (r + 1) * kTeeth; ++j) {
        v.one[j] = v.field.density(line.o + combs.s[j] * line.d);
      }
    }
    keep(v.one.data());
  }));
  v.batched.add(nsPerLookup(rays * kTeeth, [&] {
    for (std::size_t r = 0; r < rays; ++r) {
      v.field.densities(combs.lines[r], std::span(combs.s).subspan(r * kTeeth, kTeeth),
                        std::span(v.batch).subspan(r * kTeeth, kTeeth));
    }
    keep(v.batch.data());
  }));
  v.points.add(nsPerLookup(points.size(), [&] {
    for (const Vec3d& p : points) keep(v.field.density(p));
  }));
  if (std::memcmp(v.one.data(), v.batch.data(), v.one.size() * sizeof(float)) != 0) {
    fail(std::string(v.name) + ": a batch differs from its scalar twin");
  }
}

/// Answers of a variant against those of linear floats.
void check(const Variant& v, const Variant& linear) {
  const bool half = v.field.samples().view().halves != nullptr;
  const float allowed = half ? 0x1p-11f : 0;
  for (std::size_t i = 0; i < v.one.size(); ++i) {
    if (std::abs(v.one[i] - linear.one[i]) > allowed) fail(std::string(v.name) + ": wrong density");
  }
}

nlohmann::json measureSize(int n) {
  const Combs combs = randomCombs(n, kLookups / kTeeth);
  Rng rng(kSeed + 1);
  std::vector<Vec3d> points(kLookups / 4);
  for (Vec3d& p : points) {
    p = {.5 + n * rng.uniformDouble(), .5 + n * rng.uniformDouble(), .5 + n * rng.uniformDouble()};
  }
  std::vector<Variant> variants;
  variants.push_back({"linear", makeField(n, GridPrecision::Float, GridLayout::Linear)});
  variants.push_back({"bricked", makeField(n, GridPrecision::Float, GridLayout::Bricked)});
  variants.push_back({"half", makeField(n, GridPrecision::Half, GridLayout::Linear)});
  variants.push_back({"bricked half", makeField(n, GridPrecision::Half, GridLayout::Bricked)});
  for (Variant& v : variants) {
    v.one.resize(combs.s.size());
    v.batch.resize(combs.s.size());
  }
  const bool bare = hasGatherLoop();
  Trials gather;
  std::vector<float> gathered(combs.s.size());
  for (std::size_t trial = 0; trial < kTrials; ++trial) {
    for (Variant& v : variants) measureOnce(v, combs, points);
    if (!bare) continue;
    gather.add(nsPerLookup(combs.s.size(), [&] {
      for (std::size_t r = 0; r < combs.lines.size(); ++r) {
        gatherLoop(variants[0].field.samples().view(), combs.lines[r].o, combs.lines[r].d,
                   combs.s.data() + r * kTeeth, gathered.data() + r * kTeeth, kTeeth);
      }
      keep(gathered.data());
    }));
    if (gathered != variants[0].one) fail("the bare gather loop answers otherwise");
  }
  const Trials& base = variants[0].scalar;
  nlohmann::json rows;
  std::printf("%d^3\n%-14s %9s %8s %8s %8s %8s %8s %7s %7s\n", n, "layout", "MB", "scalar", "batched",
              "speed-up", "points", "vs lin.", "lines", "limit");
  for (const Variant& v : variants) {
    check(v, variants[0]);
    const double lines = linesPerLookup(v.field, combs), limit = lines * independentReadNs(v.field.bytes());
    std::printf("%-14s %9.1f %8.2f %8.2f %8.2f %8.2f %8.2f %7.2f %7.2f\n", v.name,
                static_cast<double>(v.field.bytes()) / 1e6, v.scalar.median(), v.batched.median(),
                medianRatio(v.scalar, v.batched), v.points.median(), medianRatio(base, v.batched), lines,
                limit);
    std::fflush(stdout);
    rows.push_back({{"layout", v.name},
                    {"bytes", v.field.bytes()},
                    {"scalarNs", v.scalar.median()},
                    {"scalarSpread", v.scalar.spread()},
                    {"batchedNs", v.batched.median()},
                    {"batchedSpread", v.batched.spread()},
                    {"pointNs", v.points.median()},
                    {"scalarOverBatched", medianRatio(v.scalar, v.batched)},
                    {"linearScalarOverScalar", medianRatio(base, v.scalar)},
                    {"linearScalarOverBatched", medianRatio(base, v.batched)},
                    {"linesPerLookup", lines},
                    {"limitNs", limit}});
  }
  if (bare) {
    std::printf("%-14s %9s %8s %8.2f %8.2f\n", "bare gathers", "", "", gather.median(),
                medianRatio(base, gather));
    rows.push_back({{"layout", "linear, bare gathers"},
                    {"batchedNs", gather.median()},
                    {"batchedSpread", gather.spread()},
                    {"linearScalarOverBatched", medianRatio(base, gather)}});
  }
  return {{"samplesPerAxis", n}, {"rows", rows}};
}

int run(int argc, char** argv) {
  const char* json = nullptr;
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    if (std::string_view(argv[i]) == "--json" && i + 1 < argc) {
      json = argv[++i];
    } else if (const int n = std::atoi(argv[i]); n >= 2 && n <= 1024) {
      sizes.push_back(n);
    } else {
      std::fprintf(stderr, "error: \"%s\": samples per axis are 2 to 1024\n", argv[i]);
      return EXIT_FAILURE;
    }
  }
  if (sizes.empty()) sizes = {40, 256, 512};
  nlohmann::json report = {{"environment", environment()}, {"teeth", kTeeth}, {"trials", kTrials}};
  std::printf("%s\nnanoseconds per look-up, medians of %zu trials\n", report["environment"].dump().c_str(),
              kTrials);
  for (const int n : sizes) report["sizes"].push_back(measureSize(n));
  if (json) writeJson(report, json);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace pbrtmedia::bench

int main(int argc, char** argv) { return pbrtmedia::bench::run(argc, argv); }
