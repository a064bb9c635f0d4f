// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace pbrtmedia {
namespace {

constexpr std::string_view kName = "--mediumparams";

TEST(ParseParams, ReadsAListAsADirectiveHasIt) {
  Diagnostics diagnostics;
  const ParamList list = parseParams(
      R"("string transmittance" "regular" "integer supervoxels" [ 1 2 3 ] "float g" .5)", kName, diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(std::get<std::vector<std::string>>(list.find(ParamKind::String, "transmittance")->values),
            std::vector<std::string>{"regular"});
  EXPECT_EQ(std::get<std::vector<int>>(list.find(ParamKind::Integer, "supervoxels")->values),
            (std::vector{1, 2, 3}));
  EXPECT_EQ(std::get<std::vector<float>>(list.find(ParamKind::Float, "g")->values), std::vector{.5f});
}

TEST(ParseParams, NothingIsNothing) {
  for (const std::string_view text : {"", "  \n", "# a comment"}) {
    Diagnostics diagnostics;
    EXPECT_TRUE(parseParams(text, kName, diagnostics).empty());
    EXPECT_EQ(diagnostics.format(), "") << text;
  }
}

TEST(ParseParams, TellsWhereAndWhatIsWrong) {
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"transmittance regular",
            "--mediumparams:1:1: error: found transmittance, expected \"type name\" and values"},
           {"\"float g\" .5 ]", "--mediumparams:1:14: error: found ], expected \"type name\" and values"},
           {"\"float g", "--mediumparams:1:1: error: the string has no closing"},
           {"\"flaot g\" 1", "--mediumparams:1:1: error"},
           {"\"float g\" \"x\"", "--mediumparams:1:11: error"}}) {
    Diagnostics diagnostics;
    parseParams(text, kName, diagnostics);
    EXPECT_TRUE(diagnostics.hasErrors()) << text;
    EXPECT_NE(diagnostics.format().find(message), std::string::npos) << diagnostics.format();
    EXPECT_NE(diagnostics.format().find('^'), std::string::npos) << "an excerpt: " << diagnostics.format();
  }
}

}  // namespace
}  // namespace pbrtmedia
