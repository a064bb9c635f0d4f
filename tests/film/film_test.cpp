// SPDX-License-Identifier: BSD-2-Clause
#include "film/film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "base/diagnostics.h"
#include "base/parallel.h"
#include "base/rng.h"
#include "filters/box.h"
#include "filters/gaussian.h"
#include "filters/mitchell.h"
#include "filters/sinc.h"
#include "filters/triangle.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

std::unique_ptr<Filter> box(float r = 0.5f) { return std::make_unique<BoxFilter>(BoxFilter::Params{{r, r}}); }

std::vector<std::unique_ptr<Filter>> allFilters() {
  std::vector<std::unique_ptr<Filter>> f;
  f.push_back(box());
  f.push_back(box(1.25f));
  f.push_back(std::make_unique<TriangleFilter>(TriangleFilter::Params{}));
  f.push_back(std::make_unique<GaussianFilter>(GaussianFilter::Params{}));
  f.push_back(std::make_unique<MitchellFilter>(MitchellFilter::Params{}));
  f.push_back(std::make_unique<SincFilter>(SincFilter::Params{}));
  return f;
}

Film::Settings sized(int width, int height) {
  Film::Settings s;
  s.resolution = {width, height};
  return s;
}

Film cropped(int width, int height, float x0, float x1, float y0, float y1, const Filter& filter = *box()) {
  Film::Settings s = sized(width, height);
  s.cropWindow[0] = x0;
  s.cropWindow[1] = x1;
  s.cropWindow[2] = y0;
  s.cropWindow[3] = y1;
  return Film(s, filter);
}

void setSample(SamplePass& pass, Point2i pixel, int s, Point2f offset, Rgb radiance) {
  pass.at(pixel, s) = {offset, radiance, true};
}

template <class Value>
SamplePass filled(const Film& film, int samples, Value&& value) {
  SamplePass pass(film.sampleBounds(), samples);
  const Bounds2i b = film.sampleBounds();
  for (int s = 0; s < samples; ++s) {
    for (int y = b.min.y; y < b.max.y; ++y) {
      for (int x = b.min.x; x < b.max.x; ++x) {
        Rng rng(hashCombine(static_cast<std::uint64_t>(x + 1000), static_cast<std::uint64_t>(y + 1000),
                            static_cast<std::uint64_t>(s)));
        const float u = rng.uniform(), v = rng.uniform();
        setSample(pass, {x, y}, s, {u, v}, value(rng));
      }
    }
  }
  return pass;
}

Rgb noise(Rng& rng) {
  const float r = rng.uniform(), g = 100 * rng.uniform();
  return {r, g, rng.uniform() * 1e-3f};
}

SamplePass part(const SamplePass& all, int first, int count) {
  SamplePass pass(all.bounds(), count);
  const Bounds2i b = all.bounds();
  for (int s = 0; s < count; ++s) {
    for (int y = b.min.y; y < b.max.y; ++y) {
      for (int x = b.min.x; x < b.max.x; ++x) pass.at({x, y}, s) = all.at({x, y}, first + s);
    }
  }
  return pass;
}

TEST(FilmBounds, RoundCropEdgesUpInFloatLikePbrt) {
  EXPECT_EQ(cropped(200, 200, 0, 0.9f, 0, 0.8f).pixelBounds(), (Bounds2i{{0, 0}, {180, 160}}));
  EXPECT_EQ(cropped(200, 100, 0.25f, 0.755f, 0.1f, 1).pixelBounds(), (Bounds2i{{50, 10}, {151, 100}}));
  EXPECT_EQ(cropped(3, 3, 0.3f, 0.7f, 0, 1).pixelBounds(), (Bounds2i{{1, 0}, {3, 3}}));
}

TEST(FilmBounds, OfNeighbouringCropsTileThePicture) {
  for (const int width : {7, 200, 1023}) {
    int next = 0;
    for (int k = 0; k < 5; ++k) {
      const Bounds2i b =
          cropped(width, 4, static_cast<float>(k) / 5, static_cast<float>(k + 1) / 5, 0, 1).pixelBounds();
      EXPECT_EQ(b.min.x, next);
      next = b.max.x;
    }
    EXPECT_EQ(next, width);
  }
}

