// SPDX-License-Identifier: BSD-2-Clause
// Bidirectional path tracing makes the image that paths from the camera make, pixel by pixel.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "film/splat_buffer.h"
#include "integrators/bdpt/bdpt.h"
#include "lighting/light_strategy.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

constexpr int kResolution = 5;
constexpr std::uint64_t kSeed = 20261130;
constexpr std::uint64_t kSeeds = 48;
/// What a difference of light must not get away with.
constexpr double kTooBright = 1.05;

struct AgreementScene {
  const char* name;
  std::string world;
  int samples = 32;       ///< per seed and pixel
  std::string view = "";  ///< before the camera
  int maxDepth = 4;
  const char* camera = "\"perspective\" \"float fov\" 40";
  friend std::ostream& operator<<(std::ostream& os, const AgreementScene& s) { return os << s.name; }
};

const std::string kFloor =
    "Material \"matte\" \"rgb Kd\" [ .7 .6 .5 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 0 2 -2 0 2 2 0 -2 2 0 ]\n"
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 1.5 0 2 1.5 0 2 1.5 3 -2 "
    "1.5 3 ]\n";
const std::string kBall =
    "AttributeBegin\nMaterial \"plastic\" \"rgb Kd\" [ .2 .3 .5 ] \"float roughness\" .2\n"
    "Translate .5 .3 .6\nShape \"sphere\" \"float radius\" .5\nAttributeEnd\n";
const std::string kLamp =
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 9 8 6 ]\nMaterial \"matte\" \"rgb Kd\" [ .3 .3 "
    ".3 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2 ] \"point P\" [ -.6 -.6 2.6 .6 -.6 2.6 "
    ".6 .6 2.6 -.6 .6 2.6 ]\nAttributeEnd\n";
const std::string kSmoke =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .2 .2 .2 "
    "] \"rgb sigma_s\" [ 1.4 1.4 1.4 ] \"float g\" .4\n";

const std::string kThin =
    "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 .1 .1 "
    "] \"rgb sigma_s\" [ .3 .3 .3 ]\n";

std::string inBox(const std::string& medium, const std::string& name = "m") {
  return medium + mediumBox(name, {-.8, -.8, .2}, {.8, .8, 1.6});
}
std::string gridMedium(const std::string& extra = "") {
  std::string text =
      "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [ .3 .3 .3 ] \"rgb sigma_s\" "
      "[ 3 3 3 ] \"integer nx\" 3 \"integer ny\" 3 \"integer nz\" 3 \"point p0\" [ -.8 -.8 .2 ] \"point p1\" "
      "[ .8 .8 1.6 ] \"float density\" [ ";
  Rng rng(3);
  for (int i = 0; i < 27; ++i) text += std::to_string(i % 4 == 0 ? 0 : 2 * rng.uniform()) + ' ';
  return text + "] " + extra + '\n';
}

