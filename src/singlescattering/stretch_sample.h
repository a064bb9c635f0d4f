// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Where a stretch takes a light sample.
struct StretchSample {
  /// What a walk along the stretch knows already.
  struct Walked {
    Rgb through;                ///< unbiased estimate of the transmittance from the stretch's start to `t`
    double weight;              ///< what the sample counts: its share divided by its density
    std::optional<Rgb> sigmaS;  ///< scattering coefficient at `t` of the only medium there
  };

  std::size_t light;  ///< of the table of lights
  double t;           ///< on the ray
  double pdf;         ///< of this light and this distance together, per length; > 0
  std::optional<Walked> walked = std::nullopt;
};

}  // namespace pbrtmedia
