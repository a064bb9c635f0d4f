// SPDX-License-Identifier: BSD-2-Clause
#include "fields/field_box.h"

#include <sstream>
#include <string>

#include "base/diagnostics.h"

namespace pbrtmedia {

Transform worldFromUnitCube(Point3f p0, Point3f p1, const Transform& worldFromMedium,
                            std::string_view field) {
  const auto refuse = [&](const std::string& what) {
    std::ostringstream message;
    message << field << " field: " << what << "; found p0 = " << p0 << ", p1 = " << p1;
    throw SceneError(SourceLocation{}, message.str());
  };
  if (!isFinite(p0) || !isFinite(p1)) refuse("\"p0\" and \"p1\" must be finite");
  const Vec3d size = Vec3d(p1) - Vec3d(p0);
  if (size.x == 0 || size.y == 0 || size.z == 0) refuse("\"p0\" and \"p1\" must differ on every axis");
  if (worldFromMedium.isSingular()) refuse("the transform to world space has no inverse");
  return worldFromMedium * Transform::translate(Vec3d(p0)) * Transform::scale(size.x, size.y, size.z);
}

}  // namespace pbrtmedia
