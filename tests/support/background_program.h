// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace pbrtmedia::test {

/// A program that runs while a test goes on; killed in the end if it still does.
class BackgroundProgram {
 public:
  /// `words`: the program and its arguments. `output`: a file for all that it prints.
  BackgroundProgram(std::vector<std::string> words, const std::filesystem::path& folder,
                    std::filesystem::path output)
      : output_(std::move(output)) {
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    process_ = ::fork();
    if (process_ < 0) throw std::runtime_error("cannot fork");
    if (process_ == 0) {
      const int file = ::open(output_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      if (file < 0 || ::chdir(folder.c_str()) != 0) ::_exit(127);
      ::dup2(file, STDOUT_FILENO);
      ::dup2(file, STDERR_FILENO);
      ::execv(arguments[0], arguments.data());
      ::_exit(127);
    }
  }
  ~BackgroundProgram() {
    if (status_) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  BackgroundProgram(const BackgroundProgram&) = delete;
  BackgroundProgram& operator=(const BackgroundProgram&) = delete;

  pid_t process() const { return process_; }
  std::string output() const {
    std::ostringstream text;
    text << std::ifstream(output_).rdbuf();
    return text.str();
  }
  /// Its exit status, 128 + signal when killed, as soon as it ends; nothing when it does not within the time.
  std::optional<int> wait(double seconds) {
    for (double waited = 0; !status_ && waited < seconds; waited += 0.01) {
      if (!isOver()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return status_;
  }
  bool isOver() {
    int status = 0;
    if (!status_ && ::waitpid(process_, &status, WNOHANG) == process_) note(status);
    return status_.has_value();
  }
  /// Sends a signal and waits for the end: what `wait` answers; nothing when the program was over before.
  std::optional<int> end(int signal) {
    if (isOver()) return std::nullopt;
    ::kill(process_, signal);
    int status = 0;
    ::waitpid(process_, &status, 0);
    note(status);
    return status_;
  }
  /// Names of its threads.
  std::multiset<std::string> threads() const {
    std::multiset<std::string> names;
    std::error_code ended;
    const std::filesystem::path tasks = "/proc/" + std::to_string(process_) + "/task";
    for (const auto& task : std::filesystem::directory_iterator(tasks, ended)) {
      std::string name;
      std::getline(std::ifstream(task.path() / "comm") >> std::ws, name);
      names.insert(name);
    }
    return names;
  }

 private:
  void note(int status) { status_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status); }

  std::filesystem::path output_;
  pid_t process_ = -1;
  std::optional<int> status_;
};

}  // namespace pbrtmedia::test
