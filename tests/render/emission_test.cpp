// SPDX-License-Identifier: BSD-2-Clause
// Media that emit, as scenes have them: every source of bounds, instances, and places where no light sample
// looks.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// Red radiance of the first pixel's samples under the bounds that are in force. `learningPasses`: of the
/// whole film, before.
RunningStats samplesOf(const std::string& text, std::int64_t samples, std::uint64_t seed = 1,
                       int learningPasses = 0) {
  const Construction made = constructText(text, {.samplesPerPixel = learningPasses > 0 ? learningPasses : 1});
  if (learningPasses > 0) {
    RenderOptions loop;
    loop.seed = seed + 1000;
    EXPECT_EQ(made.scene->learners().size(), 1u);
    made.integrator->render(*made.camera, *made.sampler, *made.film, loop);
  }
  const std::unique_ptr<Sampler> sampler = made.sampler->clone();
  RenderCounters counters;
  RunningStats stats;
  for (std::int64_t i = 0; i < samples; ++i) {
    stats.add(static_cast<double>(
        renderSample(*made.camera, *sampler, samplingIntegrator(made), {0, 0}, i, samples, seed, counters)
            .r));
  }
  EXPECT_EQ(counters.droppedTotal(), 0u);
  EXPECT_EQ(counters.mediumMismatches, 0u);
  return stats;
}

std::string volpath(int maxDepth) { return "\"volpath\" \"integer maxdepth\" " + std::to_string(maxDepth); }

/// Looks along z through the middle of a quarter of [-1, 1]^3.
const std::string kAlongZ = "LookAt .5 .5 -3  .5 .5 0  0 1 0";
/// Looks at the point of a floor at y = -2 that is below the origin; no part of the cube is on the way.
const std::string kAtFloor = "LookAt 0 -1.5 -3  0 -2 0  0 1 0";
const std::string kFloor =
    "AttributeBegin\nMaterial \"matte\" \"rgb Kd\" [ .5 .5 .5 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -9 -2 -9  -9 -2 9  9 -2 9  9 "
    "-2 "
    "-9 ]\nAttributeEnd\n";

std::string grey(const std::string& name, double value) {
  std::ostringstream os;
  os << "\"rgb " << name << "\" [ " << value << ' ' << value << ' ' << value << " ] ";
  return os.str();
}
std::string medium(const std::string& parameters, double sigmaA, double sigmaS, double le) {
  return "MakeNamedMedium \"m\" " + grey("sigma_a", sigmaA) + grey("sigma_s", sigmaS) + grey("Le", le) +
         parameters + "\n";
}

const std::string kBox = " \"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 ] ";
const std::string kBlocks =
    "Texture \"blocks\" \"float\" \"checkerboard\" \"integer dimension\" 3 \"float tex1\" .2 "
    "\"float tex2\" 2\n";
/// Blocks of densities 0.2 and 2: along kAlongZ one of each.
const std::string kTexture = "\"string type\" \"texture\" \"texture density\" \"blocks\" " + kBox;
const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 "
    "\"float density\" [ .2 2 ] \"float Lescale\" [ 1 1 ] \"string border\" \"clamp\" " +
    kBox;
/// As deep as that.
const std::string kEvenGrid =
    "\"string type\" \"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" "
    "2 \"float density\" [ 1.1 1.1 ] \"string border\" \"clamp\" " +
    kBox;
const std::string kPerlin =
    "\"string type\" \"perlin\" \"integer octaves\" 4 \"float frequency\" 2 \"float threshold\" .3 " + kBox;
const std::string kCube = mediumBox("m", {-1, -1, -1}, {1, 1, 1});

std::string constantBound(double majorant) {
  return "\"string bounds\" \"constant\" \"float majorant\" " + std::to_string(majorant) + ' ';
}
const std::string kLearned = "\"string bounds\" \"progressive\" \"float initialextinction\" .01 ";

TEST(EmissionUnderUnprovenBounds, ThinBrightGasIsWithinAPercentAtSixtyFourSamples) {
  // Optical depth 2.2e-6. A first bound of 0.01 is far above these extinctions and cuts nothing.
  const auto sceneOf = [](const std::string& parameters) {
    return pencil(1, 1, volpath(3), kAlongZ) + "WorldBegin\n" + kBlocks +
           medium(parameters, 1e-6, 0, 1 / 2.2e-6) + kCube + "WorldEnd\n";
  };
  for (const std::string& parameters : {kTexture + constantBound(2e-6), kTexture + constantBound(1),
                                        kTexture + kLearned, kEvenGrid + kLearned}) {
    const RunningStats pixels = samplesOf(sceneOf(parameters), 1 << 12);
    EXPECT_NEAR(pixels.mean(), 1, 2e-3 + kMaxAbsZ * pixels.standardError()) << parameters;
    EXPECT_LT(std::sqrt(pixels.variance() / 64), .01) << parameters;
  }
}

