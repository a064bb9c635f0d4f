// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/bdpt/path_connector.h"
#include "integrators/bdpt/strategy_images.h"
#include "render/sampling_integrator.h"

namespace pbrtmedia {

struct BdptParams {
  int maxDepth = 5;  ///< scattering vertices of a path; 0: visible emission only
  /// Leaves out the strategy with so many vertices from the light's end and the camera's, without giving its
  /// share to the others: for tests, which see what it brings.
  struct Strategy {
    int s = 0, t = 0;
  };
  std::optional<Strategy> leftOut = std::nullopt;
  StrategyView view = StrategyView::None;  ///< else maxDepth is at most kMostShownDepth
};

/// Integrator `bdpt`: bidirectional path tracing over surfaces and media (Lafortune & Willems 1993; Veach &
/// Guibas 1995, doi:10.1145/218380.218498). A path is found by every split into a part from a light and a
/// part from the camera, weighed by the power heuristic (StrategyWeights); media that emit are
/// lights like others. Scatterings count as in `volpath`; boundaries without material cost nothing. Where
/// some medium follows another law than the exponential, which is not the same from both ends, parts from the
/// light are its point at most, so that the image is that of `volpath`. Textures are not filtered. Unbiased.
class BdptIntegrator final : public SamplingIntegrator {
 public:
  /// `selector`: of light samples, `startSelector`: of what light subpaths start on; null when the scene has
  /// no lights. Scene::prepareEmission has been called.
  BdptIntegrator(const Scene& scene, const BdptParams& params, std::unique_ptr<const LightSelector> selector,
                 std::unique_ptr<const LightSelector> startSelector, CameraMedium cameraMedium);
  ~BdptIntegrator() override;
  std::string_view typeName() const override { return "bdpt"; }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override;
  bool makesSplats() const override { return true; }
  std::vector<SideImage> sideImages() const override;

  // For other integrators that take its strategies.
  const BdptSetup& setup() const { return setup_; }
  const MediaTopology& media() const { return media_; }

 private:
  bool takes(std::size_t s, std::size_t t) const;
  /// What a strategy's image is to show.
  Rgb shown(const Contribution& made) const;
  /// What a strategy adds to the radiance of the camera's ray; its image gets it, too.
  Rgb taken(std::size_t s, std::size_t t, const Contribution& made, SampleContext& context) const;

  BdptParams params_;
  std::unique_ptr<const LightSelector> selector_, startSelector_;
  MediaTopology media_;
  BdptSetup setup_;
};

}  // namespace pbrtmedia
