// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <memory>
#include <string_view>
#include <utility>

#include "construct/shapes.h"

namespace pbrtmedia {

// The readers of the kinds of shapes. Each checks parameters and returns what makes the shape; one without
// `make` where the shape is left out, which has been told.

/// How messages about a shape end that PBRT-v3 leaves out.
inline constexpr std::string_view kShapeLeftOut = "; the shape is left out, as in PBRT-v3";

/// What a reader of shapes gets.
struct ShapeInput {
  ShapeDescription& shape;
  ParamReader& in;
  ShapePlacement placement;
};

inline ShapePlan planOf(std::function<std::unique_ptr<Shape>(Diagnostics&)> make) {
  ShapePlan plan;
  plan.make = std::move(make);
  return plan;
}

ShapePlan readSphere(const ShapeInput& input);
ShapePlan readCylinder(const ShapeInput& input);
ShapePlan readDisk(const ShapeInput& input);
ShapePlan readCone(const ShapeInput& input);
ShapePlan readParaboloid(const ShapeInput& input);
ShapePlan readHyperboloid(const ShapeInput& input);

ShapePlan readCurve(const ShapeInput& input);

ShapePlan readTriangleMesh(const ShapeInput& input);
ShapePlan readPlyMesh(const ShapeInput& input);
ShapePlan readLoopSubdivision(const ShapeInput& input);
ShapePlan readHeightfield(const ShapeInput& input);
ShapePlan readNurbs(const ShapeInput& input);

}  // namespace pbrtmedia
