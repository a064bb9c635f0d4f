// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/rng.h"
#include "samplers/sampler.h"

namespace pbrtmedia {

/// The point of the unit cube of all random numbers at which a Markov chain stands: primary sample space
/// (Kelemen, Szirmay-Kalos, Antal & Csonka 2002, doi:10.1111/1467-8659.t01-1-00703). The parts of a path draw
/// from streams of their own, so that one that gets longer does not shift the numbers of the others. What
/// draws from an Rng (media, roulette) has one dimension a stream, its seed, that is kept or drawn anew.
///
/// A step is proposed, numbers are drawn (those not asked for are moved when they are needed, by all steps
/// missed at once), and it stays unless it is rejected. All randomness of a step follows from one number.
class PrimarySampler final : public Sampler {
 public:
  enum class Stream : std::uint8_t { Camera, Light, Connection };
  static constexpr std::size_t kStreams = 3;
  /// `sigma`: standard deviation of a small step.
  explicit PrimarySampler(float sigma) : Sampler(1, 0), sigma_(sigma) {}

  /// All numbers are independent of those before.
  void proposeLarge(std::uint64_t randomness);
  /// Numbers are moved a little; seeds are kept, or drawn anew.
  void proposeSmall(std::uint64_t randomness, bool redrawsSeeds);
  /// Of a large step: what its stream begins with, instead of independent numbers.
  void set(Stream stream, std::span<const float> first);
  /// Takes the step at hand back.
  void reject();

  /// Draws from the beginning of a stream, or goes on where it was left.
  void use(Stream stream) { stream_ = static_cast<std::size_t>(stream); }
  Rng rngOf(Stream stream) const { return Rng(seeds_[static_cast<std::size_t>(stream)]); }

  std::string_view typeName() const override { return "primary"; }
  std::unique_ptr<Sampler> clone() const override;
  void start(Point2i pixel, std::int64_t index) override;
  float get1D() override;
  Point2f get2D() override;
  void get2DArray(std::span<Point2f> out) override;

  /// The whole state between steps, as numbers, and back; `at` is moved behind it. Throws std::length_error
  /// for too few numbers.
  void save(std::vector<double>& out) const;
  void restore(std::span<const double>& at);

 private:
  struct Coordinate {
    float value = 0;
    std::int64_t step = 0;  ///< up to which it was moved
  };
  struct Moved {
    std::size_t stream, index;
    Coordinate before;
  };
  void begin(std::uint64_t randomness);
  void drawSeeds();
  void move(Coordinate& x);
  /// Number `index` of a stream, which is about to change.
  Coordinate& changing(std::size_t stream, std::size_t index);

  float sigma_;
  std::int64_t step_ = 0, lastLarge_ = 0, lastLargeBefore_ = 0;
  Rng random_;
  std::array<std::uint64_t, kStreams> seeds_{}, seedsBefore_{};
  std::array<std::vector<Coordinate>, kStreams> coordinates_;
  std::array<std::size_t, kStreams> next_{};
  std::size_t stream_ = 0;
  std::vector<Moved> moved_;  ///< by the step at hand
};

}  // namespace pbrtmedia
