// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>

#include "tools/medialab/session.h"

namespace pbrtmedia {

struct DocsOptions {
  LabOptions lab;
  std::uint64_t trials = 20000;
};

/// The page docs/estimators.md: all that the lists say of estimators and laws, and measured tables.
std::string docsPage(const DocsOptions& options, const StopSignal& stop);

/// `medialab docs`.
int runDocs(const DocsOptions& options);

}  // namespace pbrtmedia