std::vector<AgreementScene> scenes() {
  const std::string point = "LightSource \"point\" \"point from\" [ -.6 -.5 2 ] \"rgb I\" [ 5 4 3 ]\n";
  const std::string surfaces = kFloor + kBall;
  const std::string chromatic =
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 .3 .6 ] \"rgb sigma_s\" [ "
      "2 1 .6 ]\n";
  const std::string rough = "Material \"glass\" \"float uroughness\" .4 \"float vroughness\" .4\n";
  return {
      {"area", surfaces + kLamp},
      {"point", surfaces + point},
      {"spot", surfaces +
                   "LightSource \"spot\" \"point from\" [ -.6 -.5 2 ] \"point to\" [ .2 .2 0 ] \"rgb I\" "
                   "[ 7 6 5 ] \"float coneangle\" 40 \"float conedeltaangle\" 10\n"},
      {"distant", surfaces + "LightSource \"distant\" \"point from\" [ -1 -2 3 ] \"rgb L\" [ 2 2 1 ]\n"},
      {"infinite", surfaces + kWhiteEnvironment},
      {"mirror",
       surfaces + kLamp +
           "AttributeBegin\nMaterial \"mirror\"\nTranslate -.6 .2 .6\nShape \"sphere\" \"float "
           "radius\" .4\nAttributeEnd\n",
       64},
      {"sphereLight", surfaces +
                          "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 20 18 12 ]\n"
                          "Translate -.6 -.4 2.6\nShape \"sphere\" \"float radius\" .2\nAttributeEnd\n"},
      {"lampWithoutMaterial",
       kFloor +
           "AttributeBegin\nMaterial \"none\"\nAreaLightSource \"diffuse\" \"rgb L\" [ 6 5 4 ] \"bool "
           "twosided\" \"true\"\nTranslate 0 0 2.9\nShape \"sphere\" \"float radius\" .3\nAttributeEnd\n"},
      {"severalLights", surfaces + kLamp + point + kWhiteEnvironment},
      {"homogeneous", kFloor + kLamp + inBox(kSmoke)},
      {"homogeneousUnderAPoint", kFloor + point + inBox(kSmoke)},
      {"homogeneousUnderTheSky", kFloor + kWhiteEnvironment + inBox(kSmoke)},
      {"homogeneousUnderTheSun",
       kFloor + "LightSource \"distant\" \"point from\" [ -1 -2 3 ] \"rgb L\" [ 2 2 1 ]\n" + inBox(kSmoke)},
      {"grid", kFloor + kLamp + inBox(gridMedium())},
      {"gridWithLearnedBounds", kFloor + point + inBox(gridMedium("\"string bounds\" \"progressive\" "))},
      {"chromatic", kFloor + kLamp + inBox(chromatic), 64},
      {"emissive",
       kFloor + point +
           inBox("MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [ 1 .6 .3 ] "
                 "\"rgb sigma_a\" [ .6 .6 .6 ] \"rgb sigma_s\" [ .8 .8 .8 ]\n"),
       64},
      {"overlapping",
       kFloor + kLamp +
           "MakeNamedMedium \"a\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .1 .1 .1 ] "
           "\"rgb sigma_s\" [ 1 1 1 ] \"string overlap\" \"add\" \"float g\" .6\n" +
           mediumBox("a", {-1, -1, .1}, {.3, .9, 1.2}) +
           "MakeNamedMedium \"b\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .4 .4 .4 ] \"rgb "
           "sigma_s\" "
           "[ 2 2 2 ] \"string overlap\" \"add\" \"float g\" -.5\n" +
           mediumBox("b", {-.4, -1, .3}, {.9, .8, 1.7}),
       64},
      {"roughGlassAroundAMedium",
       kFloor + kLamp + kSmoke + "AttributeBegin\nMediumInterface \"m\" \"\"\n" + rough +
           "Translate 0 0 .8\nShape \"sphere\" \"float radius\" .6\nAttributeEnd\n",
       128},
      {"glassAroundAMediumUnderTheSky",
       kFloor + kWhiteEnvironment + kSmoke +
           "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"glass\"\n"
           "Translate 0 0 .8\nShape \"sphere\" \"float radius\" .6\nAttributeEnd\n",
       256},
      {"cameraInside", kFloor + point + kThin + mediumBox("m", {-1.9, -4.5, .1}, {1.9, 1.4, 1.9}), 64},
      {"cameraAndLampInEndlessFog", kFloor + point + kBall, 64,
       "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .05 .05 .05 ] \"rgb "
       "sigma_s\" [ .2 .2 .2 ]\nMediumInterface \"\" \"fog\"\n"},
      {"lampInTheMedium", kFloor + kThin + mediumBox("m", {-1.2, -1.2, .2}, {1.2, 1.2, 2.8}) + kLamp, 64},
      {"lampAtTheHeightOfTheCamera",
       kFloor +
           "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ 9 8 6 ]\nMaterial \"matte\" \"rgb Kd\" [ "
           ".3 "
           ".3 .3 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 2 1 0 3 2 ] \"point P\" [ -.6 -.6 1.6 .6 "
           "-.6 1.6 .6 .6 1.6 -.6 .6 1.6 ]\nAttributeEnd\n" +
           kThin + mediumBox("m", {-.8, -.8, .2}, {.8, .8, 1.3})},
      {"otherLaw", kFloor + kLamp + inBox(gridMedium("\"string law\" \"linear\" ")), 64},
      {"lens", kFloor + kLamp + kBall + inBox(kThin), 64, "", 3,
       "\"perspective\" \"float fov\" 40 \"float lensradius\" .2 \"float focaldistance\" 4"},
      {"orthographic", kFloor + kLamp + kBall + inBox(kThin), 64, "", 3,
       "\"orthographic\" \"float screenwindow\" [ -1.5 1.5 -1.5 1.5 ]"},
      {"environment", kFloor + point + kBall + inBox(kThin), 256, "", 3, "\"environment\""},
  };
}

