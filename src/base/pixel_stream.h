// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

#include "base/rng.h"

namespace pbrtmedia {

/// Which of the samples of a pixel random numbers serve: what sampling patterns across them need to know.
struct PixelSample {
  std::uint64_t key = 0;               ///< the same for all samples of the pixel
  std::uint64_t index = 0, count = 0;  ///< index < count; count 0: nothing is known
  std::uint64_t estimates = 0;         ///< taken so far by estimators that use a pattern
};

/// The random numbers of unbounded dimension of one sample: an Rng, and if it is known which sample of which
/// pixel it serves. What estimates and flights of the sample draw from, each by a SampleStream of its own.
/// Borrows both and is cheap to copy; not thread-safe.
class PixelStream {
 public:
  PixelStream(Rng& rng) : rng_(&rng) {}
  PixelStream(Rng& rng, PixelSample& sample) : rng_(&rng), sample_(&sample) {}

  Rng& rng() const { return *rng_; }
  /// Null: not known.
  PixelSample* sample() const { return sample_; }

  class Copy;

 private:
  Rng* rng_;
  PixelSample* sample_ = nullptr;
};

/// All that a stream is about to draw, to be drawn again.
class PixelStream::Copy {
 public:
  explicit Copy(PixelStream of) : rng_(of.rng()), isKnown_(of.sample() != nullptr) {
    if (isKnown_) sample_ = *of.sample();
  }
  PixelStream stream() { return isKnown_ ? PixelStream(rng_, sample_) : PixelStream(rng_); }

 private:
  Rng rng_;
  PixelSample sample_;
  bool isKnown_;
};

}  // namespace pbrtmedia
