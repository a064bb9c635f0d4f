// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A scattering law that is the same rotated about the normal: Fourier series in the azimuth over a grid of
/// cosines, splines in between (Jakob, d'Eon, Jakob & Marschner 2014, "A Comprehensive Framework for
/// Rendering Layered Materials"; `.bsdf` files, scene-language reference 15.2). Cosines are those of the
/// direction in which light flies, muI, and of wo, muO; phi is the angle between the two. Immutable.
class FourierTable {
 public:
  /// Any bytes; throws SceneError at `shownName` for what is no such table.
  static FourierTable parse(std::string_view bytes, const std::string& shownName);

  float eta() const { return eta_; }  ///< index behind the normal over that before it

  /// The series between the entries at two cosines.
  class Blend;

 private:
  struct Entry {
    std::uint32_t offset, length;  ///< of the first channel in coefficients_; per channel
  };
  void integrate();
  const Entry& entry(std::size_t o, std::size_t i) const { return entries_[o * mu_.size() + i]; }
  float mean(std::size_t o, std::size_t i) const {
    const Entry& e = entry(o, i);
    return e.length > 0 ? coefficients_[e.offset] : 0;
  }

  float eta_ = 1;
  std::size_t channels_ = 1;
  std::vector<float> mu_;  ///< increasing, in [-1, 1]
  std::vector<Entry> entries_;
  std::vector<float> coefficients_;
  std::vector<float> cumulative_;  ///< of mean(o, ·) over muI
};

class FourierTable::Blend {
 public:
  /// Black where the grid does not reach.
  Blend(const FourierTable& table, float muI, float muO);
  /// f |muI|, >= 0.
  Rgb value(float cosPhi) const;
  /// Its luminance, not clamped at 0.
  float luminance(float cosPhi) const { return channel(0, cosPhi); }
  /// An azimuth in [0, 2π) in proportion to the luminance.
  float samplePhi(float u) const;

  /// Integral of the luminance over all directions of light with this muO.
  static float whole(const FourierTable& table, float muO);
  /// A muI in proportion to the luminance over all azimuths. Only where `whole` is positive.
  static float sampleMu(const FourierTable& table, float muO, float u);

 private:
  struct Part {
    Entry entry;
    float weight;
  };
  float channel(std::size_t c, float cosPhi) const;

  const FourierTable& table_;
  std::array<Part, 16> parts_;
  std::size_t count_ = 0;
  std::uint32_t longest_ = 0;
};

}  // namespace pbrtmedia
