// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <variant>

#include "transmittance/estimators/adaptive_ratio_tracking.h"
#include "transmittance/estimators/bhanot_kennedy.h"
#include "transmittance/estimators/biased_ray_marching.h"
#include "transmittance/estimators/bidirectional_mis.h"
#include "transmittance/estimators/debiased_ray_marching.h"
#include "transmittance/estimators/johnson.h"
#include "transmittance/estimators/next_flight.h"
#include "transmittance/estimators/p_series_cmf.h"
#include "transmittance/estimators/p_series_cumulative.h"
#include "transmittance/estimators/p_series_next_flight.h"
#include "transmittance/estimators/p_series_ratio.h"
#include "transmittance/estimators/p_series_residual.h"
#include "transmittance/estimators/prefix_debiased_ray_marching.h"
#include "transmittance/estimators/random_medium.h"
#include "transmittance/estimators/ratio_tracking.h"
#include "transmittance/estimators/ray_marching.h"
#include "transmittance/estimators/regular_tracking.h"
#include "transmittance/estimators/residual_ratio_tracking.h"
#include "transmittance/estimators/residual_track_length.h"
#include "transmittance/estimators/telescoping_ray_marching.h"
#include "transmittance/estimators/track_length.h"
#include "transmittance/estimators/two_comb_umvu.h"
#include "transmittance/estimators/u_bk.h"
#include "transmittance/estimators/unbiased_ray_marching.h"
#include "transmittance/estimators/unidirectional_mis.h"

namespace pbrtmedia {

/// The one list of the estimators that serve the exponential law, alone or among others. A new one is its
/// header and one word here. The first is the default.
///
/// An estimator is a small immutable value: kName, traits(), parameters() (base/parameters.h), a
/// member `law` if it serves more laws than one, and
///   template <DensityLine Line, std::size_t N>
///   Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const;
/// which estimates g(integral of sigmaT[c] rho) for each channel and counts its look-ups. sigmaT: >= 0,
/// finite.
using AnyExponentialEstimator =
    std::variant<RatioTracking, RegularTracking, DebiasedRayMarching, PrefixDebiasedRayMarching,
                 BidirectionalMis, NextFlight, PSeriesCmf, PSeriesCumulative, PSeriesNextFlight,
                 UnidirectionalMis, UnbiasedRayMarching, TelescopingRayMarching, BiasedRayMarching,
                 RayMarching, BhanotKennedy, UBk, TwoCombUmvu, AdaptiveRatioTracking, Johnson, PSeriesRatio,
                 PSeriesResidual, RandomMedium, ResidualRatioTracking, ResidualTrackLength, TrackLength>;

}  // namespace pbrtmedia
