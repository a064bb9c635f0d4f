// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>

#include "construct/texturable.h"
#include "scene/description.h"
#include "shapes/curves.h"
#include "shapes/shape.h"

namespace pbrtmedia {

/// A shape whose parameters are checked; `make` does the work (reads the file, subdivides, copies). Null for
/// a file that is broken, which is told, and the shape left out. May throw SceneError. Call it once: it takes
/// the arrays out of the description.
struct ShapePlan {
  std::function<std::unique_ptr<Shape>(Diagnostics&)> make;
  std::optional<TextureUse<float>> alpha, shadowAlpha;
  /// Of a curve: what `make` makes the shape of. Strands of others that stand alike may be added to it.
  std::shared_ptr<Curves::Params> strands;
};

/// Reads a Shape. Nothing for an unknown type, when no parameter has been looked at; a plan without `make`
/// for one that is left out, as PBRT-v3 does with what is incomplete or flat, and after an error. `in` reads
/// the shape's list; it may be handed on to the material before unused parameters are reported.
std::optional<ShapePlan> readShape(ShapeDescription& shape, ParamReader& in, Diagnostics& diagnostics);

}  // namespace pbrtmedia
