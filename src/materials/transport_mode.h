// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>

namespace pbrtmedia {

/// What a path carries away from a surface along wo, toward where it came from. `Radiance`: paths from the
/// camera; `Importance`: paths from lights (photons, light subpaths). The law of the one is the adjoint of
/// the other's: Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", chapter 5.
enum class TransportMode : std::uint8_t { Radiance, Importance };

}  // namespace pbrtmedia
