// SPDX-License-Identifier: BSD-2-Clause
// Bounds that are learned while rendering: where the image converges to, and that it depends on nothing else.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <string_view>

#include "media/medium.h"
#include "render/render_state.h"
#include "support/render_scene.h"

namespace pbrtmedia::test {
namespace {

/// Explored before the first sample, as is the default.
const std::string kExplored = " \"string bounds\" \"progressive\" \"float initialextinction\" 0.01 ";
/// As in the paper: nothing is known before the first pass.
const std::string kUnknown = kExplored + "\"integer warmup\" 0 ";

/// A square of parallel rays along z through the unit cube, which holds the medium; white all around.
std::string cube(int resolution, int spp, const std::string& medium, int maxDepth = 5) {
  return pencil(resolution, spp, "\"volpath\" \"integer maxdepth\" " + std::to_string(maxDepth),
                "LookAt .5 .5 -1  .5 .5 1  0 1 0", .45) +
         "WorldBegin\n" + kWhiteEnvironment + medium + mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
}

std::string medium(const std::string& type, double sigmaA, double sigmaS, const std::string& more) {
  std::ostringstream os;
  os << "MakeNamedMedium \"m\" \"string type\" \"" << type << "\" \"rgb sigma_a\" [ " << sigmaA << ' '
     << sigmaA << ' ' << sigmaA << " ] \"rgb sigma_s\" [ " << sigmaS << ' ' << sigmaS << ' ' << sigmaS
     << " ] " << more << '\n';
  return os.str();
}

/// sigma(z) = 0.1 + 1000 exp(-(z - 0.5)² / (2 0.002²)); its optical depth is 0.1 + 2 sqrt(2 pi).
std::string needle(const std::string& more) {
  return medium("analytic", 1, 0, "\"string function\" \"needle\" \"integer supervoxels\" [ 1 1 16 ]" + more);
}
const double kNeedle = std::exp(-0.1 - 2 * std::sqrt(2 * std::numbers::pi));

std::string perlin(const std::string& more) {
  return medium(
      "perlin", 2, 10,
      "\"integer octaves\" 5 \"float frequency\" 3 \"float threshold\" 0.3 \"integer supervoxels\" 6 " +
          more);
}

std::string grid(const std::string& more) {
  std::string text =
      "\"string border\" \"clamp\" \"integer nx\" 5 \"integer ny\" 4 \"integer nz\" 6 "
      "\"float density\" [";
  for (int i = 0; i < 5 * 4 * 6; ++i) text += i % 7 == 0 ? " 2.5" : i % 3 == 0 ? " 0" : " 0.3";
  return medium("heterogeneous", 2, 8, text + " ] " + more);
}

/// Statistics over the pixels, which are independent.
RunningStats pixelsOf(const Image& image) {
  RunningStats stats;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) stats.add(static_cast<double>(image.at(x, y, 0)));
  }
  return stats;
}

/// The image of a render that starts with what another one, of another seed, has learned in its passes.
Rendered continued(const std::string& text, int learningPasses, std::uint64_t seed) {
  const Construction first = constructText(text, {.seed = seed + 1000, .samplesPerPixel = learningPasses}),
                     second = constructText(text, {.seed = seed});
  RenderOptions loop;
  loop.seed = seed + 1000;
  first.integrator->render(*first.camera, *first.sampler, *first.film, loop);
  loop.seed = seed;
  EXPECT_TRUE(second.scene->learners()[0]->learnedBounds()->restore(
      first.scene->learners()[0]->learnedBounds()->save()));
  Rendered rendered;
  rendered.result = second.integrator->render(*second.camera, *second.sampler, *second.film, loop);
  rendered.image = second.film->develop();
  return rendered;
}

