// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "integrators/bdpt/bdpt.h"
#include "render/integrator.h"

namespace pbrtmedia {

/// Parameters of `mlt` (scene-language reference 11.1). Mutations per pixel are the samples per pixel of the
/// sampler.
struct MltParams {
  int maxDepth = 5;                  ///< scatterings of a path
  int bootstrapSamples = 100000;     ///< of each number of scatterings, to find where chains start; >= 1
  int chains = 1000;                 ///< >= 1
  float largeStepProbability = .3f;  ///< of steps to anywhere, in [0, 1]
  float sigma = .01f;                ///< standard deviation of the others, in primary sample space; >= 0
};

/// Integrator `mlt`: Metropolis light transport in primary sample space (Kelemen et al. 2002) over the
/// strategies of `bdpt`, of which a chain takes those that find paths of its own number of scatterings
/// (Hachisuka et al. 2014). Media are rendered as by `bdpt`.
///
/// Chains start at samples that are drawn from the bootstrap by what they bring, and all they find is
/// weighed by the bootstrap's mean, so that every mutation is unbiased by itself, however short the chains
/// (Veach 1997, section 11.3.1): noise alone tells of them. Mutation number m of the image is of chain
/// m mod chains, and what it brings is summed in the order of these numbers.
class MltIntegrator final : public Integrator {
 public:
  /// Selectors as for BdptIntegrator.
  MltIntegrator(const Scene& scene, const MltParams& params, std::unique_ptr<const LightSelector> selector,
                std::unique_ptr<const LightSelector> startSelector, CameraMedium cameraMedium);
  ~MltIntegrator() override;
  std::string_view typeName() const override { return "mlt"; }
  RenderResult render(const Camera& camera, const Sampler& sampler, Film& film,
                      const RenderOptions& options) const override;
  bool makesSplats() const override { return true; }
  std::string whyInOnePiece() const override;
  /// By chains through the numbers that all terms' paths are made of, in proportion to the mean of what a
  /// path brings to each.
  bool rendersSums() const override { return true; }
  RenderResult renderSum(std::span<const ImageTerm> terms, std::optional<std::int64_t> startsAgain,
                         const Sampler& sampler, Film& film, const RenderOptions& options) const override;

 private:
  class Mutations;

  MltParams params_;
  BdptIntegrator strategies_;
};

}  // namespace pbrtmedia