TEST(EmissionUnderUnprovenBounds, AbsorbingTextureShowsItsOpticalDepth) {
  const std::string scene = pencil(1, 1, volpath(3), kAlongZ) + "WorldBegin\n" + kBlocks +
                            medium(kTexture + constantBound(1.4), .7, 0, 3) + kCube + "WorldEnd\n";
  const RunningStats pixels = samplesOf(scene, 1 << 18);
  const ZTest test = zTest(pixels, 3 * -std::expm1(-.7 * 2.2), 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees()) << test;
  // Negative control: one block missing would be seen.
  EXPECT_GT(std::abs(zTest(pixels, 3 * -std::expm1(-.7 * 2), 1).z()), kMaxAbsZ);
}

TEST(EmissionUnderUnprovenBounds, HotFurnaceIsWhiteWhateverIsCut) {
  // Emission and absorption are cut alike: every pass of a furnace is white.
  const auto furnace = [](const std::string& parameters) {
    return pencil(2, 1, volpath(100000), kAlongZ, .5) + "WorldBegin\n" + kWhiteEnvironment + kBlocks +
           medium(parameters, .5, 1, 1) + kCube +
           "Material \"matte\" \"rgb Kd\" [ 1 1 1 ] Shape \"sphere\" \"float radius\" .4\nWorldEnd\n";
  };
  for (const std::string& parameters : {kTexture + constantBound(3), kTexture + kLearned, kGrid + kLearned,
                                        kPerlin + kLearned, kPerlin + constantBound(1.5)}) {
    for (const int learningPasses : {0, 16}) {
      if (learningPasses > 0 && parameters.find("progressive") == std::string::npos) continue;
      // A texture of blocks is noisy under bounds that hold, which are far above half of the blocks.
      const bool isNoisy = parameters.find("texture") != std::string::npos &&
                           (learningPasses > 0 || parameters.find("constant") != std::string::npos);
      const ZTest test =
          zTest(samplesOf(furnace(parameters), isNoisy ? 110'000 : 24'000, 1, learningPasses), 1, 1);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << parameters << ": " << test;
      EXPECT_TRUE(test.sees()) << parameters << ": " << test;
    }
  }
}

TEST(EmissionUnderUnprovenBounds, LightSamplesSeeTheMediumThatIsCut) {
  // Sigma_t 8 under a first bound of 2: until bounds are published a quarter of the medium is there.
  const auto floor = [](const std::string& parameters, double sigmaA, double sigmaS, std::int64_t samples) {
    return samplesOf(pencil(1, 1, volpath(4), kAtFloor) + "WorldBegin\n" +
                         medium(parameters, sigmaA, sigmaS, 5) + kFloor + kCube + "WorldEnd\n",
                     samples);
  };
  const std::string slab =
      "\"string type\" \"analytic\" \"string function\" \"slab\" \"float from\" -2 \"float to\" 2 " + kBox +
      "\"string bounds\" \"progressive\" \"float initialextinction\" 2";
  const RunningStats cut = floor(slab, 6, 2, 1 << 18),
                     quarter = floor("\"string type\" \"homogeneous\"", 1.5, .5, 1 << 16),
                     whole = floor("\"string type\" \"homogeneous\"", 6, 2, 1 << 14);
  const auto z = [&](const RunningStats& a) {
    return (cut.mean() - a.mean()) / std::hypot(cut.standardError(), a.standardError());
  };
  EXPECT_LT(std::abs(z(quarter)), kMaxAbsZ) << cut.mean() << " and " << quarter.mean();
  EXPECT_GT(std::abs(z(whole)), kMaxAbsZ) << "negative control";
}

