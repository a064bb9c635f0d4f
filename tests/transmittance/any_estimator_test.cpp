// SPDX-License-Identifier: BSD-2-Clause
#include "transmittance/estimator_list.h"

#include <gtest/gtest.h>

namespace pbrtmedia {
namespace {

TEST(AnyEstimator, IsFoundByEveryNameOfTheList) {
  const auto names = estimatorNames();
  EXPECT_EQ(names.size(), std::variant_size_v<EstimatorVariant>);
  for (const auto name : names) {
    const auto estimator = findEstimator(name);
    ASSERT_TRUE(estimator) << name;
    EXPECT_EQ(nameOf(*estimator), name);
  }
  EXPECT_EQ(nameOf(AnyEstimator()), names.front());
  EXPECT_EQ(names.front(), "ratio");
}

TEST(AnyEstimator, IsNotFoundByOtherNames) {
  EXPECT_FALSE(findEstimator("ratoi"));
  EXPECT_FALSE(findEstimator(""));
  EXPECT_FALSE(findEstimator("Ratio"));
}

}  // namespace
}  // namespace pbrtmedia
