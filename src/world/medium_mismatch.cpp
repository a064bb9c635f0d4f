// SPDX-License-Identifier: BSD-2-Clause
#include "world/medium_mismatch.h"

#include <sstream>

#include "world/primitive.h"

namespace pbrtmedia {

std::string MediumMismatch::toString() const {
  std::ostringstream out;
  out << "pixel " << pixel.x << ' ' << pixel.y << ", sample " << sample << ": a boundary ";
  if (boundary && boundary->location.file) out << '(' << boundary->location.toString() << ") ";
  out << "at " << p << " has " << named << " on the side of a ray that is in " << believed;
  return out.str();
}

}  // namespace pbrtmedia
