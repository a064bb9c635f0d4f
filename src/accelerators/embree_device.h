// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <embree3/rtcore.h>

#include <cstddef>
#include <functional>

// Internal to the room: other rooms see accelerator.h only.

namespace pbrtmedia {

/// The one device of the process, made on first use and kept until the process ends. Thread-safe.
/// Throws std::runtime_error when it cannot be made.
RTCDevice embreeDevice();

/// Runs `build` and returns the bytes the device allocated (net) meanwhile. Builds run one after the other,
/// each on all threads; a thread that waits inside a build takes no other task. Throws what the device
/// reports: std::bad_alloc or std::runtime_error.
std::size_t measureBuild(const std::function<void()>& build);

}  // namespace pbrtmedia
