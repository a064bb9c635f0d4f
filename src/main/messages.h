// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "base/diagnostics.h"

namespace pbrtmedia {

/// Prints what has been collected on standard error; warnings and notes only when not `quiet`. Messages that
/// begin with no place begin with the program's name.
void show(const Diagnostics& diagnostics, bool quiet);

}  // namespace pbrtmedia
