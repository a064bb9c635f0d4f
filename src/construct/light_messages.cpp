// SPDX-License-Identifier: BSD-2-Clause
#include "construct/light_messages.h"

#include <array>
#include <cmath>
#include <sstream>

namespace pbrtmedia {
namespace {

/// Relative: as much is rounding of a transformation given by 16 numbers.
constexpr double kNoScale = 1e-3;

/// Where PBRT-v3 can sample at all what it finds emitting: it ends at cones, paraboloids and hyperboloids.
bool isSampledByPbrt(std::string_view shape) {
  return shape == "sphere" || shape == "cylinder" || shape == "disk";
}

void reportScaledQuadric(const ShapeDescription& description, const Shape& shape, Diagnostics& diagnostics) {
  if (!isSampledByPbrt(description.type)) return;
  const double factor = shape.areaSampledByPbrt(0) / shape.area(0);
  if (std::abs(factor - 1) <= kNoScale) return;
  std::ostringstream os;
  os.precision(3);
  os << "Shape \"" << description.type << "\" emits: PBRT-v3 "
     << (description.type == "sphere"
             ? "samples a whole sphere of \"radius\" in its place, whatever the transformation scales and "
               "\"zmin\", \"zmax\", \"phimax\" leave of it, with "
             : "takes its area before the transformation scales it, ")
     << factor << " times the area, so there it illuminates about " << factor
     << " times as brightly as here, where it illuminates as large as it is seen; for one image in both give "
        "the size by the shape's own parameters and do not scale, for PBRT-v3's brightness multiply \"L\" by "
     << factor;
  diagnostics.warning(description.location, os.str());
}

}  // namespace

void reportAreaLight(const ShapeDescription& description, const Shape& shape,
                     const DiffuseAreaLight::Params& light, Diagnostics& diagnostics) {
  reportScaledQuadric(description, shape, diagnostics);
  if (light.twoSided || !shape.isSampledFromBehind()) return;
  const bool isMesh = std::holds_alternative<TriangleBuffers>(shape.geometry());
  diagnostics.tolerated(description.location,
                        "Shape \"" + description.type + "\" emits " +
                            (isMesh ? "and has normals or tangents under ReverseOrientation"
                                    : "in a space that a transformation mirrors") +
                            ": as in PBRT-v3 light samples find the side emitting that is dark as cameras "
                            "and scattered rays see it, "
                            "so that it mostly illuminates what is before that side; without " +
                            (isMesh ? "ReverseOrientation" : "the mirror (a negative Scale)") +
                            " both are one side");
}

void reportScaledSky(const Transform& worldFromLight, const SourceLocation& location,
                     const std::string& context, Diagnostics& diagnostics) {
  const std::array axes{length(worldFromLight.vector(Vec3d(1, 0, 0))),
                        length(worldFromLight.vector(Vec3d(0, 1, 0))),
                        length(worldFromLight.vector(Vec3d(0, 0, 1)))};
  double most = 1;
  for (const double axis : axes) {
    if (std::abs(std::log(axis)) > std::abs(std::log(most))) most = axis;
  }
  if (std::abs(most - 1) <= kNoScale) return;
  std::ostringstream os;
  os.precision(3);
  os << context << ": the transformation scales by " << most << ": PBRT-v3 illuminates surfaces about "
     << most
     << " times as brightly as the sky is seen; here the scale of the sky has no effect, as if the "
        "transformation only turned it";
  diagnostics.warning(location, os.str());
}

}  // namespace pbrtmedia