std::string textOf(const AgreementScene& scene, const std::string& integrator, double light = 1,
                   const std::string& parameters = "") {
  std::ostringstream os;
  os << "Film \"image\" \"integer xresolution\" " << kResolution << " \"integer yresolution\" " << kResolution
     << " \"float scale\" " << light << " \"string filename\" \"unused.exr\"\nPixelFilter \"box\"\n"
     << "Sampler \"random\" \"integer pixelsamples\" " << scene.samples << "\nIntegrator \"" << integrator
     << "\" \"integer maxdepth\" " << scene.maxDepth << ' ' << parameters
     << "\nLookAt 0 -4 1.6  0 0 .9  0 0 1\n"
     << scene.view << "Camera " << scene.camera << "\nWorldBegin\n"
     << scene.world << "WorldEnd\n";
  return os.str();
}

/// Of each pixel and channel, over renders of several seeds.
class Images {
 public:
  void add(const Image& image) {
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t i = 3 * static_cast<std::size_t>(y * image.width() + x) + c;
          if (values_.size() <= i) values_.resize(i + 1);
          values_[i].add(image.at(x, y, c));
        }
      }
    }
    for (std::size_t c = 0; c < 3; ++c) means_[c].add(imageMean(image, c));
  }
  const std::vector<RunningStats>& values() const { return values_; }
  const RunningStats& mean(std::size_t c) const { return means_[c]; }

 private:
  std::vector<RunningStats> values_;
  RunningStats means_[3];
};

Images render(const AgreementScene& scene, const std::string& integrator, std::uint64_t firstSeed,
              double light = 1) {
  Images images;
  for (std::uint64_t s = 0; s < kSeeds; ++s)
    images.add(renderText(textOf(scene, integrator, light), {.seed = firstSeed + s}).image);
  return images;
}

/// The largest |z| of a pixel, and of the means.
struct Distance {
  double ofPixel = 0, ofMean = 0;
};
Distance distance(const Images& a, const Images& b) {
  Distance worst;
  for (std::size_t i = 0; i < a.values().size(); ++i)
    worst.ofPixel = std::max(worst.ofPixel, std::abs(zTest(a.values()[i], b.values()[i], kSeed).z()));
  for (std::size_t c = 0; c < 3; ++c)
    worst.ofMean = std::max(worst.ofMean, std::abs(zTest(a.mean(c), b.mean(c), kSeed).z()));
  return worst;
}

class BdptAgreement : public testing::TestWithParam<AgreementScene> {};

TEST_P(BdptAgreement, WithVolPathPixelByPixel) {
  const Images bdpt = render(GetParam(), "bdpt", kSeed),
               volpath = render(GetParam(), "volpath", kSeed + 1000);
  const Distance apart = distance(bdpt, volpath);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_LT(std::abs(zTest(bdpt.mean(c), volpath.mean(c), kSeed).z()), kMaxAbsZ)
        << zTest(bdpt.mean(c), volpath.mean(c), kSeed);
  }
  EXPECT_LT(apart.ofPixel, kMaxAbsZ);
  // Negative control: some more light is seen.
  const Images brighter = render(GetParam(), "bdpt", kSeed, kTooBright);
  const Distance brighterApart = distance(brighter, volpath);
  EXPECT_GT(brighterApart.ofMean, kMaxAbsZ);
  std::printf("%-30s worst pixel %.2f, mean %.2f; 5 %% brighter: %.1f, mean %.1f\n", GetParam().name,
              apart.ofPixel, apart.ofMean, brighterApart.ofPixel, brighterApart.ofMean);
}

class MltAgreement : public BdptAgreement {};

/// Each channel times a factor.
Image scaled(Image image, double factor) {
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) image.setRgb(x, y, image.rgb(x, y) * static_cast<float>(factor));
  }
  return image;
}

