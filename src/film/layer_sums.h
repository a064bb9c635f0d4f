// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>

#include "film/layers.h"
#include "image/splat_sums.h"
#include "image/weighted_sums.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

// The sums that a pixel has for its layers (LayerSet::sumCount, in double), and how they become values. Sums
// of parts of the samples add up to those of all.

/// A sample under the filter: its numbers, radiance and weight. Totals are none of its business.
void addFiltered(const LayerSet& set, const float* sample, Rgb radiance, double weight, double* sums);
/// A sample that lies in the pixel: totals alone.
void addOwn(const LayerSet& set, const float* sample, double* sums);
/// The values of a pixel's channels. `colour`: its sums; `splatVariance`: of the mean of its splats, which is
/// added (a sample and the splats of its own path in its own pixel count as independent: off by about one
/// part in the number of pixels). Radiance is scaled as colours are, but stays negative where it is, so that
/// parts go on adding up to the whole.
///
/// The variance of the mean m = Σ w L / W of samples L of weights w, W = Σ w, is estimated by
/// Σ w² (L - m)² / W² over 1 - 2 Σ w³ / (W Σ w²) + Σ w² / W²: without bias where the L are independent and of
/// one distribution, whatever the weights; for equal weights it is the classical s² / n. Nothing is known of
/// fewer than two samples: 0. After Cochran 1977, Sampling Techniques, section 2.11, for the first factor.
void developLayers(const LayerSet& set, std::span<const double> sums, const WeightedSums& colour,
                   const SplatSum& splatVariance, const Development& development, float* out);

}  // namespace pbrtmedia
