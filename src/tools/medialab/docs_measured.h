// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <ostream>

#include "tools/medialab/docs.h"
#include "tools/medialab/table.h"

namespace pbrtmedia {

/// What docs/estimators.md measures: all estimators, those of reciprocals, and ours against the best before
/// it.
struct DocsTables {
  LabTable estimators, reciprocals, duels;
};

/// Unfinished where `stop` is set.
DocsTables measureDocs(const DocsOptions& options, const StopSignal& stop);
/// The second half of the page: variance times cost.
void printTables(std::ostream& out, const DocsTables& tables, const DocsOptions& options);

}  // namespace pbrtmedia
