// SPDX-License-Identifier: BSD-2-Clause
// Without vector rounding (SSSE3) a batch is slower than the scalar twin.
#define HWY_DISABLED_TARGETS HWY_SSSE3
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "fields/grid_batch.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "fields/grid_batch-inl.h"

#if HWY_ONCE
#include <stdexcept>

#include "fields/grid_batch.h"

namespace pbrtmedia {

HWY_EXPORT(gridDensitiesOnTarget);

void gridDensities(const GridView& view, Vec3d o, Vec3d d, std::span<const double> s, std::span<float> out) {
  HWY_DYNAMIC_DISPATCH(gridDensitiesOnTarget)(view, o, d, s.data(), out.data(), s.size());
}

namespace {

/// Bits of the targets that are compiled in and run here; a lower bit is a better target.
std::int64_t usableTargets() { return hwy::SupportedTargets() & HWY_TARGETS; }

std::vector<std::int64_t> targetBits() {
  std::vector<std::int64_t> bits;
  for (std::int64_t rest = usableTargets(); rest != 0; rest &= rest - 1) bits.push_back(rest & -rest);
  return bits;
}

}  // namespace

std::vector<std::string> gridBatchTargets() {
  std::vector<std::string> names;
  for (const std::int64_t bit : targetBits()) names.emplace_back(hwy::TargetName(bit));
  return names;
}

std::string gridBatchTarget() { return hwy::TargetName(targetBits().front()); }

void useGridBatchTarget(std::string_view name) {
  hwy::SetSupportedTargetsForTest(0);  // all that there are
  std::string known;
  for (const std::int64_t bit : targetBits()) {
    if (name == hwy::TargetName(bit)) {
      hwy::SetSupportedTargetsForTest(bit);
      hwy::GetChosenTarget().Update(bit);
      return;
    }
    known += known.empty() ? "" : ", ";
    known += hwy::TargetName(bit);
  }
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
  if (name.empty()) return;
  throw std::invalid_argument("unknown instruction set \"" + std::string(name) + "\"; known: " + known);
}

}  // namespace pbrtmedia
#endif
