// SPDX-License-Identifier: BSD-2-Clause
// Derivatives of images against closed forms.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <sstream>
#include <string>

#include "support/derivative_of.h"
#include "support/render_scene.h"
#include "support/statistics.h"

namespace pbrtmedia::test {
namespace {

/// Down at the origin of the plane z = 0, from (0, 0, 5).
std::string lookingDown(int resolution, const std::string& integrator) {
  return pencil(resolution, 1, integrator, "LookAt 0 0 5  0 0 0  0 1 0", 1e-5) + "WorldBegin\n";
}

const std::string kPlane =
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -90 -90 0 90 -90 0 90 90 0 -90 "
    "90 "
    "0 ]\nWorldEnd\n";

/// A point light of intensity pi at (x, 0, 2) over a white plane: x shifts it.
std::string movedLight(const std::string& x) {
  return lookingDown(2, "\"path\" \"integer maxdepth\" 1") + "Material \"matte\" \"rgb Kd\" [ 1 1 1 ]\n" +
         "LightSource \"point\" \"point from\" [ " + x +
         " 0 2 ] \"rgb I\" [ 3.14159274 3.14159274 3.14159274 ]\n" + kPlane;
}
double litByMovedLight(double x) { return 2 / std::pow(x * x + 4, 1.5); }
double slopeOfMovedLight(double x) { return -6 * x / std::pow(x * x + 4, 2.5); }
double secondOfMovedLight(double x) { return 6 * (4 * x * x - 4) / std::pow(x * x + 4, 3.5); }

TEST(Derivative, OfALightThatMovesIsThatOfItsIrradiance) {
  const double x = 1.5, h = .0625, slope = slopeOfMovedLight(x);
  const double forward = meanOf(movedLight, {.value = x, .step = h}),
               difference = (litByMovedLight(x + h) - litByMovedLight(x)) / h;
  EXPECT_LT(slope, 0) << "the sign stays";
  EXPECT_NEAR(forward, difference, 3e-6);
  // Which is off by h / 2 f''.
  const double bias = h / 2 * secondOfMovedLight(x);
  EXPECT_NEAR(forward - slope, bias, .1 * std::abs(bias));
  const double central = meanOf(movedLight, {.value = x, .step = h, .difference = Difference::Central});
  EXPECT_NEAR(central, (litByMovedLight(x + h) - litByMovedLight(x - h)) / (2 * h), 3e-6);
  EXPECT_LT(std::abs(central - slope), .1 * std::abs(bias));
}

/// Without noise of its own; that of the levels is all there is.
TEST(Derivative, OfALightThatMovesIsDebiased) {
  const double x = 1.5, h = .25, slope = slopeOfMovedLight(x);
  const ZTest single =
      zTest(means(movedLight, {.value = x, .step = h, .debias = Debias::Single}, 64, 24), slope);
  EXPECT_LT(std::abs(single.z()), kMaxAbsZ) << single;
  EXPECT_TRUE(single.sees()) << single;
  const double none = meanOf(movedLight, {.value = x, .step = h}, 1);
  EXPECT_GT(std::abs(none - slope), 2 * kMaxAbsZ * single.standardError) << "one step is seen to be biased";
}

/// The plane of `movedLight`, seen from above between -1 and 1.
std::string seenByBdpt(const std::string& x) {
  return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\nSampler \"random\"\n"
         "Integrator \"bdpt\" \"integer maxdepth\" 1\nLookAt 0 0 5  0 0 0  0 1 0\n"
         "Camera \"orthographic\" \"float screenwindow\" [ -1 1 -1 1 ]\nWorldBegin\n"
         "Material \"matte\" \"rgb Kd\" [ 1 1 1 ]\nLightSource \"point\" \"point from\" [ " +
         x + " 0 2 ] \"rgb I\" [ 3.14159274 3.14159274 3.14159274 ]\n" + kPlane;
}
/// The mean of what is seen, by the midpoint rule.
double seenMean(double x) {
  constexpr int kCells = 400;
  double sum = 0;
  for (int j = 0; j < kCells; ++j) {
    for (int i = 0; i < kCells; ++i) {
      const double dx = (2 * i + 1.0) / kCells - 1 - x, dy = (2 * j + 1.0) / kCells - 1;
      sum += 2 / std::pow(dx * dx + dy * dy + 4, 1.5);
    }
  }
  return sum / (kCells * kCells);
}

TEST(Derivative, OfBdptHasThatOfItsLightPaths) {
  const double x = 1.5, h = .0625, difference = (seenMean(x + h) - seenMean(x)) / h;
  const ZTest z = zTest(means(seenByBdpt, {.value = x, .step = h}, 64, 24), difference);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
  EXPECT_TRUE(z.sees()) << z;
}

/// The matte material of Oren and Nayar, seen along the normal: Kd / pi A(sigma), sigma in degrees.
std::string roughened(const std::string& sigma) {
  return lookingDown(2, "\"path\" \"integer maxdepth\" 1") +
         "Material \"matte\" \"rgb Kd\" [ 1 1 1 ] \"float sigma\" " + sigma +
         "\nLightSource \"point\" \"point from\" [ 0 0 2 ] \"rgb I\" [ 3.14159274 3.14159274 3.14159274 ]\n" +
         kPlane;
}

TEST(Derivative, OfAMatteRoughnessIsTheClosedOne) {
  const double sigma = 20, radians = std::numbers::pi / 180, s2 = sigma * radians * sigma * radians;
  const auto lit = [&](double degrees) {
    const double s = degrees * radians;
    return .25 * (1 - s * s / (2 * (s * s + .33)));
  };
  const double slope = -.25 * .33 * sigma * radians / ((s2 + .33) * (s2 + .33)) * radians;
  EXPECT_NEAR(meanOf(roughened, {.value = sigma, .step = 1}), lit(sigma + 1) - lit(sigma), 2e-7);
  const ZTest single =
      zTest(means(roughened, {.value = sigma, .step = 4, .debias = Debias::Single}, 64, 24), slope);
  EXPECT_LT(std::abs(single.z()), kMaxAbsZ) << single;
  EXPECT_TRUE(single.sees(.02)) << single;
  EXPECT_GT(std::abs(meanOf(roughened, {.value = sigma, .step = 4}) - slope),
            kMaxAbsZ * single.standardError);
}

/// Metal lit and seen along the normal: Fresnel's reflectance over 4 pi alpha^2.
std::string metal(const std::string& roughness) {
  return lookingDown(2, "\"path\" \"integer maxdepth\" 1") +
         "Material \"metal\" \"rgb eta\" [ 2 2 2 ] \"rgb k\" [ 3 3 3 ] \"bool remaproughness\" \"false\" "
         "\"float "
         "roughness\" " +
         roughness + "\nLightSource \"point\" \"point from\" [ 0 0 2 ] \"rgb I\" [ 4 4 4 ]\n" + kPlane;
}

TEST(Derivative, OfTheRoughnessOfAMetalIsTheClosedOne) {
  const double alpha = .4, fresnel = (1.0 + 9) / (9 + 9),
               slope = -fresnel / (2 * std::numbers::pi * std::pow(alpha, 3));
  const ZTest single =
      zTest(means(metal, {.value = alpha, .step = .02, .debias = Debias::Single}, 64, 24), slope);
  EXPECT_LT(std::abs(single.z()), kMaxAbsZ) << single;
  EXPECT_TRUE(single.sees()) << single;
  const double none = meanOf(metal, {.value = alpha, .step = .02}),
               bias = .01 * 3 * fresnel / (2 * std::numbers::pi * std::pow(alpha, 4));
  EXPECT_NEAR(none - slope, bias, .15 * bias);
  EXPECT_GT(std::abs(none - slope), kMaxAbsZ * single.standardError);
}

/// White light through a slab of unit thickness, whose optical depth is x.
Text slab(const std::string& parameters) {
  return [parameters](const std::string& x) {
    return pencil(8, 1, "\"volpath\"", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .3) + "WorldBegin\n" +
           kWhiteEnvironment +
           "MakeNamedMedium \"m\" \"rgb sigma_s\" [ 0 0 0 ] \"rgb sigma_a\" [ 1 1 1 ] \"float scale\" " + x +
           ' ' + parameters + '\n' + mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
  };
}
const std::string kGrid =
    R"("string type" "heterogeneous" "integer nx" 1 "integer ny" 1 "integer nz" 1 "float density" [ 1 ] "point p0" [ 0 0 0 ] "point p1" [ 1 1 1 ] "string border" "clamp" )";

TEST(Derivative, OfADensityIsThatOfTheTransmittance) {
  const Text homogeneous = slab(R"("string type" "homogeneous")");
  const double tau = .75, slope = -std::exp(-tau), h = .125;
  const double none = meanOf(homogeneous, {.value = tau, .step = h}), bias = h / 2 * std::exp(-tau);
  EXPECT_NEAR(none, (std::exp(-tau - h) - std::exp(-tau)) / h, 2e-6);
  EXPECT_NEAR(none - slope, bias, .1 * bias);
  const ZTest single =
      zTest(means(homogeneous, {.value = tau, .step = h, .debias = Debias::Single}, 64, 24), slope);
  EXPECT_LT(std::abs(single.z()), kMaxAbsZ) << single;
  EXPECT_TRUE(single.sees()) << single;
  EXPECT_GT(std::abs(none - slope), kMaxAbsZ * single.standardError);
}

/// The collisions of ratio tracking come and go with the density, so its differences are noisy; their mean is
/// the difference of means.
TEST(Derivative, OfADensityUnderRatioTrackingIsItsMean) {
  const Text grid =
      slab(kGrid + R"("string transmittance" "ratio" "string bounds" "constant" "float majorant" 2)");
  const double tau = .75, h = .5, difference = (std::exp(-tau - h) - std::exp(-tau)) / h;
  const ZTest none = zTest(means(grid, {.value = tau, .step = h}, 256, 16), difference);
  EXPECT_LT(std::abs(none.z()), kMaxAbsZ) << none;
  EXPECT_GT(std::abs(none.mean + std::exp(-tau)), kMaxAbsZ * none.standardError) << none;
}

/// A sphere of radius 1 whose centre is at height y, at a distance of 3 beside the point of the plane that is
/// seen.
std::string sphereAt(const std::string& y) {
  return lookingDown(8, R"("ambientocclusion" "integer nsamples" 1)") + "AttributeBegin\nTranslate 3 0 " + y +
         "\nShape \"sphere\" \"float radius\" 1\nAttributeEnd\n" + kPlane;
}
/// pi (1 - (r / d)^2 cos(angle)) at distance d under this angle.
double openness(double y) { return std::numbers::pi * (1 - y / std::pow(9 + y * y, 1.5)); }
double slopeOfOpenness(double y) {
  const double d2 = 9 + y * y;
  return std::numbers::pi * (3 * y * y / std::pow(d2, 2.5) - 1 / std::pow(d2, 1.5));
}

TEST(Derivative, OfOcclusionByARisingSphereIsTheClosedOne) {
  const double y = 1.25, h = .75, difference = (openness(y + h) - openness(y)) / h;
  const ZTest none = zTest(means(sphereAt, {.value = y, .step = h}, 512, 16), difference);
  EXPECT_LT(std::abs(none.z()), kMaxAbsZ) << none;
  EXPECT_GT(std::abs(none.mean - slopeOfOpenness(y)), kMaxAbsZ * none.standardError)
      << none << ", negative control: the derivative, " << slopeOfOpenness(y);
  const double bias = h / 2 * (slopeOfOpenness(y + .01) - slopeOfOpenness(y - .01)) / .02;
  EXPECT_NEAR(difference - slopeOfOpenness(y), bias, .5 * std::abs(bias));
}

/// Its mean is that of the differences of its steps, which come ever closer to the derivative.
TEST(Derivative, OfOcclusionIsConsistentWhereStepsShrink) {
  const double y = 1.25, h = .75;
  const int passes = 512;
  double expected = 0;
  for (int k = 1; k <= passes; ++k) {
    const double step = h * std::pow(k, -DifferenceSchedule::kDecay);
    expected += (openness(y + step) - openness(y)) / step / passes;
  }
  const ZTest progressive =
      zTest(means(sphereAt, {.value = y, .step = h, .debias = Debias::Progressive}, passes, 16), expected);
  EXPECT_LT(std::abs(progressive.z()), kMaxAbsZ) << progressive;
  const double difference = (openness(y + h) - openness(y)) / h;
  EXPECT_GT(std::abs(progressive.mean - difference), kMaxAbsZ * progressive.standardError) << progressive;
  EXPECT_LT(std::abs(expected - slopeOfOpenness(y)), .3 * std::abs(difference - slopeOfOpenness(y)));
}

/// Both sides of a difference draw the same numbers: what the parameter has no effect on has derivative 0,
/// however noisy.
TEST(Derivative, HasTheSameRandomNumbersOnBothSides) {
  const Text text = [](const std::string& x) {
    return pencil(4, 4, "\"path\"", "LookAt 0 0 5  0 0 0  0 1 0", 2) + "WorldBegin\n" + kWhiteEnvironment +
           "AttributeBegin\nTranslate 0 0 " + x +
           "\nMaterial \"matte\" \"rgb Kd\" [ 0 0 0 ]\nShape \"sphere\" \"float radius\" .5\nAttributeEnd\n" +
           "Material \"matte\"\nShape \"sphere\" \"float radius\" 1\n" + kPlane;
  };
  const Derivative hidden = derivativeOf(text, {.difference = {.value = 0, .step = .125}}, {.seed = 5});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) EXPECT_EQ(hidden.image.rgb(x, y), Rgb()) << x << ' ' << y;
  }
}

