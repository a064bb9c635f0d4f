// SPDX-License-Identifier: BSD-2-Clause
#include <sanitizer/allocator_interface.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <stdexcept>

#include "memory_file.h"
#include "openvdb_alone.h"
#include "vdb2pbrt/crash_guard.h"
#include "vdb2pbrt/vdb_file.h"

// .vdb files of any content, read as vdb2pbrt does: densities, or an error. OpenVDB is not ours, and damaged
// files crash it; so a file is first read in a process of its own. Where that goes well the fuzzer reads it
// itself, with its instruments. Where not, a process of OpenVDB alone tells whose fault it is: should it
// survive, the crash is ours and ends the fuzzer.

namespace {

using namespace pbrtmedia;

/// Of vdb2pbrt's, with all densities.
void readOurs(const std::filesystem::path& path) {
  try {
    const VdbFile vdb(path);
    for (std::size_t i = 0; i < vdb.grids().size(); ++i) {
      try {
        VdbDensity density = vdb.read(i);
        static_cast<void>(density.checkValues(NegativeRule::Clamp, NanRule::Zero));
        static_cast<void>(density.quantile(.5));
        static_cast<void>(density.worldBox());
      } catch (const std::runtime_error&) {
      }
    }
  } catch (const std::runtime_error&) {
  } catch (const std::bad_alloc&) {
  }
}

/// OpenVDB takes what a damaged file asks for (a name of two gigabytes); the fuzzer itself may have 2 GB.
constexpr std::size_t kMostBytes = 1UL << 30;

/// Whether a process of its own comes to its end in `seconds`, within the memory it may have.
bool survives(const std::function<void()>& run, unsigned seconds) {
  constexpr int kDone = 42;  // no status of a sanitizer or the fuzzer
  const auto inChild = [&] {
    const auto endIfTooLarge = [](const volatile void*, std::size_t size) {
      if (size > kMostBytes) ::_exit(1);
    };
    __sanitizer_install_malloc_and_free_hooks(endIfTooLarge, [](const volatile void*) {});
    for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) std::signal(crash, SIG_DFL);
    std::signal(SIGALRM, [](int) { ::_exit(1); });
    ::alarm(seconds);
    run();
    rusage used{};
    ::getrusage(RUSAGE_SELF, &used);
    return static_cast<std::size_t>(used.ru_maxrss) <= kMostBytes / 1024 ? kDone : 1;
  };
  try {
    return runGuarded("fuzz.vdb", inChild) == kDone;
  } catch (const std::runtime_error&) {
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const test::MemoryFile file({reinterpret_cast<const char*>(data), size});
  // OpenVDB alone does less, and must be much faster to accuse us of taking too long.
  constexpr unsigned kSeconds = 10, kSecondsAlone = 1;
  if (survives([&] { readOurs(file.path()); }, kSeconds)) {
    readOurs(file.path());
  } else if (survives([&] { test::OpenVdbAlone::read(file.path()); }, kSecondsAlone)) {
    std::fprintf(stderr, "OpenVDB reads this file without a crash, VdbFile does not\n");
    std::abort();
  }
  return 0;
}
