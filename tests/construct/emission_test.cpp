// SPDX-License-Identifier: BSD-2-Clause
#include "construct/emission.h"

#include <gtest/gtest.h>

#include <cmath>

#include "construct/attempt.h"
#include "spectrum/spectrum.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

const std::string kHomogeneous = "\"string type\" \"homogeneous\" ";
const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 "
    "\"float density\" [ 1 1 ] \"string border\" \"clamp\" ";
/// The unit cube, in front of the camera.
const std::string kInBox = "\nMediumInterface \"m\" \"\" Material \"none\" " + boxMesh({0, 0, 1}, {1, 1, 2});

Attempt with(const std::string& parameters) {
  return attemptWorld("Translate 0 0 1 MakeNamedMedium \"m\" " + parameters + " Identity" + kInBox);
}

/// Mean of a channel of the picture of the cube from the front, sigma_a 2, against the radiance `le`.
ZTest seen(const std::string& parameters, double le, std::size_t channel = 0) {
  const double deep = -std::expm1(-2.0);
  return zTestOfMean(pencil(4, 64, "\"volpath\"", "Translate -0.5 -0.5 0", 0.4) +
                         "WorldBegin\nTranslate 0 0 1 MakeNamedMedium \"m\" \"rgb sigma_a\" [ 2 2 2 ] "
                         "\"rgb sigma_s\" [ 0 0 0 ] " +
                         parameters + " Identity" + kInBox + "WorldEnd\n",
                     le * deep, channel);
}

TEST(ConstructEmission, RadianceIsLeTimesLescale) {
  const std::string type = kGrid;
  const ZTest plain = seen(type + "\"rgb Le\" [ 1 2 3 ]", 2, 1),
              scaled = seen(type + "\"rgb Le\" [ 1 2 3 ] \"float Lescale\" 5", 15, 2),
              body = seen(type + "\"blackbody Le\" [ 3000 2 ]", double{blackbodyToRgb(3000, 2).r});
  for (const ZTest& test : {plain, scaled, body}) EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_GT(std::abs(seen(type + "\"rgb Le\" [ 1 2 3 ]", 3, 1).z()), kMaxAbsZ);
  // Without noise, but for the rounding of sums.
  EXPECT_NEAR(seen(kHomogeneous + "\"rgb Le\" [ 4 4 4 ] \"float Lescale\" .5", 2).mean, -2 * std::expm1(-2.0),
              1e-5);
  EXPECT_EQ(seen(kHomogeneous, 0).mean, 0);
}

TEST(ConstructEmission, GridsOfFactorsAndTemperatures) {
  const double body = double{blackbodyToRgb(3000, 1).r};
  const ZTest factors = seen(kGrid + "\"rgb Le\" [ 1 1 1 ] \"float Lescale\" [ 3 3 ]", 3),
              temperatures = seen(kGrid + "\"float temperature\" [ 3000 3000 ]", body),
              mapped = seen(kGrid +
                                "\"float temperature\" [ 31 31 ] \"float temperaturescale\" 100 "
                                "\"float temperatureoffset\" 1 \"float Lescale\" 2",
                            2 * body),
              both = seen(kGrid + "\"float temperature\" [ 3000 3000 ] \"float Lescale\" [ 2.5 2.5 ]",
                          2.5 * body);
  for (const ZTest& test : {factors, temperatures, mapped, both})
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_EQ(seen(kGrid + "\"float temperature\" [ 90 100 ]", 0).mean, 0);
}

TEST(ConstructEmission, WrongInputIsToldWhereItStands) {
  const Attempt negative = with(kHomogeneous + "\"rgb Le\" [ 1 -2 3 ]");
  EXPECT_TRUE(negative.warns("negative channels count as 0"));
  EXPECT_FALSE(negative.warns("PBRT-v3")) << "whose media do not emit";
  for (const std::string map : {"temperaturescale", "temperatureoffset"}) {
    EXPECT_TRUE(with(kGrid + "\"rgb Le\" [ 1 1 1 ] \"float " + map + "\" 2")
                    .failsWith('"' + map + "\": needs \"float temperature\", which is not given"));
  }
  EXPECT_TRUE(with(kHomogeneous + "\"rgb Le\" [ 1 1 1 ] \"float Lescale\" -1").failsWith("negative"));
  EXPECT_TRUE(with(kHomogeneous + "\"rgb Le\" [ 1 1 1 ] \"float Lescale\" [ 1 2 ]")
                  .failsWith("found 2 values, expected 1"));
  EXPECT_TRUE(with(kHomogeneous + "\"float temperature\" [ 1 2 ]").warns("temperature"));
  EXPECT_TRUE(with(kGrid + "\"float Lescale\" [ 1 2 3 ]").failsWith("expected 1 or nx*ny*nz = 2"));
  EXPECT_TRUE(
      with(kGrid + "\"float temperature\" [ 1 2 3 ]").failsWith("found 3 values, expected nx*ny*nz = 2"));
  EXPECT_TRUE(with(kGrid + "\"float temperature\" [ 1 -2 ]").warns("negative value at voxel (1, 0, 0)"));
  EXPECT_TRUE(with(kGrid + "\"float temperature\" [ 1 2 ] \"rgb Le\" [ 1 1 1 ]").failsWith("one of them"));
  EXPECT_TRUE(with(kGrid + "\"rgb le\" [ 1 1 1 ]").warns("Le"));
  EXPECT_TRUE(with(kGrid + "\"rgb Le\" [ 1 1 1 ] ").isSilent());
  EXPECT_TRUE(
      with(kGrid + "\"rgb Le\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ] \"string law\" \"davis\" ").isSilent());
}

TEST(ConstructEmission, GlowingMediumIsALightAndNoDarkScene) {
  Attempt a = attempt(kSmall + "WorldBegin\nMakeNamedMedium \"m\" " + kGrid + "\"rgb Le\" [ 1 1 1 ]" +
                      kInBox + "WorldEnd\n");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_EQ(a.made->scene->illuminants().size(), 1u);
  Attempt dark = attempt(kSmall + "WorldBegin\nMakeNamedMedium \"m\" " + kGrid + kInBox + "WorldEnd\n");
  EXPECT_TRUE(dark.warns("black")) << dark.messages();
}

TEST(ConstructVolPath, KnowsEveryWayOfSamplingLightsInMedia) {
  const auto with = [](const std::string& word) {
    return attemptWorld("Shape \"sphere\"", {},
                        "Integrator \"volpath\" \"string mediumlightsampling\" \"" + word + "\"");
  };
  for (const std::string word :
       {"auto", "collision", "equiangular", "mis", "attenuation-driven", "attenuation-driven-sir",
        "source-driven", "scattering-driven", "source-scattering-mis"}) {
    EXPECT_EQ(with(word).find(Severity::Error, "mediumlightsampling"), nullptr) << word;
  }
  EXPECT_NE(with("equiangle").find(Severity::Error, "equiangular"), nullptr);
}

}  // namespace
}  // namespace pbrtmedia::test
