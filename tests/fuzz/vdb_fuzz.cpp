// SPDX-License-Identifier: BSD-2-Clause
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <stdexcept>

#include "memory_file.h"
#include "vdb2pbrt/crash_guard.h"
#include "vdb2pbrt/vdb_file.h"

// .vdb files of any content, read as vdb2pbrt does: densities, or an error; whatever OpenVDB does to the
// process that reads, which is not ours and not instrumented, must come out of the guard as a status or an
// error, in time. In a process of its own, so the fuzzer gets no feedback from the code: it tries changes of
// its seeds.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pbrtmedia;
  const test::MemoryFile file({reinterpret_cast<const char*>(data), size});
  const auto readAll = [&] {
    constexpr unsigned kSeconds = 5;
    for (const int crash : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL}) std::signal(crash, SIG_DFL);
    std::signal(SIGALRM, [](int) { ::_exit(1); });
    ::alarm(kSeconds);
    try {
      const VdbFile vdb(file.path());
      for (std::size_t i = 0; i < vdb.grids().size(); ++i) {
        try {
          static_cast<void>(vdb.read(i));
        } catch (const std::runtime_error&) {
        }
      }
    } catch (const std::runtime_error&) {
      return 1;
    } catch (const std::bad_alloc&) {
      return 1;
    }
    return 0;
  };
  try {
    // 0 and 1 are ours; the hooks of fuzzer and sanitizer end a process that asks for too much with others.
    static_cast<void>(runGuarded("fuzz.vdb", readAll));
  } catch (const std::runtime_error&) {
  }
  return 0;
}
