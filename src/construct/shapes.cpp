// SPDX-License-Identifier: BSD-2-Clause
#include "construct/shapes.h"

#include <array>

#include "construct/plugins.h"
#include "construct/shape_kinds.h"

namespace pbrtmedia {
namespace {

using ReadShape = ShapePlan (*)(const ShapeInput&);

constexpr std::array<Plugin<ReadShape>, 12> kShapes = {{{"sphere", readSphere},
                                                        {"cylinder", readCylinder},
                                                        {"disk", readDisk},
                                                        {"cone", readCone},
                                                        {"paraboloid", readParaboloid},
                                                        {"hyperboloid", readHyperboloid},
                                                        {"curve", readCurve},
                                                        {"trianglemesh", readTriangleMesh},
                                                        {"plymesh", readPlyMesh},
                                                        {"loopsubdiv", readLoopSubdivision},
                                                        {"heightfield", readHeightfield},
                                                        {"nurbs", readNurbs}}};

}  // namespace

std::optional<ShapePlan> readShape(ShapeDescription& shape, ParamReader& in, Diagnostics& diagnostics) {
  const auto* plugin = findPlugin<ReadShape>(kShapes, shape, "Shape", kShapeLeftOut.substr(2), diagnostics);
  if (plugin == nullptr) return std::nullopt;
  // A moving shape is built in its own space and placed by an animated instance.
  const Transform place = shape.ctm->isAnimated() ? Transform() : shape.ctm->start;
  return plugin->read({shape, in, ShapePlacement{place, shape.reverseOrientation}});
}

}  // namespace pbrtmedia
