// SPDX-License-Identifier: BSD-2-Clause
#include "base/animated_transform.h"

#include <cmath>
#include <utility>

namespace pbrtmedia {
namespace {

constexpr int kPolarIterations = 100;      // the averaging converges quadratically: ten are plenty
constexpr double kPolarTolerance = 1e-14;  // largest row-sum change that still counts as movement
constexpr int kMotionSteps = 128;          // times at which motionBounds looks

Matrix4 linearPart(const Matrix4& m) {
  Matrix4 r = m;
  for (std::size_t i = 0; i < 3; ++i) r.m[i][3] = r.m[3][i] = 0;
  r.m[3][3] = 1;
  return r;
}

}  // namespace

AnimatedTransform::Parts AnimatedTransform::decompose(const Matrix4& m) {
  Parts parts;
  parts.translation = {m.m[0][3], m.m[1][3], m.m[2][3]};
  const Matrix4 linear = linearPart(m);
  // Polar decomposition by averaging with the inverse transpose (Higham 1986, Newton iteration).
  Matrix4 r = linear;
  for (int i = 0; i < kPolarIterations; ++i) {
    bool singular = false;
    const Matrix4 it = r.transposed().inverse(singular);
    if (singular) break;
    double change = 0;
    Matrix4 next;
    for (std::size_t row = 0; row < 3; ++row) {
      double sum = 0;
      for (std::size_t col = 0; col < 3; ++col) {
        next.m[row][col] = 0.5 * (r.m[row][col] + it.m[row][col]);
        sum += std::abs(next.m[row][col] - r.m[row][col]);
      }
      change = std::max(change, sum);
    }
    r = next;
    if (change < kPolarTolerance) break;
  }
  // A mirroring matrix has a mirroring R: move the mirror into S so that R is a rotation.
  if (r.determinant3() < 0) {
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) r.m[i][j] = -r.m[i][j];
    }
  }
  parts.stretch = r.transposed() * linear;

  const auto& q = r.m;  // rotation matrix to quaternion, largest component first
  const double trace = q[0][0] + q[1][1] + q[2][2];
  if (trace > 0) {
    const double s = std::sqrt(trace + 1) * 2;
    parts.w = s / 4;
    parts.x = (q[2][1] - q[1][2]) / s;
    parts.y = (q[0][2] - q[2][0]) / s;
    parts.z = (q[1][0] - q[0][1]) / s;
  } else if (q[0][0] > q[1][1] && q[0][0] > q[2][2]) {
    const double s = std::sqrt(1 + q[0][0] - q[1][1] - q[2][2]) * 2;
    parts.w = (q[2][1] - q[1][2]) / s;
    parts.x = s / 4;
    parts.y = (q[0][1] + q[1][0]) / s;
    parts.z = (q[0][2] + q[2][0]) / s;
  } else if (q[1][1] > q[2][2]) {
    const double s = std::sqrt(1 + q[1][1] - q[0][0] - q[2][2]) * 2;
    parts.w = (q[0][2] - q[2][0]) / s;
    parts.x = (q[0][1] + q[1][0]) / s;
    parts.y = s / 4;
    parts.z = (q[1][2] + q[2][1]) / s;
  } else {
    const double s = std::sqrt(1 + q[2][2] - q[0][0] - q[1][1]) * 2;
    parts.w = (q[1][0] - q[0][1]) / s;
    parts.x = (q[0][2] + q[2][0]) / s;
    parts.y = (q[1][2] + q[2][1]) / s;
    parts.z = s / 4;
  }
  return parts;
}

AnimatedTransform::AnimatedTransform() {
  static const auto identity = std::make_shared<const Transform>();
  start_ = identity;
}

AnimatedTransform::AnimatedTransform(const Transform& start, double startTime, const Transform& end,
                                     double endTime)
    : AnimatedTransform(start) {
  if (start == end) return;
  Motion motion{end, startTime, endTime, decompose(start.matrix()), decompose(end.matrix())};
  const Parts& a = motion.a;
  Parts& b = motion.b;
  if (a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z < 0) {  // the shorter arc
    b.w = -b.w;
    b.x = -b.x;
    b.y = -b.y;
    b.z = -b.z;
  }
  motion_ = std::make_shared<const Motion>(std::move(motion));
}

Transform AnimatedTransform::at(double time) const {
  if (!motion_ || time <= motion_->startTime) return *start_;
  if (time >= motion_->endTime) return motion_->end;
  const double u = (time - motion_->startTime) / (motion_->endTime - motion_->startTime);
  const Parts &a = motion_->a, &b = motion_->b;

  const double cosine = std::min(1.0, a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z);
  const double theta = std::acos(cosine);
  double fa = 1 - u, fb = u;
  if (theta > 1e-6) {  // below, slerp equals lerp to rounding
    fa = std::sin((1 - u) * theta) / std::sin(theta);
    fb = std::sin(u * theta) / std::sin(theta);
  }
  double w = fa * a.w + fb * b.w, x = fa * a.x + fb * b.x, y = fa * a.y + fb * b.y, z = fa * a.z + fb * b.z;
  const double norm = std::sqrt(w * w + x * x + y * y + z * z);
  w /= norm;
  x /= norm;
  y /= norm;
  z /= norm;
  const Matrix4 rotation{{{{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), 0},
                           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x), 0},
                           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y), 0},
                           {0, 0, 0, 1}}}};
  Matrix4 stretch;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) stretch.m[i][j] = (1 - u) * a.stretch.m[i][j] + u * b.stretch.m[i][j];
  }
  const Vec3d t = (1 - u) * a.translation + u * b.translation;
  return Transform::translate(t) * Transform(rotation * stretch);
}

Bounds3f AnimatedTransform::motionBounds(const Bounds3f& b) const {
  if (!motion_) return start_->bounds(b);
  Bounds3f r;
  if (b.isEmpty()) return r;
  const double startTime = motion_->startTime, endTime = motion_->endTime;
  if (!(startTime < endTime)) {  // a jump: never between the two
    r = start_->bounds(b);
    r.expand(motion_->end.bounds(b));
    return r;
  }
  float step = 0;  // largest move of a corner between two neighbouring times
  for (int i = 0; i < 8; ++i) {
    Point3f last = start_->point(b.corner(i));
    r.expand(last);
    for (int k = 1; k <= kMotionSteps; ++k) {
      const Transform t = at(startTime + (endTime - startTime) * k / kMotionSteps);
      const Point3f p = t.point(b.corner(i));
      r.expand(p);
      step = std::max(step, distance(p, last));
      last = p;
    }
  }
  r.min -= Vector3f{step, step, step};
  r.max += Vector3f{step, step, step};
  return r;
}

}  // namespace pbrtmedia