TEST(Progressive, FindsANeedleOfUnknownHeight) {
  const std::string scene = cube(24, 128, needle(kUnknown));
  const ZTest learned = zTest(pixelsOf(continued(scene, 64, 1).image), kNeedle, 1);
  EXPECT_LT(std::abs(learned.z()), kMaxAbsZ) << learned;
  // The average over all passes, from the first on, comes closer with every pass.
  const double few = imageMean(renderText(scene, {.seed = 3, .samplesPerPixel = 16}).image) - kNeedle,
               many = imageMean(renderText(scene, {.seed = 3, .samplesPerPixel = 256}).image) - kNeedle;
  EXPECT_GT(few, .05) << "the first passes do not see the needle";
  EXPECT_LT(many, few / 8);
  // Negative control: without publication nothing is learned.
  const Construction made = constructText(scene, {.seed = 1});
  const std::unique_ptr<Sampler> sampler = made.sampler->clone();
  RenderCounters counters;
  RunningStats samples;
  for (std::int64_t i = 0; i < 64 * 128; ++i) {
    const Point2i pixel{static_cast<int>(i % 24), static_cast<int>(i / 24 % 24)};
    samples.add(static_cast<double>(
        renderSample(*made.camera, *sampler, samplingIntegrator(made), pixel, i / (24 * 24), 128, 1, counters)
            .r));
  }
  const ZTest unlearned = zTest(samples, kNeedle, 1);
  EXPECT_GT(std::abs(unlearned.z()), kMaxAbsZ) << unlearned;
}

struct Case {
  const char* name;
  std::string (*medium)(const std::string&);
  const char* ways;
  /// What any render of one sample a pixel may lack after a warm-up. Smooth densities are found; of the peaks
  /// of a grid, each at one point of a super-voxel of 64 pieces, the tips may be missed.
  double mostShortfall;
};
constexpr double kSmooth = LearningRecord::kMostShortfall, kPeaks = .01;

class ProgressiveImage : public testing::TestWithParam<Case> {};

TEST_P(ProgressiveImage, ConvergesToThatOfExactBounds) {
  const std::string ways = GetParam().ways;
  const auto scene = [&](const std::string& bounds) {
    return cube(16, 64, GetParam().medium(ways + bounds));
  };
  RunningStats exact, learned, fresh;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    exact.add(imageMean(renderText(scene(""), {.seed = seed}).image));
    learned.add(imageMean(continued(scene(kUnknown), 256, seed).image));
  }
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    fresh.add(imageMean(renderText(scene(kUnknown), {.seed = seed, .samplesPerPixel = 4}).image));
  const auto z = [&](const RunningStats& a) {
    return (a.mean() - exact.mean()) / std::hypot(a.standardError(), exact.standardError());
  };
  EXPECT_LT(std::abs(z(learned)), kMaxAbsZ) << learned.mean() << " and " << exact.mean();
  EXPECT_GT(std::abs(z(fresh)), kMaxAbsZ) << "negative control: four passes are no convergence";
}

TEST_P(ProgressiveImage, AndItsStatisticsDependOnSceneAndSeedAlone) {
  const std::string scene = cube(21, 7, GetParam().medium(GetParam().ways + kUnknown));
  const Rendered one = renderText(scene, {.seed = 5, .threads = 1});
  ASSERT_EQ(one.result.learning.size(), 1u);
  ASSERT_EQ(one.result.learning[0].passes.size(), 7u);
  EXPECT_GT(one.result.learning[0].passes[0].cut, 0u);
  EXPECT_GT(one.result.learning[0].passes[0].raised, 0u);
  for (const RenderSettings& settings :
       {RenderSettings{5, 2, 16, {}}, RenderSettings{5, 5, 16, {}}, RenderSettings{5, 2, 4, {}}}) {
    const Rendered other = renderText(scene, settings);
    EXPECT_EQ(one.image.data(), other.image.data()) << settings.threads << " threads";
    EXPECT_EQ(one.result.counters.densityLookups, other.result.counters.densityLookups);
    for (std::size_t k = 0; k < 7; ++k) {
      const LearningProgress &a = one.result.learning[0].passes[k], &b = other.result.learning[0].passes[k];
      EXPECT_EQ(a.cut, b.cut);
      EXPECT_EQ(a.raised, b.raised);
      EXPECT_EQ(a.visited, b.visited);
      EXPECT_EQ(a.maximum, b.maximum);
    }
  }
  EXPECT_NE(one.image.data(), renderText(scene, {.seed = 6}).image.data());
}

