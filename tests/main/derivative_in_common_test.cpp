// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of images whose samples follow from those before, which both sides must have in common: chains,
// radii, bounds that are learned.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "fields/learned_bounds.h"
#include "support/derivative_of.h"
#include "support/render_scene.h"
#include "support/statistics.h"

namespace pbrtmedia::test {
namespace {

/// Of sums of images times factors of some thousands.
constexpr float kRounding = 1e-3f;

// ---- mlt

const std::string kChains =
    "\"mlt\" \"integer bootstrapsamples\" 2000 \"integer chains\" 60 \"integer mutationsperpixel\" 16 ";

/// A white plane under a point light at (x, 0, 2), seen from above between -1 and 1.
Text litPlane(const std::string& integrator) {
  return [integrator](const std::string& x) {
    return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\nSampler \"random\"\n"
           "Integrator " +
           integrator +
           " \"integer maxdepth\" 1\nLookAt 0 0 5  0 0 0  0 1 0\n"
           "Camera \"orthographic\" \"float screenwindow\" [ -1 1 -1 1 ]\nWorldBegin\n"
           "Material \"matte\" \"rgb Kd\" [ 1 1 1 ]\nLightSource \"point\" \"point from\" [ " +
           x +
           " 0 2 ] \"rgb I\" [ 3.14159274 3.14159274 3.14159274 ]\n"
           "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -90 -90 0 90 -90 0 90 "
           "90 "
           "0 -90 90 0 ]\nWorldEnd\n";
  };
}
/// The mean of what is seen, by the midpoint rule.
double seenMean(double x) {
  constexpr int kCells = 200;
  double sum = 0;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const double dx = (2 * i + 1.0) / kCells - 1 - x, dy = (2 * j + 1.0) / kCells - 1;
      sum += 2 / std::pow(dx * dx + dy * dy + 4, 1.5);
    }
  }
  return sum / (kCells * kCells);
}

TEST(DerivativeOfChains, OfALightThatMovesIsThatOfItsIrradiance) {
  constexpr int kPasses = 16;
  const double x = 1.5, h = .25, slope = (seenMean(x + .001) - seenMean(x - .001)) / .002;
  const auto expectMean = [&](const DifferenceSchedule::Params& params, double expected, double share) {
    const ZTest z = zTest(means(litPlane(kChains), params, kPasses, 16), expected);
    EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
    EXPECT_TRUE(z.sees(share)) << z;
    return z;
  };
  expectMean({.value = x, .step = h}, (seenMean(x + h) - seenMean(x)) / h, .05);
  expectMean({.value = x, .step = h, .difference = Difference::Central},
             (seenMean(x + h) - seenMean(x - h)) / (2 * h), .05);
  // Chains start again in each pass, and have other scenes.
  expectMean({.value = x, .step = h, .debias = Debias::Single}, slope, .3);
  double shrinking = 0;
  for (int k = 1; k <= kPasses; ++k) {
    const double step = h * std::pow(k, -DifferenceSchedule::kDecay);
    shrinking += (seenMean(x + step) - seenMean(x)) / step / kPasses;
  }
  expectMean({.value = x, .step = h, .debias = Debias::Progressive}, shrinking, .05);
}

/// Fog and a ball that moves into the light: on either side of a difference there are paths that the other
/// lacks.
Text shadedFog(const std::string& integrator) {
  return [integrator](const std::string& x) {
    return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\nPixelFilter \"box\"\nSampler "
           "\"random\"\nIntegrator " +
           integrator +
           " \"integer maxdepth\" 2\nLookAt 0 -5 0  0 0 0  0 0 1\nCamera \"orthographic\" \"float "
           "screenwindow\" [ -1 1 "
           "-1 1 ]\nWorldBegin\nMakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 "
           ".1 "
           ".1 ] "
           "\"rgb sigma_s\" [ .6 .6 .6 ]\nLightSource \"point\" \"point from\" [ 0 -.2 2.5 ] \"rgb I\" [ 20 "
           "20 20 ]\n"
           "AttributeBegin Translate 0 0 -1.2 Material \"matte\" \"rgb Kd\" [ .8 .8 .8 ] Shape \"disk\" "
           "\"float radius\" 4 AttributeEnd\n"
           "AttributeBegin Material \"none\" MediumInterface \"m\" \"\" Shape \"sphere\" \"float radius\" .9 "
           "AttributeEnd\n"
           "AttributeBegin Translate " +
           x +
           " 0 1.5 Material \"matte\" \"rgb Kd\" [ .5 .5 .5 ] Shape \"sphere\" \"float radius\" .4 "
           "AttributeEnd\nWorldEnd\n";
  };
}

