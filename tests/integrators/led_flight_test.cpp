// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/path/led_flight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

PixelSample sampleOf(std::uint64_t key, std::uint64_t index, std::uint64_t count) {
  return {.key = key, .index = index, .count = count, .estimates = 0};
}

TEST(LedFlight, FirstNumbersOfAPixelFillEveryStratumOnce) {
  for (const std::uint64_t count : {1u, 8u, 64u}) {
    std::vector<int> hits(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      Rng rng(hashCombine(7, i));
      const LedFlight led(rng, sampleOf(3, i, count), 0);
      ++hits[static_cast<std::size_t>(rng.uniformDouble() * static_cast<double>(count))];
    }
    EXPECT_EQ(hits, std::vector<int>(count, 1)) << count;
  }
}

TEST(LedFlight, PixelsAndFlightsHaveOrdersOfTheirOwn) {
  const auto firstOf = [](std::uint64_t key, std::uint64_t number) {
    Rng rng(1);
    const LedFlight led(rng, sampleOf(key, 5, 16), number);
    return rng.uniform();
  };
  EXPECT_EQ(firstOf(1, 0), firstOf(1, 0));
  EXPECT_NE(firstOf(1, 0), firstOf(2, 0));
  EXPECT_NE(firstOf(1, 0), firstOf(1, 1));
}

TEST(LedFlight, MorePlannedSamplesChangeNoneOfThoseBefore) {
  for (std::uint64_t i = 0; i < 12; ++i) {
    Rng few(1), many(1);
    const LedFlight ledFew(few, sampleOf(3, i, 12), 0), ledMany(many, sampleOf(3, i, 100), 0);
    EXPECT_EQ(few.next(), many.next()) << i;
  }
}

TEST(LedFlight, CountsWhatHasDrawnAlone) {
  Rng rng(1);
  LedFlight led(rng, sampleOf(3, 5, 16), 0);
  EXPECT_FALSE(led.isTaken());
  rng.next();
  EXPECT_TRUE(led.isTaken());
}

TEST(LedFlight, WhatDrawsNothingLeavesTheStreamAsItWas) {
  Rng rng(1), same(1);
  { const LedFlight led(rng, sampleOf(3, 5, 16), 0); }
  EXPECT_EQ(rng.next(), same.next());
  {
    const LedFlight led(rng, sampleOf(3, 5, 16), 0);
    rng.next();
  }
  same.next();
  EXPECT_NE(rng.next(), same.next()) << "what was drawn from goes on from there";
}

TEST(LedFlight, NothingHappensWhereTheSampleIsNotKnown) {
  Rng rng(1), same(1);
  const LedFlight led(rng, {}, 0);
  EXPECT_EQ(rng.next(), same.next());
}

TEST(LedFlight, WhatFollowsIsUniformWhateverWasGiven) {
  // Mean, square and correlation with the number given, of the second to fourth number.
  constexpr int kRounds = 1 << 16;
  for (int which = 1; which <= 3; ++which) {
    RunningStats mean, square, together;
    for (int i = 0; i < kRounds; ++i) {
      Rng rng(hashCombine(11, i));
      const LedFlight led(rng, sampleOf(5, static_cast<std::uint64_t>(i), kRounds), 0);
      const double first = rng.uniformDouble();
      double later = 0;
      for (int k = 0; k < which; ++k) later = rng.uniformDouble();
      mean.add(later);
      square.add(later * later);
      together.add((first - 0.5) * (later - 0.5));
    }
    EXPECT_LT(std::abs(zTest(mean, 0.5).z()), kMaxAbsZ) << which << ": " << zTest(mean, 0.5);
    EXPECT_LT(std::abs(zTest(square, 1.0 / 3).z()), kMaxAbsZ) << which << ": " << zTest(square, 1.0 / 3);
    EXPECT_LT(std::abs(zTest(together, 0).z()), kMaxAbsZ) << which << ": " << zTest(together, 0);
    EXPECT_GT(std::abs(zTest(together, 0.01).z()), kMaxAbsZ) << "a correlation of 12 % is seen";
  }
}

/// Mean radiance of each of many pixels of 16 samples through fog; `known`: which sample each is.
RunningStats pixelsThroughFog(bool known) {
  SceneKit kit;
  const Medium* fog = kit.fog("fog", Rgb(0.5f), Rgb(0.5f));
  kit.builder.addPrimitive({.shape = kit.box({-5, -5, 0}, {5, 5, 1}), .media = {fog, nullptr}});
  kit.sky(1);
  const auto scene = kit.finish();
  const auto integrator = makeVolPath(*scene, {.maxDepth = 2});
  RunningStats pixels;
  constexpr std::uint64_t kSamples = 16;
  for (std::uint64_t pixel = 0; pixel < 2000; ++pixel) {
    RandomSampler sampler({.pixelSamples = 1, .seed = pixel});
    RenderCounters counters;
    double sum = 0;
    for (std::uint64_t i = 0; i < kSamples; ++i) {
      sampler.start({0, 0}, static_cast<std::int64_t>(i));
      Rng rng(hashCombine(pixel, i, known ? 1 : 2));
      SampleContext context{sampler, rng, counters};
      if (known) context.pixelSample = sampleOf(pixel, i, kSamples);
      sum += double{integrator->radiance(RayDifferential(rayOf({0.3f, 0.2f, 5}, {0, 0, -1})), context).r};
    }
    pixels.add(sum / static_cast<double>(kSamples));
  }
  return pixels;
}

TEST(LedFlight, SpreadsTheFirstCollisionsOfAPixel) {
  const RunningStats led = pixelsThroughFog(true), independent = pixelsThroughFog(false);
  EXPECT_LT(led.variance(), 0.5 * independent.variance());
  EXPECT_LT(std::abs(zTest(led, independent).z()), kMaxAbsZ) << zTest(led, independent);
  EXPECT_GT(std::abs(zTest(led, 1.02 * independent.mean()).z()), kMaxAbsZ) << "two percent are seen";
}

}  // namespace
}  // namespace pbrtmedia