INSTANTIATE_TEST_SUITE_P(
    FieldsAndTrackers, ProgressiveImage,
    testing::Values(
        Case{"Perlin", perlin, "", kSmooth}, Case{"Grid", grid, "", kPeaks},
        Case{"GridByResiduals", grid,
             "\"string transmittance\" \"residual-ratio\" \"string freeflight\" \"decomposition\" ", kPeaks},
        Case{"PerlinByDelta", perlin, "\"string freeflight\" \"delta\" ", kSmooth},
        Case{"GridByMarching", grid, "\"string transmittance\" \"unbiased-ray-marching\" ", kPeaks},
        Case{"PerlinBySingleParticle", perlin, "\"string freeflight\" \"single-particle\" ", kSmooth}),
    [](const auto& value) { return std::string(value.param.name); });

TEST_P(ProgressiveImage, IsRightFromTheFirstSampleAfterAWarmUp) {
  // The mean of many renders of one sample a pixel, as merged parts are.
  const std::string ways = GetParam().ways;
  const auto scene = [&](const std::string& bounds) { return cube(16, 1, GetParam().medium(ways + bounds)); };
  RunningStats exact, explored, unknown, shortfalls;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    exact.add(imageMean(renderText(scene(""), {.seed = seed}).image));
    const Rendered part = renderText(scene(kExplored), {.seed = seed + 1000});
    explored.add(imageMean(part.image));
    shortfalls.add(part.result.learning[0].shortfall);
    EXPECT_LT(part.result.learning[0].shortfall, GetParam().mostShortfall) << seed;
    const Rendered blind = renderText(scene(kUnknown), {.seed = seed + 2000});
    unknown.add(imageMean(blind.image));
    EXPECT_TRUE(blind.result.learning[0].isRising()) << blind.result.learning[0].shortfall;
  }
  EXPECT_LT(shortfalls.mean(), LearningRecord::kMostShortfall);
  const ZTest same = zTest(explored, exact), blind = zTest(unknown, exact);
  EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
  EXPECT_GT(std::abs(blind.z()), kMaxAbsZ) << "negative control: " << blind;
}

TEST_P(ProgressiveImage, DependsOnNoThreadAfterAWarmUp) {
  const std::string scene = cube(21, 2, GetParam().medium(GetParam().ways + kExplored));
  const Rendered one = renderText(scene, {.seed = 5, .threads = 1});
  for (const RenderSettings& settings :
       {RenderSettings{5, 2, 16, {}}, RenderSettings{5, 5, 16, {}}, RenderSettings{5, 2, 4, {}}}) {
    const Rendered other = renderText(scene, settings);
    EXPECT_EQ(one.image.data(), other.image.data()) << settings.threads << " threads";
    EXPECT_EQ(one.result.counters.densityLookups, other.result.counters.densityLookups);
    EXPECT_EQ(one.result.learning[0].warmUpLookups, other.result.learning[0].warmUpLookups);
    EXPECT_EQ(one.result.learning[0].warmUp.maximum, other.result.learning[0].warmUp.maximum);
    EXPECT_EQ(one.result.learning[0].shortfall, other.result.learning[0].shortfall);
  }
  EXPECT_NE(one.image.data(), renderText(scene, {.seed = 6}).image.data());
}

