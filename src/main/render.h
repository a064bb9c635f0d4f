// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "main/options.h"

namespace pbrtmedia {

/// Renders (or prints) the scenes of the command line, one after the other; reports on standard error, writes
/// images and statistics. Returns the exit status: 0; 1 for bad input or failed output; 2 with --strict when
/// samples were dropped or a density bound was violated. Throws only what is a fault of the program or the
/// machine.
int runPbrt(const Options& options);

}  // namespace pbrtmedia
