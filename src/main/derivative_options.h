// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <CLI/CLI.hpp>

#include "main/options.h"

namespace pbrtmedia {

/// --derivative and what says how: they are written into `options`, which must outlive the reading.
void addDerivativeOptions(CLI::App& app, DerivativeOptions& options);

}  // namespace pbrtmedia
