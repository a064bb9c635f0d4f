// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "base/bounds.h"
#include "construct/construct_options.h"
#include "render/integrator.h"
#include "scene/description.h"
#include "world/camera_medium.h"
#include "world/scene.h"

namespace pbrtmedia {

/// An integrator whose parameters are checked.
struct IntegratorPlan {
  std::function<std::unique_ptr<Integrator>(const Scene&, CameraMedium)> make;
  bool rendersMedia = false;
  std::optional<Bounds2i> pixelBounds{};
  bool needsLights = true;                        ///< without them the image is black
  bool rendersSubsurface = false;                 ///< asks for Material::bssrdf
  std::optional<std::int64_t> samplesPerPixel{};  ///< of an integrator that has no use for those of Sampler
  bool tracesFromLights = false;                  ///< needs Scene::prepareEmission
  bool weighsBothEnds = false;      ///< paths from lights and from the camera by their densities
  bool hasNegativeSamples = false;  ///< without which the image would be biased
};

/// Reads Integrator. Nothing for an unknown type.
std::optional<IntegratorPlan> readIntegrator(SceneDescription& scene, const ConstructOptions& options,
                                             Diagnostics& diagnostics);

}  // namespace pbrtmedia
