// SPDX-License-Identifier: BSD-2-Clause
#include "media/medium_bounds.h"

namespace pbrtmedia {

FieldBounds unprovenBounds(const FieldMediumParams& params, const SuperVoxelLattice& cells) {
  const BoundsParams& b = params.bounds;
  const float sigmaT = (params.sigmaA + params.sigmaS).max();
  // A medium of sigma_t 0 is clear whatever the bounds are.
  const auto densityOf = [&](float extinction) { return sigmaT > 0 ? extinction / sigmaT : extinction; };
  if (b.source == BoundsParams::Source::Constant) {
    return FieldBounds::given(
        SuperVoxels(cells, SuperVoxel{densityOf(b.majorant), 0, SuperVoxel::kUnknownMean}));
  }
  return FieldBounds::learned(cells, {densityOf(b.initialExtinction), densityOf(b.epsilon), b.slack,
                                      b.warmUpPasses, b.warmUpLookups});
}

}  // namespace pbrtmedia
