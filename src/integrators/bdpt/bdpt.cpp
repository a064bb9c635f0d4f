// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/bdpt/bdpt.h"

#include <glog/logging.h>

#include <algorithm>

#include "cameras/camera.h"
#include "film/side_images.h"
#include "film/splat_buffer.h"
#include "integrators/bdpt/strands.h"
#include "integrators/bdpt/subpath_tracer.h"

namespace pbrtmedia {
namespace {

bool areExponential(const Scene& scene) {
  return std::ranges::all_of(scene.media(), [](const Medium* m) { return m->isExponential(); });
}

/// Whether there is vacuum far out.
bool isConfined(const Scene& scene, const MediaTopology& media) {
  return !media.camera().given() &&
         std::ranges::all_of(scene.media(), [&](const Medium* m) { return media.isConfined(m); });
}

}  // namespace

BdptIntegrator::BdptIntegrator(const Scene& scene, const BdptParams& params,
                               std::unique_ptr<const LightSelector> selector,
                               std::unique_ptr<const LightSelector> startSelector, CameraMedium cameraMedium)
    : SamplingIntegrator(scene),
      params_(params),
      selector_(std::move(selector)),
      startSelector_(areExponential(scene) ? std::move(startSelector) : nullptr),
      media_(scene, std::move(cameraMedium)),
      // Without media and shadowalpha the yes/no occlusion query answers the same and is faster.
      setup_{scene,
             params.maxDepth,
             selector_.get(),
             startSelector_.get(),
             media_.hasMedia() || scene.hasShadowAlpha() ? &media_ : nullptr,
             media_.hasEmission(),
             hasStrands(scene),
             {selector_.get(), startSelector_.get(), isConfined(scene, media_)}} {
  CHECK(selector_ || scene.illuminants().empty()) << "lights need a selector";
}
BdptIntegrator::~BdptIntegrator() = default;

bool BdptIntegrator::takes(std::size_t s, std::size_t t) const {
  return !params_.leftOut ||
         !(static_cast<int>(s) == params_.leftOut->s && static_cast<int>(t) == params_.leftOut->t);
}

std::vector<SideImage> BdptIntegrator::sideImages() const {
  if (params_.view == StrategyView::None) return {};
  return strategyImages(params_.maxDepth);
}

Rgb BdptIntegrator::shown(const Contribution& made) const {
  if (params_.view == StrategyView::Weighted) return made.weighted;
  return made.weighted.isBlack() ? Rgb() : made.unweighted;
}

Rgb BdptIntegrator::taken(std::size_t s, std::size_t t, const Contribution& made,
                          SampleContext& context) const {
  if (context.sides) context.sides->addHere(strategyImage(s, t), shown(made));
  return made.weighted;
}

Rgb BdptIntegrator::radiance(const RayDifferential& ray, SampleContext& context) const {
  const Camera& camera = *context.camera;
  const MediumState start = media_.stateOf(ray, context.counters);
  const bool isSeen = setup_.startSelector && context.splats && camera.we(ray).value > 0;
  FoundRadiance found;
  const Subpath fromCamera =
      SubpathTracer(setup_, context).fromCamera(ray, start, isSeen, camera.pdfWe(ray), found);
  Rgb radiance;
  for (std::size_t depth = 0; depth < found.size(); ++depth) {
    if (takes(0, depth + 2)) radiance += taken(0, depth + 2, found[depth], context);
  }
  const std::optional<Subpath> fromLight = SubpathTracer(setup_, context).fromLight(ray, start);
  PathConnector connector(setup_, context, ray.time);
  PathSamples samples(context.sampler, context.rng, setup_.sampledVertices);
  const auto mostScatterings = static_cast<std::size_t>(params_.maxDepth);
  for (std::size_t j = 0; j < fromCamera.vertices.size(); ++j) {
    const PathVertex& vertex = fromCamera.vertices[j];
    const std::size_t number = vertex.number;
    if (!vertex.isConnectible()) continue;
    samples.startVertex(static_cast<int>(number));
    const float uLight = samples.get1D();
    const Point2f u = samples.get2D();
    if (takes(1, number + 2))
      radiance += taken(1, number + 2, connector.lookForLight(fromCamera, j, uLight, u), context);
    if (!fromLight) continue;
    for (std::size_t i = 0; i < fromLight->vertices.size() && i + number + 2 <= mostScatterings; ++i) {
      if (fromLight->vertices[i].isConnectible() && takes(i + 2, number + 2))
        radiance += taken(i + 2, number + 2, connector.connect(fromCamera, j, *fromLight, i), context);
    }
  }
  if (!fromLight || !context.splats) return radiance;
  for (std::size_t i = 0; i < fromLight->vertices.size(); ++i) {
    samples.startVertex(static_cast<int>(i));
    const Point2f lens = samples.get2D();
    if (!fromLight->vertices[i].isConnectible() || !takes(i + 2, 1)) continue;
    const auto onFilm = connector.lookForCamera(*fromLight, i, lens);
    if (!onFilm || onFilm->contribution.weighted.isBlack()) continue;
    context.splats->add(onFilm->film, onFilm->contribution.weighted);
    if (context.sides) context.sides->add(strategyImage(i + 2, 1), onFilm->film, shown(onFilm->contribution));
  }
  return radiance;
}

}  // namespace pbrtmedia
