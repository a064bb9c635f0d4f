// SPDX-License-Identifier: BSD-2-Clause
#include "render/sampling_integrator.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "film/splat_buffer.h"
#include "filters/box.h"
#include "render/render_state.h"
#include "render/sample_taker.h"
#include "support/fake_render.h"
#include "support/running_stats.h"

namespace pbrtmedia {
namespace {

using namespace test;

bool sameBits(const Image& a, const Image& b) { return a.data() == b.data(); }

TEST(RenderLoop, GivesTheSameBitsForAnyThreadsTilesAndGrouping) {
  const FakeIntegrator integrator = noise();
  const Outcome reference = renderFake(integrator, {.seed = 3});
  EXPECT_FALSE(reference.result.interrupted);
  EXPECT_EQ(reference.result.samplesTaken, reference.result.samplesTotal);
  for (const unsigned threads : {1u, 2u, 5u}) {
    for (const int tile : {16, 5}) {
      for (const std::optional<int> grouping :
           {std::optional<int>(), std::optional<int>(1), std::optional<int>(3)}) {
        const Outcome other =
            renderFake(integrator, {.seed = 3, .tileSize = tile, .samplesPerPass = grouping}, threads);
        EXPECT_TRUE(sameBits(reference.image, other.image)) << threads << " threads, tiles of " << tile;
        EXPECT_EQ(reference.result.counters.cameraSamples, other.result.counters.cameraSamples);
      }
    }
  }
  EXPECT_FALSE(sameBits(reference.image, renderFake(integrator, {.seed = 4}).image));  // negative control
}

TEST(RenderLoop, GivesEverySampleRandomNumbersOfItsOwn) {
  const FakeIntegrator first(
      [](const RayDifferential&, SampleContext& context) { return Rgb(context.rng.uniform()); });
  RandomSampler sampler({.pixelSamples = 4, .seed = 3});
  RenderCounters counters;
  std::set<float> seen;
  std::size_t asked = 0;
  for (const std::uint64_t seed : {3u, 4u}) {
    for (const Point2i pixel : {Point2i{2, 5}, Point2i{5, 2}, Point2i{3, 5}}) {
      for (int sample = 0; sample < 4; ++sample) {
        seen.insert(renderSample(FlatCamera(), sampler, first, pixel, sample, 4, seed, counters).r);
        EXPECT_EQ(seen.size(), ++asked) << "seed " << seed << ", pixel " << pixel << ", sample " << sample;
      }
    }
  }
}

TEST(RenderLoop, SplitBySampleIndexAddsUp) {
  const FakeIntegrator integrator = noise();
  const Outcome whole = renderFake(integrator, {.seed = 3});
  const RandomSampler sampler({.pixelSamples = 7, .seed = 3});
  const FlatCamera camera;
  Film film = smallFilm();
  RenderOptions first{.seed = 3, .samplesPerPixel = 4};
  RenderOptions second{.seed = 3, .firstSample = 4};
  EXPECT_EQ(integrator.render(camera, sampler, film, first).completedSamplesPerPixel, 4);
  EXPECT_EQ(integrator.render(camera, sampler, film, second).completedSamplesPerPixel, 7);
  EXPECT_TRUE(sameBits(whole.image, film.develop()));
}

TEST(RenderLoop, StopsInTimeAndKeepsAProperlyNormalisedImage) {
  const FakeIntegrator slow([](const RayDifferential&, SampleContext&) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    return Rgb(2);
  });
  const auto start = std::chrono::steady_clock::now();
  const Outcome out = renderFake(slow, {.timeLimit = 0.3}, 2, 1 << 20);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  EXPECT_LT(seconds, 2.3);
  EXPECT_TRUE(out.result.interrupted);
  EXPECT_GT(out.result.samplesTaken, 0u);
  EXPECT_LT(out.result.samplesTaken, out.result.samplesTotal);
  int lit = 0;
  for (int y = 0; y < out.image.height(); ++y) {
    for (int x = 0; x < out.image.width(); ++x) {
      const float value = out.image.rgb(x, y).r;
      EXPECT_TRUE(value == 0 || std::abs(value - 2) < 1e-5f) << value;
      lit += value > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(lit, 0);
}

TEST(RenderLoop, StopsOnTheFlagAndOnTheCallback) {
  std::atomic<bool> stop{false};
  const FakeIntegrator integrator([&](const RayDifferential& ray, SampleContext&) {
    if (ray.o.y > 12) stop.store(true);
    return Rgb(1);
  });
  const Outcome flagged = renderFake(integrator, {.samplesPerPass = 1, .stop = &stop});
  EXPECT_TRUE(flagged.result.interrupted);
  EXPECT_LT(flagged.result.samplesTaken, flagged.result.samplesTotal / 7);
  EXPECT_EQ(flagged.result.completedSamplesPerPixel, 0);

  int passes = 0;
  const Outcome called = renderFake(noise(), {.samplesPerPass = 2, .afterPass = [&](const PassEnd& end) {
                                                EXPECT_GT(end.progress.samplesDone, 0u);
                                                return ++passes < 2;
                                              }});
  EXPECT_TRUE(called.result.interrupted);
  EXPECT_EQ(called.result.completedSamplesPerPixel, 4);
}

TEST(RenderLoop, LeavesPathsThatDoNotEndOutOfTheImage) {
  const StopSignal signal({.timeLimit = 0.05, .abandonsPaths = true});
  const FakeIntegrator integrator([&](const RayDifferential& ray, SampleContext&) {
    while (ray.o.y > 4) leaveIfAbandoned();
    return Rgb(1);
  });
  const auto start = std::chrono::steady_clock::now();
  const Outcome out = renderFake(integrator, {.stop = &signal.flag()});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  EXPECT_TRUE(out.result.interrupted);
  EXPECT_EQ(out.result.samplesAbandoned, 1u);
  EXPECT_GT(out.result.samplesTaken, 0u);
  EXPECT_EQ(out.result.pixelsSampled, out.result.samplesTaken) << "the first pass takes one of each";
  EXPECT_LT(out.result.pixelsSampled, out.result.pixelsTotal);
  for (int y = 0; y < out.image.height(); ++y) {
    for (int x = 0; x < out.image.width(); ++x) {
      const float value = out.image.rgb(x, y).r;
      EXPECT_TRUE(value == 0 || std::abs(value - 1) < 1e-5f) << value;
    }
  }
}

TEST(RenderLoop, RecordsDroppedSamplesSoThatTheyCanBeReplayed) {
  const FakeIntegrator broken([](const RayDifferential& ray, SampleContext& context) {
    const float u = context.rng.uniform();
    if (u < 0.01f) return Rgb(std::numeric_limits<float>::quiet_NaN());
    if (u < 0.02f) return Rgb(std::numeric_limits<float>::infinity());
    return Rgb(ray.o.x < 5 && u > 0.9f ? -1.0f : 1.0f);
  });
  const Outcome a = renderFake(broken, {.seed = 3, .maxRecords = 20});
  ASSERT_EQ(a.result.dropped.size(), 20u);
  EXPECT_GT(a.result.counters.droppedTotal(), 20u);
  for (const float v : a.image.data())
    ASSERT_TRUE(v >= 0 && v <= 1.0001f) << v << ": what is dropped is black";
  for (const auto& [threads, tile, group] : {std::tuple{2u, 5, 1}, std::tuple{5u, 16, 3}}) {
    const Outcome b =
        renderFake(broken, {.seed = 3, .tileSize = tile, .samplesPerPass = group, .maxRecords = 20}, threads);
    EXPECT_EQ(a.result.dropped, b.result.dropped);
    EXPECT_EQ(a.result.counters.dropped, b.result.counters.dropped);
  }
  RandomSampler sampler({.pixelSamples = 7, .seed = 3});
  for (const DroppedSample& d : a.result.dropped) {
    RenderCounters counters;
    const Rgb again = renderSample(FlatCamera(), sampler, broken, d.pixel, d.sample, 7, 3, counters);
    switch (d.cause) {
      case DropCause::NotANumber:
        EXPECT_TRUE(std::isnan(again.r));
        break;
      case DropCause::Infinite:
        EXPECT_TRUE(std::isinf(again.r));
        break;
      default:
        EXPECT_LT(again.r, 0);
    }
  }
  for (int y = 0; y < a.image.height(); ++y) {
    for (int x = 0; x < a.image.width(); ++x) EXPECT_TRUE(a.image.rgb(x, y).isFinite());
  }
}

TEST(RenderLoop, RecordsMismatchesWithTheirPixel) {
  const FakeIntegrator integrator([](const RayDifferential& ray, SampleContext& context) {
    if (ray.o.x > 10 && ray.o.x < 11 && ray.o.y > 10 && ray.o.y < 11) {
      ++context.counters.mediumMismatches;
      if (context.mismatches->entries.size() < context.mismatches->capacity) {
        context.mismatches->entries.push_back(
            {context.mismatches->pixel, context.mismatches->sample, {}, "vacuum", "\"fog\""});
      }
    }
    return Rgb(1);
  });
  const Outcome out = renderFake(integrator, {.maxRecords = 3}, 2);
  ASSERT_EQ(out.result.mismatches.size(), 3u);
  EXPECT_EQ(out.result.counters.mediumMismatches, 7u);
  for (std::int64_t i = 0; i < 3; ++i) {
    EXPECT_EQ(out.result.mismatches[static_cast<std::size_t>(i)].pixel, Point2i(10, 10));
    EXPECT_EQ(out.result.mismatches[static_cast<std::size_t>(i)].sample, i);
  }
}

TEST(RenderLoop, TellsTheFilmWhereInItsPixelASampleLies) {
  // A filter that takes the middle quarter of a pixel sees nothing of what lies around it.
  const auto isInside = [](float x) { return std::abs(x - std::floor(x) - 0.5f) < 0.25f; };
  const FakeIntegrator middle([&](const RayDifferential& ray, SampleContext&) {
    return Rgb(isInside(ray.o.x) && isInside(ray.o.y) ? 1.0f : 0.0f);
  });
  const RandomSampler sampler({.pixelSamples = 64, .seed = 3});
  Film::Settings settings;
  settings.resolution = {6, 5};
  Film film(settings, BoxFilter({.radius = {0.25f, 0.25f}}));
  middle.render(FlatCamera(), sampler, film, {.seed = 3});
  const Image image = film.develop();
  for (const float v : image.data()) EXPECT_EQ(v, 1);
}

TEST(RenderLoop, TakesSamplesWithinThePixelBoundsOnly) {
  const FakeIntegrator white([](const RayDifferential&, SampleContext&) { return Rgb(1); });
  const Outcome out = renderFake(white, {.pixelBounds = Bounds2i{{10, 5}, {20, 9}}});
  EXPECT_EQ(out.result.samplesTaken, 7u * 10 * 4);
  EXPECT_EQ(out.image.rgb(15, 7).r, 1);
  EXPECT_EQ(out.image.rgb(30, 20).r, 0);
  const Outcome none = renderFake(white, {.pixelBounds = Bounds2i{{1000, 5}, {1001, 9}}});
  EXPECT_EQ(none.result.samplesTaken, 0u);
  EXPECT_FALSE(none.result.interrupted);
}

TEST(RenderLoop, ScalesDifferentialsBySamplesPerPixel) {
  class Camera4 final : public Camera {
   public:
    Camera4() : Camera(AnimatedTransform(), 0, 1) {}
    WeightedRay generateRay(Point2f, Point2f, float) const override {
      WeightedRay w;
      w.ray = RayDifferential(rayOf({0, 0, 1}, {0, 0, -1}));
      w.ray.hasDifferentials = true;
      w.ray.rxOrigin = w.ray.ryOrigin = {8, 0, 1};
      w.ray.rxDirection = w.ray.ryDirection = {0, 0, -1};
      return w;
    }
  };
  const FakeIntegrator offset([](const RayDifferential& ray, SampleContext&) { return Rgb(ray.rxOrigin.x); });
  RandomSampler sampler({.pixelSamples = 16, .seed = 0});
  RenderCounters counters;
  EXPECT_FLOAT_EQ(renderSample(Camera4(), sampler, offset, {0, 0}, 0, 16, 0, counters).r, 2);
}

/// Half of a function of the position along camera rays, half by paths that hit the film anywhere.
Rgb pattern(float x, float y) { return {1 + std::sin(x * .7f), 2 + std::cos(y), x * .1f + 1}; }
FakeIntegrator halfBySplats(int splatsPerSample) {
  return FakeIntegrator(
      [=](const RayDifferential& ray, SampleContext& context) {
        // As wide as a filter of radius 2 looks around the 37 x 23 pixels of the film.
        const float width = 37 + 4, height = 23 + 4;
        for (int i = 0; i < splatsPerSample; ++i) {
          const Point2f at{context.rng.uniform() * width - 2, context.rng.uniform() * height - 2};
          context.splats->add(at, pattern(at.x, at.y) *
                                      (width * height / (37 * 23) / 2 / static_cast<float>(splatsPerSample)));
        }
        return pattern(ray.o.x, ray.o.y) / 2;
      },
      true);
}

TEST(RenderLoop, AddsSplatsToTheSameBitsForAnyThreadsTilesAndGrouping) {
  const FakeIntegrator integrator = halfBySplats(2);
  const Outcome reference = renderFake(integrator, {.seed = 3});
  for (const auto& [threads, tile, group] :
       {std::tuple{2u, 16, 7}, std::tuple{5u, 5, 7}, std::tuple{1u, 16, 1}, std::tuple{2u, 7, 3}}) {
    const Outcome other =
        renderFake(integrator, {.seed = 3, .tileSize = tile, .samplesPerPass = group}, threads);
    EXPECT_TRUE(sameBits(reference.image, other.image))
        << threads << " threads, tiles of " << tile << ", passes of " << group;
  }
  EXPECT_FALSE(sameBits(reference.image, renderFake(integrator, {.seed = 4}).image));  // negative control
}

TEST(RenderLoop, AddsToEveryPixelWhatSplatsBringUnderTheFilterOfSamples) {
  const FakeIntegrator direct(
      [](const RayDifferential& ray, SampleContext&) { return pattern(ray.o.x, ray.o.y); });
  const Image truth = renderFake(direct, {.seed = 1}, 2, 4096).image;
  std::vector<RunningStats> pixels(truth.data().size());
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    const Image image = renderFake(halfBySplats(1), {.seed = seed}, 2, 16).image;
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].add(static_cast<double>(image.data()[i]));
  }
  RunningStats z;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    z.add((pixels[i].mean() - static_cast<double>(truth.data()[i])) / pixels[i].standardError());
    EXPECT_NEAR(pixels[i].mean(), static_cast<double>(truth.data()[i]),
                .12 * static_cast<double>(truth.data()[i]) + .05)
        << i;
  }
  EXPECT_LT(std::abs(z.mean()), kMaxAbsZ / std::sqrt(static_cast<double>(pixels.size()) / 12))
      << "about 12 pixels share a splat";
}

