// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "integrators/bdpt/bdpt_setup.h"

namespace pbrtmedia {

/// What a ray that starts on a light starts in, and leaves out.
struct LightSurroundings {
  MediumState state;
  Exclusions start;
  BoundaryPlane plane;
};

/// Goes from the camera, where it is known what media there are, straight to where `ray` starts on the
/// light; `normal` is that of hits there. `target`: Scene::lightTarget. Where that line does not meet the
/// light's surface (it runs in its plane, or through a hole) the media are told from off the surface. Lights
/// at infinity start nothing unless there is vacuum around the scene.
LightSurroundings surroundingsOf(const BdptSetup& setup, PrimitiveId target, bool isInfinite, const Ray& ray,
                                 Normal3f normal, Point3f camera, MediumState atCamera,
                                 SampleContext& context);

}  // namespace pbrtmedia