TEST(DerivativeOfChains, IsThatOfBdpt) {
  const DifferenceSchedule::Params params{.value = .6, .step = -.4};
  const RunningStats truth = means(shadedFog("\"bdpt\""), params, 256, 8);
  const ZTest same = zTest(means(shadedFog(kChains), params, 128, 16), truth);
  EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  EXPECT_TRUE(same.sees(.25)) << same;
  // Negative control: that to the other side.
  const ZTest other = zTest(means(shadedFog(kChains), {.value = .6, .step = .4}, 128, 16), truth);
  EXPECT_GT(std::abs(other.z()), kMaxAbsZ) << other;
}

/// What the parameter has no effect on is the same on both sides, whatever chains do.
TEST(DerivativeOfChains, IsNothingWhereNothingChanges) {
  const Text text = [](const std::string& x) {
    std::string scene = litPlane(kChains)("1");
    const std::string hidden =
        "AttributeBegin Translate 0 0 -3 Shape \"sphere\" \"float radius\" " + x + " AttributeEnd\n";
    return scene.insert(scene.rfind("WorldEnd"), hidden);
  };
  for (const Debias debias : {Debias::None, Debias::Single}) {
    const Derivative d =
        derivativeOf(text, {.difference = {.value = .5, .step = .25, .debias = debias}, .samplesPerPass = 2},
                     {.seed = 3, .samplesPerPixel = 8});
    EXPECT_TRUE(std::ranges::all_of(d.image.data(), [](float v) { return std::abs(v) < kRounding; }));
    EXPECT_EQ(d.result.samplesTaken, 16u * 8);
    EXPECT_FALSE(d.result.interrupted);
  }
}

TEST(DerivativeOfChains, DoesNotDependOnThreads) {
  for (const Debias debias : {Debias::None, Debias::Progressive}) {
    const DerivativeOptions options{.difference = {.value = .6, .step = -.4, .debias = debias},
                                    .samplesPerPass = 3};
    const auto with = [&](unsigned threads) {
      return derivativeOf(shadedFog(kChains), options, {.seed = 7, .threads = threads, .samplesPerPixel = 8})
          .image;
    };
    EXPECT_EQ(with(1).data(), with(3).data());
  }
}

/// What both sides have in common is in the state between passes.
void expectGoesOn(const Text& text, const DerivativeOptions& options, const RenderSettings& settings) {
  const Derivative whole = derivativeOf(text, options, settings),
                   part = derivativeOf(text, options, settings, nullptr, 2),
                   rest = derivativeOf(text, options, settings, &part.state);
  EXPECT_EQ(whole.image.data(), rest.image.data());
  EXPECT_NE(whole.image.data(), part.image.data());
}

TEST(DerivativeOfChains, GoesOnFromAStateToTheSameBits) {
  for (const Debias debias : {Debias::None, Debias::Single}) {
    expectGoesOn(shadedFog(kChains),
                 {.difference = {.value = .6, .step = -.4, .debias = debias}, .samplesPerPass = 2},
                 {.seed = 7, .samplesPerPixel = 8});
  }
}

// ---- sppm with radii of its own

