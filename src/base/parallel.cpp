// SPDX-License-Identifier: BSD-2-Clause
#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace pbrtmedia {
namespace {

/// ThreadSanitizer sees nothing of how oneTBB, which it did not compile, hands work over and takes it back.
/// It is told what a loop promises, and no more: what was done before a loop comes before every body, and
/// what bodies do before whatever follows the loop.
struct LoopOrder {
  char begin = 0, end = 0;  // only their addresses matter

#ifdef __SANITIZE_THREAD__
  static void before(char& event) { __tsan_release(&event); }
  static void after(char& event) { __tsan_acquire(&event); }
#else
  static void before(char&) {}
  static void after(char&) {}
#endif
  LoopOrder() { before(begin); }
  ~LoopOrder() { after(end); }

  /// While a thread runs bodies.
  struct Bodies {
    explicit Bodies(LoopOrder& o) : order(o) { after(order.begin); }
    ~Bodies() { before(order.end); }
    LoopOrder& order;
  };
};

}  // namespace

ThreadLimit::ThreadLimit(unsigned count)
    : control_(new tbb::global_control(
          tbb::global_control::max_allowed_parallelism,
          count > 0 ? count : static_cast<unsigned>(tbb::info::default_concurrency()))) {}

ThreadLimit::~ThreadLimit() { delete static_cast<tbb::global_control*>(control_); }

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  LoopOrder order;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        const LoopOrder::Bodies bodies(order);
        for (std::size_t i = range.begin(); i != range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
}

unsigned threadCount() {
  return static_cast<unsigned>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace pbrtmedia
