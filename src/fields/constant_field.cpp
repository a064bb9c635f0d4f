// SPDX-License-Identifier: BSD-2-Clause
#include "fields/constant_field.h"

#include <cmath>
#include <sstream>

#include "base/diagnostics.h"
#include "fields/field_box.h"

namespace pbrtmedia {

ConstantField::ConstantField(const Params& params, const Transform& worldFromMedium)
    : density_(params.density),
      worldFromLocal_(worldFromUnitCube(params.p0, params.p1, worldFromMedium, kTypeName)),
      localFromWorld_(worldFromLocal_.inverseMatrix()) {
  if (!std::isfinite(density_) || density_ < 0) {
    throw SceneError(SourceLocation{},
                     "constant field: density must be finite and >= 0; found " + std::to_string(density_));
  }
}

float ConstantField::densityAt(Point3f world) const {
  return localBox().contains(localFromWorld_.point(Vec3d(world))) ? density_ : 0;
}

SuperVoxels ConstantField::superVoxels() const {
  return SuperVoxels({.box = localBox()}, SuperVoxel{density_, density_, density_});
}

std::string ConstantField::describe() const {
  std::ostringstream text;
  text << "constant density " << density_;
  return text.str();
}

}  // namespace pbrtmedia
