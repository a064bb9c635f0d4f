// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "samplers/halton.h"
#include "samplers/max_min_dist.h"
#include "samplers/random.h"
#include "samplers/sobol.h"
#include "samplers/stratified.h"
#include "samplers/zero_two.h"

namespace pbrtmedia::test {

inline const std::vector<std::string> kSamplerNames{"random", "stratified", "halton",
                                                    "sobol",  "02sequence", "maxmindist"};

/// Any sampler with root * root samples per pixel, good distribution in all dimensions that it can.
inline std::unique_ptr<Sampler> makeSampler(const std::string& name, int root = 4, std::uint64_t seed = 0) {
  const int n = root * root;
  if (name == "random") return std::make_unique<RandomSampler>(RandomSampler::Params{n, seed});
  if (name == "stratified")
    return std::make_unique<StratifiedSampler>(StratifiedSampler::Params{root, root, true, 100, seed});
  if (name == "halton") return std::make_unique<HaltonSampler>(HaltonSampler::Params{n, false, seed});
  if (name == "sobol") return std::make_unique<SobolSampler>(SobolSampler::Params{n, seed});
  if (name == "02sequence") return std::make_unique<ZeroTwoSampler>(ZeroTwoSampler::Params{n, 100, seed});
  return std::make_unique<MaxMinDistSampler>(MaxMinDistSampler::Params{n, 100, seed});
}

/// Samples first .. first + count - 1 of 2D slot number `slot` of a pixel.
inline std::vector<Point2f> slotPoints(Sampler& sampler, Point2i pixel, int slot, std::int64_t first,
                                       int count) {
  std::vector<Point2f> points;
  for (std::int64_t i = first; i < first + count; ++i) {
    sampler.start(pixel, i);
    Point2f p;
    for (int k = 0; k <= slot; ++k) p = sampler.get2D();
    points.push_back(p);
  }
  return points;
}

/// Whether each of columns x rows equal cells holds exactly one of the points.
inline bool oneInEachCell(const std::vector<Point2f>& points, int columns, int rows) {
  std::vector<int> counts(static_cast<std::size_t>(columns * rows));
  for (const Point2f p : points) {
    const int x = static_cast<int>(double{p.x} * columns), y = static_cast<int>(double{p.y} * rows);
    ++counts[static_cast<std::size_t>(y * columns + x)];
  }
  for (const int n : counts) {
    if (n != 1) return false;
  }
  return points.size() == counts.size();
}

/// Whether 2^k points form a (0, k, 2)-net in base 2: one point in each elementary interval of area 2^-k.
inline bool isNet(const std::vector<Point2f>& points) {
  const int n = static_cast<int>(points.size());
  for (int columns = 1; columns <= n; columns *= 2) {
    if (!oneInEachCell(points, columns, n / columns)) return false;
  }
  return true;
}

}  // namespace pbrtmedia::test
