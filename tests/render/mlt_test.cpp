// SPDX-License-Identifier: BSD-2-Clause
// Markov chains make the image of independent samples, whatever their number and length.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include "cameras/camera.h"
#include "render/render_state.h"
#include "support/compare_images.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

std::string mlt(const std::string& parameters) { return "\"mlt\" " + parameters; }
/// Few chains, and short ones.
const std::string kFew = "\"integer chains\" 7 \"integer bootstrapsamples\" 500 ";

const std::string kPlane =
    "Material \"matte\" \"rgb Kd\" [ .5 .5 .5 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
    "\"point P\" [ -9 -9 1 9 -9 1 9 9 1 -9 9 1 ]\n";

/// All paths are as bright, so chains have no noise.
TEST(Mlt, IsExactWhereAllPathsBringTheSame) {
  const std::string sky =
      pencil(4, 3, mlt("\"integer maxdepth\" 0 " + kFew)) + "WorldBegin\n" + kWhiteEnvironment + "WorldEnd\n";
  EXPECT_NEAR(imageMean(renderText(sky).image), 1, 1e-5);
  // Through a slab that absorbs.
  const std::string slab = pencil(4, 3, mlt("\"integer maxdepth\" 0 " + kFew)) + "WorldBegin\n" +
                           kWhiteEnvironment +
                           "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .7 .7 .7 "
                           "] \"rgb sigma_s\" [ 0 "
                           "0 0 ]\n" +
                           mediumBox("m", {-5, -5, 1}, {5, 5, 3}) + "WorldEnd\n";
  EXPECT_NEAR(imageMean(renderText(slab).image), std::exp(-1.4), 1e-5);
}

TEST(Mlt, IsUnbiasedHoweverShortItsChains) {
  // A plane of albedo 1/2 under a sky of 1. One scattering: 1/2, found by all four strategies.
  for (const std::string& chains :
       {kFew, std::string("\"integer chains\" 1000 \"integer bootstrapsamples\" 300 "),
        kFew + "\"float largestepprobability\" 0 ", kFew + "\"float largestepprobability\" 1 ",
        kFew + "\"float sigma\" .2 "}) {
    const std::string text =
        pencil(4, 2, mlt("\"integer maxdepth\" 1 \"integer mutationsperpixel\" 2 " + chains)) +
        "WorldBegin\n" + kWhiteEnvironment + kPlane + "WorldEnd\n";
    const ZTest test = zTestOfMean(text, .5, 0, 256);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << chains << test;
    EXPECT_TRUE(test.sees(.05)) << chains << test;
  }
}

TEST(Mlt, IsAWhiteFurnaceInAMediumToo) {
  // All light comes out again of a ball that scatters it: 1, but for what paths beyond 64 scatterings bring.
  const std::string text =
      pencil(3, 16,
             mlt("\"integer maxdepth\" 64 \"integer mutationsperpixel\" 64 \"integer chains\" 20 \"integer "
                 "bootstrapsamples\" 200")) +
      "WorldBegin\n" + kWhiteEnvironment +
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] \"rgb sigma_s\" [ 1 1 "
      "1 "
      "]\n" +
      mediumBox("m", {-1, -1, 1}, {1, 1, 3}) + "WorldEnd\n";
  const ZTest test = zTestOfMean(text, 1, 0, 128);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees(.05)) << test;
}