TEST(RenderLoop, StopsWithSplatsOfTheSamplesThatWereTakenOnly) {
  const StopSignal signal({.timeLimit = 0.05, .abandonsPaths = true});
  const FakeIntegrator integrator(
      [&](const RayDifferential& ray, SampleContext& context) {
        context.splats->add({5.5f, 5.5f}, Rgb(1));
        while (ray.o.y > 4) leaveIfAbandoned();
        return Rgb(0);
      },
      true);
  const RandomSampler sampler({.pixelSamples = 1, .seed = 1});
  const ThreadLimit one(1);
  Film::Settings settings;
  settings.resolution = {37, 23};
  Film film(settings, BoxFilter({.radius = {.5f, .5f}}));
  const RenderResult result = integrator.render(FlatCamera(), sampler, film, {.stop = &signal.flag()});
  ASSERT_EQ(result.samplesAbandoned, 1u);
  double sum = 0;
  for (const SplatSum& s : film.state().splats) sum += s.r;
  EXPECT_EQ(sum, static_cast<double>(result.samplesTaken));
  EXPECT_EQ(film.state().paths.count, result.samplesTaken);
  EXPECT_EQ(film.state().paths.area, 37 * 23);
}

TEST(RenderLoop, KeepsSplatsThatAreNoNumbersOffTheFilm) {
  const FakeIntegrator integrator(
      [](const RayDifferential& ray, SampleContext& context) {
        const bool isBad = ray.o.x > 10 && ray.o.x < 11 && ray.o.y > 10 && ray.o.y < 11;
        context.splats->add({3, 3}, Rgb(isBad ? std::numeric_limits<float>::quiet_NaN() : 1));
        return Rgb(1);
      },
      true);
  const Outcome out = renderFake(integrator, {.seed = 1}, 2, 2);
  ASSERT_EQ(out.result.dropped.size(), 2u);
  EXPECT_EQ(out.result.dropped[0].pixel, Point2i(10, 10));
  EXPECT_EQ(out.result.counters.droppedTotal(), 2u);
  for (const float v : out.image.data()) EXPECT_TRUE(std::isfinite(v));
}

