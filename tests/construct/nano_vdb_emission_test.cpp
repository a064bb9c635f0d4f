// SPDX-License-Identifier: BSD-2-Clause
// Media of type "nanovdb" that emit by a second grid.
#include <gtest/gtest.h>

#include "construct/attempt.h"
#include "fields/nano_vdb_samples.h"
#include "media/emission/emission_volume.h"
#include "media/medium.h"
#include "spectrum/spectrum.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

class ConstructNanoVdbEmission : public testing::Test {
 protected:
  ConstructNanoVdbEmission() {
    NanoVdbSample smoke{
        .min = {-7, -7, -7}, .max = {7, 7, 7}, .worldFromIndex = Transform::scale(.1, .1, .1)};
    smoke.name = "smoke";
    smoke.valueAt = [](Ijk) { return 2.0; };
    // Of another extent and other voxels: half as large, above z = 0 only.
    NanoVdbSample fire{
        .min = {-20, -20, 2}, .max = {20, 20, 10}, .worldFromIndex = Transform::scale(.05, .05, .05)};
    fire.name = "fire";
    fire.valueAt = [](Ijk) { return 0.5; };
    writeNanoVdb(folder_.path() / "two.nvdb", {smoke, fire});
  }
  Attempt with(const std::string& parameters) const {
    return attemptWorld(
        "MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"two.nvdb\" \"string grid\" "
        "\"smoke\" \"rgb sigma_a\" [ 1 2 3 ] " +
            parameters + "\nMediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"",
        {.folder = folder_.path()});
  }
  static Rgb emissionAt(const Attempt& a, Point3f p) {
    RenderCounters counters;
    return a.made->scene->media()[0]->at(p, counters).emission;
  }
  static void expectNear(Rgb found, Rgb expected) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(found[c], expected[c], 2e-3f * expected.max());
  }

  static void expectAllFound(const Attempt& a) {
    const Medium& medium = *a.made->scene->media()[0];
    const Segment up{{0.1f, -0.2f, -2}, {0, 0, 1}, 0, 4};
    const auto volume = medium.emissionVolume({});
    ASSERT_NE(volume, nullptr);
    std::size_t emitting = 0;
    Rng rng(1);
    RenderCounters counters;
    for (int i = 0; i < 400; ++i) {
      const double t = 0.01 * i + 0.005;
      if (emissionAt(a, up.at(t)).isBlack()) continue;
      ++emitting;
      const Segment there{up.o, up.d, t - 0.005, t + 0.005};
      // In dense cells free flights find it, which end in so short a stretch now and then only.
      bool isFound = false;
      for (int k = 0; k < 400 && !isFound; ++k) {
        isFound = medium.sampleEmission(there, rng, counters).count > 0;
      }
      EXPECT_TRUE(isFound) << t;
      EXPECT_GT(volume->directionDensity(there), 0) << t;
    }
    EXPECT_GT(emitting, 20u);
  }

  TemporaryFolder folder_;
  const Point3f inFire_{0.1f, -0.2f, 0.3f}, below_{0.1f, -0.2f, -0.3f};
};

TEST_F(ConstructNanoVdbEmission, TemperaturesOfAnotherGridOfTheFile) {
  const Attempt a = with(
      "\"string temperaturegrid\" \"fire\" \"float temperaturescale\" 7500 "
      "\"float temperatureoffset\" .1 \"float Lescale\" 3");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  expectNear(emissionAt(a, inFire_), Rgb(1, 2, 3) * 2.0f * blackbodyToRgb(3000, 3));
  EXPECT_EQ(emissionAt(a, below_), Rgb());
  EXPECT_EQ(a.made->scene->illuminants().size(), 2u);
}

TEST_F(ConstructNanoVdbEmission, FactorsOfAnotherGridOfTheFile) {
  const Attempt a = with("\"string Legrid\" \"fire\" \"rgb Le\" [ 1 2 3 ] \"float Lescale\" 3");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  expectNear(emissionAt(a, inFire_), Rgb(1, 4, 9) * (2 * 0.5f * 3));
  EXPECT_EQ(emissionAt(a, below_), Rgb());
}

/// Exporters write a temperature for the colour and another grid for how much of it burns.
TEST_F(ConstructNanoVdbEmission, TemperaturesTimesFactors) {
  const Attempt a = with(
      "\"string temperaturegrid\" \"smoke\" \"float temperaturescale\" 1500 \"string Legrid\" \"fire\" "
      "\"float Lescale\" 3");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  expectNear(emissionAt(a, inFire_), Rgb(1, 2, 3) * (2 * 0.5f) * blackbodyToRgb(3000, 3));
  EXPECT_EQ(emissionAt(a, below_), Rgb()) << "hot, and nothing burns";
}

/// The places that distances and light samples look at must cover all that emits.
TEST_F(ConstructNanoVdbEmission, DistancesFindAllOfIt) {
  for (const char* emission :
       {"\"string Legrid\" \"fire\" \"rgb Le\" [ 1 1 1 ]",
        "\"string Legrid\" \"fire\" \"string temperaturegrid\" \"smoke\" \"float temperaturescale\" 1e3"}) {
    SCOPED_TRACE(emission);
    const Attempt a = with(emission);
    ASSERT_TRUE(a.made) << a.messages();
    expectAllFound(a);
  }
}

TEST_F(ConstructNanoVdbEmission, WrongNamesAreToldWhereTheyStand) {
  const Attempt missing = with("\"string temperaturegrid\" \"fyre\"");
  EXPECT_TRUE(missing.failsWith("fyre")) << missing.messages();
  EXPECT_TRUE(with("\"string temperaturegrid\" \"fire\" \"string Legrid\" \"heet\"").failsWith("heet"));
  EXPECT_TRUE(with("\"string temperaturegrid\" \"fire\" \"rgb Le\" [ 1 1 1 ]").failsWith("one of them"));
}

}  // namespace
}  // namespace pbrtmedia::test
