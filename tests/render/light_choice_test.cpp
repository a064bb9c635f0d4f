// SPDX-License-Identifier: BSD-2-Clause
// How lights are chosen is noise, not image; what is learned about it depends on scene and seed alone.
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "filters/box.h"
#include "render/render_state.h"
#include "support/render_scene.h"
#include "support/thread_ranks.h"

namespace pbrtmedia::test {
namespace {

/// Those that take no time to begin with, as tables of a grid do (tests/lighting holds them to the same
/// mean).
constexpr const char* kStrategies[] = {"uniform", "power", "tree", "learned"};

/// Lamps of all kinds in fog over a floor, some of them hidden by a wall, under a sky and a sun.
std::string lamps(const std::string& integrator, const std::string& strategy, int resolution, int spp,
                  double strength = 1, const std::string& crop = "") {
  std::ostringstream os;
  os << "Film \"image\" \"integer xresolution\" " << resolution << " \"integer yresolution\" " << resolution
     << crop << "\nPixelFilter \"box\"\nSampler \"random\" \"integer pixelsamples\" " << spp
     << "\nIntegrator \"" << integrator << "\" \"integer maxdepth\" 3";
  if (!strategy.empty()) os << " \"string lightsamplestrategy\" \"" << strategy << '"';
  os << "\nLookAt 0 -8 3  0 0 1  0 0 1\nCamera \"perspective\" \"float fov\" 40\n"
     << "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ .01 .01 .01 ] \"rgb "
        "sigma_s\" "
        "[ .06 .06 .06 ] \"float g\" .6\nWorldBegin\n"
     << "LightSource \"infinite\" \"rgb L\" [ .1 .1 .1 ]\n"
     << "LightSource \"distant\" \"point from\" [ 1 -1 3 ] \"point to\" [ 0 0 0 ] \"rgb L\" [ .3 .3 .3 ]\n";
  for (int i = 0; i < 24; ++i) {
    const double x = -4 + 1.6 * (i % 6), y = -2 + 2.0 * (i / 6), s = strength * (i % 5 == 0 ? 4 : 1);
    if (i % 3 == 0) {
      os << "LightSource \"point\" \"point from\" [ " << x << ' ' << y << " 3 ] \"rgb I\" [ " << s << ' ' << s
         << ' ' << s << " ]\n";
    } else if (i % 3 == 1) {
      os << "LightSource \"spot\" \"point from\" [ " << x << ' ' << y << " 4 ] \"point to\" [ " << x
         << " 0 0 ] "
         << "\"rgb I\" [ " << s << ' ' << s << ' ' << s << " ]\n";
    } else {
      os << "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [ " << s << ' ' << s << ' ' << s
         << " ]\nTranslate " << x << ' ' << y << " 3.5\nShape \"sphere\" \"float radius\" .2\nAttributeEnd\n";
    }
  }
  os << "Material \"matte\" \"rgb Kd\" [ .5 .5 .5 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 2 3 "
        "0 ] \"point "
        "P\" [ -9 -9 0  9 -9 0  9 9 0  -9 9 0 ]\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 2 3 0 ] "
        "\"point P\" [ 1 "
        "-9 0  1 9 0  1 9 5  1 -9 5 ]\n";
  os << "Material \"\"\nMediumInterface \"fog\" \"\"\nShape \"sphere\" \"float radius\" 30\nWorldEnd\n";
  return os.str();
}

RunningStats meansOf(const std::string& scene) {
  RunningStats means;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    means.add(imageMean(renderText(scene, {.seed = seed}).image));
  return means;
}

double zOf(const RunningStats& a, const RunningStats& b) {
  return (a.mean() - b.mean()) / std::hypot(a.standardError(), b.standardError());
}

TEST(LightChoice, ChangesNoImage) {
  for (const std::string integrator : {"path", "volpath"}) {
    const RunningStats uniform = meansOf(lamps(integrator, "uniform", 32, 2));
    ASSERT_GT(uniform.mean(), 0.05);
    RunningStats learned;
    for (const std::string strategy : kStrategies) {
      if (strategy == "uniform") continue;
      learned = meansOf(lamps(integrator, strategy, 32, 2));
      EXPECT_LT(std::abs(zOf(learned, uniform)), kMaxAbsZ) << integrator << ' ' << strategy;
    }
    // The test sees lamps that are a fifth too bright.
    EXPECT_GT(zOf(meansOf(lamps(integrator, "learned", 32, 2, 1.2)), learned), kMaxAbsZ) << integrator;
  }
}

/// A ball of gas of that albedo under a sky of the same radiance everywhere.
std::string ballUnderSky(const std::string& strategy, double albedo) {
  std::ostringstream os;
  os << "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 16\nPixelFilter \"box\"\n"
     << "Sampler \"random\" \"integer pixelsamples\" 8\n"
     << "Integrator \"volpath\" \"integer maxdepth\" 50 \"string lightsamplestrategy\" \"" << strategy
     << "\"\nLookAt 0 0 -5  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 20\nWorldBegin\n"
     << "LightSource \"infinite\" \"rgb L\" [ 1 1 1 ]\n"
     << "MakeNamedMedium \"gas\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [ " << 4 * albedo << ' '
     << 4 * albedo << ' ' << 4 * albedo << " ] \"rgb sigma_a\" [ " << 4 - 4 * albedo << ' ' << 4 - 4 * albedo
     << ' ' << 4 - 4 * albedo << " ]\nMediumInterface \"gas\" \"\"\nMaterial \"\"\n"
     << "Shape \"sphere\" \"float radius\" 1\nWorldEnd\n";
  return os.str();
}

/// Mean over the pixels.
double pixelVariance(const std::string& scene) {
  std::vector<RunningStats> pixels;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    const Image image = renderText(scene, {.seed = seed}).image;
    pixels.resize(image.data().size());
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i].add(static_cast<double>(image.data()[i]));
  }
  double sum = 0;
  for (const RunningStats& pixel : pixels) sum += pixel.variance();
  return sum / static_cast<double>(pixels.size());
}

