// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <variant>

#include "materials/disney_profile.h"
#include "materials/subsurface_table.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// How light that a surface lets through comes out elsewhere on it: the radial part Sr of a separable BSSRDF
/// at one point (Christensen & Burley 2015; Habel, Christensen & Jarosz 2013). Lengths are world lengths. The
/// part of the entrance is in the lobe that light came in by, that of the exit is `SubsurfaceExit`.
class Bssrdf {
 public:
  using Profile = std::variant<TabulatedProfile, DisneyProfile>;
  /// `eta`: relative index of the surface.
  Bssrdf(const Profile& profile, float eta) : profile_(profile), eta_(eta) {}

  float eta() const { return eta_; }
  /// Sr at distance r, [1/area]: its integral over the plane is the albedo of the profile.
  Rgb radial(float r) const {
    return std::visit([&](const auto& p) { return p.radial(r); }, profile_);
  }
  /// A distance in proportion to 2π r Sr of the channel; negative: the channel does not scatter.
  float sampleRadius(std::size_t channel, float u) const {
    return std::visit([&](const auto& p) { return p.sampleRadius(channel, u); }, profile_);
  }
  /// Its density [1/area]: the integral of 2π r pdf is 1.
  float pdfRadius(std::size_t channel, float r) const {
    return std::visit([&](const auto& p) { return p.pdfRadius(channel, r); }, profile_);
  }
  /// Distance that a share of at most `kBeyondReach` of samples lies beyond.
  float reach(std::size_t channel) const {
    return std::visit([&](const auto& p) { return p.sampleRadius(channel, 1 - kBeyondReach); }, profile_);
  }
  static constexpr float kBeyondReach = 1e-3f;

 private:
  Profile profile_;
  float eta_;
};

}  // namespace pbrtmedia
