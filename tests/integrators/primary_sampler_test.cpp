// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/mlt/primary_sampler.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

#include "base/hash.h"
#include "support/chi_square.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

using Stream = PrimarySampler::Stream;

std::vector<float> numbersOf(PrimarySampler& sampler, Stream stream, std::size_t count) {
  sampler.use(stream);
  std::vector<float> numbers;
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(sampler.get1D());
  return numbers;
}

TEST(PrimarySampler, StaysUniformUnderSmallSteps) {
  for (const float sigma : {0.01f, 0.3f}) {
    std::vector<double> bins(10);
    for (std::uint64_t walk = 0; walk < 20000; ++walk) {
      PrimarySampler sampler(sigma);
      sampler.proposeLarge(hashCombine(walk, 1));
      for (std::uint64_t step = 2; step < 12; ++step) sampler.proposeSmall(hashCombine(walk, step), false);
      const float x = numbersOf(sampler, Stream::Camera, 1).front();
      ASSERT_TRUE(x >= 0 && x < 1);
      ++bins[static_cast<std::size_t>(10 * x)];
    }
    EXPECT_GT(test::chiSquareUniform(bins).pValue(), test::kMinPValue) << sigma;
  }
}

TEST(PrimarySampler, MovesByTheStepsItHasMissed) {
  // A number that is asked for after n steps has moved as far as one that was asked for at each.
  constexpr int kSteps = 4;
  constexpr float kSigma = 0.01f;
  for (const bool asksEachTime : {false, true}) {
    test::RunningStats squares;
    for (std::uint64_t walk = 0; walk < 20000; ++walk) {
      PrimarySampler sampler(kSigma);
      sampler.proposeLarge(hashCombine(walk, 0));
      const float from = numbersOf(sampler, Stream::Light, 1).front();
      float to = from;
      for (std::uint64_t step = 1; step <= kSteps; ++step) {
        sampler.proposeSmall(hashCombine(walk, step), true);
        if (asksEachTime || step == kSteps) to = numbersOf(sampler, Stream::Light, 1).front();
      }
      const float moved = std::remainder(to - from, 1.0f);
      squares.add(double{moved} * double{moved});
    }
    const test::ZTest z = test::zTest(squares, kSteps * double{kSigma} * double{kSigma});
    EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << z;
  }
}

TEST(PrimarySampler, StandsWhereItStoodAfterARejection) {
  PrimarySampler sampler(0.02f);
  sampler.proposeLarge(7);
  const std::vector<float> camera = numbersOf(sampler, Stream::Camera, 5),
                           light = numbersOf(sampler, Stream::Light, 3);
  Rng rng = sampler.rngOf(Stream::Connection);
  std::vector<double> before;
  sampler.save(before);
  for (std::uint64_t i = 0; i < 4; ++i) {
    if (i % 2 == 0) {
      sampler.proposeLarge(100 + i);
    } else {
      sampler.proposeSmall(100 + i, true);
    }
    const std::vector<float> other = numbersOf(sampler, Stream::Camera, 5);
    EXPECT_NE(other, camera);
    numbersOf(sampler, Stream::Light, 3);
    sampler.reject();
    std::vector<double> after;
    sampler.save(after);
    EXPECT_EQ(after, before);
    Rng again = sampler.rngOf(Stream::Connection);
    Rng copy = rng;
    EXPECT_EQ(again.next(), copy.next());
  }
}

TEST(PrimarySampler, BeginsWithWhatIsSet) {
  PrimarySampler sampler(0.02f);
  sampler.proposeLarge(7);
  sampler.set(Stream::Light, std::vector{0.25f, 0.5f});
  const std::vector<float> numbers = numbersOf(sampler, Stream::Light, 3);
  EXPECT_EQ(numbers[0], 0.25f);
  EXPECT_EQ(numbers[1], 0.5f);
  sampler.proposeSmall(8, false);
  EXPECT_NEAR(numbersOf(sampler, Stream::Light, 1).front(), 0.25f, 0.2f);
  sampler.reject();
  sampler.proposeLarge(9);
  sampler.set(Stream::Light, std::vector{0.75f});
  sampler.reject();
  sampler.proposeSmall(10, false);
  EXPECT_NEAR(numbersOf(sampler, Stream::Light, 1).front(), 0.25f, 0.2f);
}

TEST(PrimarySampler, KeepsStreamsApart) {
  // More numbers in one do not change those of another.
  const auto light = [](std::size_t fromCamera) {
    PrimarySampler sampler(0.02f);
    sampler.proposeLarge(7);
    numbersOf(sampler, Stream::Light, 4);
    sampler.proposeSmall(8, false);
    const std::vector<float> moved = numbersOf(sampler, Stream::Light, 4);
    numbersOf(sampler, Stream::Camera, fromCamera);
    sampler.use(Stream::Light);
    return moved;
  };
  EXPECT_EQ(light(0), light(9));
  PrimarySampler sampler(0.02f);
  sampler.proposeLarge(7);
  EXPECT_NE(sampler.rngOf(Stream::Camera).next(), sampler.rngOf(Stream::Light).next());
  // A stream goes on where it was left.
  sampler.use(Stream::Camera);
  const float first = sampler.get1D();
  numbersOf(sampler, Stream::Light, 2);
  sampler.use(Stream::Camera);
  EXPECT_NE(sampler.get1D(), first);
}

TEST(PrimarySampler, KeepsOrRedrawsItsSeeds) {
  PrimarySampler sampler(0.02f);
  sampler.proposeLarge(7);
  const auto first = [&] { return sampler.rngOf(Stream::Light).next(); };
  const std::uint64_t at = first();
  sampler.proposeSmall(8, false);
  EXPECT_EQ(first(), at);
  sampler.proposeSmall(9, true);
  EXPECT_NE(first(), at);
}

TEST(PrimarySampler, GoesOnFromASavedState) {
  PrimarySampler sampler(0.02f);
  sampler.proposeLarge(7);
  numbersOf(sampler, Stream::Camera, 5);
  sampler.proposeSmall(8, true);
  numbersOf(sampler, Stream::Camera, 2);
  std::vector<double> state;
  sampler.save(state);
  PrimarySampler other(0.02f);
  std::span<const double> at = state;
  other.restore(at);
  EXPECT_TRUE(at.empty());
  sampler.proposeSmall(9, false);
  other.proposeSmall(9, false);
  EXPECT_EQ(numbersOf(other, Stream::Camera, 7), numbersOf(sampler, Stream::Camera, 7));
  for (std::size_t n = 0; n < state.size(); ++n) {
    std::span<const double> part = std::span(state).first(n);
    EXPECT_THROW(PrimarySampler(0.02f).restore(part), std::length_error) << n;
  }
}

}  // namespace
}  // namespace pbrtmedia
