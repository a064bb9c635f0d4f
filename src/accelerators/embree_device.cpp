// SPDX-License-Identifier: BSD-2-Clause
#include "accelerators/embree_device.h"

#include <tbb/task_arena.h>

#include <sys/types.h>
#include <atomic>
#include <mutex>
#include <new>
#include <stdexcept>
#include <string>

#include "base/interruption.h"

namespace pbrtmedia {
namespace {

std::atomic<std::ptrdiff_t>& allocatedBytes() {
  static std::atomic<std::ptrdiff_t> bytes{0};
  return bytes;
}

bool countBytes(void*, ssize_t bytes, bool) {
  allocatedBytes().fetch_add(bytes, std::memory_order_relaxed);
  return true;
}

RTCDevice makeDevice() {
  RTCDevice device = rtcNewDevice(nullptr);
  if (!device) {
    throw std::runtime_error("Embree: no device, error " + std::to_string(rtcGetDeviceError(nullptr)));
  }
  rtcSetDeviceMemoryMonitorFunction(device, countBytes, nullptr);
  return device;
}

}  // namespace

RTCDevice embreeDevice() {
  static RTCDevice device = makeDevice();  // never released: scenes may die later than static objects
  return device;
}

std::size_t measureBuild(const std::function<void()>& build) {
  std::ptrdiff_t bytes = 0;
  RTCError error = RTC_ERROR_NONE;
  // Isolated: while this thread waits for its build it must not start another one, whose lock it holds.
  tbb::this_task_arena::isolate([&] {
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    RTCDevice device = embreeDevice();
    const std::ptrdiff_t before = allocatedBytes().load();
    build();
    bytes = allocatedBytes().load() - before;
    error = rtcGetDeviceError(device);
  });
  if (error == RTC_ERROR_CANCELLED) leaveIfStopped();
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE)
    throw std::runtime_error("Embree: build failed, error " + std::to_string(error));
  return bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

}  // namespace pbrtmedia