TEST_P(ProgressiveImage, GoesOnElsewhereToTheSameBits) {
  for (const std::string& bounds : {kUnknown, kExplored}) {
    const std::string scene = cube(13, 7, GetParam().medium(GetParam().ways + bounds));
    const Construction whole = constructText(scene), first = constructText(scene),
                       second = constructText(scene), forgetful = constructText(scene);
    const RenderResult expected = whole.integrator->render(*whole.camera, *whole.sampler, *whole.film, {});
    RenderState state;
    first.integrator->render(*first.camera, *first.sampler, *first.film,
                             {.afterPass = [&](const PassEnd& end) {
                               state = saveState(*first.scene, *first.film, end.result);
                               return end.result.completedSamplesPerPixel < 3;
                             }});
    ASSERT_TRUE(restoreState(state, *second.scene, *second.film));
    const RenderResult result =
        second.integrator->render(*second.camera, *second.sampler, *second.film, {.start = &state});
    EXPECT_EQ(second.film->state(), whole.film->state());
    EXPECT_EQ(result.counters.densityLookups, expected.counters.densityLookups);
    ASSERT_EQ(result.learning[0].passes.size(), 7u);
    EXPECT_EQ(result.learning[0].warmUpLookups, expected.learning[0].warmUpLookups);
    EXPECT_EQ(result.learning[0].shortfall, expected.learning[0].shortfall);
    EXPECT_EQ(result.learning[0].passes[6].visited, expected.learning[0].passes[6].visited);
    // Negative control: with the film alone, the passes that are left learn anew.
    ASSERT_TRUE(forgetful.film->restore(state.film));
    forgetful.integrator->render(*forgetful.camera, *forgetful.sampler, *forgetful.film, {.firstSample = 3});
    if (bounds == kUnknown) {
      EXPECT_NE(forgetful.film->state(), whole.film->state());
    }
  }
}

/// Asks to stop when so many samples have begun.
class StoppingSampler final : public Sampler {
 public:
  StoppingSampler(const Sampler& sampler, std::atomic<int>& left, std::atomic<bool>& stop)
      : Sampler(sampler), sampler_(sampler.clone()), left_(left), stop_(stop) {}
  std::string_view typeName() const override { return sampler_->typeName(); }
  std::unique_ptr<Sampler> clone() const override {
    return std::make_unique<StoppingSampler>(*sampler_, left_, stop_);
  }
  void start(Point2i pixel, std::int64_t index) override {
    if (--left_ == 0) stop_ = true;
    sampler_->start(pixel, index);
  }
  float get1D() override { return sampler_->get1D(); }
  Point2f get2D() override { return sampler_->get2D(); }
  void get2DArray(std::span<Point2f> out) override { sampler_->get2DArray(out); }

 private:
  std::unique_ptr<Sampler> sampler_;
  std::atomic<int>& left_;
  std::atomic<bool>& stop_;
};

TEST_P(ProgressiveImage, GoesOnToTheSameBitsAfterAStopInsideAPass) {
  const std::string scene = cube(13, 7, GetParam().medium(GetParam().ways + kUnknown));
  const Construction whole = constructText(scene);
  whole.integrator->render(*whole.camera, *whole.sampler, *whole.film, {});
  for (const int inThird : {1, 60, 168}) {
    const Construction first = constructText(scene), second = constructText(scene);
    const auto area = static_cast<int>(first.film->sampleBounds().area());
    std::atomic<int> left{2 * area + inThird};
    std::atomic<bool> stop{false};
    RenderState state;
    first.integrator->render(*first.camera, StoppingSampler(*first.sampler, left, stop), *first.film,
                             {.stop = &stop, .beforePartialPass = [&](const PassEnd& end) {
                                state = saveState(*first.scene, *first.film, end.result);
                              }});
    ASSERT_EQ(state.result.completedSamplesPerPixel, 2);
    ASSERT_EQ(state.bounds[0].progress.passes, 2u);
    ASSERT_TRUE(restoreState(state, *second.scene, *second.film));
    const RenderResult result =
        second.integrator->render(*second.camera, *second.sampler, *second.film, {.start = &state});
    EXPECT_EQ(second.film->state(), whole.film->state());
    EXPECT_EQ(result.completedSamplesPerPixel, 7);
  }
}

TEST(Progressive, AWarmUpFindsTheNeedle) {
  RunningStats few;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    few.add(imageMean(renderText(cube(24, 1, needle(kExplored)), {.seed = seed}).image));
  }
  const ZTest test = zTest(few, kNeedle, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_LT(test.standardError, .002) << "unseen it is off by a half";
}

