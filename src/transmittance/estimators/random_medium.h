// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "base/parameters.h"
#include "transmittance/parts/bound_profile.h"
#include "transmittance/parts/bounded_lookup.h"
#include "transmittance/parts/channel_products.h"
#include "transmittance/parts/explored_control.h"
#include "transmittance/parts/lookup_limit.h"
#include "transmittance/parts/poisson_walk.h"
#include "transmittance/sample_stream.h"
#include "transmittance/traits.h"

namespace pbrtmedia {

/// What becomes of a particle at a point that samples a difference of the medium, r = sigma_diff /
/// sigma_samp. Szirmay-Kalos et al. 2017, section 4.
enum class Particle {
  Double,          ///< goes on, weighted with 1 - r
  Terminating,     ///< goes on with q_t = |1 - r|, weighted with (1 - r) / q_t, as long as a r + |1 - r| <= 1
  NonTerminating,  ///< with q_t = |1 - r| / (a |r| + |1 - r|)
  Adaptive         ///< terminating, unless r < 1 or a r + |1 - r| > 1
};
template <>
inline constexpr std::array kChoices<Particle>{std::string_view("double"), std::string_view("terminating"),
                                               std::string_view("nonterminating"),
                                               std::string_view("adaptive")};

/// Random medium manipulation: a main part, piecewise linear through look-ups at fixed explorer points, is
/// integrated; the difference, of any sign, is sampled by the double particle model: at each point of a
/// Poisson process of rate sigma_samp the transmittance is scaled by 1 - sigma_diff / sigma_samp.
/// Szirmay-Kalos, Georgiev, Magdics, Molnár & Légrády 2017, sections 3.3 and 4.2, Eq. (5).
///
/// Deviations: the main part is kept within the bounds of each super-voxel, so with no explorers this is
/// residual ratio tracking, and where bounds leave nothing open it is exact. sigma_samp is not learned from
/// rays before but follows from this one: the largest error that leaving out an explorer would have made, not
/// above the largest difference B that the local bounds allow, nor below `rateFloor` times B. With the
/// default of one half, what explorers missed in an otherwise clear stretch stays stable in the paper's sense
/// (w <= 2 sigma_t): no second moment above 1. A `samplingextinction` given is used as it is, everywhere.
///
/// The single-particle models, which trace what else becomes of a particle, estimate transmittance by those
/// that went on; with several channels their probabilities follow the mean over channels.
///
/// Bias: none for any bounds that differ where the density is not theirs. Range: any sign, above 1 too.
/// Variance in one channel: T^2 expm1(integral of sigma_diff^2 / sigma_samp), Eqs. (16) and (17), for the
/// double particle; with other particles T^2 expm1(integral of w), w = sigma_diff (terminating, r <= 1),
/// sigma_diff (3 - 2 / r) (terminating, r >= 1), |sigma_diff| (|r| + a |1 - r|) (non-terminating). Cost: the
/// explorers and the integral of sigma_samp; a look-up less for each explorer on a stretch of known density.
struct RandomMedium {
  static constexpr std::string_view kName = "random-medium";

  std::uint32_t explorers = 10;   ///< see ExploredControl
  double samplingExtinction = 0;  ///< [1/length]; 0: automatic
  double rateFloor = 0.5;         ///< of the automatic one, in (0, 1], times the largest difference possible
  Particle particle = Particle::Double;
  double particleAlbedo = 0.7;   ///< a, of single particles
  std::uint64_t maxLookups = 0;  ///< see LookupLimit; explorers count