TEST(RenderLoop, FillsTheLayersThatTheFilmWasAskedFor) {
  const FakeIntegrator integrator([](const RayDifferential& ray, SampleContext& context) {
    context.counters.densityLookups += ray.o.x < 18 ? 3 : 7;
    return Rgb(1);
  });
  Film::Settings settings;
  settings.resolution = {36, 8};
  settings.layers = LayerSet(maskOf({Layer::Lookups, Layer::Samples}));
  const RandomSampler sampler({.pixelSamples = 5, .seed = 1});
  Film film(settings, BoxFilter({.radius = {.5f, .5f}}));
  integrator.render(FlatCamera(), sampler, film, {});
  const Image image = film.develop();
  ASSERT_EQ(image.channels(), (std::vector<std::string>{"R", "G", "B", "samples", "lookups"}));
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 36; ++x) {
      EXPECT_EQ(image.at(x, y, 0), 1);
      EXPECT_EQ(image.at(x, y, 3), 5);
      EXPECT_EQ(image.at(x, y, 4), 5 * (x < 18 ? 3 : 7));
    }
  }
}

TEST(RenderLoop, GoesOnFromAStateToTheSameResult) {
  const FakeIntegrator integrator = halfBySplats(1);
  const RandomSampler sampler({.pixelSamples = 7, .seed = 3});
  Film whole = smallFilm(), first = smallFilm(), second = smallFilm();
  const RenderResult expected =
      integrator.render(FlatCamera(), sampler, whole, {.seed = 3, .samplesPerPass = 2});
  RenderState state;
  integrator.render(FlatCamera(), sampler, first,
                    {.seed = 3, .samplesPerPass = 2, .afterPass = [&](const PassEnd& end) {
                       state = saveState(integrator.scene(), first, end.result);
                       return end.result.completedSamplesPerPixel < 4;
                     }});
  EXPECT_EQ(state.result.completedSamplesPerPixel, 4);
  ASSERT_TRUE(restoreState(state, integrator.scene(), second));
  const RenderResult result = integrator.render(FlatCamera(), sampler, second, {.seed = 3, .start = &state});
  EXPECT_EQ(second.state(), whole.state());
  EXPECT_EQ(result.samplesTaken, expected.samplesTaken);
  EXPECT_EQ(result.samplesTotal, expected.samplesTotal);
  EXPECT_EQ(result.pixelsSampled, expected.pixelsSampled);
  EXPECT_EQ(result.completedSamplesPerPixel, 7);
  EXPECT_EQ(result.counters.cameraSamples, expected.counters.cameraSamples);
  EXPECT_FALSE(result.interrupted);
  Film other = smallFilm({36, 23});
  EXPECT_FALSE(restoreState(state, integrator.scene(), other));
}

