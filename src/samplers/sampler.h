// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string_view>

#include "base/vec.h"

namespace pbrtmedia {

/// The film position, lens position and time of one camera sample.
struct CameraSample {
  Point2f film;    ///< raster position, pixels
  Point2f lens;    ///< unit square
  float time = 0;  ///< unit interval
};

/// A source of sample points in the unit hypercube. Every value is a pure function of (seed, pixel, sample
/// index, dimension): no state is carried between pixels, so the order of pixels and the number of threads do
/// not matter. `clone` for each thread; one object is not thread-safe.
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual std::string_view typeName() const = 0;
  virtual std::unique_ptr<Sampler> clone() const = 0;
  /// Samples per pixel after rounding.
  std::int64_t samplesPerPixel() const { return samplesPerPixel_; }
  std::uint64_t seed() const { return seed_; }
  /// Whether a sample is the same however many there are of its pixel: more can then be taken later.
  virtual bool isExtensible() const { return false; }

  /// Positions the stream at dimension 0 of one sample. `index` may exceed samplesPerPixel: the sequence goes
  /// on.
  virtual void start(Point2i pixel, std::int64_t index) = 0;
  /// Next one or two dimensions, in [0, 1).
  virtual float get1D() = 0;
  virtual Point2f get2D() = 0;
  /// `out.size()` two-dimensional points of the next two dimensions that are well distributed together
  /// (element i of sample s is point s*n + i of the pattern).
  virtual void get2DArray(std::span<Point2f> out) = 0;
  /// Dimensions in PBRT's order: film, time, lens.
  CameraSample cameraSample(Point2i pixel);

 protected:
  Sampler(std::int64_t samplesPerPixel, std::uint64_t seed)
      : samplesPerPixel_(samplesPerPixel), seed_(seed) {}
  Sampler(const Sampler&) = default;
  /// halton's samplepixelcenter
  bool pinsPixelCentre_ = false;

 private:
  std::int64_t samplesPerPixel_;
  std::uint64_t seed_;
};

}  // namespace pbrtmedia
