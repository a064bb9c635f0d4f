// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// What strategies bring.
struct Contribution {
  Rgb unweighted;  ///< as if each were the only strategy
  Rgb weighted;    ///< by their shares among all that find the paths
  void add(Rgb value, double weight) {
    unweighted += value;
    weighted += value * static_cast<float>(weight);
  }
};

}  // namespace pbrtmedia
