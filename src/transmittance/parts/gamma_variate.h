// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// A variate of the gamma distribution with mean 1 and variance 1 / shape, shape > 0: density proportional to
/// x^(shape - 1) e^(-shape x), x >= 0. Marsaglia & Tsang 2000, doi:10.1145/358407.358414: exact up to
/// rounding, for shapes from 1e-6 (where most variates are below the smallest double, and 0) to 1e16 and
/// beyond (where they are 1 within rounding). Dimensions: three per trial, of which more than 95 % are
/// accepted, and one more for shapes below 1.
double gammaVariate(double shape, SampleStream& stream);

}  // namespace pbrtmedia