TEST(FilmBounds, SortAndClampTheCropWindow) {
  const Film film = cropped(10, 10, 0.8f, 0.2f, -3, 7);
  EXPECT_EQ(film.pixelBounds(), (Bounds2i{{2, 0}, {8, 10}}));
  EXPECT_EQ(film.settings().cropWindow[0], 0.2f);
  EXPECT_EQ(film.settings().cropWindow[3], 1.0f);
}

TEST(FilmBounds, SamplesAreTakenAsFarAsTheFilterReaches) {
  const auto bounds = [](std::unique_ptr<Filter> f) {
    return cropped(10, 10, 0.2f, 0.8f, 0, 1, *f).sampleBounds();
  };
  EXPECT_EQ(bounds(box(0.5f)), (Bounds2i{{2, 0}, {8, 10}}));
  EXPECT_EQ(bounds(box(0.25f)), (Bounds2i{{2, 0}, {8, 10}}));
  EXPECT_EQ(bounds(box(0.75f)), (Bounds2i{{1, -1}, {9, 11}}));
  EXPECT_EQ(bounds(box(2)), (Bounds2i{{0, -2}, {10, 12}}));
  EXPECT_EQ(bounds(box(1.5f)), (Bounds2i{{1, -1}, {9, 11}}));
}

TEST(FilmSettings, ThatMakeNoPictureAreErrors) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_THROW(Film(sized(0, 5), *box()), SceneError);
  EXPECT_THROW(Film(sized(5, -5), *box()), SceneError);
  EXPECT_THROW(Film(sized(1 << 30, 1), *box()), SceneError);
  EXPECT_THROW(cropped(10, 10, 0.5f, 0.5f, 0, 1), SceneError);
  EXPECT_THROW(cropped(10, 10, 0.51f, 0.55f, 0, 1), SceneError);  // no pixel begins between them
  EXPECT_THROW(cropped(10, 10, nan, 1, 0, 1), SceneError);
  Film::Settings s = sized(2, 2);
  s.scale = nan;
  EXPECT_THROW(Film(s, *box()), SceneError);
  s = sized(2, 2);
  s.maxSampleLuminance = -1;
  EXPECT_THROW(Film(s, *box()), SceneError);
}

TEST(FilmSettings, ThatTakeMoreThanTheMachineHasAreErrorsBeforeMemoryIsTaken) {
  try {
    const Film film(sized(1 << 20, 1 << 20), *box());
    ADD_FAILURE() << "a film of 2^40 pixels";
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find("1048576 x 1048576 pixels"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("render parts with \"cropwindow\""), std::string::npos) << e.what();
  }
  EXPECT_EQ(cropped(1 << 20, 1 << 20, 0, 0x1p-18f, 0, 0x1p-18f).pixelBounds().area(), 16)
      << "a part is enough";
}

TEST(Film, WithTheDefaultBoxIsThePlainMeanOfAPixelsOwnSamples) {
  Film film(sized(2, 1), *box());
  SamplePass pass(film.sampleBounds(), 2);
  setSample(pass, {0, 0}, 0, {0, 0}, Rgb(1, 2, 3));
  setSample(pass, {0, 0}, 1, {0.99f, 0.5f}, Rgb(3, 2, 1));
  setSample(pass, {1, 0}, 0, {0, 0.3f}, Rgb(10));  // on the border: belongs to this pixel only
  setSample(pass, {1, 0}, 1, {0.5f, 0.5f}, Rgb(0));
  film.accumulate(pass);
  const Image image = film.develop();
  EXPECT_EQ(image.rgb(0, 0), Rgb(2));
  EXPECT_EQ(image.rgb(1, 0), Rgb(5));
}

TEST(Film, UnsampledPixelsAreBlackAndInvalidSamplesDoNotCount) {
  Film film(sized(2, 1), *box());
  SamplePass pass(film.sampleBounds(), 2);
  setSample(pass, {0, 0}, 0, {0.5f, 0.5f}, Rgb(4));
  pass.at({0, 0}, 1).radiance = Rgb(100);  // not valid
  film.accumulate(pass);
  EXPECT_EQ(film.develop().rgb(0, 0), Rgb(4));
  EXPECT_EQ(film.develop().rgb(1, 0), Rgb(0));
  EXPECT_EQ(film.state().sums[1], Film::Sums{});
}