TEST(EmissionUnderUnprovenBounds, IsFoundAsWellAsUnderThoseOfTheData) {
  // A small flame in a large box over a floor.
  const auto floor = [](const std::string& bounds, int learningPasses) {
    const std::string flame =
        "\"string type\" \"analytic\" \"string function\" \"sphere\" \"float radius\" .3 \"float edge\" .2 "
        "\"point center\" [ .3 .2 .4 ] " +
        kBox + bounds;
    return samplesOf(pencil(4, 1, volpath(2), kAtFloor, .5) + "WorldBegin\n" + medium(flame, 8, 2, 20) +
                         kFloor + kCube + "WorldEnd\n",
                     1 << 14, 1, learningPasses);
  };
  const RunningStats exact = floor("", 0);
  for (const auto& [bounds, passes] : {std::pair{constantBound(10), 0}, {kLearned, 256}}) {
    const RunningStats other = floor(bounds, passes);
    const double z = (other.mean() - exact.mean()) / std::hypot(other.standardError(), exact.standardError());
    EXPECT_LT(std::abs(z), kMaxAbsZ) << bounds << other.mean() << " and " << exact.mean();
    // Where the flame is unknown to light samples, the variance is some thirty times as large.
    EXPECT_LT(other.variance(), 3 * exact.variance()) << bounds;
  }
}

TEST(EmissionInInstances, LooksAsIfPlacedDirectly) {
  // The same cube of blocks in the world: directly, or through an instance of an object of an instance. By
  // the same random numbers: where paths are told apart by rounding, some few differ.
  const auto scene = [](bool nested) {
    const std::string place = "Translate 1 2 -1 Rotate 30 1 2 3 Scale 2 .5 1.5\n",
                      inner = "Rotate 50 0 1 1 Scale 1 2 1\n",
                      undo =
                          "Scale 1 .5 1 Rotate -50 0 1 1  Scale .5 2 .666666666666667 Rotate -30 1 2 3 "
                          "Translate -1 -2 1\n";
    // What an object holds is placed by the CTM of its definition first.
    const std::string grid = medium(kGrid, .7, .5, 4);
    return pencil(4, 256, volpath(4), kAtFloor, .6) + "WorldBegin\n" + kFloor +
           (nested ? "AttributeBegin\n" + undo + "ObjectBegin \"cube\"\n" + grid + kCube +
                         "ObjectEnd\nAttributeEnd\nObjectBegin \"group\"\n" + inner +
                         "ObjectInstance \"cube\"\nObjectEnd\nAttributeBegin\n" + place +
                         "ObjectInstance \"group\"\nAttributeEnd\n"
                   : grid + kCube) +
           "WorldEnd\n";
  };
  const Rendered direct = renderText(scene(false), {.seed = 1}),
                 placed = renderText(scene(true), {.seed = 1});
  for (int i = 0; i < 16; ++i) {
    const double a = direct.image.at(i % 4, i / 4, 0), b = placed.image.at(i % 4, i / 4, 0);
    EXPECT_GT(a, 0);
    EXPECT_NEAR(b, a, kVisible * a) << "pixel " << i;
  }
  EXPECT_NEAR(imageMean(placed.image), imageMean(direct.image), 1e-3 * imageMean(direct.image));
  for (const Rendered* r : {&direct, &placed}) EXPECT_EQ(r->result.counters.mediumMismatches, 0u);
}