TEST_P(MltAgreement, WithVolPathPixelByPixel) {
  const int samples = GetParam().samples;
  const std::string text =
      textOf(GetParam(), "mlt", 1,
             "\"integer mutationsperpixel\" " + std::to_string(16 * samples) +
                 " \"integer chains\" 40 \"integer bootstrapsamples\" " + std::to_string(150 * samples));
  Images mlt, brighter;
  for (std::uint64_t s = 0; s < kSeeds; ++s) {
    const Image image = renderText(text, {.seed = kSeed + s}).image;
    mlt.add(image);
    brighter.add(scaled(image, kTooBright));
  }
  const Images volpath = render(GetParam(), "volpath", kSeed + 1000);
  const Distance apart = distance(mlt, volpath);
  EXPECT_LT(apart.ofMean, kMaxAbsZ);
  EXPECT_LT(apart.ofPixel, kMaxAbsZ);
  // Negative control: some more light is seen.
  const Distance brighterApart = distance(brighter, volpath);
  EXPECT_GT(brighterApart.ofMean, kMaxAbsZ);
  std::printf("%-30s worst pixel %.2f, mean %.2f; 5 %% brighter: %.1f, mean %.1f\n", GetParam().name,
              apart.ofPixel, apart.ofMean, brighterApart.ofPixel, brighterApart.ofMean);
}

/// The mean over the image of one seed, with one strategy left out, or none.
double meanWithout(const std::string& text, std::uint64_t seed, std::optional<BdptParams::Strategy> leftOut) {
  const Construction made = constructText(text, {.seed = seed});
  const auto selector = [&] {
    return makeLightSelector(LightStrategy::Power, made.scene->illuminants(), made.scene->bounds());
  };
  const BdptIntegrator integrator(*made.scene, {.maxDepth = 2, .leftOut = leftOut}, selector(), selector(),
                                  CameraMedium(*made.scene, {0, -4, 1.6f}, 0));
  integrator.render(*made.camera, *made.sampler, *made.film, {.seed = seed});
  return imageMean(made.film->develop(), 1);
}

// The same random numbers with and without: what is missing is what the strategy finds.
TEST(Bdpt, IsDarkerWithoutAnyOfItsStrategies) {
  const std::string text = textOf({"", kFloor + kBall + kLamp + inBox(kSmoke), 16, "", 2}, "bdpt");
  for (int depth = 1; depth <= 2; ++depth) {
    for (int s = 0; s <= depth + 1; ++s) {
      RunningStats missing;
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const double all = meanWithout(text, seed, std::nullopt);
        missing.add(1 - meanWithout(text, seed, BdptParams::Strategy{s, depth + 2 - s}) / all);
      }
      const ZTest test = zTest(missing, 0, 1);
      EXPECT_GT(test.z(), kMaxAbsZ) << "s " << s << ", t " << depth + 2 - s << ": " << test;
      std::printf("without s %d, t %d: darker by %.3f %%\n", s, depth + 2 - s, 100 * missing.mean());
    }
  }
}

/// Paths of a few vertices neither need memory for, nor depend on, what they might have had.
TEST(Bdpt, IsTheSameWhateverMaxDepthBeyondItsPaths) {
  const auto image = [](int maxDepth) {
    return renderText(textOf({"", kFloor + kLamp, 1, "", maxDepth}, "bdpt"), {.seed = 3}).image;
  };
  const Image deep = image(1 << 30);
  EXPECT_EQ(image(200).data(), deep.data());
  EXPECT_NE(image(1).data(), deep.data());
}

/// What light paths would bring to other pixels is then left to the paths of each pixel itself.
TEST(Bdpt, IsThatOfVolpathWhereNobodyWantsSplats) {
  const auto mean = [](const std::string& integrator, bool splats, std::uint64_t firstSeed) {
    const Construction made = constructText(textOf({"", kFloor + kLamp, 1, "", 2}, integrator));
    RunningStats means;
    RenderCounters counters;
    for (std::uint64_t seed = firstSeed; seed < firstSeed + 2000; ++seed) {
      const std::unique_ptr<Sampler> sampler = made.sampler->clone();
      SplatBuffer nobodys;
      double sum = 0;
      for (int i = 0; i < kResolution * kResolution; ++i) {
        sum += double{renderSample(*made.camera, *sampler, samplingIntegrator(made),
                                   {i % kResolution, i / kResolution}, static_cast<std::int64_t>(seed), 1,
                                   seed, counters, {.splats = splats ? &nobodys : nullptr})
                          .g};
      }
      means.add(sum);
    }
    return means;
  };
  const RunningStats truth = mean("volpath", false, 1);
  const ZTest without = zTest(mean("bdpt", false, 10000), truth),
              withSplats = zTest(mean("bdpt", true, 10000), truth);
  EXPECT_LT(std::abs(without.z()), kMaxAbsZ) << without;
  EXPECT_TRUE(without.sees(.03)) << without;
  EXPECT_LT(withSplats.mean, .97 * truth.mean()) << "control: splats are a part of the light";
}

