// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>

namespace pbrtmedia {

/// Throws std::runtime_error when the headers of an OpenEXR file cannot be honest: attributes longer than the
/// file, tables of offsets that do not fit it, or more pixels than its compression could hold in its bytes.
/// OpenEXR takes memory by these numbers before it looks at the data.
void checkExrHeaders(std::span<const std::byte> bytes);

}  // namespace pbrtmedia
