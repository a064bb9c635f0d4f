// SPDX-License-Identifier: BSD-2-Clause
#include "display/change_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "base/rng.h"
#include "support/running_stats.h"
#include "support/statistics.h"

namespace pbrtmedia {
namespace {

/// Means of the first n samples of each pixel: uniform in [0, 2), so 1 with a variance of 1/3.
Image meanOf(int samples) {
  Image image(16, 16);
  for (std::size_t i = 0; i < image.data().size(); ++i) {
    Rng rng(i);
    double sum = 0;
    for (int s = 0; s < samples; ++s) sum += 2 * rng.uniform();
    image.data()[i] = static_cast<float>(sum / samples);
  }
  return image;
}

TEST(ErrorFromChange, IsTheErrorOfIndependentSamples) {
  for (const auto& [before, after] : {std::pair{1, 2}, std::pair{10, 40}, std::pair{30, 31}}) {
    const std::optional<double> error = errorFromChange(meanOf(before), before, meanOf(after), after);
    ASSERT_TRUE(error.has_value());
    const double expected = 1.0 / 3 / after, numbers = 16 * 16 * 3;
    // The mean of `numbers` squares of nearly normal values with the variance `expected`.
    const double z = (*error * *error - expected) / (expected * std::sqrt(2 / numbers));
    EXPECT_LT(std::abs(z), test::kMaxAbsZ)
        << before << " of " << after << ": " << *error * *error << " against " << expected;
  }
}

TEST(ErrorFromChange, IsExactForTwoNumbers) {
  Image before(1, 1), after(1, 1);
  for (std::size_t c = 0; c < 3; ++c) before.at(0, 0, c) = 1;
  for (std::size_t c = 0; c < 3; ++c) after.at(0, 0, c) = 2;
  // One sample was 1, the mean of it and another is 2: the two differ by 2, their variance is 2, that of the
  // mean 1.
  EXPECT_DOUBLE_EQ(*errorFromChange(before, 1, after, 2), 1);
}

TEST(ErrorFromChange, IsNothingWithoutTwoImagesOfAKind) {
  const Image image(2, 2);
  EXPECT_FALSE(errorFromChange(image, 2, image, 2).has_value());
  EXPECT_FALSE(errorFromChange(image, 0, image, 2).has_value());
  EXPECT_FALSE(errorFromChange(Image(2, 1), 1, image, 2).has_value());
  EXPECT_FALSE(errorFromChange(Image(0, 0), 1, Image(0, 0), 2).has_value());
  const Image depth(2, 2, {"Z", "A"});
  EXPECT_FALSE(errorFromChange(depth, 1, depth, 2).has_value());
}

}  // namespace
}  // namespace pbrtmedia
