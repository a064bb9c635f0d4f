// SPDX-License-Identifier: BSD-2-Clause
#include "filters/triangle.h"

#include "filters/check.h"

namespace pbrtmedia {

TriangleFilter::TriangleFilter(const Params& params) : Filter(checkedRadius("triangle", params.radius)) {}

float TriangleFilter::evaluate(Point2f p) const {
  return std::max(0.0f, radius().x - std::abs(p.x)) * std::max(0.0f, radius().y - std::abs(p.y));
}

}  // namespace pbrtmedia