/// Smooth normals of the floor that lean away from the wall. Where a surface faces light but its normal does
/// not, light samples find that, and scattered rays never do: what comes from the wall is missing from the
/// images of `path` and `volpath`, as in PBRT-v3. Paths from both ends find it, and so do photons, where the
/// camera sees such a surface.
TEST(Bdpt, SeesBeyondTheHorizonOfShadingNormalsAsPhotonsDo) {
  const std::string leaning =
      "Material \"matte\" \"rgb Kd\" [ .8 .8 .8 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 "
      "] "
      "\"point P\" [ -2 -2 0 2 -2 0 2 2 0 -2 2 0 ] \"normal N\" [ 0 -1 .3 0 -1 .3 0 -1 .3 0 -1 .3 ]\n"
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 1.5 0 2 1.5 0 2 1.5 3 -2 "
      "1.5 3 ]\nLightSource \"point\" \"point from\" [ -.6 .2 2 ] \"rgb I\" [ 5 5 5 ]\n";
  // The lowest row, which sees the floor alone.
  const auto means = [&](const std::string& integrator, int depth, const std::string& parameters = "") {
    std::string text = textOf({"", leaning, depth == 1 ? 4096 : 512, "", depth}, integrator);
    text.insert(text.find("\"image\"") + 7, " \"float cropwindow\" [ 0 1 .8 1 ]");
    text.insert(text.find("\nLookAt"), parameters);
    RunningStats all;
    for (std::uint64_t seed = 1; seed <= 16; ++seed)
      all.add(imageMean(renderText(text, {.seed = seed}).image, 1));
    return all;
  };
  const ZTest direct = zTest(means("bdpt", 1), means("volpath", 1));
  EXPECT_LT(std::abs(direct.z()), kMaxAbsZ) << direct;
  EXPECT_TRUE(direct.sees()) << direct;
  const RunningStats bdpt = means("bdpt", 2);
  const ZTest photons =
      zTest(means("sppm", 2,
                  " \"integer photonsperiteration\" 20000 \"integer iterations\" 64 \"float "
                  "radius\" .1"),
            bdpt);
  EXPECT_LT(std::abs(photons.z()), kMaxAbsZ) << photons;
  EXPECT_TRUE(photons.sees(.1)) << photons;
  const ZTest paths = zTest(means("volpath", 2), bdpt);
  EXPECT_LT(paths.mean, .7 * bdpt.mean()) << paths;
  std::printf("beyond the horizon: bdpt %.4f, sppm %.4f, volpath %.4f\n", bdpt.mean(), photons.mean,
              paths.mean);
}

TEST(Bdpt, TakesTheSameBitsForAnyThreadsAndTiles) {
  const std::string text =
      "Film \"image\" \"integer xresolution\" 37 \"integer yresolution\" 29 \"float cropwindow\" [ .1 .95 0 "
      ".9 ]\n"
      "PixelFilter \"mitchell\"\nSampler \"halton\" \"integer pixelsamples\" 4\n"
      "Integrator \"bdpt\" \"integer maxdepth\" 5\nLookAt 0 -4 1.6  0 0 .9  0 0 1\nCamera "
      "\"perspective\"\nWorldBegin\n" +
      kFloor + kBall + kLamp + inBox(gridMedium("\"string bounds\" \"progressive\" ")) + "WorldEnd\n";
  const Rendered one = renderText(text, {.seed = 9, .threads = 1, .tileSize = 16});
  ASSERT_GT(imageMean(one.image), .05);
  for (const RenderSettings& settings : {RenderSettings{9, 3, 16, {}}, RenderSettings{9, 3, 7, {}}}) {
    const Rendered other = renderText(text, settings);
    EXPECT_EQ(one.image.data(), other.image.data())
        << settings.threads << " threads, tiles of " << settings.tileSize;
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, MltAgreement, testing::ValuesIn(scenes()),
                         [](const auto& value) { return std::string(value.param.name); });
INSTANTIATE_TEST_SUITE_P(Scenes, BdptAgreement, testing::ValuesIn(scenes()),
                         [](const auto& value) { return std::string(value.param.name); });

}  // namespace
}  // namespace pbrtmedia::test
