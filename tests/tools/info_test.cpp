// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tools/imgtool/info.h"

namespace pbrtmedia {
namespace {

TEST(ChannelStatistics, CountWhatIsNotFiniteApart) {
  Image image(5, 1, {"Y", "Z"});
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  image.data() = {1, nan, -2, nan, nan, nan, inf, nan, 4, nan};
  const std::vector<ChannelStatistics> s = channelStatistics(image);
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].name, "Y");
  EXPECT_EQ(s[0].nans, 1);
  EXPECT_EQ(s[0].infinities, 1);
  EXPECT_EQ(s[0].min, -2);
  EXPECT_EQ(s[0].max, 4);
  EXPECT_EQ(s[0].mean, 1);
  EXPECT_EQ(s[1].nans, 5);
  EXPECT_EQ(s[1].mean, 0);
}

TEST(LogAverageLuminance, IsTheGeometricMean) {
  Image image(2, 1, {"Y"});
  image.data() = {1, 100};
  EXPECT_NEAR(logAverageLuminance(image), 10, 1e-4);
  image.data() = {0, 0};
  EXPECT_NEAR(logAverageLuminance(image), 1e-6, 1e-12);
}

TEST(Shortest, ReadsBackAsTheSameFloat) {
  EXPECT_EQ(shortest(0.1f), "0.1");
  EXPECT_EQ(shortest(1.0f / 3.0f), "0.33333334");
  EXPECT_EQ(shortest(-std::numeric_limits<float>::infinity()), "-inf");
}

}  // namespace
}  // namespace pbrtmedia
