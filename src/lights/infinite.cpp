// SPDX-License-Identifier: BSD-2-Clause
#include "lights/infinite.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "base/interruption.h"
#include "base/parallel.h"
#include "base/warp.h"
#include "lights/light_geometry.h"

namespace pbrtmedia {
namespace {

constexpr float kSimilarityTolerance = 1e-5f;  // of squared lengths: rounding of a float rotation, no more

/// True when the columns are orthogonal and of one length, so that solid angles keep their size.
bool isSimilarity(const Affine3f& m) {
  const float scale2 = lengthSquared(m.x), most = kSimilarityTolerance * scale2;
  return std::abs(lengthSquared(m.y) - scale2) <= most && std::abs(lengthSquared(m.z) - scale2) <= most &&
         std::abs(dot(m.x, m.y)) <= most && std::abs(dot(m.y, m.z)) <= most &&
         std::abs(dot(m.z, m.x)) <= most;
}

/// Channel mean of |factor · texel| averaged over the cell of each texel. Interpolation is bilinear between
/// texel centres and repeats, so the mean over a cell is the 3 x 3 neighbourhood weighted by
/// (1/8, 3/4, 1/8) per axis: the integral of the hat function over the texel and over half of each neighbour.
std::vector<float> cellMeans(const LightMap& map, Rgb factor) {
  const auto width = static_cast<std::size_t>(map.width()), height = static_cast<std::size_t>(map.height());
  std::vector<float> alongRow(width * height), means(width * height);
  constexpr float kCentre = 0.75f, kSide = 0.125f;
  parallelFor(height, [&](std::size_t y) {
    leaveIfStopped();
    std::vector<float> row(width);
    for (std::size_t x = 0; x < width; ++x) {
      const Rgb c = factor * map.texel(static_cast<int>(x), static_cast<int>(y));
      row[x] = (std::abs(c.r) + std::abs(c.g) + std::abs(c.b)) / 3;
    }
    for (std::size_t x = 0; x < width; ++x) {
      alongRow[y * width + x] =
          kCentre * row[x] + kSide * (row[(x + width - 1) % width] + row[(x + 1) % width]);
    }
  });
  parallelFor(height, [&](std::size_t y) {
    const float* here = &alongRow[y * width];
    const float* above = &alongRow[(y + height - 1) % height * width];
    const float* below = &alongRow[(y + 1) % height * width];
    for (std::size_t x = 0; x < width; ++x) {
      means[y * width + x] = kCentre * here[x] + kSide * (above[x] + below[x]);
    }
  });
  return means;
}

}  // namespace

InfiniteLight::InfiniteLight(const Transform& worldFromLight, const Params& params)
    : Light(params.samples),
      worldFromLight_(worldFromLight.matrix()),
      lightFromWorld_(worldFromLight.inverseMatrix()),
      inverseDeterminant_(static_cast<float>(std::abs(worldFromLight.inverseMatrix().determinant3()))),
      keepsSolidAngles_(isSimilarity(lightFromWorld_)),
      radiance_(params.radiance) {
  if (worldFromLight.isSingular()) {
    throw std::invalid_argument("infinite light: the transform has no inverse");
  }
  if (!params.map) return;
  map_.emplace(*params.map);
  const auto width = static_cast<std::size_t>(map_->width()),
             height = static_cast<std::size_t>(map_->height());
  sinSquaredHalf_.resize(height + 1);
  for (std::size_t y = 0; y <= height; ++y) {
    sinSquaredHalf_[y] =
        sqr(std::sin(std::numbers::pi / 2 * static_cast<double>(y) / static_cast<double>(height)));
  }
  std::vector<float> weights = cellMeans(*map_, radiance_);
  for (std::size_t y = 0; y < height; ++y) {
    const auto area = static_cast<float>(sinSquaredHalf_[y + 1] - sinSquaredHalf_[y]);
    for (std::size_t x = 0; x < width; ++x) weights[y * width + x] *= area;
  }
  cells_ = Distribution2D(weights, width, height);
}

void InfiniteLight::preprocess(const Bounds3f& sceneBounds) {
  sceneRadius_ = boundingSphereRadius(sceneBounds);
}

float InfiniteLight::solidAnglePdf(Point2f uv) const {
  const auto height = sinSquaredHalf_.size() - 1;
  const double rowSolidAngle =
      4 * std::numbers::pi * (sinSquaredHalf_[rowOf(uv.y) + 1] - sinSquaredHalf_[rowOf(uv.y)]);
  return static_cast<float>(cells_.pdf(uv) / (static_cast<double>(height) * rowSolidAngle));
}

std::size_t InfiniteLight::rowOf(float v) const {
  const auto height = sinSquaredHalf_.size() - 1;
  return std::min(static_cast<std::size_t>(v * static_cast<float>(height)), height - 1);
}

float InfiniteLight::jacobian(Vector3f world) const {
  if (keepsSolidAngles_) return 1;
  const float stretched = length(lightFromWorld_.vector(world));
  return inverseDeterminant_ / (stretched * stretched * stretched);
}

LightSample InfiniteLight::sample(Point3f, Point2f u) const {
  LightSample s;
  if (!map_) {
    s.wi = sampleUniformSphere(u);
    s.radiance = radiance_;
    s.pdf = pdfUniformSphere();
    return s;
  }
  const Point2f cell = cells_.sample(u).p;
  const std::size_t row = rowOf(cell.y);
  const double inRow = double{cell.y} * static_cast<double>(map_->height()) - static_cast<double>(row);
  // Uniform in solid angle inside the cell: cosθ = 1 - 2 sin²(θ/2), and the latter is a difference without
  // cancellation next to the upper pole.
  const double sin2 = lerp(inRow, sinSquaredHalf_[row], sinSquaredHalf_[row + 1]);
  const auto sinTheta = static_cast<float>(2 * safeSqrt(sin2 * (1 - sin2)));
  const float phi = 2 * kPi * cell.x;
  const Vector3f w{sinTheta * std::cos(phi), sinTheta * std::sin(phi), static_cast<float>(1 - 2 * sin2)};
  s.wi = normalize(worldFromLight_.vector(w));
  const auto v = static_cast<float>(2 * std::asin(std::sqrt(sin2)) / std::numbers::pi);
  s.radiance = radiance_ * map_->lookup({cell.x, v});
  s.pdf = solidAnglePdf(cell) * jacobian(s.wi);
  return s;
}

float InfiniteLight::pdf(Point3f, Vector3f wi, const SurfaceInteraction*) const {
  if (!map_) return pdfUniformSphere();
  return solidAnglePdf(latLong(lightFromWorld_.vector(wi))) * jacobian(wi);
}

Rgb InfiniteLight::background(Vector3f direction) const {
  if (!map_) return radiance_;
  return radiance_ * map_->lookup(latLong(lightFromWorld_.vector(direction)));
}

Rgb InfiniteLight::power() const {
  return static_cast<float>(std::numbers::pi * sqr(sceneRadius_)) * radiance_ *
         (map_ ? map_->mean() : Rgb(1));
}

}  // namespace pbrtmedia
