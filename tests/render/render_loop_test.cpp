// SPDX-License-Identifier: BSD-2-Clause
#include "render/render_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <set>
#include <thread>

#include "base/parallel.h"
#include "base/stop_signal.h"
#include "filters/box.h"
#include "filters/gaussian.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// Rays along -z through the film plane.
class FlatCamera final : public Camera {
 public:
  FlatCamera() : Camera(AnimatedTransform(), 0, 1) {}
  WeightedRay generateRay(Point2f film, Point2f, float time) const override {
    WeightedRay w;
    w.ray = RayDifferential(rayOf({film.x, film.y, 1}, {0, 0, -1}));
    w.ray.time = rayTime(time);
    return w;
  }
};

/// Any function of position and random numbers.
class FakeIntegrator final : public Integrator {
 public:
  using Function = std::function<Rgb(const RayDifferential&, SampleContext&)>;
  explicit FakeIntegrator(Function f) : f_(std::move(f)) {}
  std::string_view typeName() const override { return "fake"; }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override { return f_(ray, context); }

 private:
  Function f_;
};

FakeIntegrator noise() {
  return FakeIntegrator([](const RayDifferential& ray, SampleContext& context) {
    return Rgb(ray.o.x * 0.1f, context.sampler.get1D(), context.rng.uniform());
  });
}

Film makeFilm(Point2i resolution = {37, 23}) {
  Film::Settings settings;
  settings.resolution = resolution;
  return Film(settings, std::make_unique<GaussianFilter>(GaussianFilter::Params{}));
}

struct Outcome {
  Image image;
  RenderResult result;
};
Outcome render(const Integrator& integrator, RenderOptions options, unsigned threads = 1,
               std::int64_t spp = 7) {
  const ThreadLimit limit(threads);
  const RandomSampler sampler({.pixelSamples = spp, .seed = options.seed});
  const FlatCamera camera;
  Film film = makeFilm();
  Outcome out;
  out.result = renderFilm(camera, sampler, integrator, film, options);
  out.image = film.develop();
  return out;
}

bool sameBits(const Image& a, const Image& b) {
  if (a.width() != b.width() || a.height() != b.height()) return false;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) {
      if (!(a.rgb(x, y) == b.rgb(x, y))) return false;
    }
  }
  return true;
}

TEST(RenderLoop, GivesTheSameBitsForAnyThreadsTilesAndGrouping) {
  const FakeIntegrator integrator = noise();
  const Outcome reference = render(integrator, {.seed = 3});
  EXPECT_FALSE(reference.result.interrupted);
  EXPECT_EQ(reference.result.samplesTaken, reference.result.samplesTotal);
  for (const unsigned threads : {1u, 2u, 5u}) {
    for (const int tile : {16, 5}) {
      for (const std::optional<int> grouping :
           {std::optional<int>(), std::optional<int>(1), std::optional<int>(3)}) {
        const Outcome other =
            render(integrator, {.seed = 3, .tileSize = tile, .samplesPerPass = grouping}, threads);
        EXPECT_TRUE(sameBits(reference.image, other.image)) << threads << " threads, tiles of " << tile;
        EXPECT_EQ(reference.result.counters.cameraSamples, other.result.counters.cameraSamples);
      }
    }
  }
  EXPECT_FALSE(sameBits(reference.image, render(integrator, {.seed = 4}).image));  // negative control
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
  const Outcome whole = render(integrator, {.seed = 3});
  const RandomSampler sampler({.pixelSamples = 7, .seed = 3});
  const FlatCamera camera;
  Film film = makeFilm();
  RenderOptions first{.seed = 3, .samplesPerPixel = 4};
  RenderOptions second{.seed = 3, .firstSample = 4};
  EXPECT_EQ(renderFilm(camera, sampler, integrator, film, first).completedSamplesPerPixel, 4);
  EXPECT_EQ(renderFilm(camera, sampler, integrator, film, second).completedSamplesPerPixel, 7);
  EXPECT_TRUE(sameBits(whole.image, film.develop()));
}

TEST(RenderLoop, StopsInTimeAndKeepsAProperlyNormalisedImage) {
  const FakeIntegrator slow([](const RayDifferential&, SampleContext&) {
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    return Rgb(2);
  });
  const auto start = std::chrono::steady_clock::now();
  const Outcome out = render(slow, {.timeLimit = 0.3}, 2, 1 << 20);
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
  const Outcome flagged = render(integrator, {.samplesPerPass = 1, .stop = &stop});
  EXPECT_TRUE(flagged.result.interrupted);
  EXPECT_LT(flagged.result.samplesTaken, flagged.result.samplesTotal / 7);
  EXPECT_EQ(flagged.result.completedSamplesPerPixel, 0);

  int passes = 0;
  const Outcome called = render(noise(), {.samplesPerPass = 2, .afterPass = [&](const RenderProgress& p) {
                                            EXPECT_GT(p.samplesDone, 0u);
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
  const Outcome out = render(integrator, {.stop = &signal.flag()});
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
  const Outcome a = render(broken, {.seed = 3, .maxRecords = 20});
  ASSERT_EQ(a.result.dropped.size(), 20u);
  EXPECT_GT(a.result.counters.droppedTotal(), 20u);
  for (const float v : a.image.data())
    ASSERT_TRUE(v >= 0 && v <= 1.0001f) << v << ": what is dropped is black";
  for (const auto& [threads, tile, group] : {std::tuple{2u, 5, 1}, std::tuple{5u, 16, 3}}) {
    const Outcome b =
        render(broken, {.seed = 3, .tileSize = tile, .samplesPerPass = group, .maxRecords = 20}, threads);
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
  const Outcome out = render(integrator, {.maxRecords = 3}, 2);
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
  Film film(settings, std::make_unique<BoxFilter>(BoxFilter::Params{.radius = {0.25f, 0.25f}}));
  renderFilm(FlatCamera(), sampler, middle, film, {.seed = 3});
  const Image image = film.develop();
  for (const float v : image.data()) EXPECT_EQ(v, 1);
}

TEST(RenderLoop, TakesSamplesWithinThePixelBoundsOnly) {
  const FakeIntegrator white([](const RayDifferential&, SampleContext&) { return Rgb(1); });
  const Outcome out = render(white, {.pixelBounds = Bounds2i{{10, 5}, {20, 9}}});
  EXPECT_EQ(out.result.samplesTaken, 7u * 10 * 4);
  EXPECT_EQ(out.image.rgb(15, 7).r, 1);
  EXPECT_EQ(out.image.rgb(30, 20).r, 0);
  const Outcome none = render(white, {.pixelBounds = Bounds2i{{1000, 5}, {1001, 9}}});
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
  render(slow, options, 2);
  EXPECT_GE(reports, 1);
  EXPECT_LE(reports, 200);
}

}  // namespace
}  // namespace pbrtmedia