const std::string kRoom =
    "Film \"image\" \"integer xresolution\" 23 \"integer yresolution\" 17 \"float cropwindow\" [ .1 .95 0 .9 "
    "]\nPixelFilter \"mitchell\"\nSampler \"halton\"\nIntegrator \"mlt\" \"integer maxdepth\" 3 \"integer "
    "mutationsperpixel\" 6 \"integer chains\" 37 \"integer bootstrapsamples\" 3000\nLookAt 0 -4 1.6  0 0 .9  "
    "0 0 "
    "1\nCamera \"perspective\"\nWorldBegin\nMaterial \"matte\" \"rgb Kd\" [ .7 .6 .5 ]\nShape "
    "\"trianglemesh\" "
    "\"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -2 -2 0 2 -2 0 2 2 0 -2 2 0 ]\nLightSource \"point\" "
    "\"point from\" [ -.6 -.5 2 ] \"rgb I\" [ 5 4 3 ]\nMakeNamedMedium \"m\" \"string type\" \"homogeneous\" "
    "\"rgb "
    "sigma_a\" [ .2 .2 .2 ] \"rgb sigma_s\" [ 1.4 1 .6 ]\n" +
    mediumBox("m", {-.8, -.8, .2}, {.8, .8, 1.6}) + "WorldEnd\n";

/// The same, with the parameters of another integrator.
std::string roomBy(const std::string& integrator) {
  std::string text = kRoom;
  const std::size_t from = text.find("\"mlt\""), end = text.find("\nLookAt");
  return text.replace(from, end - from, integrator);
}

TEST(Mlt, CropsAndFiltersAsBdptDoes) {
  RunningStats chains, independent;
  for (std::uint64_t seed = 1; seed <= 256; ++seed) {
    chains.add(imageMean(renderText(kRoom, {.seed = seed}).image));
    independent.add(imageMean(
        renderText(roomBy("\"bdpt\" \"integer maxdepth\" 3"), {.seed = 1000 + seed, .samplesPerPixel = 4})
            .image));
  }
  const ZTest test = zTest(chains, independent);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees(.05)) << test;
}

struct Outcome {
  Image image;
  RenderResult result;
};
Outcome renderRoom(const RenderOptions& options, unsigned threads) {
  const ThreadLimit limit(threads);
  const Construction made = constructText(kRoom, {.seed = options.seed});
  Outcome outcome;
  outcome.result = made.integrator->render(*made.camera, *made.sampler, *made.film, options);
  outcome.image = made.film->develop();
  return outcome;
}

TEST(Mlt, TakesTheSameBitsForAnyThreadsAndPasses) {
  const Outcome one = renderRoom({.seed = 9}, 1);
  ASSERT_GT(imageMean(one.image), .01);
  EXPECT_EQ(one.result.samplesTaken, one.result.samplesTotal);
  EXPECT_EQ(one.result.pixelsSampled, one.result.pixelsTotal);
  for (const RenderOptions& options :
       {RenderOptions{.seed = 9}, RenderOptions{.seed = 9, .samplesPerPass = 1},
        RenderOptions{.seed = 9, .samplesPerPass = 4}}) {
    const Outcome other = renderRoom(options, 3);
    EXPECT_EQ(one.image.data(), other.image.data());
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
    EXPECT_EQ(one.result.carried, other.result.carried);
  }
  EXPECT_NE(one.image.data(), renderRoom({.seed = 10}, 1).image.data());
}

TEST(Mlt, GoesOnFromAStateToTheSameBits) {
  const Outcome whole = renderRoom({.seed = 3}, 2);
  const Construction made = constructText(kRoom, {.seed = 3});
  RenderState state;
  made.integrator->render(*made.camera, *made.sampler, *made.film,
                          {.seed = 3, .samplesPerPass = 1, .afterPass = [&](const PassEnd& end) {
                             state = saveState(*made.scene, *made.film, end.result);
                             return end.result.completedSamplesPerPixel < 2;
                           }});
  ASSERT_EQ(state.result.completedSamplesPerPixel, 2);
  const auto goOn = [&](const RenderState& from) {
    const Construction rest = constructText(kRoom, {.seed = 3});
    EXPECT_TRUE(restoreState(from, *rest.scene, *rest.film));
    rest.integrator->render(*rest.camera, *rest.sampler, *rest.film, {.seed = 3, .start = &from});
    return rest.film->develop();
  };
  EXPECT_EQ(goOn(state).data(), whole.image.data());
  state.result.carried.pop_back();
  EXPECT_THROW(goOn(state), SceneError);
}