// [quirk] of PBRT-v3: a weight is the filter at the centre of a cell, 1/8 pixel wide for radius 2.
TEST(Film, WeightsAreThoseOfTheSixteenBySixteenTable) {
  const TriangleFilter exact({.radius = {2, 2}});
  Film film(sized(5, 5), TriangleFilter({}));
  SamplePass pass(film.sampleBounds(), 1);
  setSample(pass, {2, 2}, 0, {0.8f, 0.4f}, Rgb(1));
  film.accumulate(pass);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 5; ++x) {
      // Sample minus pixel centre; 8 cells for each pixel of distance, read at the cell's centre.
      const float dx = static_cast<float>(2 - x) + 0.3f, dy = static_cast<float>(2 - y) - 0.1f;
      const bool inside = std::abs(dx) < 2 && std::abs(dy) < 2;
      const float cx = (std::floor(std::abs(dx) * 8) + 0.5f) / 8,
                  cy = (std::floor(std::abs(dy) * 8) + 0.5f) / 8;
      const double expected = inside ? exact.evaluate({cx, cy}) : 0;
      const Film::Sums& sums = film.state().sums[static_cast<std::size_t>(5 * y + x)];
      EXPECT_FLOAT_EQ(static_cast<float>(sums.weight), static_cast<float>(expected)) << x << ' ' << y;
      EXPECT_EQ(sums.r, sums.weight);
    }
  }
  EXPECT_NE(film.state().sums[12].weight, exact.evaluate({0.3f, -0.1f}));  // the exact value is another one
}

TEST(Film, WeightsMatchABruteForceSumOverAllSamplesForEveryFilter) {
  for (auto& filter : allFilters()) {
    const Filter* f = filter.get();
    Film film = cropped(12, 10, 0.25f, 0.75f, 0.2f, 0.9f, *filter);
    const SamplePass pass = filled(film, 2, noise);
    film.accumulate(pass);
    const Bounds2i b = film.sampleBounds(), p = film.pixelBounds();
    const Vector2f r = f->radius();
    for (int y = p.min.y; y < p.max.y; ++y) {
      for (int x = p.min.x; x < p.max.x; ++x) {
        double weight = 0, green = 0;
        for (int sy = b.min.y; sy < b.max.y; ++sy) {
          for (int sx = b.min.x; sx < b.max.x; ++sx) {
            for (int s = 0; s < 2; ++s) {
              const auto& sample = pass.at({sx, sy}, s);
              const double dx = sx - x + double{sample.offset.x} - 0.5,
                           dy = sy - y + double{sample.offset.y} - 0.5;
              if (dx < -r.x || dx >= r.x || dy < -r.y || dy >= r.y) continue;
              const auto cell = [](double d, float radius) {
                return static_cast<float>((std::floor(std::abs(d) * 16 / radius) + 0.5) * radius / 16);
              };
              const double w = f->evaluate({cell(dx, r.x), cell(dy, r.y)});
              weight += w;
              green += w * sample.radiance.g;
            }
          }
        }
        const auto& sums =
            film.state().sums[static_cast<std::size_t>((y - p.min.y) * p.width() + x - p.min.x)];
        EXPECT_NEAR(sums.weight, weight, 1e-5) << x << ' ' << y;
        EXPECT_NEAR(sums.g, green, 1e-3) << x << ' ' << y;
      }
    }
  }
}

TEST(Film, AConstantImageStaysConstantForEveryFilter) {
  for (auto& filter : allFilters()) {
    Film film(sized(6, 5), *filter);
    film.accumulate(filled(film, 4, [](Rng&) { return Rgb(0.25f, 1, 3); }));
    const Image image = film.develop();
    for (int y = 0; y < 5; ++y) {
      for (int x = 0; x < 6; ++x) {
        EXPECT_FLOAT_EQ(image.at(x, y, 0), 0.25f);
        EXPECT_FLOAT_EQ(image.at(x, y, 1), 1.0f);
        EXPECT_FLOAT_EQ(image.at(x, y, 2), 3.0f);
      }
    }
  }
}

TEST(Film, DoesNotDependOnHowSamplesAreGroupedIntoPasses) {
  for (std::size_t i = 0; i < allFilters().size(); ++i) {
    Film one(sized(9, 7), *allFilters()[i]), two(sized(9, 7), *allFilters()[i]),
        three(sized(9, 7), *allFilters()[i]);
    const SamplePass all = filled(one, 6, noise);
    one.accumulate(all);
    for (int s = 0; s < 6; ++s) two.accumulate(part(all, s, 1));
    three.accumulate(part(all, 0, 4));
    three.accumulate(part(all, 4, 2));
    EXPECT_EQ(one.state().sums, two.state().sums) << i;
    EXPECT_EQ(one.state().sums, three.state().sums) << i;
  }
}

