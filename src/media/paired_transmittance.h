// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A transmittance that knows its own noise (PairedEstimate): the complex number value + i spread, of which
/// the mean is the transmittance T, that of the square T², and that of spread² the variance of the value.
/// Spread 0: exact, or nobody knows.
struct PairedTransmittance {
  Rgb value{1.0f}, spread;

  /// What lies behind one another. The halves of each segment are independent of those of all others.
  PairedTransmittance& operator*=(const PairedTransmittance& o) {
    const Rgb product = value * o.value - spread * o.spread;
    spread = value * o.spread + spread * o.value;
    value = product;
    return *this;
  }
  bool isBlack() const { return value.isBlack() && spread.isBlack(); }
};

}  // namespace pbrtmedia
