// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>

#include "fields/canonical_function.h"

namespace pbrtmedia {

/// A density from a table: lines "x,density" (also with blanks or tabs between), x increasing, straight lines
/// in between; two lines of the same x are a jump. A first line of words and lines that begin with # are left
/// out. The domain is moved to begin at 0. Its integral is exact. `name` of the function: the path.
/// Throws std::runtime_error with path and line for anything else: no file, a number that is none, negative
/// or not finite, x going back, fewer than two points, no density at all.
CanonicalFunction readTabulatedFunction(const std::filesystem::path& path);

}  // namespace pbrtmedia
