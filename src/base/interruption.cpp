// SPDX-License-Identifier: BSD-2-Clause
#include "base/interruption.h"

namespace pbrtmedia {

std::string Interrupted::reason() const {
  return cause_ == StopCause::Time ? "the time of --time was up" : "a signal asked for it";
}

namespace interruption {

void leave() { throw Interrupted(requested.load()); }

}  // namespace interruption
}  // namespace pbrtmedia