  static constexpr auto parameters() {
    return std::tuple{
        Parameter{"explorers", &RandomMedium::explorers,
                  "look-ups through which the main part is interpolated", 0,
                  static_cast<double>(ExploredControl::kMost)},
        Parameter{"samplingextinction", &RandomMedium::samplingExtinction,
                  "rate of the points that sample the difference to the main part, per unit of length; 0: "
                  "automatic, from the explorers and the bounds",
                  0, 1e9},
        Parameter{"ratefloor", &RandomMedium::rateFloor,
                  "least automatic rate, as a share of the largest difference that the bounds allow", 1e-3,
                  1},
        Parameter{"particle", &RandomMedium::particle,
                  "what becomes of a particle at such a point: it goes on with a weight (double), or with a "
                  "probability (single-particle models: terminating, nonterminating, adaptive)"},
        Parameter{"particlealbedo", &RandomMedium::particleAlbedo,
                  "of single particles, which scatter instead of going on", 0, 1},
        Parameter{"maxlookups", &RandomMedium::maxLookups, LookupLimit::kWalkHelp, 0}};
  }
  EstimatorTraits traits() const {
    return {.summary = "a main part through explorer points integrated, the signed difference tracked",
            .source = "Szirmay-Kalos et al. 2017 (5), (16), (17)",
            .useWhen = "the density varies smoothly but far from its bounds",
            .bias = LookupLimit::bias(maxLookups),
            .biasNote = LookupLimit::biasNote(maxLookups),
            .mayLeaveUnitInterval = true,
            .control = EstimatorTraits::Control::Any,
            .boundedCost = maxLookups > 0};
  }

  template <DensityLine Line, std::size_t N>
  Estimate<N> operator()(const Line& line, const Channels<N>& sigmaT, SampleStream& stream) const {
    Estimate<N> estimate;
    const double sigmaMax = maxOf(sigmaT);
    if (!(sigmaMax > 0)) return estimate;
    LookupTally& tally = estimate.tally;
    const BoundProfile profile(line);
    // Explorers first; none where there is nothing to explore.
    std::uint64_t count = profile.excess() > 0 ? explorers : 0;
    if (maxLookups > 0) count = std::min(count, maxLookups);
    const ExploredControl control(line, profile, count, tally);
    const double error = control.largestError();
    const LookupLimit limit(maxLookups);
    ChannelProducts<N> weight;
    double mainPart = 0;  // its integral
    PoissonWalk walk(stream);
    for (const BoundPiece& piece : profile.pieces()) {
      const double lower = piece.lower, upper = piece.upper;
      if (!(upper > lower)) {
        mainPart += lower * piece.length();
        probeTrusted(line, piece.sEnter, piece.sExit, upper, stream.rng(), tally);
        continue;
      }
      const bool goesOn = control.stretches(piece.sEnter, piece.sExit, [&](const auto& stretch) {
        mainPart += stretch.integral(lower, upper);
        if (tally.capped != 0) return true;
        const double enter = stretch.at(stretch.a, lower, upper), exit = stretch.at(stretch.b, lower, upper);
        const double largest = std::max(upper - std::min(enter, exit), std::max(enter, exit) - lower);
        const double rate = samplingExtinction > 0
                                ? samplingExtinction
                                : sigmaMax * std::clamp(error, rateFloor * largest, largest);
        walk.cross(stretch.a, stretch.b, rate, [&](double s) {
          if (limit.reached(tally)) return false;
          const double difference = boundedLookup(line, s, upper, tally) - stretch.at(s, lower, upper);
          ++tally.nullCollisions;
          Channels<N> factor;
          for (std::size_t c = 0; c < N; ++c) factor[c] = 1 - sigmaT[c] * difference / rate;
          weight.multiply(factor, particle == Particle::Double ? 1 : followed(weight, factor, stream));
          return !weight.isZero();
        });
        return !weight.isZero();
      });
      if (!goesOn) break;
    }
    for (std::size_t c = 0; c < N; ++c) {
      estimate.value[c] = weight[c].isZero() ? 0 : weight[c].timesExp(-sigmaT[c] * mainPart);
    }
    return estimate;
  }

 private:
  /// The factor of a single particle that goes on; 0 for one that does not.
  template <std::size_t N>
  double followed(const ChannelProducts<N>& weight, const Channels<N>& transmitted,
                  SampleStream& stream) const {
    double all = 0, scatter = 0, transmit = 0, ratio = 0;
    for (std::size_t c = 0; c < N; ++c) {
      const double size = weight[c].magnitude(), r = 1 - transmitted[c];
      all += size;
      scatter += size * particleAlbedo * std::abs(r);
      transmit += size * std::abs(transmitted[c]);
      ratio += size * r;
    }
    const double sum = scatter + transmit;
    const bool terminates = particle != Particle::NonTerminating && sum <= all &&
                            (particle == Particle::Terminating || ratio >= all);
    const double whole = terminates ? all : sum;
    return stream.uniform() * whole < transmit ? whole / transmit : 0;
  }
};

}  // namespace pbrtmedia
