// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/bounds.h"
#include "base/distribution.h"
#include "lighting/learned_shares.h"
#include "lighting/light_selector.h"
#include "lighting/light_tree.h"
#include "lights/illuminant.h"

namespace pbrtmedia {

/// Picks lights by what they would send to the point, were nothing in the way: 1/r², where they shine, and
/// what the receiver scatters of light from there. Lights are in clusters: up to some each is one of its own;
/// of more, those at finite places are in parts of a LightTree, so that a choice costs the logarithm of their
/// number, and those far away are chosen by their power. One choice in kDefensiveShare of all goes by power
/// alone, so that no weight is much above that of the strategy `power`.
///
/// What stands in the way, and what scattered rays find in place of light samples, is not known but may be
/// learned: factors on what clusters are taken to send (LearnedShares).
///
/// Lights that the receiver finds by directions alone (LightReceiver::findsUniformLights) are left out,
/// unless there are no others.
class LightTreeSelector final : public LightSelector {
 public:
  /// The part of choices by power.
  static constexpr double kDefensiveShare = 0.1;

  /// `sceneBounds`: of the surfaces; tells how strong lights are that shine from infinitely far, whose powers
  /// are known. `lights`: at least one, borrowed.
  /// `learns`: exploratory paths are of use.
  LightTreeSelector(std::span<const Illuminant* const> lights, const Bounds3f& sceneBounds,
                    bool learns = false);

  Choice choose(const LightReceiver& at, float u) const override;
  float probability(const LightReceiver& at, std::size_t light) const override;
  bool leavesOutUniformLights() const override { return true; }
  bool canLearn() const override { return learns_ && clusters_.size() > 1; }
  void note(const LightReceiver& at, std::size_t light, double contribution,
            LightTrials& trials) const override;
  std::vector<double> learn(const LightTrials& trials) const override;
  bool recall(std::span<const double> learned) const override;
  const LearnedShares& learned() const { return learned_; }

 private:
  /// Far lights that are clusters of their own, and parts of the tree.
  static constexpr std::size_t kMostFar = 7, kMostParts = 16;
  static constexpr std::size_t kMostClusters = kMostFar + 1 + kMostParts;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct Cluster {
    std::uint32_t light = kNone;  ///< the only one, if it shines from afar
    std::uint32_t node = kNone;   ///< of the tree; neither: the rest of the far lights
    double irradiance = 0;        ///< of far lights, W/m²
    double share = 0;             ///< of the power of all
    Vector3f toLight{};           ///< unit, where all light comes from one direction; else 0
    bool isUniform = false;       ///< Illuminant::isUniformInfinite
  };
  struct Weights {
    std::array<double, kMostClusters> of;  ///< clusters; sum to 1
  };
  /// Importances times factors, whose sum is answered; 0 for what is left out.
  double importancesAt(const LightReceiver& at, std::span<const double> factors, Weights& weights) const;
  bool leavesOut(const Cluster& c, const LightReceiver& at) const {
    return c.isUniform && at.findsUniformLights && hasOthers_;
  }
  Weights weightsAt(const LightReceiver& at) const;
  double importanceOf(const Cluster& cluster, const LightReceiver& at) const;
  void addFarLights(std::span<const Illuminant* const> lights, std::span<const double> powers,
                    std::vector<std::uint32_t> far, double area);
  void addTree(std::span<const Illuminant* const> lights, std::span<const double> powers,
               std::span<const std::uint32_t> near);

  std::vector<Cluster> clusters_;
  std::vector<std::uint32_t> clusterOf_;  ///< of each light
  std::vector<std::uint32_t> slotOf_;     ///< of each light among those of the tree, or the rest of the far
  LightTree tree_;
  std::vector<std::uint32_t> nearLights_, restLights_;
  Distribution1D rest_;     ///< by power
  bool hasOthers_ = false;  ///< than uniform infinite lights
  bool learns_;
  mutable LearnedShares learned_;  ///< changes between passes alone
};

}  // namespace pbrtmedia
