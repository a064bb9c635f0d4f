// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "integrators/bdpt/bdpt_setup.h"
#include "integrators/bdpt/path_vertex.h"

namespace pbrtmedia {

/// A straight way on which a strategy connects a vertex to the other end of a path.
struct ConnectingWay {
  Vector3f d;                                ///< unit
  float length = kInfinity;                  ///< world
  const PathVertex* end = nullptr;           ///< where it ends, unless on a light or on the camera
  PrimitiveId target{};                      ///< the light that it ends on
  std::uint32_t hider = PrimitiveId::kNone;  ///< Scene::hiderOf the light
};

/// What media let through on such a way: an unbiased estimate, black when a surface with a material is on it,
/// and what their controls say of it, for weights.
struct WayThrough {
  Rgb transmittance{};
  Rgb depth{};
};
WayThrough wayThrough(const BdptSetup& setup, const PathVertex& from, const ConnectingWay& way, float time,
                      SampleContext& context);

}  // namespace pbrtmedia