/// A plane with a wall beside it, under a lamp of intensity x.
std::string litCorner(const std::string& x, const std::string& debias = "") {
  return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\nSampler \"random\"\nIntegrator "
         "\"sppm\" \"integer maxdepth\" 3 \"integer photonsperiteration\" 500 \"float radius\" .5 " +
         debias +
         "\nLookAt 0 -4 2  0 0 .5  0 0 1\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n"
         "LightSource \"point\" \"point from\" [ 0 -1 1 ] \"rgb I\" [ " +
         x + ' ' + x + ' ' + x +
         " ]\nMaterial \"matte\" \"rgb Kd\" [ .6 .6 .6 ]\n"
         "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 0 2 -2 0 2 1 0 -2 1 "
         "0 ]\n"
         "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 1 0 2 1 0 2 1 3 -2 1 3 "
         "]\n"
         "WorldEnd\n";
}
std::string litCornerWithRadii(const std::string& x) { return litCorner(x); }

/// What is in proportion to the parameter has the image at 1 as its derivative, if both sides have its radii.
TEST(DerivativeOfPhotons, OfTheLampIsTheImageAtTheRadiiOfTheValue) {
  constexpr std::int64_t kIterations = 6;
  const RenderSettings settings{.seed = 4, .samplesPerPixel = kIterations};
  for (const Difference difference : {Difference::Forward, Difference::Central}) {
    const Derivative d = derivativeOf(
        litCornerWithRadii,
        {.difference = {.value = 1, .step = .5, .difference = difference}, .samplesPerPass = 4}, settings);
    const Image image = renderText(litCorner("1"), settings).image;
    for (std::size_t i = 0; i < image.data().size(); ++i)
      EXPECT_NEAR(d.image.data()[i], image.data()[i], 2e-5f * image.data()[i]) << i;
    EXPECT_EQ(d.result.samplesTaken, 16u * kIterations);
  }
  EXPECT_GT(imageMean(renderText(litCorner("1"), settings).image), 0);
}

/// A lamp that is dark at the value: no photons are found there, so no radius shrinks on either side.
TEST(DerivativeOfPhotons, HasTheRadiiOfTheValueOnBothSides) {
  constexpr std::int64_t kIterations = 6;
  const RenderSettings settings{.seed = 4, .samplesPerPixel = kIterations};
  const Derivative d = derivativeOf(litCornerWithRadii,
                                    {.difference = {.value = 0, .step = 1}, .samplesPerPass = 2}, settings);
  const auto radii = [](const std::vector<double>& carried) { return carried[0]; };
  EXPECT_DOUBLE_EQ(radii(d.result.carried), .25) << "the square of the first radius";
  const double own = imageMean(renderText(litCorner("1"), settings).image);
  EXPECT_GT(std::abs(imageMean(d.image) - own), 1e-3 * own)
      << "radii that shrink, as those of the other side would, make another image";
}

TEST(DerivativeOfPhotons, DoesNotDependOnThreads) {
  const DerivativeOptions options{.difference = {.value = 1, .step = .5, .debias = Debias::Progressive},
                                  .samplesPerPass = 2};
  const auto with = [&](unsigned threads) {
    return derivativeOf(litCornerWithRadii, options, {.seed = 4, .threads = threads, .samplesPerPixel = 6})
        .image;
  };
  EXPECT_EQ(with(1).data(), with(3).data());
}

TEST(DerivativeOfPhotons, GoesOnFromAStateToTheSameBits) {
  expectGoesOn(litCornerWithRadii,
               {.difference = {.value = 1, .step = .5, .debias = Debias::Single}, .samplesPerPass = 2},
               {.seed = 4, .samplesPerPixel = 6});
}

// ---- Bounds that are learned

/// White light through a slab of unit thickness, of densities 0.2 to 1 and optical depth 0.6 x.
Text learnedSlab(const std::string& more) {
  return [more](const std::string& x) {
    return pencil(8, 1, "\"volpath\"", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .3) + "WorldBegin\n" +
           kWhiteEnvironment +
           "MakeNamedMedium \"m\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" [ 1 1 1 ] \"float scale\" " + x +
           " \"string type\" \"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 \"float "
           "density\" [ .2 1 ] \"point p0\" [ 0 0 0 ] \"point p1\" [ 1 1 1 ] \"string border\" \"clamp\" "
           "\"string transmittance\" \"ratio\" \"string bounds\" \"progressive\" " +
           more + '\n' + mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
  };
}

