// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <ostream>

namespace pbrtmedia {

/// The first half of docs/estimators.md: what the lists say of estimators, laws, free flights and
/// reciprocals.
void printLists(std::ostream& out);

}  // namespace pbrtmedia
