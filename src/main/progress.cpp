// SPDX-License-Identifier: BSD-2-Clause
#include "main/progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pbrtmedia {
namespace {

constexpr double kLiveInterval = 0.1;   // seconds between redraws
constexpr double kPlainInterval = 5.0;  // seconds between lines
constexpr double kPhaseInterval = 0.5;  // seconds between redraws of a phase on a terminal
constexpr std::size_t kBarWidth = 30, kShortestBar = 8;
constexpr std::size_t kBarFrame = 4;  // brackets and blanks
constexpr int kUnknownColumns = 80;
constexpr std::size_t kShortestTitle = 12;

int terminalColumns() {
  winsize size{};
  return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUnknownColumns;
}

/// The beginning and the end of a text with dots between, `length` bytes in all. Names are cut between
/// characters.
std::string shortened(const std::string& text, std::size_t length) {
  if (text.size() <= length) return text;
  if (length <= 2) return text.substr(0, length);
  const auto isInside = [&](std::size_t i) {
    return i < text.size() && (static_cast<unsigned char>(text[i]) & 0xc0) == 0x80;
  };
  std::size_t head = (length - 2) / 2;
  std::size_t tail = text.size() - (length - 2 - head);
  while (head > 0 && isInside(head)) --head;
  while (isInside(tail)) ++tail;
  return text.substr(0, head) + ".." + text.substr(tail);
}

}  // namespace

std::string formatDuration(double seconds) {
  char text[32];
  const long whole = std::lround(seconds);
  if (seconds < 59.95) {
    std::snprintf(text, sizeof text, "%.1fs", seconds);
  } else if (whole < 3600) {
    std::snprintf(text, sizeof text, "%ldm%02lds", whole / 60, whole % 60);
  } else {
    std::snprintf(text, sizeof text, "%ldh%02ldm", whole / 3600, whole / 60 % 60);
  }
  return text;
}

std::string formatCount(double count) {
  char text[32];
  const char* units[] = {"", "k", "M", "G", "T"};
  std::size_t unit = 0;
  while (count >= 999.5 && unit + 1 < std::size(units)) {
    count /= 1000;
    ++unit;
  }
  std::snprintf(text, sizeof text, unit == 0 ? "%.0f%s" : "%.3g%s", count, units[unit]);
  return text;
}

ProgressStyle progressStyle(ProgressMode mode, bool quiet) {
  if (quiet || mode == ProgressMode::None) return ProgressStyle::Silent;
  return mode == ProgressMode::Plain || ::isatty(STDERR_FILENO) == 0 ? ProgressStyle::Plain
                                                                     : ProgressStyle::Live;
}

std::string liveLine(const std::string& title, double fraction, const std::string& numbers, int columns) {
  const auto room = static_cast<std::size_t>(std::max(columns - 1, 1));
  const std::size_t needed = std::min(kShortestTitle, title.size()) + kBarFrame + numbers.size();
  const std::size_t width = needed < room ? std::min(room - needed, kBarWidth) : 0;
  std::string bar = " ";
  if (width >= kShortestBar) {
    const auto done = static_cast<std::size_t>(std::clamp(fraction, 0.0, 1.0) * static_cast<double>(width));
    bar = " [" + std::string(done, '=') + std::string(width - done, ' ') + "] ";
  }
  const std::size_t rest = bar.size() + numbers.size();
  const std::size_t forTitle =
      std::max(rest < room ? room - rest : 0, std::min(kShortestTitle, title.size()));
  return (shortened(title, forTitle) + bar + numbers).substr(0, room);
}

PhaseLine::PhaseLine(ProgressMode mode, bool quiet, std::string text)
    : style_(progressStyle(mode, quiet)), text_(std::move(text)) {
  if (style_ != ProgressStyle::Silent) printer_ = std::thread([this] { print(); });
}

PhaseLine::~PhaseLine() {
  if (!printer_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    isOver_ = true;
  }
  over_.notify_one();
  printer_.join();
}

void PhaseLine::print() {
  using Clock = std::chrono::steady_clock;
  const bool isLive = style_ == ProgressStyle::Live;
  const std::chrono::duration<double> interval(isLive ? kPhaseInterval : kPlainInterval);
  const Clock::time_point start = Clock::now();
  bool isShown = false;
  std::unique_lock lock(mutex_);
  while (!over_.wait_for(lock, interval, [this] { return isOver_; })) {
    const std::string elapsed = formatDuration(std::chrono::duration<double>(Clock::now() - start).count());
    if (isLive) {
      const auto room = static_cast<std::size_t>(std::max(terminalColumns() - 1, 1));
      const std::size_t forText = room > elapsed.size() + 1 ? room - elapsed.size() - 1 : 0;
      std::fprintf(stderr, "\r%s %s\033[K", shortened(text_, forText).c_str(), elapsed.c_str());
    } else {
      std::fprintf(stderr, "%s, %s\n", text_.c_str(), elapsed.c_str());
    }
    std::fflush(stderr);
    isShown = isLive;
  }
  if (isShown) std::fprintf(stderr, "\r\033[K");
}

ProgressLine::ProgressLine(ProgressMode mode, bool quiet, std::string title)
    : style_(progressStyle(mode, quiet)), title_(std::move(title)), start_(Clock::now()), last_(start_) {}

void ProgressLine::update(std::int64_t done, std::int64_t total, double timeLimit) {
  if (style_ == ProgressStyle::Silent || total <= 0) return;
  const auto now = Clock::now();
  const double interval = style_ == ProgressStyle::Live ? kLiveInterval : kPlainInterval;
  if (std::chrono::duration<double>(now - last_).count() < interval) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  double fraction = static_cast<double>(done) / static_cast<double>(total);
  if (timeLimit > 0) fraction = std::max(fraction, elapsed / timeLimit);
  fraction = std::min(fraction, 1.0);
  const double rest = fraction > 0 ? elapsed / fraction - elapsed : 0;
  const std::string rate = formatCount(elapsed > 0 ? static_cast<double>(done) / elapsed : 0);
  if (style_ == ProgressStyle::Plain) {
    std::fprintf(stderr, "%s: %3.0f%%, %s, %s left, %s samples/s\n", title_.c_str(), 100 * fraction,
                 formatDuration(elapsed).c_str(), formatDuration(rest).c_str(), rate.c_str());
    return;
  }
  char numbers[96];
  std::snprintf(numbers, sizeof numbers, "%3.0f%%  %s, %s left, %s samples/s", 100 * fraction,
                formatDuration(elapsed).c_str(), formatDuration(rest).c_str(), rate.c_str());
  std::fprintf(stderr, "\r%s\033[K", liveLine(title_, fraction, numbers, terminalColumns()).c_str());
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::finish(std::int64_t done, std::int64_t total) {
  if (style_ == ProgressStyle::Silent) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (shown_) std::fprintf(stderr, "\r\033[K");
  std::fprintf(stderr, "%s: %s of %s samples in %s\n", title_.c_str(),
               formatCount(static_cast<double>(done)).c_str(),
               formatCount(static_cast<double>(total)).c_str(), formatDuration(elapsed).c_str());
}

}  // namespace pbrtmedia
