// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/mlt/strategy_sample.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "cameras/camera.h"
#include "integrators/bdpt/path_connector.h"
#include "integrators/bdpt/subpath_tracer.h"

namespace pbrtmedia {
namespace {

using Stream = PrimarySampler::Stream;

/// Chains stay where roulette leaves much weight: only what is next to nothing is thinned out.
constexpr float kRouletteWeight = 0.03f;

/// A raster position, uniform over the pixels.
Point2f positionIn(const Bounds2i& bounds, Point2f u) {
  const auto along = [](int min, int max, float t) {
    const auto first = static_cast<float>(min), end = static_cast<float>(max);
    return std::min(first + t * static_cast<float>(max - min), std::nextafter(end, first));
  };
  return {along(bounds.min.x, bounds.max.x, u.x), along(bounds.min.y, bounds.max.y, u.y)};
}

bool isIn(const Bounds2i& bounds, Point2f p) {
  return p.x >= static_cast<float>(bounds.min.x) && p.x < static_cast<float>(bounds.max.x) &&
         p.y >= static_cast<float>(bounds.min.y) && p.y < static_cast<float>(bounds.max.y);
}

/// One sample: the subpaths that a strategy needs, and what they find together.
class Finder {
 public:
  Finder(const BdptSetup& setup, const MediaTopology& media, const StrategyFilm& film,
         PrimarySampler& sampler, RenderCounters& counters)
      : setup_(setup), media_(media), film_(film), sampler_(sampler), counters_(counters) {}

  StrategySample find(int depth) {
    sampler_.use(Stream::Camera);
    StrategySample sample{positionIn(film_.bounds, sampler_.get2D()), {}};
    const Point2f lens = sampler_.get2D();
    const Camera::WeightedRay seen = film_.camera.generateRay(sample.film, lens, sampler_.get1D());
    if (seen.weight == 0) return sample;
    ray_ = seen.ray;
    state_ = media_.stateOf(ray_, counters_);
    sampler_.use(Stream::Connection);
    const int strategies = depth == 0 ? 1 : depth + 2;
    const int fromLight =
        std::min(static_cast<int>(sampler_.get1D() * static_cast<float>(strategies)), strategies - 1);
    if (fromLight == depth + 1) {
      sample = seenFromLight(depth);
    } else {
      sample.value = seen.weight * radiance(depth, fromLight);
    }
    sample.value *= static_cast<float>(strategies);
    return sample;
  }

 private:
  /// Of paths with `fromLight` vertices from the light's end, the light included.
  Rgb radiance(int depth, int fromLight) {
    if (fromLight == 0) {
      FoundRadiance found;
      cameraSubpath(depth, found, true);
      const auto scatterings = static_cast<std::size_t>(depth);
      return scatterings < found.size() ? found[scatterings].weighted : Rgb();
    }
    const int lightVertices = fromLight - 1, cameraVertices = depth - lightVertices;
    FoundRadiance ignored;
    const Subpath camera = cameraSubpath(cameraVertices, ignored, false);
    if (camera.vertices.empty() ||
        camera.vertices.back().number + 1 != static_cast<std::size_t>(cameraVertices)) {
      return {};
    }
    std::optional<Subpath> light;
    if (lightVertices > 0) {
      light = lightSubpath(lightVertices);
      if (!light || !endsAt(*light, lightVertices)) return {};
    }
    Rng rng = begin(Stream::Connection);
    SampleContext context = contextOf(rng);
    PathConnector connector(setup_, context, ray_.time);
    Rgb sum;
    for (std::size_t j = 0; j < camera.vertices.size(); ++j) {
      const PathVertex& vertex = camera.vertices[j];
      if (vertex.number + 1 != static_cast<std::size_t>(cameraVertices) || !vertex.isConnectible()) continue;
      if (light) {
        sum += connector.connect(camera, j, *light, light->vertices.size() - 1).weighted;
      } else {
        const float uLight = sampler_.get1D();
        sum += connector.lookForLight(camera, j, uLight, sampler_.get2D()).weighted;
      }
    }
    return sum;
  }

  StrategySample seenFromLight(int depth) {
    const std::optional<Subpath> light = lightSubpath(depth);
    if (!light || !endsAt(*light, depth)) return {};
    Rng rng = begin(Stream::Connection);
    SampleContext context = contextOf(rng);
    const auto found = PathConnector(setup_, context, ray_.time)
                           .lookForCamera(*light, light->vertices.size() - 1, sampler_.get2D());
    if (!found || !isIn(film_.bounds, found->film)) return {};
    const auto share = static_cast<float>(film_.imageArea / static_cast<double>(film_.bounds.area()));
    return {found->film, share * found->contribution.weighted};
  }

  Subpath cameraSubpath(int vertices, FoundRadiance& found, bool looksBeyond) {
    BdptSetup setup = setupOf(vertices);
    setup.mediaEmit = setup_.mediaEmit && looksBeyond;
    Rng rng = begin(Stream::Camera);
    SampleContext context = contextOf(rng);
    const Camera& camera = film_.camera;
    const bool isSeen = setup.startSelector && camera.we(ray_).value > 0;
    return SubpathTracer(setup, context)
        .fromCamera(ray_, state_, isSeen, camera.pdfWe(ray_), found, looksBeyond);
  }

  std::optional<Subpath> lightSubpath(int vertices) {
    const BdptSetup setup = setupOf(vertices);
    Rng rng = begin(Stream::Light);
    SampleContext context = contextOf(rng);
    return SubpathTracer(setup, context).fromLight(ray_, state_);
  }

  BdptSetup setupOf(int vertices) const {
    BdptSetup setup = setup_;
    setup.maxDepth = vertices;
    setup.sampledVertices = std::numeric_limits<int>::max();
    setup.roulette = {kRouletteWeight, kRouletteWeight};
    return setup;
  }

  /// Whether so many vertices were found, and light can be connected at the last.
  static bool endsAt(const Subpath& path, int vertices) {
    return path.vertices.size() == static_cast<std::size_t>(vertices) && path.vertices.back().isConnectible();
  }

  Rng begin(Stream stream) {
    sampler_.use(stream);
    return sampler_.rngOf(stream);
  }
  SampleContext contextOf(Rng& rng) {
    return {.sampler = sampler_, .rng = rng, .counters = counters_, .camera = &film_.camera};
  }

  const BdptSetup& setup_;
  const MediaTopology& media_;
  const StrategyFilm& film_;
  PrimarySampler& sampler_;
  RenderCounters& counters_;
  Ray ray_;
  MediumState state_;
};

}  // namespace

StrategySample sampleStrategy(const BdptSetup& setup, const MediaTopology& media, const StrategyFilm& film,
                              int depth, PrimarySampler& sampler, RenderCounters& counters) {
  return Finder(setup, media, film, sampler, counters).find(depth);
}

}  // namespace pbrtmedia
