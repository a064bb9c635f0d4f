// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

namespace pbrtmedia {

struct ListOptions {
  std::string what = "all";  ///< estimators, reciprocals, functions, laws, patterns or all
  bool json = false;
};

/// `medialab list`: what there is to choose from, read from the lists themselves.
int runList(const ListOptions& options);

}  // namespace pbrtmedia
