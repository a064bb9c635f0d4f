// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include "media/emission/blackbody_curve.h"
#include "spectrum/spectrum.h"

namespace pbrtmedia {
namespace {

TEST(BlackbodyCurve, AgreesWithBlackBodiesWhereTheyAreSeen) {
  const BlackbodyCurve curve(6000);
  for (float kelvin = 900; kelvin <= 6000; kelvin += 53) {
    const Rgb exact = blackbodyToRgb(kelvin, 1).nonNegative(), found = curve.at(kelvin);
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(found[c], exact[c], 2e-3f * exact.max()) << kelvin << " K";
  }
}

TEST(BlackbodyCurve, UpperBoundsEveryCoolerBodyAndNotMuchMore) {
  const BlackbodyCurve curve(6000);
  float brightest = 0;  // of those up to the next temperature
  for (float kelvin = 150; kelvin <= 6000; kelvin *= 1.013f) {
    brightest = std::max(brightest, curve.at(1.013f * kelvin).max());
    const float upper = curve.upper(kelvin);
    for (const float share : {1.0f, 0.999f, 0.9f, 0.5f}) {
      EXPECT_GE(upper, curve.at(share * kelvin).max()) << share << " of " << kelvin << " K";
    }
    EXPECT_LE(upper, brightest + 1e-4f) << kelvin << " K";
  }
}

TEST(BlackbodyCurve, IsBlackInTheDarkAndKnowsNothingHotter) {
  const BlackbodyCurve curve(3000);
  for (const float dark : {-5.0f, 0.0f, 100.0f}) {
    EXPECT_TRUE(curve.at(dark).isBlack());
    EXPECT_EQ(curve.upper(dark), 0);
  }
  EXPECT_EQ(curve.at(4000), curve.at(3000));
  EXPECT_TRUE(BlackbodyCurve(50).at(60).isBlack());
}

}  // namespace
}  // namespace pbrtmedia
