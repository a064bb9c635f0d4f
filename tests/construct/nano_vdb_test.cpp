// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "construct/probe.h"
#include "fields/nano_vdb_samples.h"
#include "support/temporary_folder.h"

// MakeNamedMedium of type "nanovdb".
namespace pbrtmedia::test {
namespace {

class ConstructNanoVdb : public testing::Test {
 protected:
  ConstructNanoVdb() {
    // In the sphere of radius 1 around the origin; voxels of 0.1.
    NanoVdbSample smoke{
        .min = {-7, -7, -7}, .max = {7, 7, 7}, .worldFromIndex = Transform::scale(.1, .1, .1)};
    smoke.name = "smoke";
    smoke.valueAt = [](Ijk at) { return 0.1 + 3 * (at[0] + 7) / 14.0; };
    NanoVdbSample fire = smoke;
    fire.name = "fire";
    fire.valueAt = [](Ijk at) { return at[2] > 0 ? 0.5 : 0.0; };
    writeNanoVdb(folder_.path() / "two.nvdb", {smoke, fire});
    writeNanoVdb(folder_.path() / "one.nvdb", {smoke});
  }
  /// A medium "m" in a sphere; MakeNamedMedium stands in line 2, column 1.
  Attempt with(const std::string& parameters, const std::string& before = "") const {
    return attemptWorld(before + "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" " + parameters +
                            "\nIdentity MediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"",
                        {.folder = folder_.path()});
  }

  TemporaryFolder folder_;
  const std::string one_ = "\"string filename\" \"one.nvdb\" ", two_ = "\"string filename\" \"two.nvdb\" ";
};

TEST_F(ConstructNanoVdb, EveryParameterHasItsEffect) {
  const std::string smoke = two_ + "\"string grid\" \"smoke\" ";
  std::vector<Effect> effects{
      {one_, one_ + "\"float densityscale\" 2"},   {one_, one_ + "\"float densityoffset\" 0.25"},
      {one_, one_ + "\"rgb sigma_a\" [ 1 2 3 ]"},  {one_, one_ + "\"rgb sigma_s\" [ 1 2 3 ]"},
      {one_, one_ + "\"float scale\" 0.1"},        {one_, one_ + "\"float g\" 0.5"},
      {one_, one_ + "\"string overlap\" \"add\""}, {smoke, two_ + "\"string grid\" \"fire\""}};
  const auto make = [&](const std::string& p) { return with(p); };
  expectEffects(effects, make, media);
  expectSame({{one_, smoke},
              {one_, one_ + "\"string grid\" \"sm\" \"float densityscale\" 1 \"float densityoffset\" 0"},
              {two_ + "\"string grid\" \"1\"", two_ + "\"string grid\" \"f\""}},
             make, media);
}

TEST_F(ConstructNanoVdb, HasBoundsOfEveryKind) {
  const auto make = [&](const std::string& p) { return with(one_ + p); };
  expectSame({{"", "\"string bounds\" \"exact\""}}, make, media);
  expectEffects({{"", "\"integer supervoxels\" 0"},
                 {"", "\"string bounds\" \"constant\" \"float majorant\" 40"},
                 {"", "\"string bounds\" \"progressive\""},
                 {"", "\"string freeflight\" \"regular\""}},
                make, media);
  EXPECT_NE(make("\"string bounds\" \"progressive\"").made->scene->media()[0]->learnedBounds(), nullptr);
  // 15 voxels and one around them on either side, from a whole brick on.
  EXPECT_NE(mediumOf(make("\"integer supervoxels\" [ 3 1 5 ]"))->describe().find("super-voxels 3 x 1 x 5"),
            std::string::npos)
      << mediumOf(make("\"integer supervoxels\" [ 3 1 5 ]"))->describe();
}

TEST_F(ConstructNanoVdb, IsReadByAGridTooWhenTheFileIsOne) {
  const Attempt grid = attemptWorld("MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" " + one_ +
                                        "\nMediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"",
                                    {.folder = folder_.path()});
  ASSERT_TRUE(grid.isSilent()) << grid.messages();
  EXPECT_EQ(media(grid), media(with(one_)));
}

TEST_F(ConstructNanoVdb, StandsWhereItsDirectiveStands) {
  expectEffects(
      {{"", "Translate 0 0 0.2 "}, {"", "Scale 2 1 1 "}},
      [&](const std::string& before) { return with(one_, before); }, media);
}

TEST_F(ConstructNanoVdb, SaysWhatIsWrongAndWhere) {
  folder_.write("broken.nvdb", "NanoVDB0");
  folder_.write("cloud.vdb", std::string(" BDV\0\0\0\0\xe0\0\0\0", 12));
  const auto expect = [&](const std::string& parameters, const std::string& message,
                          const std::string& place) {
    const Attempt a = with(parameters);
    EXPECT_TRUE(a.failsWith(message)) << a.messages();
    const Diagnostic* d = a.find(Severity::Error, message);
    ASSERT_NE(d, nullptr);
    EXPECT_NE(placeOf(d).find(place), std::string::npos) << placeOf(d);
  };
  expect("", "parameter \"string filename\" is missing", "t.pbrt:2:1");
  expect("\"string filename\" \"none.nvdb\"", "there is no file", "t.pbrt:2:");
  expect("\"string filename\" \"broken.nvdb\"", "truncated", "broken.nvdb");
  expect("\"string filename\" \"cloud.vdb\"", "\"vdb2pbrt cloud.vdb\" makes an .nvdb file of it",
         "t.pbrt:2:");
  expect("\"string filename\" \"\"", "the name is empty, expected a file", "t.pbrt:2:");
  expect(two_ + "\"string grid\" \"smok\" \"float densityscale\" -1", "expected >= 0", "t.pbrt:2:");
  expect(two_ + "\"string grid\" \"Smoke\"", "no grid is called \"Smoke\"; the file holds:", "t.pbrt:2:88");
  expect(two_, "several grids could be the density: name one", "t.pbrt:2:");
  EXPECT_TRUE(with(one_ + "\"string grd\" \"smoke\"").warns("unknown parameter \"grd\""));
}

TEST_F(ConstructNanoVdb, NegativeDensitiesCountAsZeroAndAreToldOnce) {
  const Attempt a = with(one_ + "\"float densityoffset\" -0.26");
  ASSERT_TRUE(a.warns("the grid holds ")) << a.messages();
  EXPECT_TRUE(a.warns("negative values, the first at ")) << a.messages();
  EXPECT_EQ(a.diagnostics.all().size(), 1u) << a.messages();
  const Medium& medium = *a.made->scene->media()[0];
  RenderCounters counters;
  for (int i = 0; i < 4000; ++i) {
    const Point3f p{0.4f * static_cast<float>(i % 20) - 4, 0.4f * static_cast<float>(i / 20 % 20) - 4,
                    0.8f * static_cast<float>(i / 400) - 4};
    EXPECT_GE(medium.at(p, counters).sigmaS.r, 0) << p;
  }
  const StrictAttempts strict;
  EXPECT_TRUE(with(one_ + "\"float densityoffset\" -0.26").failsWith("the grid holds "));
}

TEST_F(ConstructNanoVdb, AFileThatNoShapeUsesIsNotRead) {
  folder_.write("broken.nvdb", "NanoVDB0");
  const Attempt a = attemptWorld(
      "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"broken.nvdb\" Shape "
      "\"sphere\"",
      {.folder = folder_.path()});
  EXPECT_TRUE(a.made.has_value()) << a.messages();
}

}  // namespace
}  // namespace pbrtmedia::test
