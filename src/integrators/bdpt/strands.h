// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "world/scene.h"

namespace pbrtmedia {

/// Whether a surface is that of curves (BdptSetup::hasStrands).
bool isStrand(const Primitive& primitive);
bool hasStrands(const Scene& scene);

}  // namespace pbrtmedia
