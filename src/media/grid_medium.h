// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>
#include <string>

#include "base/transform.h"
#include "fields/constant_field.h"
#include "fields/grid_field.h"
#include "freeflight/any_sampler.h"
#include "media/medium.h"
#include "transmittance/any_estimator.h"

namespace pbrtmedia {

/// What every medium with a density field has: coefficients that its density scales, and its ways of
/// tracking.
struct FieldMediumParams {
  std::string name;
  Rgb sigmaA{.0011f, .0024f, .014f};  ///< absorption at density 1, 1/world length, >= 0
  Rgb sigmaS{2.55f, 3.21f, 3.77f};    ///< scattering at density 1, 1/world length, >= 0
  float g = 0;                        ///< Henyey-Greenstein, in (-1, 1)
  OverlapRule overlap;
  AnyEstimator estimator;
  AnySampler sampler;
};

/// A medium on a density grid: PBRT-v3's "heterogeneous". Equal sigma_t in R, G, B runs one channel, others
/// three. Throws SceneError (location unknown) for bad parameters. `superVoxelPower`: bounds over 2^power
/// samples per axis.
struct GridMediumParams : FieldMediumParams {
  GridField::Params grid;
  int superVoxelPower = GridField::kDefaultSuperVoxelPower;
};
std::unique_ptr<Medium> makeGridMedium(const GridMediumParams& params, const Transform& worldFromMedium);

/// A medium of one density inside a box.
struct ConstantMediumParams : FieldMediumParams {
  ConstantField::Params field;
};
std::unique_ptr<Medium> makeConstantMedium(const ConstantMediumParams& params,
                                           const Transform& worldFromMedium);

}  // namespace pbrtmedia
