// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "base/transform.h"

namespace pbrtmedia {

/// A transform at two times. Each matrix is split as T·R·S (R by polar decomposition); translation and S are
/// interpolated linearly, R by quaternion slerp along the shorter arc; outside the interval the end matrices
/// hold (scene-language reference 6.3). Immutable after construction, so safe to share between threads.
/// Copies share what they hold.
class AnimatedTransform {
 public:
  AnimatedTransform();  ///< identity, not animated
  explicit AnimatedTransform(const Transform& fixed) : start_(std::make_shared<const Transform>(fixed)) {}
  AnimatedTransform(const Transform& start, double startTime, const Transform& end, double endTime);

  bool isAnimated() const { return motion_ != nullptr; }
  const Transform& start() const { return *start_; }
  const Transform& end() const { return motion_ ? motion_->end : *start_; }
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
  struct Motion {
    Transform end;
    double startTime, endTime;
    Parts a, b;  ///< of the start and of the end
  };

  std::shared_ptr<const Transform> start_;  ///< never null
  std::shared_ptr<const Motion> motion_;    ///< null: none
};

}  // namespace pbrtmedia
