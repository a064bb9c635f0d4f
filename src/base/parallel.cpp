// SPDX-License-Identifier: BSD-2-Clause
#include "base/parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#include <tbb/task_scheduler_observer.h>

extern "C" {  // of libtsan, in none of its headers
void AnnotateIgnoreReadsBegin(const char* file, int line);
void AnnotateIgnoreReadsEnd(const char* file, int line);
void AnnotateIgnoreWritesBegin(const char* file, int line);
void AnnotateIgnoreWritesEnd(const char* file, int line);
}
#endif

namespace pbrtmedia {
namespace {

#ifdef __SANITIZE_THREAD__

/// ThreadSanitizer sees nothing of how oneTBB, which it did not compile, hands work over and takes it back,
/// but does see what oneTBB's headers read and write of their tasks, which lie on stacks of threads and are
/// soon something else. So it does not look while a thread is in oneTBB, and is told what a loop promises,
/// and no more: what was done before a loop comes before every body, and what bodies do before whatever
/// follows the loop.
class Watch {
 public:
  ~Watch() { set(true); }
  void set(bool isOn) {
    if (isOn == isOn_) return;
    isOn_ = isOn;
    if (isOn) {
      AnnotateIgnoreReadsEnd(__FILE__, __LINE__);
      AnnotateIgnoreWritesEnd(__FILE__, __LINE__);
    } else {
      AnnotateIgnoreReadsBegin(__FILE__, __LINE__);
      AnnotateIgnoreWritesBegin(__FILE__, __LINE__);
    }
  }

 private:
  bool isOn_ = true;
};
thread_local Watch watch;

/// Threads of oneTBB split tasks before they run a body.
class Newcomers : public tbb::task_scheduler_observer {
 public:
  Newcomers() { observe(true); }
  ~Newcomers() override { observe(false); }
  void on_scheduler_entry(bool isWorker) override {
    if (isWorker) watch.set(false);
  }
};

void leave(char& event) {
  static Newcomers newcomers;
  __tsan_release(&event);
  watch.set(false);
}
void enter(char& event) {
  watch.set(true);
  __tsan_acquire(&event);
}

#else

void leave(char&) {}
void enter(char&) {}

#endif

/// The order of what a loop does. Its maker goes into oneTBB, and comes back when this ends.
struct LoopOrder {
  char begin = 0, end = 0;  // only their addresses matter

  LoopOrder() { leave(begin); }
  ~LoopOrder() { enter(end); }

  /// While a thread runs bodies: it comes out of oneTBB and goes back.
  struct Bodies {
    explicit Bodies(LoopOrder& o) : order(o) { enter(order.begin); }
    ~Bodies() { leave(order.end); }
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
        const std::size_t end = range.end();
        std::size_t i = range.begin();
        const LoopOrder::Bodies bodies(order);
        for (; i != end; ++i) body(i);
      },
      tbb::simple_partitioner());
}

unsigned threadCount() {
  return static_cast<unsigned>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

}  // namespace pbrtmedia
