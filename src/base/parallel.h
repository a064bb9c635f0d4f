// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace pbrtmedia {

/// Limits every parallel loop of this process to `count` threads while alive; 0: one per processor.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned count);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  void* control_;
};

/// Calls body(i) for i in [0, count), each once, in any order and on any thread. Returns when all are done;
/// the first exception of a body is rethrown.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// Threads that a parallel loop may use now.
unsigned threadCount();

}  // namespace pbrtmedia
