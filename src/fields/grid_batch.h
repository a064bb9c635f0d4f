// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "fields/grid_view.h"

namespace pbrtmedia {

/// out[i] = view.density(o + s[i] * d), bit for bit on every instruction set: the same operations in the same
/// order, none of them fused. `s` and `out` have equal sizes and do not overlap; the points need no order and
/// no spacing. Every point must be one where `view.density` is defined.
///
/// Within a cache about 2.7 times as fast as one look-up after the other, beyond it about 1.8 times
/// (docs/benchmarks.md): four reads of 64 bits a look-up instead of eight of 32, as many in flight as the
/// processor holds. The instruction set is chosen when the program runs; those without vector rounding and
/// conversion run the scalar twin.
void gridDensities(const GridView& view, Vec3d o, Vec3d d, std::span<const double> s, std::span<float> out);

/// The instruction sets that `gridDensities` can use on this machine, best first.
std::vector<std::string> gridBatchTargets();
/// The one in use.
std::string gridBatchTarget();
/// Uses only the one called `name`, one of the above; "" returns to the best. For tests and benchmarks; not
/// thread-safe. Throws std::invalid_argument that lists the names.
void useGridBatchTarget(std::string_view name);

}  // namespace pbrtmedia
