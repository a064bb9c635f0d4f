// SPDX-License-Identifier: BSD-2-Clause
// An integrator with a loop of its own, over the parts that all renders share.
#include "render/pass_loop.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "film/splat_buffer.h"
#include "support/fake_render.h"
#include "support/z_test.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// Chains that walk over the image by the Metropolis rule: pixels brighten toward the right, and nothing
/// but splats makes them. A pass is some mutations per pixel, a chain a unit of work.
class ChainIntegrator final : public Integrator {
 public:
  explicit ChainIntegrator(std::size_t chains) : Integrator(emptyScene()), chains_(chains) {}
  std::string_view typeName() const override { return "chains"; }

  RenderResult render(const Camera&, const Sampler& sampler, Film& film,
                      const RenderOptions& options) const override {
    const auto area = static_cast<std::uint64_t>(film.sampleBounds().area());
    const auto perPixel = options.samplesPerPixel.value_or(sampler.samplesPerPixel());
    PassLoop loop(scene(), options,
                  {.end = perPixel, .samplesPerIndex = area, .pixels = area, .mostPerPass = 4});
    std::vector<Chain> chains;
    for (std::size_t i = 0; i < chains_; ++i) chains.push_back(Chain{Rng(hashCombine(options.seed, i))});
    std::vector<SplatBuffer> splats;
    const auto takeSamples = [&](const Pass& pass) {
      std::vector<UnitReport> reports(chains_);
      splats.assign(chains_, {});
      const std::uint64_t mutations = area * static_cast<std::uint64_t>(pass.count) / chains_;
      parallelFor(chains_, [&](std::size_t i) {
        splats[i].begin(i);
        for (std::uint64_t m = 0; m < mutations; ++m) {
          if (loop.shouldStop()) return;
          mutate(chains[i], film, splats[i]);
          ++reports[i].samples;
        }
        loop.count(reports[i].samples);
        loop.reportProgress();
        reports[i].complete = true;
      });
      return reports;
    };
    const auto addToFilm = [&](std::span<const UnitReport> reports) {
      std::uint64_t taken = 0;
      for (const UnitReport& report : reports) taken += report.samples;
      film.addSplats(splats, {taken, static_cast<double>(area)});
    };
    return loop.run(takeSamples, addToFilm);
  }

  /// Mean over the image, as on the film: the luminance that chains are normalised by.
  static constexpr float kMean = 2;

 private:
  struct Chain {
    Rng rng;
    Point2f at{5, 5};
  };
  /// In [1, 3] from the left to the right of the sample bounds.
  static float brightness(Point2f p, const Bounds2i& b) {
    return 1 + 2 * (p.x - static_cast<float>(b.min.x)) / static_cast<float>(b.width());
  }
  static void mutate(Chain& chain, const Film& film, SplatBuffer& out) {
    const Bounds2i b = film.sampleBounds();
    const float u = chain.rng.uniform(), v = chain.rng.uniform();
    const Point2f next{static_cast<float>(b.min.x) + u * static_cast<float>(b.width()),
                       static_cast<float>(b.min.y) + v * static_cast<float>(b.height())};
    if (chain.rng.uniform() < brightness(next, b) / brightness(chain.at, b)) chain.at = next;
    out.add(chain.at, Rgb(kMean));
  }

  std::size_t chains_;
};

TEST(PassLoop, ServesAnIntegratorWithChainsToTheSameBitsForAnyThreads) {
  const ChainIntegrator integrator(12);
  const Outcome one = renderFake(integrator, {.seed = 5}, 1, 12);
  EXPECT_FALSE(one.result.interrupted);
  EXPECT_EQ(one.result.completedSamplesPerPixel, 12);
  for (const unsigned threads : {2u, 5u}) {
    EXPECT_EQ(one.image.data(), renderFake(integrator, {.seed = 5}, threads, 12).image.data()) << threads;
  }
  EXPECT_NE(one.image.data(), renderFake(integrator, {.seed = 6}, 1, 12).image.data());
}

TEST(PassLoop, AndItsImageIsWhatTheChainsWalkBy) {
  RunningStats left, right;
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    const Image image = renderFake(ChainIntegrator(4), {.seed = seed}, 2, 12).image;
    double l = 0, r = 0;
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < 10; ++x) {
        l += static_cast<double>(image.at(x, y, 0)) / (10 * image.height());
        r += static_cast<double>(image.at(image.width() - 1 - x, y, 0)) / (10 * image.height());
      }
    }
    left.add(l);
    right.add(r);
  }
  // Brightness at the middle of ten columns; samples lie within [-2, 39).
  const ZTest atLeft = zTest(left, 1 + 2 * (5 + 2) / 41.0, 1),
              atRight = zTest(right, 1 + 2 * (32 + 2) / 41.0, 1);
  EXPECT_LT(std::abs(atLeft.z()), kMaxAbsZ) << atLeft;
  EXPECT_LT(std::abs(atRight.z()), kMaxAbsZ) << atRight;
}

TEST(PassLoop, StopsChainsAsItStopsSamples) {
  const ChainIntegrator integrator(3);
  int passes = 0;
  const Outcome called =
      renderFake(integrator, {.seed = 5, .afterPass = [&](const PassEnd&) { return ++passes < 2; }}, 1, 12);
  EXPECT_TRUE(called.result.interrupted);
  EXPECT_EQ(called.result.completedSamplesPerPixel, 8) << "passes of four";
  const std::atomic<bool> stop{true};
  const Outcome never = renderFake(integrator, {.seed = 5, .stop = &stop}, 1, 12);
  EXPECT_EQ(never.result.samplesTaken, 0u);
  EXPECT_TRUE(never.result.interrupted);
  EXPECT_EQ(renderFake(integrator, {.seed = 5, .samplesPerPixel = 3}, 1, 12).result.completedSamplesPerPixel,
            3);
}

}  // namespace
}  // namespace pbrtmedia