TEST(DerivativeUnderLearnedBounds, OfADensityIsThatOfTheTransmittance) {
  const double x = 1.25, h = .5, depth = .6,
               difference = (std::exp(-depth * (x + h)) - std::exp(-depth * x)) / h;
  const ZTest test = zTest(means(learnedSlab(""), {.value = x, .step = h}, 128, 16), difference);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees(.15)) << test;
  EXPECT_GT(std::abs(test.mean + depth * std::exp(-depth * x)), kMaxAbsZ * test.standardError)
      << "negative control: that of no step " << test;
}

/// What is in front of a slab whose bounds are still rising: where the parameter changes nothing, nothing
/// differs, whichever scenes are built and dropped on the way.
TEST(DerivativeUnderLearnedBounds, IsNothingWhereNothingChanges) {
  const Text text = [](const std::string& x) {
    std::string scene = learnedSlab("\"integer warmup\" 0")("2");
    return scene.insert(
        scene.rfind("WorldEnd"),
        "AttributeBegin Translate 9 0 -4 Shape \"sphere\" \"float radius\" " + x + " AttributeEnd\n");
  };
  for (const Debias debias : {Debias::None, Debias::Single, Debias::Progressive}) {
    const Derivative d =
        derivativeOf(text, {.difference = {.value = .5, .step = .25, .debias = debias}, .samplesPerPass = 2},
                     {.seed = 3, .samplesPerPixel = 8});
    EXPECT_TRUE(std::ranges::all_of(d.image.data(), [](float v) { return std::abs(v) < kRounding; }))
        << static_cast<int>(debias);
  }
}

/// A density that the parameter scales: bounds learned at either side hold on both. The scene at the value is
/// no side of central differences, and learns all the same.
TEST(DerivativeUnderLearnedBounds, LearnsFromBothSides) {
  const Text text = [](const std::string& x) {
    return pencil(8, 1, "\"volpath\"", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .3) + "WorldBegin\n" +
           kWhiteEnvironment +
           "MakeNamedMedium \"m\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" [ 1 1 1 ] \"string type\" "
           "\"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 1 \"float density\" [ " +
           x +
           " ] \"point p0\" [ 0 0 0 ] \"point p1\" [ 1 1 1 ] \"string border\" \"clamp\" \"string bounds\" "
           "\"progressive\" \"integer warmup\" 0\n" +
           mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
  };
  for (const Difference difference : {Difference::Forward, Difference::Central}) {
    const Derivative d = derivativeOf(
        text, {.difference = {.value = 1, .step = .5, .difference = difference}, .samplesPerPass = 4},
        {.seed = 3, .samplesPerPixel = 32});
    ASSERT_EQ(d.result.learning.size(), 1u);
    ASSERT_EQ(d.result.learning[0].passes.size(), 32u);
    EXPECT_GT(d.result.learning[0].passes.back().maximum, 1.5f);
    EXPECT_GT(d.result.learning[0].passes.front().shortfall, 0) << "the first bounds cut nearly all";
  }
}

TEST(DerivativeUnderLearnedBounds, IsRefusedWhereSuperVoxelsAreOthers) {
  const Text text = [](const std::string& x) {
    return learnedSlab(std::stod(x) > 1.3 ? "\"integer supervoxels\" 0" : "\"integer supervoxels\" 2")(x);
  };
  try {
    derivativeOf(text, {.difference = {.value = 1.25, .step = .5}, .samplesPerPass = 1},
                 {.seed = 3, .samplesPerPixel = 2});
    ADD_FAILURE() << "both sides cannot share bounds";
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find("how many super-voxels"), std::string::npos) << e.what();
  }
}

}  // namespace
}  // namespace pbrtmedia::test
