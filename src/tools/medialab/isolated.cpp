// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/isolated.h"

#include <poll.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <type_traits>

namespace pbrtmedia {
namespace {

using End = IsolatedResult::End;

// A child answers with one byte, 'd' (done) or 't' (threw), then the numbers or the message.
static_assert(std::is_trivially_copyable_v<TrialStats>);

void writeAll(int descriptor, const void* data, std::size_t size) {
  const char* at = static_cast<const char*>(data);
  while (size > 0) {
    const ssize_t written = ::write(descriptor, at, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return;
    at += written;
    size -= static_cast<std::size_t>(written);
  }
}

[[noreturn]] void runChild(const std::function<TrialStats()>& job, int descriptor, double seconds) {
  std::signal(SIGINT, SIG_IGN);  // the parent decides
  std::signal(SIGTERM, SIG_DFL);
  std::signal(SIGPROF, SIG_DFL);
  itimerval limit{};
  limit.it_value.tv_sec = static_cast<time_t>(seconds);
  limit.it_value.tv_usec =
      static_cast<suseconds_t>((seconds - static_cast<double>(limit.it_value.tv_sec)) * 1e6);
  ::setitimer(ITIMER_PROF, &limit, nullptr);
  try {
    const TrialStats stats = job();
    writeAll(descriptor, "d", 1);
    writeAll(descriptor, &stats, sizeof stats);
  } catch (const std::exception& e) {
    writeAll(descriptor, "t", 1);
    writeAll(descriptor, e.what(), std::strlen(e.what()));
  }
  ::_exit(0);
}

struct Child {
  pid_t pid;
  int descriptor;
  std::size_t job;
  std::string answer;
};

Child start(const std::function<TrialStats()>& job, std::size_t number, double seconds) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::runtime_error(std::string("pipe: ") + std::strerror(errno));
  const pid_t pid = ::fork();
  if (pid < 0) throw std::runtime_error(std::string("fork: ") + std::strerror(errno));
  if (pid == 0) {
    ::close(ends[0]);
    runChild(job, ends[1], seconds);
  }
  ::close(ends[1]);
  return {pid, ends[0], number, ""};
}

/// Waits for the child's end and reads its answer.
IsolatedResult finish(Child& child) {
  ::close(child.descriptor);
  int status = 0;
  while (::waitpid(child.pid, &status, 0) < 0 && errno == EINTR) {
  }
  IsolatedResult result;
  if (WIFSIGNALED(status)) {
    result.end = WTERMSIG(status) == SIGPROF ? End::OutOfTime : End::Crashed;
    result.message = std::string("signal ") + strsignal(WTERMSIG(status));
  } else if (child.answer.size() == 1 + sizeof(TrialStats) && child.answer[0] == 'd') {
    result.end = End::Done;
    std::memcpy(&result.stats, child.answer.data() + 1, sizeof(TrialStats));
  } else if (!child.answer.empty() && child.answer[0] == 't') {
    result.end = End::Threw;
    result.message = child.answer.substr(1);
  } else {
    result.end = End::Crashed;
    result.message = "exit status " + std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : -1);
  }
  return result;
}

/// Reads what is there; false at the end of the stream.
bool readSome(Child& child) {
  char buffer[4096];
  const ssize_t count = ::read(child.descriptor, buffer, sizeof buffer);
  if (count < 0) return errno == EINTR;
  child.answer.append(buffer, static_cast<std::size_t>(count));
  return count > 0;
}

}  // namespace

std::vector<IsolatedResult> runIsolated(const std::vector<std::function<TrialStats()>>& jobs,
                                        unsigned parallel, double seconds, const std::atomic<bool>& stop,
                                        const std::function<void(std::size_t)>& done) {
  constexpr int kPollMilliseconds = 200;
  std::vector<IsolatedResult> results(jobs.size());
  std::vector<Child> children;
  std::size_t next = 0;
  while (!stop && (next < jobs.size() || !children.empty())) {
    while (next < jobs.size() && children.size() < parallel) {
      children.push_back(start(jobs[next], next, seconds));
      ++next;
    }
    std::vector<pollfd> waits;
    for (const Child& child : children) waits.push_back({child.descriptor, POLLIN, 0});
    if (::poll(waits.data(), waits.size(), kPollMilliseconds) <= 0) continue;
    for (std::size_t i = children.size(); i-- > 0;) {
      if (waits[i].revents == 0 || readSome(children[i])) continue;
      results[children[i].job] = finish(children[i]);
      done(children[i].job);
      children.erase(children.begin() + static_cast<std::ptrdiff_t>(i));
    }
  }
  for (Child& child : children) {
    ::kill(child.pid, SIGKILL);
    finish(child);
  }
  return results;
}

}  // namespace pbrtmedia