/// Has the render stopped at one of its rays.
class StoppingCamera final : public Camera {
 public:
  StoppingCamera(const Camera& camera, int last, std::atomic<bool>& stop)
      : Camera(camera.worldFromCamera(), 0, 1), camera_(camera), left_(last), stop_(stop) {}
  WeightedRay generateRay(Point2f film, Point2f lens, float time) const override {
    if (left_-- == 0) stop_ = true;
    return camera_.generateRay(film, lens, time);
  }

 private:
  const Camera& camera_;
  mutable std::atomic<int> left_;
  std::atomic<bool>& stop_;
};

TEST(Mlt, KeepsTheMutationsOfAPassThatIsCutOff) {
  constexpr int kStarts = 500 + 7;
  const std::string sky =
      pencil(4, 3, mlt("\"integer maxdepth\" 0 \"integer mutationsperpixel\" 3 " + kFew)) + "WorldBegin\n" +
      kWhiteEnvironment + "WorldEnd\n";
  const ThreadLimit one(1);
  for (const int mutations : {-300, 5, 20, 40}) {
    const Construction made = constructText(sky);
    std::atomic<bool> stop{false};
    const RenderResult cut = made.integrator->render(StoppingCamera(*made.camera, kStarts + mutations, stop),
                                                     *made.sampler, *made.film, {.stop = &stop});
    EXPECT_TRUE(cut.interrupted);
    EXPECT_EQ(cut.samplesTaken, static_cast<std::uint64_t>(std::max(0, mutations + 1)));
    EXPECT_NEAR(imageMean(made.film->develop()), mutations < 0 ? 0 : 1, 1e-5) << mutations;
  }
}

TEST(Mlt, IsBlackWhereThereIsNoLight) {
  const std::string text = pencil(4, 2, mlt(kFew)) + "WorldBegin\n" + kPlane + "WorldEnd\n";
  EXPECT_EQ(imageMean(renderText(text).image), 0);
}

/// A quarter of the mutations that PBRT-v3's image has, of which we must not have more noise than they would
/// have. The truth is the image of its path tracer, of the same room: its own of `mlt` is 0.6 % too dark.
TEST(MltParity, IsNoFurtherFromTheTruthThanPbrts) {
  const auto folder = pbrtSceneFolder();
  if (!folder) GTEST_SKIP() << "the PBRT-v3 scenes are not beside this checkout";
  constexpr int kSeeds = 4, kMutations = 256;  // PBRT-v3: 4096
  constexpr double kFewer = 4096.0 / (kSeeds * kMutations);
  const Image theirs = readImage(*folder / "reference" / "own-mlt-room.exr"),
              truth = readImage(*folder / "reference" / "own-path-room.exr");
  std::vector<Image> images;
  Image mean(truth.width(), truth.height());
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    images.push_back(
        renderFile(*folder / "own-mlt-room.pbrt", {.seed = seed, .samplesPerPixel = kMutations}).image);
    for (int y = 0; y < mean.height(); ++y) {
      for (int x = 0; x < mean.width(); ++x)
        mean.setRgb(x, y, mean.rgb(x, y) + images.back().rgb(x, y) / static_cast<float>(kSeeds));
    }
  }
  const double ratio = squaredDistance(mean, truth) / squaredDistance(theirs, truth);
  const MeanDistance toTruth = meanDistance(images, truth);
  std::printf(
      "mean %+.4f %% of the truth (standard error %.4f %%); squared distance from it %.3f of PBRT-v3's\n",
      100 * toTruth.difference, 100 * toTruth.standardError, ratio);
  EXPECT_LT(std::abs(toTruth.difference), .005 + 3 * toTruth.standardError);
  EXPECT_LT(ratio, kFewer);
}

}  // namespace
}  // namespace pbrtmedia::test
