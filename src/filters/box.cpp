// SPDX-License-Identifier: BSD-2-Clause
#include "filters/box.h"

#include "filters/check.h"

namespace pbrtmedia {

BoxFilter::BoxFilter(const Params& params) : Filter(checkedRadius("box", params.radius)) {}

float BoxFilter::evaluate(Point2f) const { return 1; }

}  // namespace pbrtmedia