TEST(LightChoice, LeavesSkiesToScatteringInMediaThatAbsorbLittle) {
  const auto shadowRays = [](const Rendered& r) { return r.result.counters.shadowRays; };
  // The only light is sampled by all strategies where half is absorbed.
  const Rendered power = renderText(ballUnderSky("power", .5)), tree = renderText(ballUnderSky("tree", .5));
  EXPECT_EQ(power.image.data(), tree.image.data());
  EXPECT_GT(shadowRays(tree), 0u);
  EXPECT_GT(shadowRays(renderText(ballUnderSky("power", .95))), 0u);
  EXPECT_EQ(shadowRays(renderText(ballUnderSky("tree", .95))), 0u);
  const std::string sampled = ballUnderSky("power", .99), left = ballUnderSky("tree", .99);
  EXPECT_LT(std::abs(zOf(meansOf(sampled), meansOf(left))), kMaxAbsZ);
  EXPECT_LT(pixelVariance(left), .5 * pixelVariance(sampled));
}

TEST(LightChoice, ThatWasLearnedDependsOnNoThreadTileOrCrop) {
  const std::string scene = lamps("volpath", "learned", 32, 2);
  const Rendered one = renderText(scene, {.seed = 4, .threads = 1, .tileSize = 16});
  for (const RenderSettings& settings : {RenderSettings{4, 2, 16, {}}, RenderSettings{4, 5, 7, {}}}) {
    const Rendered other = renderText(scene, settings);
    EXPECT_EQ(one.image.data(), other.image.data());
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
  }
  const Rendered part = renderText(
      lamps("volpath", "learned", 32, 2, 1, " \"float cropwindow\" [ .25 .75 .5 1 ]"), {.seed = 4});
  ASSERT_EQ(part.image.width(), 16);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) ASSERT_EQ(part.image.at(x, y, 0), one.image.at(x + 8, y + 16, 0));
  }
  // Nor on an earlier render.
  const Construction twice = constructText(scene, {.seed = 4});
  const auto rendered = [&] {
    Film film(twice.film->settings(), BoxFilter({}));
    twice.integrator->render(*twice.camera, *twice.sampler, film, {.seed = 4});
    return film.state();
  };
  const Film::State before = rendered();
  EXPECT_EQ(rendered(), before);
  // It has learned something.
  EXPECT_NE(one.image.data(), renderText(lamps("volpath", "tree", 32, 2), {.seed = 4}).image.data());
}

TEST(LightChoice, ThatWasLearnedIsTakenAlong) {
  const std::string scene = lamps("volpath", "learned", 32, 3);
  const Construction whole = constructText(scene), first = constructText(scene),
                     second = constructText(scene);
  const RenderResult expected = whole.integrator->render(*whole.camera, *whole.sampler, *whole.film, {});
  RenderState state;
  first.integrator->render(*first.camera, *first.sampler, *first.film,
                           {.samplesPerPass = 1, .afterPass = [&](const PassEnd& end) {
                              state = saveState(*first.scene, *first.film, end.result);
                              return false;
                            }});
  EXPECT_FALSE(state.result.carried.empty());
  ASSERT_TRUE(restoreState(state, *second.scene, *second.film));
  const RenderResult result =
      second.integrator->render(*second.camera, *second.sampler, *second.film, {.start = &state});
  EXPECT_EQ(second.film->state(), whole.film->state());
  EXPECT_EQ(result.counters.rays, expected.counters.rays);
  state.result.carried.pop_back();
  const Construction broken = constructText(scene);
  ASSERT_TRUE(restoreState(state, *broken.scene, *broken.film));
  EXPECT_THROW(broken.integrator->render(*broken.camera, *broken.sampler, *broken.film, {.start = &state}),
               SceneError);
}

TEST(LightChoice, ThatWasLearnedIsThatOfAllRanks) {
  const auto renderBy = [&](std::size_t count) {
    Film::State film;
    std::uint64_t rays = 0;
    onRanks(count, [&](ThreadRanks& ranks) {
      const Construction scene = constructText(lamps("volpath", "learned", 32, 2));
      RenderOptions options;
      options.ranks = &ranks;
      const RenderResult result =
          scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, options);
      if (ranks.isFirst()) film = scene.film->state(), rays = result.counters.rays;
    });
    return std::pair{film, rays};
  };
  const auto one = renderBy(1);
  for (const std::size_t count : {2u, 3u}) EXPECT_TRUE(renderBy(count) == one) << count << " ranks";
}

}  // namespace
}  // namespace pbrtmedia::test