TEST(Derivative, DoesNotDependOnThreadsAndTiles) {
  const DerivativeOptions options{.difference = {.value = 1.25, .step = .5, .debias = Debias::Single},
                                  .samplesPerPass = 4};
  const Derivative one = derivativeOf(sphereAt, options, {.seed = 7, .threads = 1, .samplesPerPixel = 18});
  const Derivative three =
      derivativeOf(sphereAt, options, {.seed = 7, .threads = 3, .tileSize = 3, .samplesPerPixel = 18});
  EXPECT_EQ(one.image.data(), three.image.data());
  EXPECT_EQ(one.result.passes, 5u);
  EXPECT_EQ(one.result.samplesTaken, 64u * 18);
  EXPECT_EQ(one.result.counters.cameraSamples, three.result.counters.cameraSamples);
  EXPECT_GE(one.result.counters.cameraSamples, 2 * one.result.samplesTaken) << "of all scenes";
}

/// A scene stays while the pass or the next one needs it.
TEST(Derivative, BuildsScenesWhenTheyAreNeeded) {
  const DifferenceSchedule::Params none{.value = 1.5, .step = .25, .seed = 1};
  const auto built = [&](Debias debias) {
    DifferenceSchedule::Params params = none;
    params.debias = debias;
    return derivativeOf(movedLight, {.difference = params, .samplesPerPass = 1},
                        {.seed = 1, .samplesPerPixel = 64})
        .built;
  };
  EXPECT_EQ(built(Debias::None), 1u);
  EXPECT_EQ(built(Debias::Progressive), 64u);
  DifferenceSchedule::Params params = none;
  params.debias = Debias::Single;
  const DifferenceSchedule schedule(params);
  const auto valuesOf = [&](std::int64_t pass) {
    std::set<double> values;
    for (const DifferenceTerm& term : schedule.terms(pass)) values.insert(term.value);
    return values;
  };
  std::set<double> there = {none.value};
  std::size_t expected = 0, different = 0;
  std::set<double> seen = there;
  for (std::int64_t pass = 0; pass < 64; ++pass) {
    const std::set<double> now = valuesOf(pass), next = valuesOf(pass + 1);
    std::erase_if(there, [&](double v) { return v != none.value && !now.contains(v) && !next.contains(v); });
    for (const double value : now) {
      expected += there.insert(value).second ? 1 : 0;
      different += seen.insert(value).second ? 1 : 0;
    }
  }
  EXPECT_EQ(built(Debias::Single), expected);
  EXPECT_GT(expected, different) << "some are built again";
}

}  // namespace
}  // namespace pbrtmedia::test