TEST(Progressive, AWarmUpIsCountedAndTakenOnce) {
  const std::string scene = cube(8, 2, grid(kExplored + "\"integer warmup\" 3 \"integer supervoxels\" 2 "));
  const Rendered first = renderText(scene, {.seed = 2});
  const LearningRecord& record = first.result.learning[0];
  EXPECT_EQ(record.warmUpPasses, 3);
  EXPECT_EQ(record.warmUpLookups, 8u * 3 * 16);
  EXPECT_EQ(record.passes.size(), 2u) << "no pass of the image";
  EXPECT_GT(record.warmUp.maximum, 2.4f);
  const Rendered blind = renderText(cube(8, 2, grid(kUnknown + "\"integer supervoxels\" 2 ")), {.seed = 2});
  EXPECT_EQ(blind.result.learning[0].warmUpLookups, 0u);
  EXPECT_GT(first.result.counters.densityLookups, record.warmUpLookups);
  // What starts from the bounds of another render needs none.
  const LearningRecord next = continued(scene, 1, 2).result.learning[0];
  EXPECT_TRUE(next.restored);
  EXPECT_EQ(next.warmUpPasses, 0);
  EXPECT_EQ(next.warmUpLookups, 0u);
}

TEST(Progressive, TheShortfallIsTheShareOfExtinctionAboveTheBounds) {
  // Of density z under a bound of a quarter: what is above it is 9/32 of 1/2. Behind it a medium of bounds
  // that hold, with many look-ups more: it has a shortfall of its own.
  const std::string ramp = medium("analytic", 2, 0,
                                  "\"string function\" \"ramp\" \"integer supervoxels\" [ 1 1 4 ] " +
                                      kUnknown + " \"float initialextinction\" .5"),
                    dense =
                        "AttributeBegin\nTranslate 0 0 1\nMakeNamedMedium \"dense\" \"string type\" "
                        "\"analytic\" \"string function\" \"ramp\" \"rgb sigma_a\" [ 20 20 20 ] "
                        "\"rgb sigma_s\" [ 0 0 0 ] \"string transmittance\" \"ratio\" " +
                        kExplored + "\nAttributeEnd\n";
  const auto scene = [&](int spp) {
    return pencil(32, spp, "\"volpath\"", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .45) + "WorldBegin\n" +
           kWhiteEnvironment + ramp + dense + mediumBox("m", {0, 0, 0}, {1, 1, 1}) +
           mediumBox("dense", {0, 0, 1}, {1, 1, 2}) + "WorldEnd\n";
  };
  RunningStats first, all;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const int spp : {1, 4}) {
      const Rendered part = renderText(scene(spp), {.seed = seed});
      ASSERT_EQ(part.result.learning.size(), 2u);
      for (const LearningRecord& record : part.result.learning) {
        if (record.medium == "m") {
          (spp == 1 ? first : all).add(record.shortfall);
          EXPECT_TRUE(record.isRising());
        } else {
          EXPECT_LT(record.shortfall, LearningRecord::kMostShortfall);
        }
      }
    }
  }
  const ZTest test = zTest(first, 9.0 / 16, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_LT(test.standardError, .005);
  // From the second pass on next to nothing is cut; what the first lacks stays in the mean.
  EXPECT_NEAR(all.mean(), 9.0 / 16 / 4, .002);
}

/// Runs no further than behind the first pass.
LearningRecord recordOfFirstPass(const std::string& text) {
  const Construction made = constructText(text);
  RenderOptions loop;
  loop.afterPass = [](const PassEnd&) { return false; };
  return made.integrator->render(*made.camera, *made.sampler, *made.film, loop).learning[0];
}

