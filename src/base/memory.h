// SPDX-License-Identifier: BSD-2-Clause
#pragma once

namespace pbrtmedia {

/// Gives memory that was freed in small pieces back to the system, as far as the C library can: before
/// something large is built that does not come from those pieces. Takes up to some tenths of a second for a
/// gigabyte. Thread-safe.
void returnFreedMemory();

}  // namespace pbrtmedia
