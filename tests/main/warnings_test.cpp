// SPDX-License-Identifier: BSD-2-Clause
#include "main/warnings.h"

#include <gtest/gtest.h>

#include <string>

#include "support/render_scene.h"

namespace pbrtmedia {
namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(DescribeFaults, SaysNothingOfAFaultlessRender) { EXPECT_EQ(describeFaults({}, {}), ""); }

TEST(DescribeFaults, TellsDroppedSamplesByCauseWithAnExample) {
  RenderResult result;
  result.samplesTaken = 100;
  result.counters.dropped = {2, 0, 1};
  result.dropped = {{{3, 4}, 5, DropCause::NotANumber}};
  Options options;
  options.seed = 7;
  options.quiet = true;  // faults are told all the same
  const std::string text = describeFaults(result, options);
  EXPECT_TRUE(has(text, "3 of 100 samples were dropped: 2 not a number 1 of negative luminance.")) << text;
  EXPECT_TRUE(has(text, "pixel 3 4, sample 5, seed 7: not a number")) << text;
}

TEST(DescribeFaults, TellsViolatedBoundsWithTheirRay) {
  RenderResult result;
  result.counters.boundViolations = 4;
  result.counters.worstBoundRatio = 1.5;
  ViolationRecord record{{1, 2}, 3, BoundViolation{{}, {0, 0, -1}, {0, 0, 1}, 2.5, 3, 2}, "smoke"};
  result.violations = {record};
  Options options;
  options.quiet = true;
  const std::string text = describeFaults(result, options);
  EXPECT_TRUE(has(text, "4 density lookups exceeded their bound, the worst by a factor of 1.5.")) << text;
  EXPECT_TRUE(
      has(text, "pixel 1 2, sample 3, seed 0: medium \"smoke\" has density 3 above its bound 2 at t = 2.5"))
      << text;
}

LearningRecord learned(double shortfall, bool restored = false) {
  LearningRecord record;
  record.medium = "smoke";
  record.restored = restored;
  record.shortfall = shortfall;
  record.passes.resize(3);
  return record;
}

TEST(DescribeRisingBounds, TellsWhatIsMissing) {
  EXPECT_EQ(describeRisingBounds({}), "");
  EXPECT_EQ(describeRisingBounds({learned(0), learned(1e-4)}), "");
  const std::string text = describeRisingBounds({learned(0), learned(.25)});
  EXPECT_TRUE(has(text, "warning: the progressive bounds of medium \"smoke\" were still rising")) << text;
  EXPECT_TRUE(has(text, "about 25 % of its extinction is missing")) << text;
  EXPECT_TRUE(has(text, "more passes of \"integer warmup\" or a second run")) << text;
  LearningRecord limited = learned(.25);
  limited.warmUpIsLimited = true;
  EXPECT_TRUE(
      has(describeRisingBounds({limited}), "\"integer warmup\" within more \"integer warmuplookups\" or"));
  LearningRecord empty;
  empty.medium = "smoke";
  EXPECT_TRUE(has(describeRisingBounds({empty}), "not known yet"));
}

TEST(BoundsState, IsThatOfTheWorst) {
  EXPECT_EQ(boundsState({}), "");
  EXPECT_EQ(boundsState({learned(1e-4)}), "settled");
  EXPECT_EQ(boundsState({learned(1e-4), learned(.25)}), "rising");
  EXPECT_EQ(boundsState({learned(0, true)}), "cached");
  EXPECT_EQ(boundsState({learned(0, true), learned(0)}), "settled");
  EXPECT_EQ(boundsState({learned(0, true), learned(.25)}), "rising");
}

TEST(DescribeFaults, LeavesOutRemarksWhenQuiet) {
  RenderResult result;
  result.counters.cappedEstimates = 6;
  result.counters.mediumMismatches = 8;
  result.mismatches = {{{1, 2}, 3, {0, 0, 0}, "fog", "smoke"}};
  const std::string text = describeFaults(result, {});
  EXPECT_TRUE(has(text, "6 transmittance estimates were cut short by maxlookups")) << text;
  EXPECT_TRUE(has(text, "8 boundary crossings name another medium")) << text;
  EXPECT_TRUE(has(text, "pixel 1 2, sample 3: a boundary at")) << text;
  Options quiet;
  quiet.quiet = true;
  EXPECT_EQ(describeFaults(result, quiet), "");
}

/// What is said after rendering media without material in a column along the view.
std::string faultsOf(const std::string& world) {
  // Light samples of the sky look through boundaries as well: eight paths alone meet few.
  const std::string integrator = "\"volpath\" \"string lightsamplestrategy\" \"power\"";
  const Construction scene = test::constructText(test::pencil(2, 2, integrator) +
                                                 "WorldBegin\nMakeNamedMedium \"a\" \"string type\" "
                                                 "\"homogeneous\"\nMakeNamedMedium \"b\" \"string type\" "
                                                 "\"homogeneous\"\n" +
                                                 test::kWhiteEnvironment + world + "WorldEnd\n");
  const RenderResult result =
      scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, RenderOptions());
  return describeFaults(result, {}, scene.scene.get());
}

TEST(DescribeFaults, GivesTheAdviceThatHelps) {
  const std::string a = test::mediumBox("a", {-1, -1, 1}, {1, 1, 3}), add = "\"string overlap\" \"add\"";
  EXPECT_EQ(faultsOf(a), "");
  const std::string overlapping = faultsOf(a + test::mediumBox("b", {-1, -1, 2}, {1, 1, 4}));
  EXPECT_TRUE(has(overlapping, add)) << overlapping;
  const std::string inward = faultsOf("ReverseOrientation\n" + a);
  EXPECT_TRUE(has(inward, "test.pbrt:")) << inward;
  EXPECT_TRUE(has(inward, "medium \"a\" it faces inward")) << inward;
  EXPECT_TRUE(has(inward, "ReverseOrientation")) << inward;
  EXPECT_FALSE(has(inward, add)) << inward;
  const std::string open = faultsOf(
      "Material \"none\"\nMediumInterface \"a\" \"\"\nTranslate 0 0 1\nReverseOrientation\nShape \"disk\"\n"
      "Translate 0 0 1\nMediumInterface \"b\" \"\"\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] "
      "\"point P\" [ -9 -9 0 9 -9 0 0 9 0 ]\n");
  EXPECT_TRUE(has(open, "medium \"b\" it is open")) << open;
  // Cells of unit cubes: where the front is a hole the back is none, so rays enter by the hole and meet the
  // back.
  std::string box = test::mediumBox("b", {-1, -1, 1.5}, {1, 1, 2.5});
  box.insert(box.find("\"trianglemesh\"") + 14, " \"texture alpha\" \"t\"");
  const std::string holes =
      faultsOf("Texture \"t\" \"float\" \"checkerboard\" \"integer dimension\" 3\n" + box);
  EXPECT_TRUE(has(holes, "it has holes where its alpha is 0")) << holes;
}

}  // namespace
}  // namespace pbrtmedia
