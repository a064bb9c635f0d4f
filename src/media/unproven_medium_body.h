// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "fields/unproven_field.h"
#include "media/field_medium.h"

namespace pbrtmedia {

/// The body of every makeUnprovenMedium (media/unproven_medium.h).
template <class Field>
std::unique_ptr<Medium> unprovenMedium(const FieldMediumParams& params, std::string_view typeName,
                                       Field field) {
  const BoundsParams& b = params.bounds;
  const float sigmaT = (params.sigmaA + params.sigmaS).max();
  // A medium of sigma_t 0 is clear whatever the bounds are.
  const auto densityOf = [&](float extinction) { return sigmaT > 0 ? extinction / sigmaT : extinction; };
  const SuperVoxelLattice cells = field.lattice(b.cells);
  const auto made = [&](UnprovenField<Field> unproven) {
    return std::make_unique<FieldMedium<UnprovenField<Field>>>(params, typeName, std::move(unproven),
                                                               std::nullopt);
  };
  if (b.source == BoundsParams::Source::Constant) {
    const SuperVoxel bound{densityOf(b.majorant), 0, SuperVoxel::kUnknownMean};
    return made(UnprovenField<Field>(std::move(field), SuperVoxels(cells, bound)));
  }
  const LearnedBounds::Params learn{densityOf(b.initialExtinction), densityOf(b.epsilon), b.slack,
                                    b.warmUpPasses, b.warmUpLookups};
  return made(UnprovenField<Field>(std::move(field), cells, learn));
}

}  // namespace pbrtmedia
