// SPDX-License-Identifier: BSD-2-Clause
#include "base/animated_transform.h"

#include <cmath>

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

AnimatedTransform::AnimatedTransform(const Transform& start, double startTime, const Transform& end,
                                     double endTime)
    : start_(start), end_(end), startTime_(startTime), endTime_(endTime), animated_(!(start == end)) {
  if (!animated_) return;
  a_ = decompose(start.matrix());
  b_ = decompose(end.matrix());
  if (a_.w * b_.w + a_.x * b_.x + a_.y * b_.y + a_.z * b_.z < 0) {  // the shorter arc
    b_.w = -b_.w;
    b_.x = -b_.x;
    b_.y = -b_.y;
    b_.z = -b_.z;
  }
}

Transform AnimatedTransform::at(double time) const {
  if (!animated_ || time <= startTime_) return start_;
  if (time >= endTime_) return end_;
  const double u = (time - startTime_) / (endTime_ - startTime_);

  const double cosine = std::min(1.0, a_.w * b_.w + a_.x * b_.x + a_.y * b_.y + a_.z * b_.z);
  const double theta = std::acos(cosine);
  double fa = 1 - u, fb = u;
  if (theta > 1e-6) {  // below, slerp equals lerp to rounding
    fa = std::sin((1 - u) * theta) / std::sin(theta);
    fb = std::sin(u * theta) / std::sin(theta);
  }
  double w = fa * a_.w + fb * b_.w, x = fa * a_.x + fb * b_.x, y = fa * a_.y + fb * b_.y,
         z = fa * a_.z + fb * b_.z;
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
    for (std::size_t j = 0; j < 3; ++j)
      stretch.m[i][j] = (1 - u) * a_.stretch.m[i][j] + u * b_.stretch.m[i][j];
  }
  const Vec3d t = (1 - u) * a_.translation + u * b_.translation;
  return Transform::translate(t) * Transform(rotation * stretch);
}

Bounds3f AnimatedTransform::motionBounds(const Bounds3f& b) const {
  if (!animated_) return start_.bounds(b);
  Bounds3f r;
  if (b.isEmpty()) return r;
  if (!(startTime_ < endTime_)) {  // a jump: never between the two
    r = start_.bounds(b);
    r.expand(end_.bounds(b));
    return r;
  }
  float step = 0;  // largest move of a corner between two neighbouring times
  for (int i = 0; i < 8; ++i) {
    Point3f last = start_.point(b.corner(i));
    r.expand(last);
    for (int k = 1; k <= kMotionSteps; ++k) {
      const Transform t = at(startTime_ + (endTime_ - startTime_) * k / kMotionSteps);
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
