// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string_view>

namespace pbrtmedia {

/// What a way of sampling lights in media promises, for docs and contract tests. None has a bias.
struct MediumLightSamplingTraits {
  std::string_view summary;  ///< which points take light samples, in one sentence
  std::string_view source;   ///< papers with sections
  std::string_view useWhen;  ///< advice, in one sentence
  /// Stretches take samples, besides collisions or instead of them.
  bool onStretches = true;
  /// Samples of stretches lie close to lights, so that thin media around these have little noise.
  bool followsLights = true;
};

}  // namespace pbrtmedia