TEST(Progressive, AWarmUpIsASmallPartOfTheRender) {
  const auto ramp = [](int cells) {
    return medium(
        "analytic", 2, 0,
        "\"string function\" \"ramp\" \"integer supervoxels\" " + std::to_string(cells) + kExplored);
  };
  // By default all of it; of a small render and many super-voxels blocks, and more with more samples.
  const LearningRecord usual = recordOfFirstPass(cube(8, 1, ramp(32)));
  EXPECT_EQ(usual.warmUpPasses, 4);
  EXPECT_EQ(usual.warmUpBlockEdge, 1);
  const LearningRecord coarse = recordOfFirstPass(cube(8, 1, ramp(128)));
  EXPECT_EQ(coarse.warmUpBlockEdge, 4);
  EXPECT_EQ(coarse.warmUpPasses, 4);
  EXPECT_EQ(coarse.warmUpLookups, 1u << 21);
  EXPECT_TRUE(coarse.warmUpIsLimited);
  EXPECT_GE(coarse.warmUp.maximum, 1);
  EXPECT_EQ(coarse.warmUp.visited, 128u * 128 * 128);
  const LearningRecord fine = recordOfFirstPass(cube(128, 256, ramp(64)));
  EXPECT_EQ(fine.warmUpBlockEdge, 1);
  EXPECT_EQ(fine.warmUpPasses, 4) << "of 4 look-ups a sample";
  EXPECT_EQ(fine.warmUpLookups, 4u * 128 * 128 * 256);
  const std::string own = ramp(16) + " \"integer warmuplookups\" ";
  EXPECT_EQ(recordOfFirstPass(cube(8, 1, own + "70000")).warmUpLookups, 65536u);
  EXPECT_EQ(recordOfFirstPass(cube(8, 1, own + "70000")).warmUpPasses, 1);
  EXPECT_EQ(recordOfFirstPass(cube(8, 1, own + "1000000000")).warmUpLookups, 4u * 65536);
  EXPECT_FALSE(recordOfFirstPass(cube(8, 1, own + "1000000000")).warmUpIsLimited);
  EXPECT_EQ(recordOfFirstPass(cube(8, 1, own + "0")).warmUpLookups, 0u);
}

TEST(Progressive, AWarmUpOfBlocksIsRightFromTheFirstSampleToo) {
  RunningStats exact, explored;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    exact.add(imageMean(renderText(cube(16, 1, perlin("")), {.seed = seed}).image));
    const Rendered part =
        renderText(cube(16, 1, perlin(kExplored + "\"integer warmuplookups\" 1728 ")), {.seed = seed + 1000});
    explored.add(imageMean(part.image));
    ASSERT_EQ(part.result.learning[0].warmUpBlockEdge, 2);
    ASSERT_EQ(part.result.learning[0].warmUpPasses, 4);
  }
  const ZTest same = zTest(explored, exact);
  EXPECT_LT(std::abs(same.z()), kMaxAbsZ) << same;
}

TEST(Progressive, AWarmUpStopsWithTheRender) {
  const Construction made = constructText(cube(8, 2, perlin(kExplored)));
  RenderOptions loop;
  const std::atomic<bool> stop{true};
  loop.stop = &stop;
  const RenderResult result = made.integrator->render(*made.camera, *made.sampler, *made.film, loop);
  EXPECT_EQ(result.learning[0].warmUpLookups, 0u);
  EXPECT_TRUE(result.interrupted);
  EXPECT_TRUE(result.learning[0].isRising());
}

TEST(Progressive, ASecondRenderStartsWithoutViolations) {
  const std::string scene = cube(16, 8, grid(kUnknown + "\"float epsilon\" 0.5 "));
  const std::vector<LearningProgress> first = renderText(scene, {.seed = 2}).result.learning[0].passes,
                                      second = continued(scene, 256, 2).result.learning[0].passes;
  EXPECT_GT(first[0].cut, 100u);
  for (const LearningProgress& pass : second) {
    EXPECT_EQ(pass.cut, 0u);
    EXPECT_EQ(pass.raised, 0u);
  }
}

TEST(Progressive, TakesAPassOfOneSampleOnlyWhereBoundsAreLearned) {
  int passes = 0;
  for (const auto& [bounds, expected] : {std::pair(std::string(), 1), {kUnknown, 8}}) {
    const Construction made = constructText(cube(8, 8, grid(bounds)));
    RenderOptions loop;
    passes = 0;
    loop.afterPass = [&](const PassEnd&) { return ++passes > 0; };
    made.integrator->render(*made.camera, *made.sampler, *made.film, loop);
    EXPECT_EQ(passes, expected);
  }
}

