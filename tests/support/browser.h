// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>

#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {

/// A browser without a window, where one is installed.
class Browser {
 public:
  static std::optional<std::string> program() {
    for (const char* name : {"chromium", "chromium-browser", "google-chrome"}) {
      if (run(std::string("command -v ") + name).status == 0) return name;
    }
    return std::nullopt;
  }
  explicit Browser(std::string program) : program_(std::move(program)) {}

  /// The document after its scripts ran for so many milliseconds of the page's own clock.
  std::string documentOf(const std::string& url, int milliseconds,
                         const std::string& size = "1280,800") const {
    return run("timeout -k 5 100 " + program_ +
               " --headless --no-sandbox --disable-gpu --disable-dev-shm-usage --no-first-run "
               "--user-data-dir='" +
               folder_.path().string() + "' --window-size=" + size + " --virtual-time-budget=" +
               std::to_string(milliseconds) + " --dump-dom '" + url + "' 2>/dev/null")
        .output;
  }

 private:
  std::string program_;
  TemporaryFolder folder_;
};

}  // namespace pbrtmedia::test
