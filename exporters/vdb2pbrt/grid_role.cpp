// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/grid_role.h"

#include <algorithm>
#include <array>
#include <vector>

namespace pbrtmedia {
namespace {

using namespace std::string_view_literals;

constexpr std::array kDensities = {"density"sv, "densities"sv, "dens"sv, "smoke"sv,
                                   "fog"sv,     "soot"sv,      "cloud"sv};
constexpr std::array kTemperatures = {"temperature"sv, "temperatures"sv, "temp"sv, "kelvin"sv, "celsius"sv};
constexpr std::array kIntensities = {
    "heat"sv,      "flame"sv,    "flames"sv, "fire"sv,          "fires"sv,     "fuel"sv,     "burn"sv,
    "burning"sv,   "burnrate"sv, "react"sv,  "reaction"sv,      "emit"sv,      "emission"sv, "emissive"sv,
    "explosion"sv, "ember"sv,    "embers"sv, "incandescence"sv, "combustion"sv};
/// Surfaces and distances are not among them: a level set says so itself, and how to make a density of it.
constexpr std::array kOthers = {
    "vel"sv,       "velocity"sv,    "vorticity"sv,  "curl"sv,     "speed"sv, "force"sv,    "divergence"sv,
    "pressure"sv,  "age"sv,         "lifetime"sv,   "life"sv,     "id"sv,    "mask"sv,     "rest"sv,
    "phi"sv,       "distance"sv,    "collision"sv,  "obstacle"sv, "solid"sv, "flags"sv,    "shadow"sv,
    "shadows"sv,   "color"sv,       "colour"sv,     "cd"sv,       "alpha"sv, "gradient"sv, "buoyancy"sv,
    "viscosity"sv, "disturbance"sv, "turbulence"sv, "uv"sv};

bool isLower(char c) { return c >= 'a' && c <= 'z'; }
bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }

/// Runs of letters in lower case, cut where a capital follows a small letter.
std::vector<std::string> wordsOf(std::string_view name) {
  std::vector<std::string> words;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const char c = name[i];
    if (!isLower(c) && !isUpper(c)) continue;
    const bool continues =
        i > 0 && (isLower(c) ? isLower(name[i - 1]) || isUpper(name[i - 1]) : isUpper(name[i - 1]));
    if (!continues || words.empty()) words.emplace_back();
    words.back() += isUpper(c) ? static_cast<char>(c - 'A' + 'a') : c;
  }
  return words;
}

/// "v.x", "Cd_g": a part of a vector that is stored as three grids.
bool isComponent(const std::vector<std::string>& words) {
  return words.size() == 2 && words[0].size() <= 2 && words[1].size() == 1 &&
         "xyzrgb"sv.find(words[1][0]) != std::string_view::npos;
}

bool hasAny(const std::vector<std::string>& words, const auto& list) {
  return std::any_of(words.begin(), words.end(), [&](const std::string& word) {
    return std::find(list.begin(), list.end(), word) != list.end();
  });
}

}  // namespace

GridRole roleOfGrid(std::string_view name) {
  const std::vector<std::string> words = wordsOf(name);
  if (hasAny(words, kTemperatures)) return GridRole::Temperature;
  if (hasAny(words, kDensities)) return GridRole::Density;
  if (hasAny(words, kIntensities)) return GridRole::Intensity;
  return hasAny(words, kOthers) || isComponent(words) ? GridRole::Other : GridRole::Density;
}

std::string nameOfRole(GridRole role) {
  switch (role) {
    case GridRole::Temperature:
      return "a temperature";
    case GridRole::Intensity:
      return "what burns";
    case GridRole::Other:
      return "no density";
    case GridRole::Density:
      break;
  }
  return "a density";
}

}  // namespace pbrtmedia
