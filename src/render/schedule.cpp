// SPDX-License-Identifier: BSD-2-Clause
#include "render/schedule.h"

#include <algorithm>

namespace pbrtmedia {

Schedule::Schedule(const Plan& plan, const RenderOptions& options)
    : plan_(plan), options_(options), begin_(plan.first) {}

PhaseTime Schedule::time() const {
  PhaseTime time = watch_.elapsed();
  time += {-elsewhere_.wall, -elsewhere_.cpu};
  return time;
}

bool Schedule::isTimed() const { return options_.timeLimit < std::numeric_limits<double>::infinity(); }

bool Schedule::shouldStop() const {
  if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return true;
  return isTimed() && seconds() >= options_.timeLimit;
}

EarlyStop Schedule::reasonToStop(std::uint64_t lookups) const {
  if (options_.stop && options_.stop->load(std::memory_order_relaxed)) return EarlyStop::Asked;
  if (isTimed() && seconds() >= options_.timeLimit) return EarlyStop::Time;
  return options_.mostLookups && lookups >= *options_.mostLookups ? EarlyStop::Lookups : EarlyStop::None;
}

std::int64_t Schedule::passSize(std::uint64_t lookups) const {
  std::int64_t size = std::min(plan_.mostPerPass, plan_.end - plan_.first);
  if (options_.samplesPerPass) return std::min<std::int64_t>(size, std::max(1, *options_.samplesPerPass));
  // Where the render may be stopped early the first passes are small, so that the whole film gets samples
  // soon.
  if (isTimed() || options_.stop) size = std::min(size, std::int64_t{1} << std::min(passes_, 30));
  const std::int64_t done = plan_.first - options_.firstSample;
  if (options_.mostGrowth)
    size = std::min(size, static_cast<std::int64_t>(*options_.mostGrowth * static_cast<double>(done)));
  if (const std::int64_t here = plan_.first - begin_; here > 0) {
    const double most = options_.mostSecondsPerPass * static_cast<double>(here) / std::max(seconds(), 1e-9);
    if (most < static_cast<double>(size)) size = static_cast<std::int64_t>(most);
  }
  if (options_.mostLookups && done > 0) {
    const double perIndex = static_cast<double>(lookups) / static_cast<double>(done),
                 left = static_cast<double>(*options_.mostLookups) - static_cast<double>(lookups);
    if (perIndex * static_cast<double>(size) > left) size = static_cast<std::int64_t>(left / perIndex);
  } else if (options_.mostLookups) {
    size = 1;  // to know what an index costs
  }
  return std::max<std::int64_t>(size, 1);
}

std::optional<Pass> Schedule::next(std::uint64_t lookups) {
  if (plan_.first >= plan_.end) return std::nullopt;
  const EarlyStop reason = reasonToStop(lookups);
  // What was looked up before the first sample is no image yet.
  const bool isNothingYet = plan_.first == options_.firstSample;
  if (reason != EarlyStop::None && !(reason == EarlyStop::Lookups && isNothingYet)) return std::nullopt;
  const Pass pass{plan_.first, static_cast<int>(passSize(lookups))};
  plan_.first += pass.count;
  ++passes_;
  return pass;
}

}  // namespace pbrtmedia
