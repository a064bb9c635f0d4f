// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "tools/medialab/session.h"

namespace pbrtmedia {

/// What float would cost: the same walks, sums and differences once in float and once in double, on the same
/// random numbers, and their errors. The float forms live in the lab alone.
LabTable precisionTable(const LabOptions& options);

/// `medialab precision`.
int runPrecision(const LabOptions& options);

}  // namespace pbrtmedia
