// SPDX-License-Identifier: BSD-2-Clause
#include "lighting/light_importance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "media/phase/phase_function.h"

namespace pbrtmedia {
namespace {

/// What is left of a light that bounds say is not seen.
constexpr double kLeast = 0.02;
/// Squared distances below are taken as this: a light on the point itself is not infinitely important.
constexpr double kTiny = 1e-30;

/// Cosine of the angle a - b, or 1 where b is the larger; both in [0, π].
double cosineOfDifference(double cosA, double cosB, double sinB) {
  if (cosA >= cosB) return 1;
  const double sinA = std::sqrt(std::max(0.0, 1 - cosA * cosA));
  return cosA * cosB + sinA * sinB;
}

/// How much of its intensity a node sends along unit `d`, which is known up to an angle.
double emissionToward(const LightTree::Node& node, Vec3d d, double cosUncertain, double sinUncertain) {
  const double cosine = std::clamp(dot(Vec3d(node.axis), d), -1.0, 1.0);
  const double outside =
      cosineOfDifference(cosine, static_cast<double>(node.cosSpread), static_cast<double>(node.sinSpread));
  const double nearest = cosineOfDifference(outside, cosUncertain, sinUncertain);
  return nearest >= static_cast<double>(node.cosFade) ? std::max(nearest, kLeast) : kLeast;
}

}  // namespace

double receptionFrom(const LightReceiver& at, Vector3f toLight) {
  if (at.phase) {
    const double scattered = 4 * std::numbers::pi * static_cast<double>(at.phase->evaluate(at.wo, toLight));
    return std::max(scattered, kLeast);
  }
  if (at.n == Vector3f()) return 1;
  return std::max(static_cast<double>(dot(at.n, toLight)), kLeast);
}

double importanceAt(const LightReceiver& at, const LightTree::Node& node) {
  const Vec3d d = Vec3d(node.centre) - Vec3d(at.p);
  const double squared = lengthSquared(d), radius = static_cast<double>(node.radius);
  const double arriving = static_cast<double>(node.intensity) / std::max({squared, radius * radius, kTiny});
  if (!(squared > radius * radius)) return arriving;  // it may be on any side
  const double distance = std::sqrt(squared), sine = radius / distance,
               cosine = std::sqrt(std::max(0.0, 1 - sine * sine));
  const Vec3d toLight = d / distance;
  const double emitted = arriving * emissionToward(node, -toLight, cosine, sine);
  if (at.phase) {
    // Of a wide node the phase function at its middle says little.
    const double scattered = receptionFrom(at, Vector3f(toLight));
    return emitted * (cosine * scattered + (1 - cosine) * std::max(1.0, scattered));
  }
  if (at.n == Vector3f()) return emitted;
  const double facing = std::clamp(dot(Vec3d(at.n), toLight), -1.0, 1.0);
  return emitted * std::max(cosineOfDifference(facing, cosine, sine), kLeast);
}

double importanceAlong(Vec3d o, Vec3d d, double tMin, double tMax, const LightTree::Node& node) {
  const Vec3d centre(node.centre);
  const double dd = dot(d, d), foot = dot(centre - o, d) / dd;
  const double nearest = std::clamp(foot, tMin, tMax);
  const double speed = std::sqrt(dd), radius = static_cast<double>(node.radius);
  const double height = std::max({length(o + foot * d - centre), radius, std::sqrt(kTiny)});
  // In a frame where the line is the axis and the node stands `height` beside it.
  const double a = (tMin - foot) * speed, b = (tMax - foot) * speed;
  const double angle = std::atan2(height * (b - a), height * height + a * b);
  const double whole = std::isinf(tMax) ? std::atan2(height, a) : angle;
  const Vec3d toLine = o + nearest * d - centre;
  const double distance = length(toLine);
  const double integral = static_cast<double>(node.intensity) * std::max(whole, 0.0) / height;
  if (!(distance > radius)) return integral;
  // The line passes by under some angle: what half of it sees of the cone is uncertain too.
  const double uncertain = std::min(std::asin(radius / distance) + whole / 2, std::numbers::pi / 2);
  return integral * emissionToward(node, toLine / distance, std::cos(uncertain), std::sin(uncertain));
}

}  // namespace pbrtmedia
