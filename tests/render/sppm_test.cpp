// SPDX-License-Identifier: BSD-2-Clause
// Photons bring what paths find: `sppm` with small radii makes the images of `volpath`, whatever the lights,
// the surfaces and the media. Kernels blur, so means may differ by a little that noise does not explain.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/compare_images.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr int kSeeds = 8;
/// Of small radii: as a share of the image, and of what photons bring to it.
constexpr double kMostBias = .01, kMostBiasOfPhotons = .05;

struct SppmScene {
  const char* name;
  std::string world;
  std::string options;  ///< before WorldBegin
  friend std::ostream& operator<<(std::ostream& os, const SppmScene& s) { return os << s.name; }
};

std::string roomOf(const std::string& material) {
  return "AttributeBegin " + material +
         "\n"
         "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -1 -1 0 1 -1 0 1 1 0 -1 1 "
         "0 ]\n"
         "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -1 1 0 1 1 0 1 1 2 -1 1 2 "
         "]\n"
         "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -1 -1 0 -1 1 0 -1 1 2 -1 "
         "-1 2 "
         "]\n"
         "AttributeEnd\n";
}
const std::string kRoom = roomOf("Material \"matte\" \"rgb Kd\" [ .7 .6 .5 ]");
const std::string kMirrorAndMatte =
    "Material \"uber\" \"rgb Kd\" [ .5 .4 .3 ] \"rgb Kr\" [ .3 .3 .3 ] \"rgb Ks\" [ 0 0 0 ]";
const std::string kPoint = "LightSource \"point\" \"point from\" [ .3 -.4 1.9 ] \"rgb I\" [ 3 2.5 2 ]\n";
const std::string kSpot =
    "LightSource \"spot\" \"point from\" [ .3 -.4 1.9 ] \"point to\" [ 0 .2 0 ] \"rgb I\" [ 8 7 6 ]\n";
const std::string kSun =
    "LightSource \"distant\" \"point from\" [ .3 -.4 1 ] \"point to\" [ 0 0 0 ] \"rgb L\" [ 3 2.5 2 ]\n";
const std::string kSky = "LightSource \"infinite\" \"rgb L\" [ .4 .5 .6 ]\n";
const std::string kLamp =
    "AttributeBegin Material \"matte\" \"rgb Kd\" [ .3 .3 .3 ] AreaLightSource \"diffuse\" \"rgb L\" [ 9 7 5 "
    "]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -.35 -.35 1.98 -.35 .35 1.98 "
    ".35 "
    ".35 1.98 .35 -.35 1.98 ] AttributeEnd\n";
const std::string kFog =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .2 .3 .4 ] \"rgb sigma_s\" [ 1 "
    "1.5 2 "
    "] \"float g\" .4\n";
const std::string kSmoke =
    "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ .5 .5 .5 ] \"rgb sigma_s\" [ "
    "3 3 3 "
    "] \"float g\" .2 \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 3 \"point p0\" [ -.8 -.8 .2 ] \"point "
    "p1\" [ "
    ".8 .8 1.8 ] \"float density\" [ 1 0 .5 .2 0 1 .3 .7 .1 .9 .4 0 ]\n";
std::string ballOf(const std::string& material, double radius) {
  return "AttributeBegin " + material + " Translate 0 0 1 Shape \"sphere\" \"float radius\" " +
         std::to_string(radius) + " AttributeEnd\n";
}
const std::string kInFog = "Material \"none\" MediumInterface \"m\" \"\"";

/// Media that emit, in the room.
const std::string kGlow =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .6 .5 .4 ] \"rgb sigma_s\" [ .5 "
    ".7 .9 ] \"rgb Le\" [ 4 3 2 ]\n";
const std::string kFlame =
    "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ 2 2 2 ] \"rgb sigma_s\" [ 1 1 "
    "1 "
    "] \"rgb Le\" [ 4 3 2 ] \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 3 \"point p0\" [ -.8 -.8 .2 ] "
    "\"point p1\" [ .8 .8 1.8 ] \"float density\" [ 1 0 .5 .2 0 1 .3 .7 .1 .9 .4 0 ]\n";

const std::string kDavis = "\"string law\" \"davis\" \"float correlation\" 1.2 \"float beta\" .5";
/// A medium with more parameters.
std::string underLaw(const std::string& medium, const std::string& law) {
  return medium.substr(0, medium.size() - 1) + ' ' + law + '\n';
}

