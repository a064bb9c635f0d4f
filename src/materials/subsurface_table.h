// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "spectrum/rgb.h"

namespace pbrtmedia {

/// Radial profiles of a half space that scatters, for a pencil of light straight into it, by photon beam
/// diffusion: Habel, Christensen & Jarosz 2013, "Photon Beam Diffusion: A Hybrid Monte Carlo Method for
/// Subsurface Scattering". Single and multiple scattering, for an extinction of 1, over albedo and distance;
/// splines in between. Diffusion gives back some percent more light than it gets where next to nothing is
/// absorbed; such profiles are scaled down to an albedo of 1. Immutable; takes some ten milliseconds to make.
class SubsurfaceTable {
 public:
  /// `g` in (-1, 1): mean cosine of scattering; `eta` > 0: relative index of the surface.
  SubsurfaceTable(float g, float eta);

  float eta() const { return eta_; }
  /// Sr at an optical distance, in units of the squared extinction; >= 0.
  float radial(float albedo, float opticalRadius) const;
  /// What comes out of what goes in, in [0, 1]: the effective albedo of a single-scattering albedo.
  float effectiveAlbedo(float albedo) const;
  /// The single-scattering albedo of an effective one; what no albedo reaches gives 1.
  float albedoOf(float effectiveAlbedo) const;
  /// An optical distance in proportion to 2π r Sr, and the density of that (per squared optical length).
  float sampleRadius(float albedo, float u) const;
  float pdfRadius(float albedo, float opticalRadius) const;

 private:
  std::span<const float> row(const std::vector<float>& of, std::size_t albedo) const;

  float eta_;
  std::vector<float> albedos_, radii_;
  std::vector<float> profile_;     ///< 2π r Sr, row by row of an albedo
  std::vector<float> cumulative_;  ///< its integral up to a radius
  std::vector<float> effective_;   ///< the whole integral
};

/// The table at one point of a surface. `extinction` [1/length], per channel, as `albedo`.
struct TabulatedProfile {
  const SubsurfaceTable* table;  ///< borrowed
  Rgb extinction, albedo;

  Rgb radial(float r) const;
  float sampleRadius(std::size_t channel, float u) const;
  float pdfRadius(std::size_t channel, float r) const;
};

}  // namespace pbrtmedia
