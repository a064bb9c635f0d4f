// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>

namespace pbrtmedia {

/// What the numbers of a float grid are, as far as its name tells.
enum class GridRole {
  Density,      ///< also every name that tells nothing
  Temperature,  ///< kelvin, or a number that stands for them
  Intensity,    ///< how much burns there: heat, flames, fuel
  Other         ///< numbers of a simulation that are neither: pressure, distances, components of vectors
};

/// By the words that Houdini, Blender, EmberGen and their like give to grids, in any case and with any
/// numbers and joints around them: "temperature", "Temp_2", "flames", "fuelNoise", "vel.x".
GridRole roleOfGrid(std::string_view name);

/// "a temperature", and so on.
std::string nameOfRole(GridRole role);

}  // namespace pbrtmedia
