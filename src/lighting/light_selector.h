// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "lighting/light_receiver.h"

namespace pbrtmedia {

class LightTrials;

/// Smallest weight of a light, as a fraction of the average weight: a light whose power is estimated as 0
/// (an infinite light around a scene that is a single point, a map with negative texels) is still found.
/// PBRT-v3's strategy "spatial" has the same number.
inline constexpr double kSmallestShare = 1e-3;

/// Picks one light of the scene's table for a point (scene-language reference 11.3). Immutable after
/// construction as far as results are concerned, thread-safe. Never asked when the scene has no lights.
class LightSelector {
 public:
  virtual ~LightSelector() = default;
  struct Choice {
    std::size_t light;  ///< index into Scene::illuminants()
    float probability;  ///< > 0
  };
  /// `u`: in [0, 1).
  virtual Choice choose(const LightReceiver& at, float u) const = 0;
  /// Probability that `choose(at, .)` picks the light.
  virtual float probability(const LightReceiver& at, std::size_t light) const = 0;
  /// Whether uniform infinite lights are left to the directions that paths scatter into also in media that
  /// absorb little, as a light sample would look twice at what dims them (LightReceiver::findsUniformLights).
  virtual bool leavesOutUniformLights() const { return false; }

  /// Whether light samples of exploratory paths would teach it something.
  virtual bool canLearn() const { return false; }
  /// Adds what a sample of a light that was chosen at the receiver has brought to the image (luminance).
  virtual void note(const LightReceiver& at, std::size_t light, double contribution,
                    LightTrials& trials) const {
    (void)at, (void)light, (void)contribution, (void)trials;
  }
  /// Takes what trials teach into force, as a pure function of them; not while others ask. Answers the whole
  /// of what was learned, from which `recall` has it again; false: the numbers are of another selector.
  virtual std::vector<double> learn(const LightTrials& trials) const {
    (void)trials;
    return {};
  }
  virtual bool recall(std::span<const double> learned) const {
    (void)learned;
    return false;
  }
};

}  // namespace pbrtmedia
