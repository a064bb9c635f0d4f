// SPDX-License-Identifier: BSD-2-Clause
#include "fields/half_code.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"

namespace pbrtmedia {
namespace {

constexpr std::uint16_t kLargest = 0x7bff;  // 65504, the last finite code

/// Sum of powers of 2 as the format defines it.
double valueOf(int code) {
  const int exponent = code >> 10, mantissa = code & 1023;
  return exponent == 0 ? std::ldexp(mantissa, -24) : std::ldexp(1024 + mantissa, exponent - 25);
}

TEST(HalfCode, DecodesEveryCodeExactly) {
  for (int code = 0; code <= kLargest; ++code) {
    ASSERT_EQ(static_cast<double>(HalfCode::decode(static_cast<std::uint16_t>(code))), valueOf(code)) << code;
  }
}

TEST(HalfCode, KnowsTheLandmarksOfTheFormat) {
  EXPECT_EQ(HalfCode::encode(0), 0);
  EXPECT_EQ(HalfCode::encode(1), 0x3c00);
  EXPECT_EQ(HalfCode::encode(65504), kLargest);
  EXPECT_EQ(HalfCode::encode(0x1p-24), 1);
  EXPECT_EQ(HalfCode::encode(0x1p-14), 0x400);
}

TEST(HalfCode, RoundsToTheNearestCodeAndTiesToEven) {
  for (int code = 0; code < kLargest; ++code) {
    const double low = valueOf(code), high = valueOf(code + 1), middle = (low + high) / 2;
    ASSERT_EQ(HalfCode::encode(low), code);
    ASSERT_EQ(HalfCode::encode(std::nextafter(middle, 0.0)), code);
    ASSERT_EQ(HalfCode::encode(middle), code + (code & 1));
    ASSERT_EQ(HalfCode::encode(std::nextafter(middle, 1e9)), code + 1);
  }
}

}  // namespace
}  // namespace pbrtmedia
