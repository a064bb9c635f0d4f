// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/diagnostics.h"
#include "base/transform.h"
#include "lights/diffuse_area.h"
#include "scene/description.h"
#include "shapes/shape.h"

namespace pbrtmedia {

/// Says by how much PBRT-v3 illuminates differently with a shape that emits, and on which side where that is
/// not the side on which it is seen to emit.
void reportAreaLight(const ShapeDescription& description, const Shape& shape,
                     const DiffuseAreaLight::Params& light, Diagnostics& diagnostics);

/// Says how PBRT-v3 differs where an infinite light stands in a space that scales.
void reportScaledSky(const Transform& worldFromLight, const SourceLocation& location,
                     const std::string& context, Diagnostics& diagnostics);

}  // namespace pbrtmedia
