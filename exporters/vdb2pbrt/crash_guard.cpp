// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/crash_guard.h"

#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <iostream>
#include <stdexcept>
#include <system_error>

#include "base/stopwatch.h"

namespace pbrtmedia {
namespace {

/// More than the machine has becomes std::bad_alloc instead of an end by the system.
void limitMemory() {
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
  return;  // its shadow is larger than any machine
#endif
#endif
  const rlim_t most = machineMemoryBytes();
  const rlimit limit{most, most};
  ::setrlimit(RLIMIT_AS, &limit);
  const rlimit noCore{0, 0};
  ::setrlimit(RLIMIT_CORE, &noCore);
}

/// Signals by which a program that did something wrong ends. Others are somebody's wish.
bool isCrash(int signal) {
  return signal == SIGSEGV || signal == SIGBUS || signal == SIGABRT || signal == SIGFPE || signal == SIGILL;
}

}  // namespace

int runGuarded(const std::string& what, const std::function<int()>& run) {
  std::cout.flush();
  const pid_t child = ::fork();
  if (child < 0) throw std::system_error(errno, std::generic_category(), "fork");
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    limitMemory();
    const int status = run();
    std::cout.flush();
    std::cerr.flush();
    ::_exit(std::cout ? status : 1);
  }
  int status = 0;
  while (::waitpid(child, &status, 0) < 0) {
    if (errno != EINTR) throw std::system_error(errno, std::generic_category(), "waitpid");
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  const int signal = WTERMSIG(status);
  if (isCrash(signal)) {
    throw std::runtime_error(what + ": OpenVDB crashed (" + ::strsignal(signal) +
                             "): the file is damaged; nothing was written");
  }
  if (signal == SIGKILL) {
    throw std::runtime_error(what + ": the system ended it, perhaps for lack of memory; nothing was written");
  }
  std::signal(signal, SIG_DFL);  // as who asked for it expects
  std::raise(signal);
  return 128 + signal;
}

}  // namespace pbrtmedia
