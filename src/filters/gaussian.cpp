// SPDX-License-Identifier: BSD-2-Clause
#include "filters/gaussian.h"

#include "filters/check.h"

namespace pbrtmedia {
namespace {

double bell(double alpha, double d) { return std::exp(-alpha * d * d); }

}  // namespace

GaussianFilter::GaussianFilter(const Params& params)
    : Filter(checkedRadius("gaussian", params.radius)),
      alpha_(params.alpha),
      edgeX_(bell(params.alpha, params.radius.x)),
      edgeY_(bell(params.alpha, params.radius.y)) {
  requireFilterParameter(alpha_ > 0 && std::isfinite(alpha_), "gaussian", "alpha", alpha_,
                         "a positive number");
}

float GaussianFilter::evaluate(Point2f p) const {
  const double gx = std::max(0.0, bell(alpha_, p.x) - edgeX_), gy = std::max(0.0, bell(alpha_, p.y) - edgeY_);
  return static_cast<float>(gx * gy);
}

}  // namespace pbrtmedia