TEST(Film, DoesNotDependOnTheNumberOfThreads) {
  std::vector<Film::Sums> first;
  for (const unsigned threads : {1u, 2u, 5u}) {
    const ThreadLimit limit(threads);
    Film film(sized(40, 30), MitchellFilter({}));
    film.accumulate(filled(film, 2, noise));
    if (first.empty()) first = film.state().sums;
    EXPECT_EQ(film.state().sums, first) << threads;
  }
}

TEST(Film, ACropIsTheSamePartOfTheWholePicture) {
  Film whole(sized(20, 10), GaussianFilter({}));
  Film crop = cropped(20, 10, 0.25f, 0.75f, 0.3f, 0.8f, GaussianFilter({}));
  whole.accumulate(filled(whole, 3, noise));
  crop.accumulate(filled(crop, 3, noise));
  const Image a = whole.develop(), b = crop.develop();
  EXPECT_EQ(b.dataWindow, (Bounds2i{{5, 3}, {15, 8}}));
  EXPECT_EQ(b.displayWindow, (Bounds2i{{0, 0}, {20, 10}}));
  EXPECT_EQ(a.dataWindow, a.displayWindow);
  for (int y = 0; y < b.height(); ++y) {
    for (int x = 0; x < b.width(); ++x) EXPECT_EQ(b.rgb(x, y), a.rgb(x + 5, y + 3));
  }
}

TEST(Film, NegativeLobesAreClampedAfterTheDivisionAndBeforeTheScale) {
  Film::Settings s = sized(5, 1);
  s.scale = 2;
  Film film(s, MitchellFilter({}));
  SamplePass pass(film.sampleBounds(), 1);
  for (int x = 0; x < 5; ++x) setSample(pass, {x, 0}, 0, {0.5f, 0.5f}, x == 2 ? Rgb(100) : Rgb(0));
  setSample(pass, {0, 0}, 0, {0.1f, 0.5f}, Rgb(0));
  setSample(pass, {2, 0}, 0, {0.1f, 0.5f},
            Rgb(100));  // 1.6 pixels from the first centre: in the negative lobe
  film.accumulate(pass);
  EXPECT_LT(film.state().sums[0].r, 0.0);
  EXPECT_EQ(film.develop().rgb(0, 0), Rgb(0));
  EXPECT_GT(film.develop().rgb(2, 0).r, 100.0f);
}

TEST(Film, ScalesEveryPixel) {
  Film::Settings s = sized(1, 1);
  s.scale = 0.5f;
  Film film(s, *box());
  SamplePass pass(film.sampleBounds(), 1);
  setSample(pass, {0, 0}, 0, {0.5f, 0.5f}, Rgb(1, 2, 4));
  film.accumulate(pass);
  EXPECT_EQ(film.develop().rgb(0, 0), Rgb(0.5f, 1, 2));
}

TEST(Film, SumsKeepSmallSamplesNextToLargeOnes) {
  Film film(sized(1, 1), *box());
  SamplePass pass(film.sampleBounds(), 1);
  setSample(pass, {0, 0}, 0, {0.5f, 0.5f}, Rgb(0x1p24f));
  film.accumulate(pass);
  setSample(pass, {0, 0}, 0, {0.5f, 0.5f}, Rgb(0.5f));  // would vanish in a float sum
  for (int i = 0; i < 64; ++i) film.accumulate(pass);
  EXPECT_EQ(film.state().sums[0].r, 0x1p24 + 32);
}

TEST(Film, RestoresItsSums) {
  Film film(sized(4, 3), *box()), resumed(sized(4, 3), *box());
  const SamplePass all = filled(film, 2, noise);
  film.accumulate(part(all, 0, 1));
  EXPECT_TRUE(resumed.restore(film.state()));
  film.accumulate(part(all, 1, 1));
  resumed.accumulate(part(all, 1, 1));
  EXPECT_EQ(film.state().sums, resumed.state().sums);
  Film::State other = film.state();
  other.sums.resize(5);
  EXPECT_FALSE(resumed.restore(other));
  EXPECT_EQ(film.state(), resumed.state()) << "as it was";
}

