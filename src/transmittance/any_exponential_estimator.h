// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <variant>

#include "transmittance/adaptive_ratio_tracking.h"
#include "transmittance/bhanot_kennedy.h"
#include "transmittance/biased_ray_marching.h"
#include "transmittance/bidirectional_mis.h"
#include "transmittance/debiased_ray_marching.h"
#include "transmittance/johnson.h"
#include "transmittance/next_flight.h"
#include "transmittance/p_series_cmf.h"
#include "transmittance/p_series_cumulative.h"
#include "transmittance/p_series_next_flight.h"
#include "transmittance/p_series_ratio.h"
#include "transmittance/p_series_residual.h"
#include "transmittance/prefix_debiased_ray_marching.h"
#include "transmittance/random_medium.h"
#include "transmittance/ratio_tracking.h"
#include "transmittance/ray_marching.h"
#include "transmittance/regular_tracking.h"
#include "transmittance/residual_ratio_tracking.h"
#include "transmittance/residual_track_length.h"
#include "transmittance/track_length.h"
#include "transmittance/two_comb_umvu.h"
#include "transmittance/u_bk.h"
#include "transmittance/unbiased_ray_marching.h"
#include "transmittance/unidirectional_mis.h"

namespace pbrtmedia {

/// The one list of the estimators that serve the exponential law, alone or among others. A new one is its
/// header and one word here. The first is the default.
///
/// An estimator is a small immutable value: kName, traits(), parameters() (transmittance/parameters.h), a
/// member `law` if it serves more laws than one, and
///   template <DensityLine Line, std::size_t N>
///   Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const;
/// which estimates g(integral of sigmaT[c] rho) for each channel and counts its look-ups. sigmaT: >= 0,
/// finite.
using AnyExponentialEstimator =
    std::variant<RatioTracking, RegularTracking, DebiasedRayMarching, PrefixDebiasedRayMarching,
                 BidirectionalMis, NextFlight, PSeriesCmf, PSeriesCumulative, PSeriesNextFlight,
                 UnidirectionalMis, UnbiasedRayMarching, BiasedRayMarching, RayMarching, BhanotKennedy, UBk,
                 TwoCombUmvu, AdaptiveRatioTracking, Johnson, PSeriesRatio, PSeriesResidual, RandomMedium,
                 ResidualRatioTracking, ResidualTrackLength, TrackLength>;

}  // namespace pbrtmedia
