// SPDX-License-Identifier: BSD-2-Clause
#include "filters/sinc.h"

#include <numbers>

#include "filters/check.h"

namespace pbrtmedia {
namespace {

double sinc(double t) {
  const double x = std::numbers::pi * t;
  return std::abs(x) < 1e-5 ? 1 : std::sin(x) / x;  // 1 - x^2/6 rounds to 1 in float
}

double windowedSinc(double t, double radius, double tau) {
  return std::abs(t) <= radius ? sinc(t) * sinc(t / tau) : 0;
}

}  // namespace

SincFilter::SincFilter(const Params& params)
    : Filter(checkedRadius("sinc", params.radius)), tau_(params.tau) {
  requireFilterParameter(tau_ > 0 && std::isfinite(tau_), "sinc", "tau", tau_, "a positive number");
}

float SincFilter::evaluate(Point2f p) const {
  return static_cast<float>(windowedSinc(p.x, radius().x, tau_) * windowedSinc(p.y, radius().y, tau_));
}

}  // namespace pbrtmedia
