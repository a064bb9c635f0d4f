// SPDX-License-Identifier: BSD-2-Clause
#include "tools/medialab/estimator.h"

#include <stdexcept>
#include <utility>

#include "base/diagnostics.h"

namespace pbrtmedia {

LabEstimator::LabEstimator(std::string_view name) : label_(name) {
  auto found = findEstimator(name);
  if (!found) {
    std::string text = "unknown estimator \"";
    text += name;
    text += '"';
    throw std::runtime_error(text + suggestion(name, estimatorNames()));
  }
  estimator_ = *std::move(found);
}

}  // namespace pbrtmedia