// ---- Halves

TEST(Halves, TellTheErrorOfTheImageWithoutTheTruth) {
  // Noise of variance 1/12 around a half, under a box of a pixel.
  for (const int samples : {2, 3, 8}) {
    Film film(sized(100, 80), *box());
    film.keepHalves();
    const SamplePass all = filled(film, samples, [](Rng& rng) { return Rgb(rng.uniform()); });
    film.accumulate(all);
    const Image image = film.develop(), surrogate = film.surrogateReference();
    double squares = 0;
    for (std::size_t i = 0; i < image.data().size(); i += 3) {
      const double d = static_cast<double>(image.data()[i]) - static_cast<double>(surrogate.data()[i]);
      squares += d * d / (100 * 80);
    }
    const double variance = 1.0 / 12 / samples;
    EXPECT_LT(std::abs(squares - variance) / (variance * std::sqrt(2.0 / (100 * 80))), 5) << samples;
  }
}

TEST(Halves, DependOnNoGroupingAndChangeNoSum) {
  Film plain(sized(9, 7), GaussianFilter({})), whole(sized(9, 7), GaussianFilter({})),
      parts(sized(9, 7), GaussianFilter({})), none(sized(9, 7), GaussianFilter({}));
  for (Film* film : {&whole, &parts}) film->keepHalves();
  const SamplePass all = filled(plain, 5, noise);
  plain.accumulate(all);
  whole.accumulate(all);
  for (int s = 0; s < 5; ++s) {
    SamplePass one(all.bounds(), 1, {}, s);
    for (int y = all.bounds().min.y; y < all.bounds().max.y; ++y) {
      for (int x = all.bounds().min.x; x < all.bounds().max.x; ++x) one.at({x, y}, 0) = all.at({x, y}, s);
    }
    parts.accumulate(one);
  }
  EXPECT_EQ(whole.state().sums, plain.state().sums);
  EXPECT_EQ(whole.state(), parts.state());
  EXPECT_TRUE(plain.state().odd.empty());
  EXPECT_FALSE(plain.hasHalves());
  EXPECT_FALSE(none.restore(whole.state())) << "another kind of film";
  // Where all samples are equal the halves are, too.
  Film flat(sized(9, 7), GaussianFilter({}));
  flat.keepHalves();
  flat.accumulate(filled(flat, 4, [](Rng&) { return Rgb(.5f, 1, 2); }));
  const Image a = flat.develop(), b = flat.surrogateReference();
  for (std::size_t i = 0; i < a.data().size(); ++i) EXPECT_NEAR(a.data()[i], b.data()[i], 1e-6f);
}

// ---- Splats

std::vector<SplatBuffer> oneSplat(Point2f at, Rgb value) {
  std::vector<SplatBuffer> units(1);
  units[0].add(at, value);
  return units;
}

TEST(Splats, CountInThePixelTheyHitUnderABoxOfAPixel) {
  Film film(sized(5, 4), *box());
  film.addSplats(oneSplat({2.25f, 1.75f}, {3, 5, 7}), {2, 1});
  const Image image = film.develop();
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 5; ++x) {
      EXPECT_EQ(image.rgb(x, y), x == 2 && y == 1 ? Rgb(1.5f, 2.5f, 3.5f) : Rgb(0)) << x << ' ' << y;
    }
  }
  // A second call adds to the sums and to the samples they stand for.
  film.addSplats(oneSplat({2.25f, 1.75f}, {3, 5, 7}), {4, 1});
  EXPECT_EQ(film.develop().rgb(2, 1), Rgb(1, 6.f * 5 / 18, 7.f / 3));
}

TEST(Splats, SpreadAsSamplesDo) {
  // What a sample weighs in each pixel, a splat brings, over the filter's integral.
  for (const auto& filter : allFilters()) {
    Film samples = cropped(30, 26, .2f, .7f, .1f, .9f, *filter),
         splats = cropped(30, 26, .2f, .7f, .1f, .9f, *filter);
    const FilterTable table(*filter);
    Rng rng(5);
    for (int n = 0; n < 50; ++n) {
      const Bounds2i b = samples.sampleBounds();
      const Point2f at{static_cast<float>(b.min.x) + rng.uniform() * static_cast<float>(b.width()),
                       static_cast<float>(b.min.y) + rng.uniform() * static_cast<float>(b.height())};
      const Point2i pixel{static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y))};
      SamplePass pass(b, 1);
      setSample(pass, pixel, 0, {at.x - static_cast<float>(pixel.x), at.y - static_cast<float>(pixel.y)},
                Rgb(2));
      samples.accumulate(pass);
      splats.addSplats(oneSplat(at, Rgb(2)), {1, 1});
    }
    for (std::size_t i = 0; i < samples.state().sums.size(); ++i) {
      EXPECT_NEAR(splats.state().splats[i].g * table.integral(), samples.state().sums[i].g, 1e-10) << i;
    }
  }
}