/// A loose mat of strands under the lamp, in two directions.
std::string strands() {
  std::string text;
  for (int i = 0; i < 14; ++i) {
    const std::string a = std::to_string(-.65 + .1 * i);
    for (const bool across : {false, true}) {
      const auto point = [&](const char* along, const char* z) {
        return (across ? a + ' ' + along : along + (' ' + a)) + ' ' + z + ' ';
      };
      text += "Shape \"curve\" \"string type\" \"" + std::string(across ? "flat" : "cylinder") +
              "\" \"float width\" .05 \"point P\" [ " + point("-.7", "1.2") + point("-.3", "1.5") +
              point(".3", "1.5") + point(".7", "1.2") + "]\n";
    }
  }
  return text;
}

std::string sceneOf(const SppmScene& s, const std::string& integrator, int spp) {
  return "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32\nPixelFilter \"gaussian\" "
         "\"float xwidth\" 1 "
         "\"float ywidth\" 1\nSampler \"halton\" \"integer pixelsamples\" " +
         std::to_string(spp) + "\nIntegrator " + integrator + '\n' + s.options +
         "LookAt 0 -4.2 1  0 0 1  0 0 1\nCamera \"perspective\" \"float fov\" 34\nWorldBegin\n" + s.world +
         "WorldEnd\n";
}
std::string sppm(double radius) {
  return "\"sppm\" \"integer maxdepth\" 4 \"integer iterations\" 8 \"integer photonsperiteration\" 16000 "
         "\"float "
         "radius\" " +
         std::to_string(radius);
}

/// Green, of the whole image.
RunningStats means(const std::string& text, std::uint64_t firstSeed, int seeds = kSeeds) {
  RunningStats all;
  for (std::uint64_t seed = firstSeed; seed < firstSeed + static_cast<std::uint64_t>(seeds); ++seed)
    all.add(imageMean(renderText(text, {.seed = seed}).image, 1));
  return all;
}

class SppmAgreement : public testing::TestWithParam<SppmScene> {};

TEST_P(SppmAgreement, WithVolpath) {
  const RunningStats truth = means(sceneOf(GetParam(), "\"volpath\" \"integer maxdepth\" 4", 64), 1);
  const ZTest test = zTest(means(sceneOf(GetParam(), sppm(.06), 8), 100, 3 * kSeeds / 2), truth);
  // What photons bring is no small part, and must be right by itself.
  const RunningStats single = means(sceneOf(GetParam(), "\"volpath\" \"integer maxdepth\" 1", 16), 1);
  const double part = 1 - single.mean() / truth.mean();
  EXPECT_GT(part, .05);
  EXPECT_LT(std::abs(test.mean - truth.mean()),
            std::min(kMostBias, kMostBiasOfPhotons * part) * truth.mean() +
                kMaxAbsZ * std::hypot(test.standardError, truth.standardError()))
      << test;
  EXPECT_TRUE(test.sees(std::min(.05, .2 * part))) << test << ", photons' part " << part;
  std::printf("%-14s %+.3f %% (%.3f %%) of photons' %.1f %%\n", GetParam().name,
              100 * (test.mean / truth.mean() - 1),
              100 * std::hypot(test.standardError, truth.standardError()) / truth.mean(), 100 * part);
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, SppmAgreement,
    testing::Values(
        SppmScene{"surfaces", kRoom + kPoint, ""},
        SppmScene{"fog", kFog + kRoom + ballOf(kInFog, .7) + kPoint, ""},
        SppmScene{"smoke", kSmoke + kRoom + ballOf(kInFog, .9) + kSpot, ""},
        SppmScene{"fogAlone", kFog + ballOf(kInFog, .9) + kPoint, ""},
        SppmScene{"sky", kFog + kRoom + ballOf(kInFog, .7) + kSky, ""},
        SppmScene{"sun", kFog + kRoom + ballOf(kInFog, .7) + kSun, ""},
        SppmScene{"lamp", kFog + kRoom + ballOf(kInFog, .7) + kLamp, ""},
        SppmScene{"glassAroundFog",
                  kFog + kRoom + ballOf("Material \"glass\" MediumInterface \"m\" \"\"", .6) + kLamp, ""},
        SppmScene{"glow", kGlow + kRoom + ballOf(kInFog, .7), ""},
        SppmScene{"flame", kFlame + kRoom + ballOf(kInFog, .7), ""},
        // The same in two placements, one of them stretched.
        SppmScene{
            "flamesPlaced",
            "ObjectBegin \"flame\"\n" + kFlame + ballOf(kInFog, .7) + "ObjectEnd\n" + kRoom +
                "AttributeBegin Translate -.4 .2 0 Scale .5 .5 .5 ObjectInstance \"flame\" AttributeEnd\n"
                "AttributeBegin Translate .4 0 -.3 Scale .6 .6 1.2 ObjectInstance \"flame\" AttributeEnd\n",
            ""},
        SppmScene{"mixedLobes", roomOf(kMirrorAndMatte) + ballOf(kMirrorAndMatte, .6) + kPoint, ""},
        // Light comes to the room through strands and from them.
        SppmScene{"hair",
                  kRoom + kLamp +
                      "AttributeBegin Material \"hair\" \"rgb sigma_a\" [ .05 .1 .2 ] \"float beta_m\" .6 "
                      "\"float beta_n\" .6 " +
                      strands() + "AttributeEnd\n",
                  ""},
        // Laws with a memory: what light does in a medium depends on where it entered, or scattered last.
        SppmScene{"davisSmoke", underLaw(kSmoke, kDavis) + kRoom + ballOf(kInFog, .9) + kSky, ""},
        SppmScene{"linearSmoke",
                  underLaw(kSmoke, "\"string law\" \"linear\" \"float extent\" 1.5") + kRoom +
                      ballOf(kInFog, .9) + kSky,
                  ""},
        SppmScene{"mixtureFlame",
                  underLaw(kFlame,
                           "\"string law\" \"mixture\" \"float weight\" .4 \"float thin\" 0 "
                           "\"float thick\" 2") +
                      kRoom + ballOf(kInFog, .7),
                  ""},
        SppmScene{
            "pinkInFog",
            underLaw(kSmoke,
                     "\"string law\" \"pinknoise\" \"float correlation\" 1.5 \"string overlap\" \"add\"") +
                "MakeNamedMedium \"n\" \"string type\" \"homogeneous\" \"string overlap\" \"add\" "
                "\"rgb sigma_a\" [ .1 .1 .1 ] \"rgb sigma_s\" [ 1 1.4 1 ]\n" +
                kRoom + ballOf(kInFog, .7) +
                "AttributeBegin Material \"none\" MediumInterface \"n\" \"\" Translate .3 0 1.2 Shape "
                "\"sphere\" \"float radius\" .6 AttributeEnd\n" +
                kSun,
            ""},
        SppmScene{"overlap",
                  "MakeNamedMedium \"n\" \"string type\" \"homogeneous\" \"string overlap\" \"add\" \"rgb "
                  "sigma_a\" [ .1 .1 .1 ] "
                  "\"rgb sigma_s\" [ 1 1 1 ]\n" +
                      kFog + kRoom + ballOf(kInFog, .7) +
                      "AttributeBegin Material \"none\" MediumInterface \"n\" \"\" Translate .3 0 1.2 Shape "
                      "\"sphere\" \"float radius\" .6 AttributeEnd\n" +
                      kPoint,
                  ""}),
    [](const auto& value) { return std::string(value.param.name); });