TEST(RenderLoop, TellsOfAPassThatWasLeftInsideBeforeItIsOnTheFilm) {
  const RandomSampler sampler({.pixelSamples = 9, .seed = 3});
  Film whole = smallFilm();
  halfBySplats(1).render(FlatCamera(), sampler, whole, {.seed = 3});
  std::atomic<int> taken{0};
  std::atomic<bool> stop{false};
  const auto area = static_cast<int>(whole.sampleBounds().area());
  const FakeIntegrator half = halfBySplats(1);
  const FakeIntegrator stopping(
      [&](const RayDifferential& ray, SampleContext& context) {
        if (++taken > 5 * area) stop = true;  // in the second of the passes of four
        return half.radiance(ray, context);
      },
      /*makesSplats=*/true);
  Film film = smallFilm(), second = smallFilm();
  std::vector<RenderState> states;
  const RenderResult stopped = stopping.render(
      FlatCamera(), sampler, film,
      {.seed = 3, .samplesPerPass = 4, .stop = &stop, .beforePartialPass = [&](const PassEnd& end) {
         states.push_back(saveState(stopping.scene(), film, end.result));
       }});
  EXPECT_TRUE(stopped.interrupted);
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].result.completedSamplesPerPixel, 4);
  EXPECT_EQ(states[0].result.samplesTaken, 4u * static_cast<unsigned>(area));
  EXPECT_GT(stopped.samplesTaken, states[0].result.samplesTaken) << "which the image has";
  EXPECT_NE(film.state(), states[0].film);
  ASSERT_TRUE(restoreState(states[0], stopping.scene(), second));
  half.render(FlatCamera(), sampler, second, {.seed = 3, .start = &states[0]});
  EXPECT_EQ(second.state(), whole.state());

  // Nobody is told of a render that ends with a whole pass.
  Film again = smallFilm();
  const RenderResult asked = half.render(FlatCamera(), sampler, again,
                                         {.seed = 3,
                                          .samplesPerPass = 4,
                                          .afterPass = [](const PassEnd&) { return false; },
                                          .beforePartialPass = [](const PassEnd&) { ADD_FAILURE(); }});
  EXPECT_TRUE(asked.interrupted);
}

