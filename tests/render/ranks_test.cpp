// SPDX-License-Identifier: BSD-2-Clause
// Renders that several ranks share, which are threads here: the bits of one process.
#include "render/ranks.h"

#include <gtest/gtest.h>

#include <atomic>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/byte_stream.h"
#include "base/diagnostics.h"
#include "media/medium.h"
#include "render/pass_loop.h"
#include "render/pass_shares.h"
#include "render/render_state.h"
#include "render/sample_delivery.h"
#include "render/state_stream.h"
#include "support/fake_render.h"
#include "support/render_scene.h"
#include "support/thread_ranks.h"

namespace pbrtmedia::test {
namespace {

Film filmOfAll() {
  Film::Settings settings;
  settings.resolution = {37, 23};
  settings.layers = LayerSet(maskOf({Layer::Lookups, Layer::Variance, Layer::Samples}));
  Film film(settings, GaussianFilter({}));
  film.keepHalves();
  return film;
}

/// Noise, with look-ups, samples that are dropped, and splats of any place, also beyond the film.
FakeIntegrator everything(bool makesSplats) {
  return FakeIntegrator(
      [makesSplats](const RayDifferential& ray, SampleContext& context) {
        const float u = context.rng.uniform();
        context.counters.densityLookups += static_cast<std::uint64_t>(100 * u);
        if (makesSplats) {
          for (int i = 0; i < 3; ++i) {
            const float x = 45 * context.rng.uniform() - 4, y = 31 * context.rng.uniform() - 4;
            context.splats->add({x, y}, Rgb(context.rng.uniform()));
          }
        }
        if (u < .01f) return Rgb(std::numeric_limits<float>::quiet_NaN());
        return Rgb(ray.o.x * .1f, context.sampler.get1D(), u);
      },
      makesSplats);
}

std::string bytesOf(const Scene& scene, const Film& film, RenderResult result) {
  result.seconds = result.cpuSeconds = 0;
  ByteWriter out;
  writeState(out, scene, film, result);
  return out.text();
}

struct Shared {
  RenderResult result;
  std::string state;  ///< all the numbers of the first rank but seconds
  Film::State film;
};

/// The same render by so many ranks, as the first one has it.
Shared renderShared(const Integrator& integrator, std::size_t count, const RenderOptions& options,
                    std::int64_t spp = 7) {
  Shared shared;
  onRanks(count, [&](ThreadRanks& ranks) {
    const RandomSampler sampler({.pixelSamples = spp, .seed = options.seed});
    Film film = filmOfAll();
    RenderOptions mine = options;
    mine.ranks = &ranks;
    mine.maxRecords = 5;
    const RenderResult result = integrator.render(FlatCamera(), sampler, film, mine);
    EXPECT_FALSE(ranks.hasLost());
    if (!ranks.isFirst()) return;
    shared = {result, bytesOf(integrator.scene(), film, result), film.state()};
  });
  return shared;
}

TEST(Ranks, MakeTheImageOfOneProcess) {
  for (const bool makesSplats : {false, true}) {
    const FakeIntegrator integrator = everything(makesSplats);
    const Shared one = renderShared(integrator, 1, {.seed = 3});
    EXPECT_GT(one.result.counters.droppedTotal(), 5u);
    ASSERT_EQ(one.result.dropped.size(), 5u);
    for (const std::size_t count : {2u, 3u, 4u, 7u, 40u}) {
      const Shared many = renderShared(integrator, count, {.seed = 3, .tileSize = 7});
      EXPECT_EQ(many.film, one.film) << count << " ranks";
      EXPECT_EQ(many.result.dropped, one.result.dropped) << count << " ranks";
      EXPECT_TRUE(many.state == one.state) << count << " ranks: counters or records";
      EXPECT_FALSE(many.result.interrupted);
    }
    const Shared byOnes = renderShared(integrator, 3, {.seed = 3, .samplesPerPass = 1});
    EXPECT_TRUE(byOnes.state == one.state) << "tiles are shared anew by what they cost";
    EXPECT_NE(renderShared(integrator, 3, {.seed = 4}).film, one.film);
  }
}

TEST(Ranks, ShowTheWholeFilmAfterPassesToTheFirstWhichEndsTheRender) {
  const FakeIntegrator integrator = everything(true);
  const RandomSampler sampler({.pixelSamples = 9, .seed = 3});
  std::vector<std::string> alone, shared;
  const auto renderBy = [&](std::size_t count, std::vector<std::string>& states) {
    onRanks(count, [&](ThreadRanks& ranks) {
      Film film = filmOfAll();
      RenderOptions options{.seed = 3, .samplesPerPass = 2, .ranks = &ranks};
      options.afterPass = [&](const PassEnd& end) {
        EXPECT_TRUE(ranks.isFirst()) << "the others are not asked";
        end.bringFilm();
        states.push_back(bytesOf(integrator.scene(), film, end.result));
        return states.size() < 3;
      };
      const RenderResult result = integrator.render(FlatCamera(), sampler, film, options);
      EXPECT_TRUE(result.interrupted);
      EXPECT_EQ(result.completedSamplesPerPixel, 6) << "on every rank";
    });
  };
  renderBy(1, alone);
  renderBy(3, shared);
  ASSERT_EQ(alone.size(), 3u);
  EXPECT_TRUE(shared == alone);
}

TEST(Ranks, LeaveAPassTogetherAndKeepTheWholeOnes) {
  const FakeIntegrator integrator = everything(true);
  const RandomSampler sampler({.pixelSamples = 9, .seed = 3});
  const Shared whole = renderShared(integrator, 1, {.seed = 3}, 9);
  std::atomic<int> taken{0};
  std::atomic<bool> stop{false}, never{false};
  const int area = static_cast<int>(filmOfAll().sampleBounds().area());
  const FakeIntegrator stopping(
      [&](const RayDifferential& ray, SampleContext& context) {
        if (++taken > 5 * area) stop = true;  // in the second of the passes of four
        return everything(true).radiance(ray, context);
      },
      /*makesSplats=*/true);
  std::vector<RenderState> states;
  onRanks(3, [&](ThreadRanks& ranks) {
    Film film = filmOfAll();
    RenderOptions options{.seed = 3, .samplesPerPass = 4, .maxRecords = 5, .ranks = &ranks};
    // One that is not the first is asked to stop, and those that are not go on to the end of the pass.
    options.stop = ranks.rank() == 2 ? &stop : &never;
    options.beforePartialPass = [&](const PassEnd& end) {
      EXPECT_TRUE(ranks.isFirst());
      end.bringFilm();
      states.push_back(saveState(stopping.scene(), film, end.result));
    };
    const RenderResult stopped = stopping.render(FlatCamera(), sampler, film, options);
    EXPECT_TRUE(stopped.interrupted);
    EXPECT_EQ(stopped.completedSamplesPerPixel, 4);
    EXPECT_GT(stopped.samplesTaken, 4u * static_cast<unsigned>(area)) << "those of the others are kept";
  });
  ASSERT_EQ(states.size(), 1u);
  EXPECT_EQ(states[0].result.completedSamplesPerPixel, 4);
  for (const std::size_t count : {1u, 4u}) {  // go on with what three have begun
    onRanks(count, [&](ThreadRanks& ranks) {
      Film film = filmOfAll();
      ASSERT_TRUE(restoreState(states[0], integrator.scene(), film));
      const RenderResult result = integrator.render(
          FlatCamera(), sampler, film, {.seed = 3, .maxRecords = 5, .start = &states[0], .ranks = &ranks});
      if (ranks.isFirst()) {
        EXPECT_TRUE(bytesOf(integrator.scene(), film, result) == whole.state) << count;
      }
    });
  }
}

TEST(Ranks, StopAtTheLookupsOfAll) {
  const FakeIntegrator integrator = everything(false);
  const RenderOptions options{.seed = 3, .samplesPerPass = 1, .mostLookups = 200000};
  const Shared one = renderShared(integrator, 1, options, 20),
               many = renderShared(integrator, 4, options, 20);
  EXPECT_EQ(one.result.stoppedBy, EarlyStop::Lookups);
  EXPECT_EQ(many.result.stoppedBy, EarlyStop::Lookups);
  EXPECT_LT(one.result.completedSamplesPerPixel, 20);
  EXPECT_TRUE(many.state == one.state);
}

TEST(Ranks, HearHowMuchTimeIsLeft) {
  std::atomic<int> heard{0};
  onRanks(3, [&](ThreadRanks& ranks) {
    const FakeIntegrator integrator = everything(false);
    const RandomSampler sampler({.pixelSamples = 4, .seed = 3});
    Film film = filmOfAll();
    RenderOptions options{.seed = 3, .samplesPerPass = 2, .ranks = &ranks};
    options.secondsLeft = [&] { return ranks.isFirst() ? 12.5 : -1; };
    options.limitSeconds = [&](double seconds) {
      EXPECT_FALSE(ranks.isFirst());
      EXPECT_EQ(seconds, 12.5);
      ++heard;
    };
    integrator.render(FlatCamera(), sampler, film, options);
  });
  EXPECT_EQ(heard, 4) << "two passes on two ranks";
}

TEST(Ranks, MoveOnlyWhatOthersNeed) {
  const Film film = filmOfAll();
  const std::size_t perSample = bytesOfSample(film.layers().sampleSize());
  onRanks(4, [&](ThreadRanks& ranks) {
    // Tiles are rows.
    PassShares::Plan plan{.ranks = 4,
                          .film = film.pixelBounds(),
                          .firstNeighbour = film.firstNeighbourRow(),
                          .lastNeighbour = film.lastNeighbourRow()};
    const Bounds2i all = film.sampleBounds();
    for (int y = all.min.y; y < all.max.y; ++y) plan.tiles.push_back({{all.min.x, y}, {all.max.x, y + 1}});
    const PassShares shares(plan);
    SamplePass pass(all, 2, film.layers());
    deliver(ranks, shares, pass, nullptr);
    std::uint64_t rows = 0;
    for (const std::size_t tile : shares.takenBy(ranks.rank())) {
      for (std::size_t to = 0; to < 4; ++to)
        rows += to != ranks.rank() && shares.needs(to, shares.tiles()[tile].min.y) ? 1 : 0;
    }
    EXPECT_GT(rows, 0u);
    EXPECT_EQ(ranks.traffic().bytes, rows * 2 * static_cast<std::size_t>(all.width()) * perSample);
    EXPECT_GE(ranks.traffic().messages, 1u);
    EXPECT_LE(ranks.traffic().messages, 3u);
    EXPECT_GT(ranks.traffic().moving, 0);
  });
}

TEST(Ranks, RefuseAnIntegratorWhosePassesTheyCannotShare) {
  onRanks(2, [](ThreadRanks& ranks) {
    const RenderOptions options{.ranks = &ranks};
    PassLoop loop(emptyScene(), options, {.end = 2, .samplesPerIndex = 4, .pixels = 4});
    try {
      loop.run([](const Pass&) { return std::vector<UnitReport>(); }, [](std::span<const UnitReport>) {});
      ADD_FAILURE() << "each rank would take all samples";
    } catch (const SceneError& e) {
      EXPECT_NE(std::string(e.what()).find("cannot be shared"), std::string::npos) << e.what();
    }
  });
}

/// A cube of noise whose bounds are learned: explored before the first sample, and raised by every pass.
std::string learningScene(const std::string& warmUp) {
  return pencil(20, 6, "\"volpath\" \"integer maxdepth\" 5", "LookAt .5 .5 -1  .5 .5 1  0 1 0", .45) +
         "WorldBegin\n" + kWhiteEnvironment +
         "MakeNamedMedium \"m\" \"string type\" \"perlin\" \"rgb sigma_a\" [ 2 2 2 ] \"rgb sigma_s\" [ 10 10 "
         "10 ] \"integer octaves\" 5 \"float frequency\" 3 \"integer supervoxels\" 6 \"string bounds\" "
         "\"progressive\" \"float initialextinction\" 0.01 " +
         warmUp + '\n' + mediumBox("m", {0, 0, 0}, {1, 1, 1}) + "WorldEnd\n";
}

TEST(Ranks, LearnTheBoundsOfOneProcess) {
  for (const std::string warmUp : {"\"integer warmup\" 0", "\"integer warmup\" 2"}) {
    const auto renderBy = [&](std::size_t count) {
      std::string state;
      onRanks(count, [&](ThreadRanks& ranks) {
        const Construction scene = constructText(learningScene(warmUp), {.seed = 5});
        RenderOptions options;
        options.seed = 5;
        options.ranks = &ranks;
        const RenderResult result =
            scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, options);
        EXPECT_GT(result.learning.at(0).passes.at(1).raised, 0u);
        EXPECT_EQ(result.learning[0].warmUpLookups > 0, warmUp.back() == '2');
        if (ranks.isFirst()) state = bytesOf(*scene.scene, *scene.film, result);
      });
      return state;
    };
    const std::string one = renderBy(1);
    for (const std::size_t count : {2u, 3u, 4u}) {
      EXPECT_TRUE(renderBy(count) == one) << count << " ranks, " << warmUp;
    }
  }
}

}  // namespace
}  // namespace pbrtmedia::test
