// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "main/options.h"
#include "main/together.h"

namespace pbrtmedia {

/// Renders (or prints) the scenes of the command line, one after the other; reports on standard error, writes
/// images and statistics. Returns the exit status: 0; 1 for bad input or failed output; 2 with --strict when
/// samples were dropped or a density bound was violated. Throws only what is a fault of the program or the
/// machine. With several ranks the first prints and writes, and all answer its status.
int runPbrt(const Options& options, Together& together);

/// The same as the body of a program: what it throws is told on standard error and is status 1.
int runPbrtProgram(const Options& options, Together& together);

}  // namespace pbrtmedia
