// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>

#include "integrators/path/path.h"
#include "integrators/sppm/kernel_schedule.h"
#include "lighting/light_selector.h"
#include "render/integrator.h"
#include "singlescattering/single_scattering.h"
#include "world/media_topology.h"

namespace pbrtmedia {

/// Parameters of `sppm` (scene-language reference 11.1). Iterations are the samples per pixel of the sampler.
struct SppmParams {
  int maxDepth = 5;                                   ///< scatterings of camera and light path together
  std::optional<std::int64_t> photonsPerIteration{};  ///< light paths; nothing: as many as pixels
  float radius = 1;                                   ///< of the first iteration, world length, > 0
  KernelShape kernel = KernelShape::Uniform;
  KernelSchedule::Params schedule{};  ///< what is done about bias
};

/// Integrator `sppm`: stochastic progressive photon mapping (Hachisuka & Jensen 2009,
/// doi:10.1145/1618452.1618487), with photons in media too (balls instead of discs; Knaus & Zwicker 2011,
/// doi:10.1145/1966394.1966404). Each iteration sends photons from the lights, and one path from each pixel
/// to the first vertex in a medium or on a surface that scatters diffusely. Light from sources is found there
/// as `volpath` finds it; what was scattered before comes from the photons nearby. Each pixel has radii of
/// its own, which shrink with the photons found: biased for any number of iterations, consistent.
///
/// An iteration is a sample of each pixel: the radii that it takes are settled before, so the image is the
/// mean of what iterations find, each with its own. All rays of an iteration are at the same time, so that
/// photons meet what the camera sees.
///
/// With `schedule.debias` all pixels have the same kernels, which are known beforehand (KernelSchedule): then
/// iterations do not depend on each other. Unbiased for Single and ProgressiveUnbiased, where samples may be
/// negative.
class SppmIntegrator final : public Integrator {
 public:
  /// `selector`: of Scene::illuminants(), for light samples; `photonSelector`: of the same, but the
  /// same everywhere. Both null where there are none. After Scene::prepareEmission.
  SppmIntegrator(const Scene& scene, const SppmParams& params, std::unique_ptr<const LightSelector> selector,
                 std::unique_ptr<const LightSelector> photonSelector, CameraMedium cameraMedium);
  ~SppmIntegrator() override;
  std::string_view typeName() const override { return "sppm"; }
  RenderResult render(const Camera& camera, const Sampler& sampler, Film& film,
                      const RenderOptions& options) const override;
  std::string whyInOnePiece() const override;
  /// Radii.
  std::vector<double> carriedAtStart(std::uint64_t pixels) const override;

 private:
  class Iterations;
  /// Light paths can bring something that light samples do not.
  bool needsPhotons() const { return photonSelector_ && params_.maxDepth > 1; }
  bool hasOwnRadii() const { return params_.schedule.debias == Debias::None; }

  SppmParams params_;
  PathParams pathParams_;
  std::unique_ptr<const LightSelector> selector_, photonSelector_;
  MediaTopology media_;
  SingleScattering singleScattering_;
};

}  // namespace pbrtmedia
