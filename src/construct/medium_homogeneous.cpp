// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "media/homogeneous.h"

namespace pbrtmedia {

std::optional<MediumPlan> readHomogeneousMedium(const MediumInput& input) {
  HomogeneousMedium::Params p;
  readMediumParams(input.in, input.medium, p);
  return [p](Textures&) { return std::make_unique<HomogeneousMedium>(p); };
}

}  // namespace pbrtmedia
