// SPDX-License-Identifier: BSD-2-Clause
#include "fields/grid_choice.h"

#include <gtest/gtest.h>

#include <vector>

#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

const std::vector<GridCandidate> kFire = {{"density", "float", true},
                                          {"temperature", "float", true},
                                          {"temper", "float", true},
                                          {"vel", "Vec3f", false},
                                          {"12", "float", true}};

std::string refusal(const std::vector<GridCandidate>& grids, std::string_view wanted) {
  try {
    return "chose " + std::to_string(chooseGrid(grids, wanted));
  } catch (const SceneError& e) {
    return e.what();
  }
}

TEST(GridChoice, TakesANameANumberOrAUniqueBeginning) {
  EXPECT_EQ(chooseGrid(kFire, "density"), 0u);
  EXPECT_EQ(chooseGrid(kFire, "temper"), 2u) << "the exact name comes first";
  EXPECT_EQ(chooseGrid(kFire, "temperat"), 1u);
  EXPECT_EQ(chooseGrid(kFire, "d"), 0u);
  EXPECT_EQ(chooseGrid(kFire, "3"), 3u);
  EXPECT_EQ(chooseGrid(kFire, "12"), 4u) << "a name comes before a number";
}

TEST(GridChoice, TellsGridsOfOneNameApartByNumber) {
  const std::vector<GridCandidate> grids = {{"a", "", true}, {"b", "", true}, {"a", "", true}};
  EXPECT_EQ(chooseGrid(grids, "a"), 0u);
  EXPECT_EQ(chooseGrid(grids, "a[1]"), 2u);
  EXPECT_NE(refusal(grids, "a[2]").find("no grid is called \"a[2]\""), std::string::npos);
}

TEST(GridChoice, WithoutANameTakesTheOnlyDensityOrTheOneCalledSo) {
  EXPECT_EQ(chooseGrid(kFire, ""), 0u);
  EXPECT_EQ(chooseGrid(std::vector<GridCandidate>{{"v", "", false}, {"smoke", "", true}}, ""), 1u);
  EXPECT_NE(
      refusal({{"a", "", true}, {"b", "", true}}, "").find("several grids could be the density: name one"),
      std::string::npos);
  EXPECT_NE(refusal({{"v", "", false}}, "").find("no grid is a density"), std::string::npos);
}

TEST(GridChoice, ListsWhatIsThereOnAMiss) {
  const std::string miss = refusal(kFire, "Density");
  EXPECT_NE(miss.find("no grid is called \"Density\""), std::string::npos) << miss;
  EXPECT_NE(miss.find("0: \"density\" (float)\n"), std::string::npos) << miss;
  EXPECT_NE(miss.find("4: \"12\" (float)"), std::string::npos) << miss;
  EXPECT_NE(refusal(kFire, "te").find("several grids have names that begin with \"te\""), std::string::npos);
  EXPECT_NE(refusal(kFire, "5").find("there is no grid number 5"), std::string::npos);
  EXPECT_NE(refusal({}, "x").find("nothing"), std::string::npos);
}

TEST(GridChoice, ReachesGridsWithoutANameByNumber) {
  EXPECT_EQ(chooseGrid(std::vector<GridCandidate>{{"a", "", true}, {"", "", true}}, "1"), 1u);
}

}  // namespace
}  // namespace pbrtmedia
