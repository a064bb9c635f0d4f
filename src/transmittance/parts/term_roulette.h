// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "transmittance/sample_stream.h"

namespace pbrtmedia {

/// The roulette that ends a series by the size of its terms: it goes on with probability min(size, 1), where
/// `size` >= 0 is that of the term just made. Georgiev et al. 2019, Eq. (30). Answers what the term, and so
/// all that follow, are multiplied by, at least 1; 0 where the series ends before this term. Takes one
/// dimension also where the outcome is certain, so that dimensions keep their meaning.
inline double survivalFactor(double size, SampleStream& stream) {
  if (!(stream.uniformAboveZero() <= size)) return 0;
  return size < 1 ? 1 / size : 1;
}

}  // namespace pbrtmedia