/// Negative control of agreement under laws: without its law the smoke is another.
TEST(SppmUnderLaws, IsNotTheImageOfTheExponentialLaw) {
  const auto sceneIn = [](const std::string& smoke) {
    return SppmScene{"smoke", smoke + kRoom + ballOf(kInFog, .9) + kSky, ""};
  };
  const ZTest other = zTest(means(sceneOf(sceneIn(underLaw(kSmoke, kDavis)), sppm(.06), 8), 100, 4),
                            means(sceneOf(sceneIn(kSmoke), "\"volpath\" \"integer maxdepth\" 4", 16), 1, 4));
  EXPECT_GT(std::abs(other.z()), kMaxAbsZ) << other;
}

/// As many iterations and photons as PBRT-v3's image has. The truth is its path tracer's, of the same room:
/// what either lacks of it is noise and blur, of which we must not have more.
TEST(SppmParity, IsNoFurtherFromTheTruthThanPbrts) {
  const auto folder = pbrtSceneFolder();
  if (!folder) GTEST_SKIP() << "the PBRT-v3 scenes are not beside this checkout";
  const Image theirs = readImage(*folder / "reference" / "own-sppm-room.exr"),
              truth = readImage(*folder / "reference" / "own-path-room.exr");
  const Image ours = renderFile(*folder / "own-sppm-room.pbrt", {.seed = 1}).image;
  const std::vector<Image> images = {ours};
  const double ratio = squaredDistance(ours, truth) / squaredDistance(theirs, truth);
  const MeanDistance toTheirs = meanDistance(images, theirs), toTruth = meanDistance(images, truth);
  std::printf(
      "mean %+.4f %% of PBRT-v3's, %+.4f %% of the truth; squared distance from it %.3f of PBRT-v3's\n",
      100 * toTheirs.difference, 100 * toTruth.difference, ratio);
  EXPECT_LT(std::abs(toTheirs.difference), .005);
  EXPECT_LT(std::abs(toTruth.difference), .005);
  EXPECT_LT(ratio, 1);
}

