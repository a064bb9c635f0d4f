// SPDX-License-Identifier: BSD-2-Clause
#pragma once

// The statistical harness: everything prints all its numbers, thresholds are the same for the whole project.
//   EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;          z-test of a mean
//   EXPECT_GT(test.pValue(), sidak(kMinPValue, n)) << test;   chi-square or KS, one of n
#include "support/chi_square.h"
#include "support/kolmogorov_smirnov.h"
#include "support/running_stats.h"
#include "support/z_test.h"
