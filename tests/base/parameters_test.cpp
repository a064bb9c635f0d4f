// SPDX-License-Identifier: BSD-2-Clause
#include "base/parameters.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

TEST(Parameters, AFloatIsTakenForTheDecimalItWasWrittenAs) {
  EXPECT_EQ(decimalOf(0.65f), 0.65);
  EXPECT_EQ(decimalOf(-0.1f), -0.1);
  EXPECT_EQ(decimalOf(1e-30f), 1e-30);
  EXPECT_EQ(decimalOf(3), 3.0);
  EXPECT_NE(decimalOf(0.65f), double{0.65f}) << "negative control: the two differ";
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const float f = rng.uniform() * 1000;
    EXPECT_EQ(static_cast<float>(decimalOf(f)), f);
  }
}

TEST(Parameters, NumbersReadBackAsTheyWere) {
  // strtod: std::stod throws for numbers as small as 5e-324.
  for (const double value : {0.1, 1e300, 5e-324, -2.5, 1. / 3})
    EXPECT_EQ(std::strtod(formatNumber(value).c_str(), nullptr), value);
}

}  // namespace
}  // namespace pbrtmedia
