// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/progress_line.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cmath>
#include <iostream>
#include <sstream>
#include <utility>

namespace pbrtmedia {
namespace {

constexpr double kLiveInterval = 0.1, kPlainInterval = 5;  // seconds

}  // namespace

ProgressLine::ProgressLine(std::ostream& out, int columns, Clock clock)
    : out_(out), columns_(columns), clock_(std::move(clock)), last_(clock_()) {}

ProgressLine ProgressLine::onStandardError() {
  constexpr int kUsualColumns = 80;
  int columns = 0;
  if (::isatty(STDERR_FILENO) != 0) {
    winsize size{};
    columns = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : kUsualColumns;
  }
  return {std::cerr, columns};
}

void ProgressLine::update(const std::string& what, double share) {
  const auto now = clock_();
  const double since = std::chrono::duration<double>(now - last_).count();
  if (since < (columns_ > 0 ? kLiveInterval : kPlainInterval)) return;
  last_ = now;
  std::ostringstream text;
  text << "vdb2pbrt: " << what;
  if (share >= 0) text << ' ' << std::lround(100 * share) << '%';
  std::string line = text.str();
  if (columns_ == 0) {
    out_ << line << '\n' << std::flush;
    return;
  }
  // The last column stays free: some terminals would go to the next line.
  const auto room = static_cast<std::size_t>(columns_ - 1);
  if (line.size() > room) line.resize(room);
  out_ << '\r' << line << "\033[K" << std::flush;
  shown_ = true;
}

void ProgressLine::clear() {
  if (!shown_) return;
  out_ << "\r\033[K" << std::flush;
  shown_ = false;
}

}  // namespace pbrtmedia