TEST(Splats, OutsideTheFilmAreNowhere) {
  Film film(sized(5, 4), GaussianFilter({}));
  for (const Point2f at : {Point2f{-3, 1}, Point2f{8.5f, 1}, Point2f{1, -2.5f}, Point2f{1, 6.5f},
                           Point2f{1e30f, 1}, Point2f{1, -1e30f}})
    film.addSplats(oneSplat(at, Rgb(1)), {1, 1});
  for (const SplatSum& s : film.state().splats) EXPECT_EQ(s, SplatSum{});
  film.addSplats(oneSplat({-1, 1}, Rgb(1)), {1, 1});
  EXPECT_GT(film.state().splats[5].r, 0) << "beyond the border, within the filter";
}

TEST(Splats, AreSummedInTheirOrderWhateverTheUnitsAndThreads) {
  Rng rng(7);
  std::vector<Splat> all;
  for (std::uint64_t i = 0; i < 3000; ++i) {
    all.push_back({.film = {rng.uniform() * 41, rng.uniform() * 90},
                   .value = Rgb(rng.uniform() * std::exp(20 * rng.uniform())),
                   .isOdd = i % 3 == 0,
                   .order = i});
  }
  const auto state = [&](std::size_t units, bool backward, unsigned threads) {
    const ThreadLimit limit(threads);
    std::vector<SplatBuffer> buffers(units);
    for (std::size_t n = 0; n < all.size(); ++n) {
      const Splat& splat = all[backward ? all.size() - 1 - n : n];
      buffers[n % units].begin(splat.order, splat.isOdd);
      buffers[n % units].add(splat.film, splat.value);
    }
    Film::Settings settings = sized(41, 90);
    settings.layers = LayerSet(maskOf({Layer::Variance}));
    Film film(settings, MitchellFilter({}));
    film.keepHalves();
    film.addSplats(buffers, {1, 1});
    return film.state();
  };
  const Film::State one = state(1, false, 1);
  EXPECT_EQ(one, state(7, true, 1));
  EXPECT_EQ(one, state(64, false, 5));
  for (std::size_t i = 0; i < all.size(); ++i) all[i].order = all.size() - i;
  EXPECT_NE(one, state(1, false, 1)) << "negative control: sums of doubles depend on the order";
}

TEST(Splats, AddToTheMeanOfSamplesAndAreScaledWithThem) {
  Film::Settings s = sized(2, 1);
  s.scale = 3;
  Film film(s, *box());
  EXPECT_TRUE(film.state().splats.empty()) << "no memory before the first";
  SamplePass pass(film.sampleBounds(), 1);
  setSample(pass, {0, 0}, 0, {.5f, .5f}, {1, 2, 3});
  film.accumulate(pass);
  film.addSplats(oneSplat({.5f, .5f}, Rgb(4)), {2, 1});
  EXPECT_EQ(film.develop().rgb(0, 0), Rgb(9, 12, 15));
  EXPECT_EQ(film.develop().rgb(1, 0), Rgb(0));
  Film other(s, *box());
  EXPECT_TRUE(other.restore(film.state()));
  EXPECT_EQ(other.develop().data(), film.develop().data());
}

TEST(SamplePass, KeepsEachSampleApartAndClears) {
  SamplePass pass({{-1, -2}, {2, 1}}, 2);
  EXPECT_EQ(pass.samplesPerPixel(), 2);
  float n = 0;
  for (int s = 0; s < 2; ++s) {
    for (int y = -2; y < 1; ++y) {
      for (int x = -1; x < 2; ++x) setSample(pass, {x, y}, s, {0, 0}, Rgb(n++));
    }
  }
  n = 0;
  for (int s = 0; s < 2; ++s) {
    for (int y = -2; y < 1; ++y) {
      for (int x = -1; x < 2; ++x) EXPECT_EQ(pass.at({x, y}, s).radiance.r, n++);
    }
  }
  pass.clear(pass.bounds());
  EXPECT_FALSE(pass.at({1, 0}, 1).valid);
}