TEST(RenderLoop, DoesNotCountTheTimeOfWhoLooksOn) {
  const Stopwatch watch;
  double looked = 0;
  const Outcome out = renderFake(noise(), {.samplesPerPass = 1, .afterPass = [&looked](const PassEnd&) {
                                             const Stopwatch look;
                                             std::this_thread::sleep_for(std::chrono::milliseconds(40));
                                             looked += look.seconds();
                                             return true;
                                           }});
  EXPECT_GE(looked, .04);
  EXPECT_LE(out.result.seconds, watch.seconds() - looked);
  // A limit of time is one of rendering, too.
  EXPECT_FALSE(renderFake(noise(), {.samplesPerPass = 1,
                                    .timeLimit = .7,
                                    .afterPass =
                                        [](const PassEnd&) {
                                          std::this_thread::sleep_for(std::chrono::milliseconds(120));
                                          return true;
                                        }})
                   .result.interrupted);
}

TEST(RenderLoop, ReportsProgress) {
  std::uint64_t last = 0;
  const FakeIntegrator slow([](const RayDifferential&, SampleContext&) {
    std::this_thread::sleep_for(std::chrono::microseconds(100));
    return Rgb(1);
  });
  int reports = 0;
  RenderOptions options;
  options.progress = [&](const RenderProgress& p) {
    EXPECT_GE(p.samplesDone, last);
    EXPECT_LE(p.samplesDone, p.samplesTotal);
    last = p.samplesDone;
    ++reports;
  };
  renderFake(slow, options, 2);
  EXPECT_GE(reports, 1);
  EXPECT_LE(reports, 200);
}

}  // namespace
}  // namespace pbrtmedia
