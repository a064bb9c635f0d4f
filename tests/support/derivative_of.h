// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

#include "main/derivative.h"
#include "render/render_state.h"
#include "support/render_scene.h"
#include "support/statistics.h"

namespace pbrtmedia::test {

using Difference = DifferenceSchedule::Difference;
using Debias = DifferenceSchedule::Debias;
/// The text of a scene at a value, which is written to the last bit.
using Text = std::function<std::string(const std::string& value)>;

struct Derivative {
  Image image;
  RenderResult result;
  RenderState state;  ///< to go on from
  std::size_t built = 0;
};

/// `start`: goes on from there. At most so many passes.
inline Derivative derivativeOf(const Text& text, const DerivativeOptions& options,
                               const RenderSettings& settings, const RenderState* start = nullptr,
                               int mostPasses = 1 << 20) {
  const ThreadLimit threads(settings.threads);
  DerivativeOptions d = options;
  d.variable = "x";
  d.difference.value = static_cast<double>(static_cast<float>(d.difference.value));
  d.difference.seed = settings.seed;
  Construction scene = constructText(text(exactText(d.difference.value)), settings);
  const DerivativeScenes scenes(
      scene, d, [&](double value) { return constructText(text(exactText(value)), settings); });
  RenderOptions loop;
  loop.seed = settings.seed;
  loop.tileSize = settings.tileSize;
  loop.pixelBounds = scene.pixelBounds;
  loop.afterPass = [&](const PassEnd& end) { return static_cast<int>(end.result.passes) < mostPasses; };
  loop.start = start;
  if (start) {
    EXPECT_TRUE(restoreState(*start, *scene.scene, *scene.film));
  }
  Derivative derivative;
  derivative.result = scene.integrator->render(*scene.camera, *scene.sampler, *scene.film, loop);
  derivative.image = scene.film->develop();
  derivative.state = saveState(*scene.scene, *scene.film, derivative.result);
  derivative.built = scenes.built();
  return derivative;
}

/// The mean of a channel over the image.
inline double meanOf(const Text& text, const DifferenceSchedule::Params& params, std::int64_t samples = 1,
                     std::uint64_t seed = 1) {
  return imageMean(derivativeOf(text, {.difference = params, .samplesPerPass = 1},
                                {.seed = seed, .samplesPerPixel = samples})
                       .image);
}

/// Its means over images of independent seeds.
inline RunningStats means(const Text& text, const DifferenceSchedule::Params& params, std::int64_t samples,
                          std::uint64_t seeds) {
  RunningStats all;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) all.add(meanOf(text, params, samples, seed));
  return all;
}

}  // namespace pbrtmedia::test