class Admission : public testing::Test {
 protected:
  bool admit(Rgb& radiance) { return Film(settings_, *box()).admit(radiance, counters_); }
  bool admits(Rgb radiance) { return admit(radiance); }
  std::uint64_t dropped(DropCause cause) const { return counters_.dropped[static_cast<std::size_t>(cause)]; }

  Film::Settings settings_ = sized(1, 1);
  RenderCounters counters_;
};

TEST_F(Admission, CountsEachCauseOfADrop) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(admits({0, nan, 0}));
  EXPECT_FALSE(admits({nan, kInfinity, 0}));  // not a number comes first
  EXPECT_FALSE(admits({kInfinity, 0, 0}));
  EXPECT_FALSE(admits({0, 0, -kInfinity}));
  EXPECT_FALSE(admits({0, -1, 0}));
  EXPECT_EQ(dropped(DropCause::NotANumber), 2u);
  EXPECT_EQ(dropped(DropCause::Infinite), 2u);
  EXPECT_EQ(dropped(DropCause::Negative), 1u);
}

TEST_F(Admission, KeepsNegativesWhereEstimatorsHaveThem) {
  settings_.maxSampleLuminance = 2;
  Film film(settings_, *box());
  film.keepNegatives();
  Rgb below(-1), farBelow(-8), notANumber(std::numeric_limits<float>::quiet_NaN()), infinite(-kInfinity);
  EXPECT_TRUE(film.admit(below, counters_));
  EXPECT_EQ(below, Rgb(-1));
  EXPECT_TRUE(film.admit(farBelow, counters_));
  EXPECT_FLOAT_EQ(farBelow.luminance(), -2);
  EXPECT_FALSE(film.admit(notANumber, counters_));
  EXPECT_FALSE(film.admit(infinite, counters_));
  EXPECT_EQ(dropped(DropCause::Negative), 0u);

  SamplePass pass(film.sampleBounds(), 2);
  pass.at({0, 0}, 0) = {{.5f, .5f}, Rgb(-3), true};
  pass.at({0, 0}, 1) = {{.5f, .5f}, Rgb(1), true};
  film.accumulate(pass);
  EXPECT_EQ(film.develop().rgb(0, 0), Rgb(-1)) << "their mean, not the mean of what is positive";
}

TEST_F(Admission, LetsRoundingLeftoversAndCancellingChannelsPass) {
  EXPECT_TRUE(admits(Rgb(-0.9e-5f)));
  EXPECT_FALSE(admits(Rgb(-1.1e-5f)));
  EXPECT_TRUE(admits({-1, 1, 0}));  // luminance 0.5
  EXPECT_TRUE(admits(Rgb(0)));
  EXPECT_TRUE(admits(Rgb(1e30f)));
  EXPECT_EQ(counters_.droppedTotal(), 1u);
}

TEST_F(Admission, ScalesBrightSamplesDownToTheLimit) {
  settings_.maxSampleLuminance = 10;
  Rgb bright(50, 100, 200), dim(5);
  const float luminance = bright.luminance();
  EXPECT_TRUE(admit(bright));
  EXPECT_TRUE(admit(dim));
  EXPECT_NEAR(bright.luminance(), 10, 1e-4);
  EXPECT_FLOAT_EQ(bright.r, 50 * 10 / luminance);
  EXPECT_EQ(dim, Rgb(5));
  EXPECT_EQ(counters_.droppedTotal(), 0u);
}

/// Light paths of an image of one pixel: each brings two splats, u and u², of one random number. So a path
/// brings u + u², whose mean is 5/6 and whose variance 1/12 + 2 (1/4 - 1/6) + 4/45 = 61/180.
constexpr double kVarianceOfPath = 61.0 / 180;
std::vector<SplatBuffer> randomPaths(Rng& rng, int count) {
  std::vector<SplatBuffer> units(1);
  for (int i = 0; i < count; ++i) {
    const float u = rng.uniform();
    units[0].begin(static_cast<std::uint64_t>(i), i % 2 != 0);
    units[0].add({.5f, .5f}, Rgb(u));
    units[0].add({.25f, .75f}, Rgb(u * u));
  }
  return units;
}

