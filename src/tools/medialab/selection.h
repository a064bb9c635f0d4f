// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fields/canonical_function.h"
#include "tools/medialab/estimator.h"
#include "tools/medialab/table.h"
#include "transmittance/law.h"

// What the words of the lab's command line stand for. Everything throws std::runtime_error for unknown names
// and values that do not fit, telling the nearest names.

namespace pbrtmedia {

/// The estimators and the law that a command asks for.
struct EstimatorSelection {
  /// Names, names with parameters of their own ("ray-marching:stepsize=0.1"), or "all".
  std::vector<std::string> estimators{"all"};
  /// Whose estimators "all" stands for; named ones must be of it. Nothing: that of the named ones, and the
  /// transmittance for "all".
  std::optional<Quantity> quantity = {};
  std::string law = {};                  ///< empty: each estimator's own
  std::vector<std::string> params = {};  ///< "name=value" for the law and for every estimator chosen

  bool isAll() const;
  /// The estimators in order, labelled as they were written. One that cannot serve the law is an error if it
  /// was named, and told to `skipped` if it came with "all". A parameter must be known to the law or to each
  /// estimator named; with "all", to one at least. All are of one quantity.
  std::vector<LabEstimator> select(std::vector<LabTable::Skipped>& skipped) const;
};

/// Tells in a table what its estimators estimate, unless that is the transmittance.
void noteQuantity(LabTable& table, const std::vector<LabEstimator>& estimators);

/// With commas between them.
std::string joined(const std::vector<std::string_view>& words);

/// The densities that a command asks for.
struct FunctionSelection {
  /// Names of functions, "all" of them, tables (.csv, .txt: readTabulatedFunction) and volumes (.nvdb:
  /// functionAlong).
  std::vector<std::string> words;
  std::vector<double> ray;  ///< through volumes: o and d, six numbers
  std::string grid;         ///< of volumes

  std::vector<CanonicalFunction> select() const;
};

}  // namespace pbrtmedia
