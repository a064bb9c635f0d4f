// SPDX-License-Identifier: BSD-2-Clause
#include "display/page_data.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace pbrtmedia {
namespace {

TEST(StatusText, HoldsWhatIsKnown) {
  RenderStatus status;
  status.run = "7";
  status.title = "a \"b\".pbrt";
  status.phase = "rendering";
  status.samplesDone = std::uint64_t{1} << 52;
  status.secondsLeft = 2.5;
  status.errors = {
      {"seconds", "rmse"}, {{1, 0.5}, {2, std::numeric_limits<double>::quiet_NaN()}}, "against ref.exr"};
  status.bounds.push_back({.medium = "fog",
                           .restored = true,
                           .passes = 3,
                           .cells = 8,
                           .visited = 4,
                           .raised = 2,
                           .largest = 5,
                           .shortfall = 0.25});
  status.warnings = {"one", "two"};
  const nlohmann::json json = nlohmann::json::parse(statusText(status));
  EXPECT_EQ(json["run"], "7");
  EXPECT_EQ(json["title"], "a \"b\".pbrt");
  EXPECT_EQ(json["samplesDone"], std::uint64_t{1} << 52);
  EXPECT_EQ(json["secondsLeft"], 2.5);
  EXPECT_EQ(json["errors"]["columns"][1], "rmse");
  EXPECT_EQ(json["errors"]["rows"][0][1], 0.5);
  EXPECT_TRUE(json["errors"]["rows"][1][1].is_null());
  EXPECT_EQ(json["bounds"][0]["medium"], "fog");
  EXPECT_EQ(json["bounds"][0]["restored"], true);
  EXPECT_EQ(json["bounds"][0]["visited"], 4);
  EXPECT_EQ(json["bounds"][0]["shortfall"], 0.25);
  EXPECT_EQ(json["warnings"].size(), 2u);
}

TEST(StatusText, IsJsonWhateverTheNames) {
  RenderStatus status;
  status.title = "\xff\xfe not UTF-8";
  status.seconds = std::numeric_limits<double>::infinity();
  const nlohmann::json json = nlohmann::json::parse(statusText(status));
  EXPECT_TRUE(json["seconds"].is_null());
  EXPECT_TRUE(json["secondsLeft"].is_null());
}

TEST(ImageHeader, IsThisVeryText) {
  Snapshot snapshot;
  snapshot.sequence = 258;
  snapshot.image = Image(3, 2, {"R", "N.X"});
  std::string expected("PMI1\x02\x01\0\0\x03\0\0\0\x02\0\0\0\x02\0\0\0\x08\0\0\0", 24);
  expected += std::string("R\0N.X\0\0\0", 8);
  EXPECT_EQ(imageHeader(snapshot), expected);
}

}  // namespace
}  // namespace pbrtmedia