TEST(Splats, HaveHalvesThatTellTheErrorWithoutTheTruth) {
  Rng rng(11);
  for (const int paths : {2, 3, 8}) {
    test::RunningStats squares;
    for (int trial = 0; trial < 8000; ++trial) {
      Film film(sized(1, 1), *box());
      film.keepHalves();
      const auto count = static_cast<std::uint64_t>(paths);
      film.addSplats(randomPaths(rng, paths), {count, 1}, count / 2);
      const double d = static_cast<double>(film.develop().rgb(0, 0).r) -
                       static_cast<double>(film.surrogateReference().rgb(0, 0).r);
      squares.add(d * d);
    }
    const test::ZTest z = test::zTest(squares, kVarianceOfPath / paths, 11);
    EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << z;
  }
}

TEST(Splats, AddTheirErrorToThatOfSamples) {
  // A sample and a light path of each index, both with noise of their own.
  Rng rng(12);
  test::RunningStats squares;
  for (int trial = 0; trial < 20000; ++trial) {
    Film film(sized(1, 1), *box());
    film.keepHalves();
    SamplePass pass(film.sampleBounds(), 3);
    for (int s = 0; s < 3; ++s) setSample(pass, {0, 0}, s, {.5f, .5f}, Rgb(rng.uniform()));
    film.accumulate(pass);
    film.addSplats(randomPaths(rng, 3), {3, 1}, 1);
    const double d = static_cast<double>(film.develop().rgb(0, 0).r) -
                     static_cast<double>(film.surrogateReference().rgb(0, 0).r);
    squares.add(d * d);
  }
  const test::ZTest z = test::zTest(squares, (1.0 / 12 + kVarianceOfPath) / 3, 12);
  EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << z;
}

TEST(Splats, HaveAVarianceOfWhatWholePathsBring) {
  Rng rng(13);
  for (const int paths : {2, 3, 8}) {
    test::RunningStats variances;
    for (int trial = 0; trial < 8000; ++trial) {
      Film::Settings settings = sized(1, 1);
      settings.layers = LayerSet(maskOf({Layer::Variance}));
      settings.scale = 2;
      Film film(settings, *box());
      film.addSplats(randomPaths(rng, paths), {static_cast<std::uint64_t>(paths), 1});
      variances.add(film.develop().at(0, 0, 3));
    }
    const test::ZTest z = test::zTest(variances, 4 * kVarianceOfPath / paths, 13);
    EXPECT_LT(std::abs(z.z()), test::kMaxAbsZ) << z;
  }
  // That of splats by themselves would be 1/12 + 4/45: no test of these numbers takes one for the other.
  EXPECT_LT(1.0 / 12 + 4.0 / 45, .6 * kVarianceOfPath) << "negative control";
}

TEST(Splats, OfPartsAddUpToThoseOfAll) {
  Film::Settings settings = sized(1, 1);
  settings.layers = LayerSet(maskOf({Layer::Variance, Layer::Samples}));
  Film whole(settings, *box()), first(settings, *box());
  for (Film* film : {&whole, &first}) film->keepHalves();
  Rng a(14), b(14);
  first.addSplats(randomPaths(b, 4), {4, 1}, 2);
  whole.addSplats(randomPaths(a, 4), {4, 1}, 2);
  Film second(settings, *box());
  second.keepHalves();
  ASSERT_TRUE(second.restore(first.state()));
  Film::State odd = first.state();
  odd.oddSplats.clear();
  EXPECT_FALSE(second.restore(odd)) << "halves of a part of it";
  for (Film* film : {&whole, &second}) film->addSplats(randomPaths(film == &whole ? a : b, 4), {4, 1}, 2);
  EXPECT_EQ(whole.state(), second.state());
  // As a file keeps them: three numbers for splats and three for their squares behind those of the layers.
  const OtherSums order(settings.layers, true);
  const std::vector<double> others = whole.otherSums();
  ASSERT_EQ(others.size(), order.count());
  const PixelParts parts = order.parts(whole.state().sums[0], others);
  EXPECT_EQ(parts.splats, whole.state().splats[0]);
  EXPECT_EQ(parts.splatSquares, whole.state().splatSquares[0]);
}

}  // namespace
}  // namespace pbrtmedia
