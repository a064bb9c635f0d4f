// SPDX-License-Identifier: BSD-2-Clause
#include "main/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pbrtmedia {
namespace {

constexpr double kLiveInterval = 0.1;   // seconds between redraws
constexpr double kPlainInterval = 5.0;  // seconds between lines
constexpr int kBarWidth = 30;

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

ProgressLine::ProgressLine(ProgressMode mode, bool quiet, std::string title)
    : style_(quiet || mode == ProgressMode::None                           ? Style::Silent
             : mode == ProgressMode::Plain || ::isatty(STDERR_FILENO) == 0 ? Style::Plain
                                                                           : Style::Live),
      title_(std::move(title)),
      start_(Clock::now()),
      last_(start_) {}

void ProgressLine::update(std::int64_t done, std::int64_t total, double timeLimit) {
  if (style_ == Style::Silent || total <= 0) return;
  const auto now = Clock::now();
  const double interval = style_ == Style::Live ? kLiveInterval : kPlainInterval;
  if (std::chrono::duration<double>(now - last_).count() < interval) return;
  last_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  double fraction = static_cast<double>(done) / static_cast<double>(total);
  if (timeLimit > 0) fraction = std::max(fraction, elapsed / timeLimit);
  fraction = std::min(fraction, 1.0);
  const double rest = fraction > 0 ? elapsed / fraction - elapsed : 0;
  const std::string rate = formatCount(elapsed > 0 ? static_cast<double>(done) / elapsed : 0);
  if (style_ == Style::Plain) {
    std::fprintf(stderr, "%s: %3.0f%%, %s, %s left, %s samples/s\n", title_.c_str(), 100 * fraction,
                 formatDuration(elapsed).c_str(), formatDuration(rest).c_str(), rate.c_str());
    return;
  }
  std::string bar(kBarWidth, ' ');
  std::fill_n(bar.begin(), static_cast<std::ptrdiff_t>(fraction * kBarWidth), '=');
  std::fprintf(stderr, "\r%s [%s] %3.0f%%  %s, %s left, %s samples/s \033[K", title_.c_str(), bar.c_str(),
               100 * fraction, formatDuration(elapsed).c_str(), formatDuration(rest).c_str(), rate.c_str());
  std::fflush(stderr);
  shown_ = true;
}

void ProgressLine::finish(std::int64_t done, std::int64_t total) {
  if (style_ == Style::Silent) return;
  const double elapsed = std::chrono::duration<double>(Clock::now() - start_).count();
  if (shown_) std::fprintf(stderr, "\r\033[K");
  std::fprintf(stderr, "%s: %s of %s samples in %s\n", title_.c_str(),
               formatCount(static_cast<double>(done)).c_str(),
               formatCount(static_cast<double>(total)).c_str(), formatDuration(elapsed).c_str());
}

}  // namespace pbrtmedia
