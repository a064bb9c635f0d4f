// SPDX-License-Identifier: BSD-2-Clause
#include "film/layers.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "base/rng.h"
#include "film/film.h"
#include "film/layer_sums.h"
#include "filters/box.h"
#include "filters/gaussian.h"
#include "support/statistics.h"

namespace pbrtmedia::test {
namespace {

Film::Settings sized(int width, int height, const LayerMask& layers = {}) {
  Film::Settings s;
  s.resolution = {width, height};
  s.layers = LayerSet(layers);
  return s;
}

BoxFilter box() { return BoxFilter({.radius = {.5f, .5f}}); }

/// One sample of each pixel of each index: set(pixel, index, sample, layers).
template <class Set>
SamplePass passOf(const Film& film, int samples, const Set& set) {
  SamplePass pass(film.sampleBounds(), samples, film.layers());
  const Bounds2i b = film.sampleBounds();
  for (int i = 0; i < samples; ++i) {
    for (int y = b.min.y; y < b.max.y; ++y) {
      for (int x = b.min.x; x < b.max.x; ++x) {
        pass.at({x, y}, i) = {{.5f, .5f}, Rgb(0), true};
        set(Point2i{x, y}, i, pass.at({x, y}, i), pass.layersAt({x, y}, i));
      }
    }
  }
  return pass;
}

TEST(Layers, HaveNamesAndChannelsOfTheirOwn) {
  std::set<std::string_view> names, channels = {"R", "G", "B"};
  for (std::size_t i = 0; i < kLayerCount; ++i) {
    EXPECT_TRUE(names.insert(kLayers[i].name).second) << kLayers[i].name;
    for (std::size_t c = 0; c < kLayers[i].channelCount(); ++c)
      EXPECT_TRUE(channels.insert(kLayers[i].channels[c]).second) << kLayers[i].channels[c];
    EXPECT_EQ(layerOfName(kLayers[i].name), static_cast<Layer>(i));
  }
  EXPECT_FALSE(layerOfName("colour"));
  EXPECT_EQ(LayerSet(maskOf({Layer::Normal, Layer::Alpha})).text(), "alpha,normal");
}

TEST(Layers, AreMeansUnderTheFilterAsColoursAre) {
  Film film(sized(6, 5, maskOf({Layer::Alpha, Layer::Emission})), GaussianFilter({}));
  Rng rng(3);
  film.accumulate(passOf(film, 3, [&](Point2i, int, SamplePass::Sample& sample, const LayerSample& layers) {
    sample.radiance = Rgb(rng.uniform());
    sample.offset = {rng.uniform(), rng.uniform()};
    layers.set(Layer::Alpha, sample.radiance.r);
    layers.set(Layer::Emission, sample.radiance);
  }));
  const Image image = film.develop();
  ASSERT_EQ(image.channelCount(), 7u);
  for (int y = 0; y < 5; ++y) {
    for (int x = 0; x < 6; ++x) {
      for (std::size_t c = 3; c < 7; ++c) EXPECT_FLOAT_EQ(image.at(x, y, c), image.at(x, y, 0));
    }
  }
}

TEST(Layers, WeightedOnesAreMeansOfSamplesThatHaveAValue) {
  Film film(sized(2, 1, maskOf({Layer::Depth, Layer::Position})), box());
  film.accumulate(passOf(film, 4, [&](Point2i p, int i, SamplePass::Sample&, const LayerSample& layers) {
    if (p.x == 1 || i == 0) return;  // pixel 0 has three samples with weights 1, 2 and 3
    layers.set(Layer::Depth, static_cast<float>(10 * i), static_cast<float>(i));
    layers.set(Layer::Position, Vector3f(1, 2, 4), 1);
  }));
  const Image image = film.develop();
  EXPECT_FLOAT_EQ(image.at(0, 0, 3), (10.0f + 40 + 90) / 6);
  EXPECT_EQ(image.at(1, 0, 3), 0) << "nothing there";
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(image.at(0, 0, 4 + c), static_cast<float>(1 << c));
}

TEST(Layers, TotalsAreOfThePixelsOwnSamplesWhateverTheFilter) {
  // Also where the filter is narrower than the pixel, and does not take them all.
  for (const float radius : {.2f, .5f, 1.7f}) {
    Film film(sized(3, 2, maskOf({Layer::Lookups})), BoxFilter({.radius = {radius, radius}}));
    film.accumulate(
        passOf(film, 5, [&](Point2i p, int i, SamplePass::Sample& sample, const LayerSample& layers) {
          sample.offset = {.9f, .1f};
          layers.set(Layer::Lookups, static_cast<float>(100 * p.y + 10 * p.x + i));
        }));
    const Image image = film.develop();
    for (int y = 0; y < 2; ++y) {
      for (int x = 0; x < 3; ++x)
        EXPECT_EQ(image.at(x, y, 3), 5.0f * static_cast<float>(100 * y + 10 * x) + 10);
    }
  }
}

TEST(Layers, SamplesThatWereNotTakenCountNowhere) {
  Film film(sized(2, 1, maskOf({Layer::Samples, Layer::Alpha, Layer::Variance})), box());
  film.accumulate(
      passOf(film, 4, [&](Point2i p, int i, SamplePass::Sample& sample, const LayerSample& layers) {
        sample.valid = p.x == 0 || i < 3;
        sample.radiance = Rgb(static_cast<float>(i));
        layers.set(Layer::Samples, 1.0f);
        layers.set(Layer::Alpha, 0.25f);
      }));
  const Image image = film.develop();
  EXPECT_EQ(image.channels()[6], "samples");
  EXPECT_EQ(image.at(0, 0, 6), 4);
  EXPECT_EQ(image.at(1, 0, 6), 3);
  EXPECT_EQ(image.at(1, 0, 7), .25f);
  EXPECT_FLOAT_EQ(image.at(0, 0, 3), 5.0f / 12) << "0 1 2 3: s^2 = 5/3 over 4 samples";
  EXPECT_FLOAT_EQ(image.at(1, 0, 3), 1.0f / 3);
}

TEST(Layers, PartsOfTheRadianceAreScaledAndStayNegative) {
  Film::Settings settings = sized(1, 1, maskOf({Layer::Direct, Layer::Indirect, Layer::Variance}));
  settings.scale = 3;
  Film film(settings, box());
  film.accumulate(passOf(film, 2, [&](Point2i, int i, SamplePass::Sample& sample, const LayerSample& layers) {
    sample.radiance = Rgb(i == 0 ? 1 : 2);
    layers.set(Layer::Direct, Rgb(-1));
    layers.set(Layer::Indirect, sample.radiance + Rgb(1));
  }));
  const Image image = film.develop();
  const auto at = [&](const char* name) { return image.at(0, 0, *image.channelIndex(name)); };
  EXPECT_EQ(at("R"), 4.5f);
  EXPECT_EQ(at("direct.R"), -3);
  EXPECT_EQ(at("direct.R") + at("indirect.R"), at("R"));
  EXPECT_EQ(at("variance.R"), 9 * .25f) << "s^2 = 1/2 over 2 samples, times the scale's square";
}

TEST(Layers, OneSampleTellsNothingOfItsVariance) {
  Film film(sized(1, 1, maskOf({Layer::Variance})), box());
  EXPECT_EQ(film.develop().at(0, 0, 3), 0);
  film.accumulate(
      passOf(film, 1, [](Point2i, int, SamplePass::Sample& s, const LayerSample&) { s.radiance = Rgb(7); }));
  EXPECT_EQ(film.develop().at(0, 0, 3), 0);
}

/// Films of `n` independent samples of one pixel, L = u^3 at even places: the mean and its estimated
/// variance.
struct Estimates {
  RunningStats means, variances;
};
template <class FilterT>
Estimates estimates(const FilterT& filter, int n, std::uint64_t seed, int films = 1 << 15) {
  Estimates e;
  Rng rng(seed);
  for (int i = 0; i < films; ++i) {
    Film film(sized(1, 1, maskOf({Layer::Variance})), filter);
    film.accumulate(passOf(film, n, [&](Point2i, int, SamplePass::Sample& sample, const LayerSample&) {
      const float u = rng.uniform();
      sample.radiance = Rgb(u * u * u, u, 1 - u);
      sample.offset = {rng.uniform(), rng.uniform()};
    }));
    const Image image = film.develop();
    e.means.add(image.at(0, 0, 0));
    e.variances.add(image.at(0, 0, 3));
  }
  return e;
}
/// Of u^3: E u^6 - (E u^3)^2.
constexpr double kVarianceOfCube = 1.0 / 7 - 1.0 / 16;

TEST(VarianceLayer, IsUnbiasedForAnyNumberOfSamples) {
  for (const int n : {2, 3, 16}) {
    const ZTest test = zTest(estimates(box(), n, 5).variances, kVarianceOfCube / n, 5);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << n << ": " << test;
    EXPECT_TRUE(test.sees(.05)) << test;
  }
}

TEST(VarianceLayer, TestSeesTheFactorOfTheSamplesMean) {
  // Over n instead of n - 1.
  RunningStats biased;
  Rng rng(5);
  for (int i = 0; i < 1 << 14; ++i) {
    RunningStats samples;
    for (int k = 0; k < 3; ++k) {
      const float u = rng.uniform();
      samples.add(u * u * u);
    }
    biased.add(samples.variance() * 2 / 3 / 3);
  }
  const ZTest test = zTest(biased, kVarianceOfCube / 3, 5);
  EXPECT_GT(std::abs(test.z()), kMaxAbsZ) << test;
}

TEST(VarianceLayer, IsThatOfWeightedMeansUnderWideFilters) {
  // The filter reaches the neighbours' samples, with weights of their own: against the variance of the mean
  // over films, whose relative error is about sqrt(2 / films).
  const int films = 1 << 15;
  const Estimates e = estimates(GaussianFilter({}), 4, 11, films);
  const double truth = e.means.variance(), error = truth * std::sqrt(2.0 / films);
  const double z = (e.variances.mean() - truth) / std::hypot(error, e.variances.standardError());
  EXPECT_LT(std::abs(z), kMaxAbsZ) << e.variances.mean() << " for " << truth << " +- " << error;
  // Negative control: as if all weights were one.
  const double unweighted = kVarianceOfCube / (4 * 25);
  EXPECT_GT(std::abs(unweighted - truth) / error, kMaxAbsZ);
}

TEST(LayerSample, FollowsWhatIsDoneToTheRadiance) {
  const LayerSet set(maskOf({Layer::Variance, Layer::Samples, Layer::Alpha, Layer::Depth, Layer::Medium}));
  std::vector<float> values(set.sampleSize());
  const LayerSample sample(set, values.data());
  sample.set(Layer::Samples, 1.0f);
  sample.set(Layer::Alpha, 0.5f);
  sample.set(Layer::Depth, 3, .25f);
  sample.set(Layer::Medium, Rgb(1, 2, 3));
  sample.set(Layer::Surface, Rgb(9));  // nobody asked
  EXPECT_EQ(values, (std::vector<float>{1, .5f, 3, .25f, 1, 2, 3}));
  sample.scaleRadiance(2);
  EXPECT_EQ(values, (std::vector<float>{1, .5f, 3, .25f, 2, 4, 6}));
  sample.drop();
  EXPECT_EQ(values, (std::vector<float>{1, 0, 0, 0, 0, 0, 0}));
}

TEST(Layers, CostNothingWhereNobodyAsksForThem) {
  Film film(sized(6, 5), box());
  SamplePass pass(film.sampleBounds(), 1, film.layers());
  EXPECT_EQ(pass.layerValues({0, 0}, 0), nullptr);
  EXPECT_FALSE(pass.layersAt({0, 0}, 0).isWanted());
  EXPECT_FALSE(pass.layersAt({0, 0}, 0).wants(Layer::Lookups));
  pass.layersAt({0, 0}, 0).set(Layer::Lookups, 3.0f);
  pass.layersAt({0, 0}, 0).drop();
  film.accumulate(pass);
  EXPECT_TRUE(film.state().layers.empty());
  EXPECT_EQ(film.develop().channelCount(), 3u);
}

}  // namespace
}  // namespace pbrtmedia::test