TEST(SppmBias, IsThatOfTheRadius) {
  const SppmScene scene{"fog", kFog + kRoom + ballOf(kInFog, .7) + kPoint, ""};
  const RunningStats truth = means(sceneOf(scene, "\"volpath\" \"integer maxdepth\" 4", 64), 1);
  const ZTest wide = zTest(means(sceneOf(scene, sppm(.8), 8), 100), truth);
  EXPECT_GT(std::abs(wide.z()), kMaxAbsZ) << wide;
  EXPECT_GT(std::abs(wide.mean / truth.mean() - 1), 3 * kMostBias) << wide;
}

/// At a radius of which the bias is seen (SppmBias), debiased images have none that a test would see, and
/// progressive ones less.
TEST(SppmDebias, IsTheImageOfVolpathAtAnyRadius) {
  const SppmScene scene{"fog", kFog + kRoom + ballOf(kInFog, .7) + kPoint, ""};
  const RunningStats truth = means(sceneOf(scene, "\"volpath\" \"integer maxdepth\" 4", 64), 1);
  const auto of = [&](const std::string& debias) {
    return zTest(means(sceneOf(scene,
                               "\"sppm\" \"integer maxdepth\" 4 \"integer iterations\" 32 \"integer "
                               "photonsperiteration\" 500 \"float radius\" .8 " +
                                   debias,
                               32),
                       200, 2 * kSeeds),
                 truth);
  };
  const ZTest biased =
      of("\"string kernel\" \"cone\" \"string debias\" \"progressive\" \"float alpha\" .999");
  const ZTest progressive = of("\"string debias\" \"progressive\" \"float alpha\" .4");
  EXPECT_GT(std::abs(biased.z()), kMaxAbsZ) << biased;
  EXPECT_LT(std::abs(progressive.mean - truth.mean()), .7 * std::abs(biased.mean - truth.mean()))
      << progressive;
  for (const char* debias : {"single", "progressive-unbiased"}) {
    const ZTest unbiased = of(std::string("\"string debias\" \"") + debias + '"');
    std::printf("%s %+.3f %% +- %.3f %%, biased %+.3f %%, progressive %+.3f %%\n", debias,
                100 * (unbiased.mean / truth.mean() - 1), 100 * unbiased.standardError / truth.mean(),
                100 * (biased.mean / truth.mean() - 1), 100 * (progressive.mean / truth.mean() - 1));
    EXPECT_LT(std::abs(unbiased.z()), kMaxAbsZ) << unbiased;
    EXPECT_LT(kMaxAbsZ * unbiased.standardError, std::abs(biased.mean - truth.mean())) << unbiased;
  }
}

/// A shutter open while the lamp's shade moves: photons and camera rays of an iteration are at one time.
TEST(SppmMotion, IsThatOfVolpath) {
  const auto sceneAt = [](const char* end) {
    return SppmScene{"moving",
                     kRoom +
                         "AttributeBegin Material \"matte\" \"rgb Kd\" [ .8 .8 .8 ] ActiveTransform EndTime "
                         "Translate " +
                         end +
                         " 0 0 ActiveTransform All Translate .3 -.3 1.2 Shape \"sphere\" \"float radius\" .4 "
                         "AttributeEnd\n" +
                         kPoint,
                     "TransformTimes 0 1\n"};
  };
  const auto truthOf = [&](const char* end, int depth) {
    return means(sceneOf(sceneAt(end), "\"volpath\" \"integer maxdepth\" " + std::to_string(depth), 64), 1);
  };
  const RunningStats truth = truthOf("1.2", 4);
  const std::string text = sceneOf(sceneAt("1.2"),
                                   "\"sppm\" \"integer maxdepth\" 4 \"integer iterations\" 32 \"integer "
                                   "photonsperiteration\" 4000 \"float radius\" .06",
                                   8);
  const ZTest test = zTest(means(text, 100), truth);
  const double bias = kMostBias * (truth.mean() - truthOf("1.2", 1).mean());
  const auto isNear = [&](const RunningStats& to) {
    const double noise = std::hypot(test.standardError, to.standardError());
    return std::abs(test.mean - to.mean()) < bias + kMaxAbsZ * noise;
  };
  EXPECT_TRUE(isNear(truth)) << test;
  // Negative control: were photons of the first moment, or of another than what the camera sees.
  EXPECT_FALSE(isNear(truthOf("0", 4))) << test << ", at rest " << truthOf("0", 4).mean();
}

}  // namespace
}  // namespace pbrtmedia::test
