// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/transform.h"

namespace pbrtmedia {

/// A transform at two times. Each matrix is split as T·R·S (R by polar decomposition); translation and S are
/// interpolated linearly, R by quaternion slerp along the shorter arc; outside the interval the end matrices
/// hold (scene-language reference 6.3). Immutable after construction, so safe to share between threads.
class AnimatedTransform {
 public:
  AnimatedTransform() = default;  ///< identity, not animated
  explicit AnimatedTransform(const Transform& fixed) : start_(fixed), end_(fixed) {}
  AnimatedTransform(const Transform& start, double startTime, const Transform& end, double endTime);

  bool isAnimated() const { return animated_; }
  const Transform& start() const { return start_; }
  const Transform& end() const { return end_; }
  Transform at(double time) const;
  /// A box that holds `b` mapped by every transform of the interval: exact when not animated, otherwise the
  /// union over a dense set of times grown by the distance a corner can move between two of them.
  Bounds3f motionBounds(const Bounds3f& b) const;

 private:
  struct Parts {
    Vec3d translation;
    double w = 1, x = 0, y = 0, z = 0;  ///< unit quaternion
    Matrix4 stretch;
  };
  static Parts decompose(const Matrix4& m);

  Transform start_, end_;
  double startTime_ = 0, endTime_ = 1;
  bool animated_ = false;
  Parts a_, b_;
};

}  // namespace pbrtmedia
