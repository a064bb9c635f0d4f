// SPDX-License-Identifier: BSD-2-Clause
#include "materials/material.h"

#include "materials/bssrdf.h"

namespace pbrtmedia {

std::optional<Bssrdf> Material::bssrdf(const SurfaceInteraction&) const { return std::nullopt; }

}  // namespace pbrtmedia
