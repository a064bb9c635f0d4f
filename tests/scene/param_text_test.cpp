// SPDX-License-Identifier: BSD-2-Clause
#include "scene/param_text.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "scene/print.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kName = "--mediumparams";

TEST(ParseParams, ReadsAListAsADirectiveHasIt) {
  Diagnostics diagnostics;
  Variables variables;
  const ParamList list =
      parseParams(R"("string transmittance" "regular" "integer supervoxels" [ 1 2 3 ] "float g" .5)", kName,
                  variables, diagnostics);
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
    Variables variables;
    EXPECT_TRUE(parseParams(text, kName, variables, diagnostics).empty());
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
    Variables variables;
    parseParams(text, kName, variables, diagnostics);
    EXPECT_TRUE(diagnostics.hasErrors()) << text;
    EXPECT_NE(diagnostics.format().find(message), std::string::npos) << diagnostics.format();
    EXPECT_NE(diagnostics.format().find('^'), std::string::npos) << "an excerpt: " << diagnostics.format();
  }
}

TEST(ParseParams, RecommendsNoDirectiveForAVariableWithoutAValue) {
  Diagnostics diagnostics;
  Variables variables;
  parseParams("\"float g\" $k", kName, variables, diagnostics);
  const std::string said = diagnostics.format();
  EXPECT_NE(said.find("no variable \"k\"; give it a value: --define k=VALUE\n"), said.npos) << said;
}

TEST(ParseParams, TakesTheValuesOfVariables) {
  Diagnostics diagnostics;
  Variables variables;
  variables.set("g", "0.50");
  variables.set("other", "1");
  variables.setFrame(7);
  const ParamList list = parseParams(R"("float g" $g "string filename" "v-##.raw" "integer n" [ $frame 1 ])",
                                     kName, variables, diagnostics);
  EXPECT_EQ(diagnostics.format(), "");
  EXPECT_EQ(textOf(list), R"("float g" 0.5 "integer n" [ 7 1 ] "string filename" "v-07.raw")");
  EXPECT_EQ(variables.unused(), std::vector<std::string_view>{"other"});
}

TEST(ParamText, IsTheSameForEqualLists) {
  Diagnostics diagnostics;
  Variables variables;
  const auto text = [&](std::string_view params) {
    return textOf(parseParams(params, kName, variables, diagnostics));
  };
  EXPECT_EQ(text(R"("float a" [ 1.50 ] "bool b" "true" "rgb c" [ 1 .5 0 ])"),
            text(R"("rgb c" [ 1.0 0.5 0e3 ]  "float a" 15e-1 "bool b" [ "true" ])"));
  EXPECT_NE(text(R"("float a" 1)"), text(R"("float a" [ 1 1 ])"));
  EXPECT_EQ(text(""), "");
  EXPECT_EQ(text(text(R"("string s" "two words" "float a" [ 1 2 ])")),
            text(R"("string s" "two words" "float a" [ 1 2 ])"));
}

}  // namespace
}  // namespace pbrtmedia
