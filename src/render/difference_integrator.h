// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "render/difference_schedule.h"
#include "render/integrator.h"
#include "render/scene_family.h"

namespace pbrtmedia {

/// Makes the derivative of images by a parameter of their scene: each pass renders its samples in the scenes
/// at a few values of the parameter, as their own integrators do, with the same random numbers, and adds the
/// sum of these images that DifferenceSchedule tells. Samples of one pass share their step and level, and all
/// count for `RenderResult::counters`. A pass that is left inside adds nothing.
///
/// What follows from the samples before is the same on both sides: bounds that media learn (SharedBounds),
/// and what integrators carry from pass to pass, which is that of the scene nearest to the value. Integrators
/// that choose their samples by what they bring make the sum themselves (Integrator::renderSum).
///
/// The film is to keep negatives (Film::keepNegatives); it must be none of the family's.
class DifferenceIntegrator final : public Integrator {
 public:
  /// `atValue`: of the scene at the value itself. `samplesPerPass`: nothing: 1 / 64 of all, 1 to 16. It and
  /// `family` must outlive the object.
  DifferenceIntegrator(const Integrator& atValue, SceneFamily& family, const DifferenceSchedule& schedule,
                       std::optional<int> samplesPerPass)
      : Integrator(atValue.scene()),
        family_(family),
        schedule_(schedule),
        samplesPerPass_(samplesPerPass),
        rendersSums_(atValue.rendersSums()),
        takesSingleSamples_(!atValue.carriedAtStart(1).empty()) {}

  std::string_view typeName() const override { return "derivative"; }
  RenderResult render(const Camera& camera, const Sampler& sampler, Film& film,
                      const RenderOptions& options) const override;
  std::string whyInOnePiece() const override;

  /// What passes of an image of so many samples per pixel have.
  int samplesPerPass(std::int64_t samplesPerPixel) const;

 private:
  class Passes;
  SceneFamily& family_;
  DifferenceSchedule schedule_;
  std::optional<int> samplesPerPass_;
  bool rendersSums_, takesSingleSamples_;
};

}  // namespace pbrtmedia
