// SPDX-License-Identifier: BSD-2-Clause
#include "spectrum/spectrum.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace pbrtmedia {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

void expectNear(Rgb found, Rgb expected, float tolerance) {
  EXPECT_NEAR(found.r, expected.r, tolerance);
  EXPECT_NEAR(found.g, expected.g, tolerance);
  EXPECT_NEAR(found.b, expected.b, tolerance);
}

TEST(XyzToRgb, AppliesTheMatrixOfTheReference) {
  expectNear(xyzToRgb({1, 0, 0}), {3.240479f, -0.969256f, 0.055648f}, 1e-6f);
  expectNear(xyzToRgb({0, 1, 0}), {-1.537150f, 1.875991f, -0.204043f}, 1e-6f);
  expectNear(xyzToRgb({0, 0, 1}), {-0.498535f, 0.041556f, 1.057311f}, 1e-6f);
}

TEST(SampledSpectrum, ConstantOneIsNotWhite) {
  expectNear(sampledSpectrumToRgb({{400, 1}, {700, 1}}), {1.20233f, 0.94622f, 0.90734f}, 1e-5f);
}

TEST(SampledSpectrum, OneSampleIsAConstant) {
  const Rgb one = sampledSpectrumToRgb({{400, 1}, {700, 1}});
  const Rgb three = sampledSpectrumToRgb({{1000, 3}});
  expectNear(three, 3 * one, 1e-6f);
}

TEST(SampledSpectrum, OrderOfSamplesDoesNotMatter) {
  const Rgb sorted = sampledSpectrumToRgb({{400, 0.1f}, {500, 0.7f}, {600, 0.2f}});
  EXPECT_EQ(sampledSpectrumToRgb({{600, 0.2f}, {400, 0.1f}, {500, 0.7f}}), sorted);
}

TEST(SampledSpectrum, LinearCurveIsTheSameHoweverManySamplesDescribeIt) {
  // S(λ) = λ / 1000 is reproduced by linear interpolation wherever it is sampled.
  std::vector<SpectralSample> fine;
  for (int l = 350; l <= 840; l += 7) fine.push_back({static_cast<float>(l), static_cast<float>(l) / 1000});
  expectNear(sampledSpectrumToRgb(fine), sampledSpectrumToRgb({{300, 0.3f}, {900, 0.9f}}), 1e-6f);
}

TEST(SampledSpectrum, IsExtendedByItsEndValues) {
  // A step: 0 up to 500, 2 from 501 on. Written with and without the outer samples.
  const Rgb inner = sampledSpectrumToRgb({{500, 0}, {501, 2}});
  EXPECT_EQ(inner, sampledSpectrumToRgb({{360, 0}, {500, 0}, {501, 2}, {830, 2}}));
}

TEST(SampledSpectrum, NarrowBandKeepsNegativeRgb) {
  const Rgb cyan = sampledSpectrumToRgb({{494, 0}, {495, 1}, {496, 0}});
  EXPECT_LT(cyan.r, 0);
  EXPECT_GT(cyan.g, 0);
}

TEST(SampledSpectrum, RefusesWhatHasNoMeaning) {
  EXPECT_THROW(sampledSpectrumToRgb({}), std::invalid_argument);
  EXPECT_THROW(sampledSpectrumToRgb({{500, 1}, {400, 1}, {500, 2}}), std::invalid_argument);
  EXPECT_THROW(sampledSpectrumToRgb({{500, kNan}}), std::invalid_argument);
  EXPECT_THROW(sampledSpectrumToRgb({{kNan, 1}, {400, 1}}), std::invalid_argument);
  EXPECT_THROW(sampledSpectrumToRgb({{500, kInf}}), std::invalid_argument);
}

struct BlackbodyCase {
  float kelvin;
  Rgb expected;
};

TEST(Blackbody, AgreesWithTheTableOfTheReference) {
  const BlackbodyCase cases[] = {
      {2700, {0.53349f, 0.22157f, 0.05290f}}, {3000, {0.73506f, 0.35049f, 0.11298f}},
      {5000, {1.19001f, 0.94206f, 0.74794f}}, {5500, {1.11849f, 0.94909f, 0.84311f}},
      {6500, {0.92222f, 0.86950f, 0.91522f}}, {10000, {0.38594f, 0.44029f, 0.63353f}}};
  for (const BlackbodyCase& c : cases) {
    SCOPED_TRACE(c.kelvin);
    expectNear(blackbodyToRgb(c.kelvin, 1), c.expected, 1e-5f);
  }
}

TEST(Blackbody, ScaleIsAFactor) {
  const Rgb one = blackbodyToRgb(4000, 1);
  expectNear(blackbodyToRgb(4000, 7), 7 * one, 1e-5f);
  expectNear(blackbodyToRgb(4000, -1), -one, 1e-6f);
}

TEST(Blackbody, StaysFiniteForEveryTemperatureOfAFloat) {
  for (const float t : {std::numeric_limits<float>::denorm_min(), 1e-20f, 1.0f, 30.0f, 1e6f, 1e20f,
                        std::numeric_limits<float>::max()}) {
    SCOPED_TRACE(t);
    EXPECT_TRUE(blackbodyToRgb(t, 1).isFinite());
  }
  EXPECT_EQ(blackbodyToRgb(1, 1), Rgb(0));  // its peak lies at 2.9 mm
}

TEST(Blackbody, RefusesTemperaturesThatAreNone) {
  for (const float t : {0.0f, -1.0f, kNan, kInf}) EXPECT_THROW(blackbodyToRgb(t, 1), std::invalid_argument);
  EXPECT_THROW(blackbodyToRgb(5000, kNan), std::invalid_argument);
}

}  // namespace
}  // namespace pbrtmedia
