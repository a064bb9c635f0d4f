// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <stdexcept>
#include <string>

// Programs run as a user runs them.
namespace pbrtmedia::test {

struct ProcessResult {
  int status = -1;     ///< exit status; 128 + signal when killed
  std::string output;  ///< standard output and standard error together
};

/// Runs a shell command and waits.
inline ProcessResult run(const std::string& command) {
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) throw std::runtime_error("cannot run " + command);
  ProcessResult result;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    result.output.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return result;
}

}  // namespace pbrtmedia::test