TEST(Violations, AreReportedWithARayThatFindsThem) {
  // Density z under a bound of a half: the world stands still, so the ray of the record gives the density.
  const std::string scene =
      cube(9, 6,
           medium("analytic", 1, 1,
                  "\"string function\" \"ramp\" \"integer supervoxels\" 0 \"string bounds\" \"constant\" "
                  "\"float majorant\" 1"));
  const Rendered one = renderText(scene, {.seed = 1, .threads = 1});
  EXPECT_GT(one.result.counters.boundViolations, 10u);
  ASSERT_EQ(one.result.violations.size(), 16u);
  for (const ViolationRecord& v : one.result.violations) {
    EXPECT_EQ(v.medium, "m");
    EXPECT_EQ(v.violation.bound, .5);
    EXPECT_GT(v.violation.density, .5);
    EXPECT_NEAR(v.violation.o.z + v.violation.t * v.violation.d.z, v.violation.density, 1e-5);
  }
  const Rendered other = renderText(scene, {.seed = 1, .threads = 5, .tileSize = 4});
  ASSERT_EQ(other.result.violations.size(), 16u);
  for (std::size_t i = 0; i < 16; ++i) {
    EXPECT_EQ(one.result.violations[i].pixel, other.result.violations[i].pixel);
    EXPECT_EQ(one.result.violations[i].sample, other.result.violations[i].sample);
    EXPECT_EQ(one.result.violations[i].violation.t, other.result.violations[i].violation.t);
  }
}

TEST(Violations, OfAConstantBoundLeaveTheMeanAsItIs) {
  // Of estimates, not of an image: the film keeps negative samples away.
  const Construction made = constructText(
      cube(8, 1,
           medium("analytic", 2, 0,
                  "\"string function\" \"ramp\" \"string bounds\" \"constant\" \"float majorant\" 1.5 "
                  "\"integer supervoxels\" 0")));
  const Medium& m = *made.scene->media()[0];
  Rng rng(4);
  RenderCounters counters;
  const Segment through{{.3f, .6f, -1}, {0, 0, 1}, 0, 5};
  RunningStats estimates, flights;
  for (int n = 0; n < 100000; ++n) {
    estimates.add(static_cast<double>(m.transmittance(through, rng, counters).r));
    const FreeFlight flight = m.sampleFreeFlight(through, Rgb(1), rng, counters);
    flights.add(flight.collided ? 0 : static_cast<double>(flight.weight.r));
  }
  EXPECT_GT(counters.boundViolations, 1000u);
  for (const RunningStats& stats : {estimates, flights}) {
    const ZTest test = zTest(stats, std::exp(-1.0), 4);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  }
}

TEST(Pattern, LeavesTheMeanAndLowersTheVariance) {
  // A point of a disk, lit through an absorbing box: every sample asks for the transmittance of one line.
  const auto pixels = [&](const std::string& box) {
    const std::string scene =
        pencil(32, 64, "\"volpath\" \"integer maxdepth\" 1", "LookAt -2 0 .4  0 0 0  0 0 1") +
        "WorldBegin\nLightSource \"point\" \"point from\" [ 0 0 3 ] \"rgb I\" [ 9 9 9 ]\n"
        "Material \"matte\" Shape \"disk\" \"float radius\" .5\n" +
        box + "WorldEnd\n";
    return pixelsOf(renderText(scene, {.seed = 4}).image);
  };
  const auto through = [&](const std::string& pattern) {
    return pixels(
        medium("analytic", 2, 0,
               "\"string function\" \"slab\" \"float from\" 0 \"float to\" 3 \"point p0\" [ -1 -1 1 ] "
               "\"point p1\" [ 1 1 2 ] \"integer supervoxels\" 0 \"string bounds\" \"constant\" \"float "
               "majorant\" 2 \"string transmittance\" \"track-length\" " +
                   pattern) +
        mediumBox("m", {-1, -1, 1}, {1, 1, 2}));
  };
  const double truth = pixels("").mean() * std::exp(-2.0);
  const RunningStats independent = through("");
  EXPECT_LT(std::abs(zTest(independent, truth, 4).z()), kMaxAbsZ) << zTest(independent, truth, 4);
  for (const std::string name : {"latinhypercube", "hammersley", "halton", "scrambledhalton"}) {
    const RunningStats stats = through("\"string pattern\" \"" + name + "\"");
    const ZTest test = zTest(stats, truth, 4);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << name << test;
    EXPECT_LT(stats.variance(), .2 * independent.variance()) << name;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
