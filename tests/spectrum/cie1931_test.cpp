// SPDX-License-Identifier: BSD-2-Clause
#include "spectrum/cie1931.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

const Cie1931Entry& at(int wavelength) {
  return cie1931()[static_cast<std::size_t>(wavelength - kCieFirstWavelength)];
}

TEST(Cie1931, ColumnSumsAreThoseOfThePublishedTable) {
  long double x = 0, y = 0, z = 0;
  for (const Cie1931Entry& e : cie1931()) {
    x += static_cast<long double>(e.x);
    y += static_cast<long double>(e.y);
    z += static_cast<long double>(e.z);
  }
  EXPECT_NEAR(static_cast<double>(x), 106.865469489595, 1e-12);
  EXPECT_NEAR(static_cast<double>(y), 106.856917101172, 1e-12);
  EXPECT_NEAR(static_cast<double>(z), 106.892251278636, 1e-12);
}

TEST(Cie1931, NormalisationOfPbrtIsTheLuminousSumToTwoPartsInTenMillion) {
  double y = 0;
  for (const Cie1931Entry& e : cie1931()) y += e.y;
  EXPECT_NEAR(y / kCieYIntegral, 1, 2.1e-7);
}

TEST(Cie1931, PeaksLieWhereThePublishedTableHasThem) {
  EXPECT_EQ(at(555).y, 1.0);
  EXPECT_EQ(at(599).x, 1.0629096);
  EXPECT_EQ(at(446).z, 1.7829682);
  for (const Cie1931Entry& e : cie1931()) {
    EXPECT_LE(e.x, at(599).x);
    EXPECT_LE(e.y, 1.0);
    EXPECT_LE(e.z, at(446).z);
  }
  EXPECT_EQ(at(360).x, 0.0001299);
  EXPECT_EQ(at(830).y, 4.5181e-7);
  EXPECT_EQ(at(650).z, 0.0);
}

}  // namespace
}  // namespace pbrtmedia
