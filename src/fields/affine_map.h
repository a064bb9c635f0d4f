// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"
#include "base/vec.h"

namespace pbrtmedia {

/// World space to the local space of a field, in double: 12 numbers, applied once per segment, so a field far
/// from the origin keeps its digits.
struct AffineMap {
  Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};  ///< columns of the linear part
  Vec3d t{0, 0, 0};

  AffineMap() = default;
  explicit AffineMap(const Matrix4& m)
      : x(m.m[0][0], m.m[1][0], m.m[2][0]),
        y(m.m[0][1], m.m[1][1], m.m[2][1]),
        z(m.m[0][2], m.m[1][2], m.m[2][2]),
        t(m.m[0][3], m.m[1][3], m.m[2][3]) {}

  Vec3d vector(Vec3d v) const { return v.x * x + v.y * y + v.z * z; }
  Vec3d point(Vec3d p) const { return vector(p) + t; }
};

}  // namespace pbrtmedia