TEST(EmissionBeyondLightSamples, EndlessGasIsAFurnace) {
  // Nothing has the gas inside: it is no light, and what paths find of it counts fully.
  for (const double sigmaS : {0., 2.}) {
    const std::string text = "MediumInterface \"\" \"m\"\n" + pencil(1, 1, volpath(100000), kAlongZ) +
                             "WorldBegin\n" + medium("\"string type\" \"homogeneous\"", .5, sigmaS, 1) +
                             "MediumInterface \"\" \"m\"\nMaterial \"matte\" \"rgb Kd\" [ 1 1 1 ]\n"
                             "Translate .5 .5 0 Shape \"sphere\" \"float radius\" 1\nWorldEnd\n";
    EXPECT_TRUE(constructText(text).scene->illuminants().empty());
    const ZTest test = zTest(samplesOf(text, sigmaS > 0 ? 130'000 : 1024), 1, 1);
    EXPECT_NEAR(test.mean, 1, 1e-5 + kMaxAbsZ * test.standardError);
    EXPECT_TRUE(test.sees()) << test;
  }
}

TEST(EmissionBeyondLightSamples, CountsFullyOutsideTheBoxOfTheLight) {
  // The gas is everywhere but between two boxes: light samples look for it inside the inner one only.
  const std::string text = "MediumInterface \"\" \"m\"\n" + pencil(1, 1, volpath(100000), kAlongZ) +
                           "WorldBegin\n" + medium("\"string type\" \"homogeneous\"", .5, 1, 1) +
                           "MediumInterface \"\" \"m\"\nMaterial \"none\"\n" +
                           boxMesh({-1, -1, -1}, {2, 2, 1}) + "MediumInterface \"m\" \"\"\n" +
                           boxMesh({-.8, -.8, -.5}, {1.8, 1.8, .8}) +
                           "Material \"matte\" \"rgb Kd\" [ 1 1 1 ] MediumInterface \"\" \"m\"\nTranslate .5 "
                           ".5 3 Shape \"sphere\" "
                           "\"float radius\" 1\nWorldEnd\n";
  EXPECT_EQ(constructText(text).scene->illuminants().size(), 1u);
  const ZTest test = zTest(samplesOf(text, 65'000), 1, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees()) << test;
}

TEST(EmissionBeyondLightSamples, CountsFullyBehindMirrorsAndGlass) {
  // A slab of optical depth 1.4 seen in a mirror, and through a pane met head on that does not reflect
  // inside.
  const double slab = 4 * -std::expm1(-1.4), passed = sqr(1 - sqr(.5 / 2.5));
  const std::string gas = medium("\"string type\" \"homogeneous\"", .7, 0, 4);
  const auto seen = [&](const std::string& view, const std::string& material) {
    return samplesOf(pencil(1, 1, volpath(8), view) + "WorldBegin\n" + gas + kCube + "Material " + material +
                         "\n" + boxMesh({-5, -5, -2.2}, {5, 5, -1.8}) + "WorldEnd\n",
                     1 << 15);
  };
  const ZTest mirrored =
                  zTest(seen("LookAt .5 .5 -1.5  .5 .5 -3  0 1 0", "\"mirror\" \"rgb Kr\" [ .8 .8 .8 ]"),
                        .8 * slab, 1),
              through =
                  zTest(seen(kAlongZ, "\"glass\" \"rgb Kr\" [ 0 0 0 ] \"float eta\" 1.5"), passed * slab, 1);
  EXPECT_NEAR(mirrored.mean, mirrored.truth, 1e-5 + kMaxAbsZ * mirrored.standardError);
  EXPECT_NEAR(through.mean, through.truth, 1e-5 + kMaxAbsZ * through.standardError);
  EXPECT_TRUE(mirrored.sees()) << mirrored;
  EXPECT_TRUE(through.sees()) << through;
}

const std::string kDavis = "\"string law\" \"davis\" \"float correlation\" 1.5 \"float beta\" .5 ",
                  kLinear = "\"string law\" \"linear\" \"float extent\" 3 ",
                  kMixture = "\"string law\" \"mixture\" \"float thin\" .1 \"float thick\" 3 ";

TEST(EmissionUnderLaws, HotFurnaceOfProceduralDensityIsWhite) {
  // White only if flights collide where emission is found, whatever the density and its bounds.
  for (const std::string& law : {kDavis, kMixture, kLinear}) {
    for (const std::string& bounds : {std::string(), constantBound(3)}) {
      if (law == kLinear && !bounds.empty()) continue;  // its weights are noisy under loose bounds
      const std::string scene = pencil(2, 1, volpath(100000), kAlongZ, .5) + "WorldBegin\n" +
                                kWhiteEnvironment + medium(kPerlin + law + bounds, 1, 2, 1) + kCube +
                                "Material \"matte\" \"rgb Kd\" [ 1 1 1 ] Shape \"sphere\" \"float radius\" "
                                ".4\nWorldEnd\n";
      const ZTest test = zTest(samplesOf(scene, 8000), 1, 1);
      EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << law << bounds << ": " << test;
      EXPECT_LT(test.standardError, .03) << law << bounds << ": " << test;
    }
  }
}

TEST(EmissionUnderLaws, IntegratorsAgree) {
  // By light samples and distances, and by distances alone.
  for (const std::string& law : {kDavis, kLinear}) {
    const auto floor = [&](const std::string& integrator, std::uint64_t seed) {
      return samplesOf(pencil(1, 1, integrator + " \"integer maxdepth\" 3", kAtFloor) + "WorldBegin\n" +
                           medium(kPerlin + law, 2, 2, 5) + kFloor + kCube + "WorldEnd\n",
                       1 << 15, seed);
    };
    const RunningStats a = floor("\"volpath\"", 1), b = floor("\"bdpt\"", 2);
    const double error = std::hypot(a.standardError(), b.standardError());
    EXPECT_LT(std::abs(a.mean() - b.mean()), kMaxAbsZ * error) << law << a.mean() << " and " << b.mean();
    EXPECT_LT(error, .03 * a.mean());
    EXPECT_GT(a.mean(), 0);
  }
}

}  // namespace
}  // namespace pbrtmedia::test
