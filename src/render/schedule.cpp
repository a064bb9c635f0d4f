// SPDX-License-Identifier: BSD-2-Clause
#include "render/schedule.h"

#include <algorithm>

namespace pbrtmedia {

Schedule::Schedule(const Plan& plan, const RenderOptions& options) : plan_(plan), options_(options) {}

bool Schedule::isTimed() const { return options_.timeLimit < std::numeric_limits<double>::infinity(); }

bool Schedule::shouldStop() const {
  if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return true;
  return isTimed() && seconds() >= options_.timeLimit;
}

// Where the render may be stopped early the first passes are small, so that the whole film gets samples soon.
std::int64_t Schedule::passSize() const {
  if (options_.samplesPerPass) return std::max(1, *options_.samplesPerPass);
  if (!isTimed() && !options_.stop) return plan_.mostPerPass;
  return std::min(plan_.mostPerPass, std::int64_t{1} << std::min(passes_, 30));
}

std::optional<Pass> Schedule::next() {
  if (plan_.first >= plan_.end || shouldStop()) return std::nullopt;
  const Pass pass{plan_.first,
                  static_cast<int>(std::min({passSize(), plan_.mostPerPass, plan_.end - plan_.first}))};
  plan_.first += pass.count;
  ++passes_;
  return pass;
}

}  // namespace pbrtmedia
