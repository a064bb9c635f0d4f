// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "materials/local_frame.h"

namespace pbrtmedia {

class FourierTable;

/// A measured or computed law of a layered surface, for radiance: FourierTable. The same rotated about the
/// normal.
struct FourierScattering {
  static constexpr BsdfFlags kFlags = BsdfFlags::Reflection | BsdfFlags::Transmission | BsdfFlags::Glossy;

  const FourierTable* table;  ///< borrowed

  Rgb f(Vector3f wo, Vector3f wi) const;
  float pdf(Vector3f wo, Vector3f wi) const;
  LobeSample sample(Vector3f wo, Point2f u) const;
};

}  // namespace pbrtmedia
