// SPDX-License-Identifier: BSD-2-Clause
#pragma once

// Names that lower rooms may hold pointers to without knowing what they are.
namespace pbrtmedia {
class AreaLight;
class Light;
class Material;
class Medium;
class PhaseFunction;
class Sampler;
class Shape;
struct RenderCounters;
}  // namespace pbrtmedia
