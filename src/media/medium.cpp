// SPDX-License-Identifier: BSD-2-Clause
#include "media/medium.h"

#include "media/emission/emission_volume.h"

namespace pbrtmedia {

Medium::~Medium() = default;

std::unique_ptr<const EmissionVolume> Medium::emissionVolume(const Bounds3f&) const { return nullptr; }

}  // namespace pbrtmedia
