// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/grid_role.h"

#include <gtest/gtest.h>

#include "vdb2pbrt/grid_selection.h"

namespace pbrtmedia {
namespace {

TEST(GridRole, KnowsTheWordsOfExporters) {
  const std::vector<std::pair<GridRole, std::vector<const char*>>> table = {
      {GridRole::Density,
       {"density", "Density", "density_noise", "smokeDensity", "densityFuel", "smoke", "", "t", "cloud_01",
        "v", "grid", "x", "tempest", "surface", "sdf"}},
      {GridRole::Temperature,
       {"temperature", "Temperature", "temperature_noise", "temp", "Temp2", "TEMPERATURE",
        "fireTemperature"}},
      {GridRole::Intensity,
       {"heat", "flame", "flames", "Flames", "flame_noise", "fuel", "fuelNoise", "fire", "burn", "emission",
        "emission.r", "react"}},
      {GridRole::Other,
       {"vel.x", "vel_y", "velocityZ", "v.x", "Cd.g", "color_r", "pressure", "divergence", "phi", "phiObs",
        "collision", "flags", "shadow", "age", "mask"}}};
  for (const auto& [role, names] : table) {
    for (const char* name : names)
      EXPECT_EQ(roleOfGrid(name), role) << name << " is " << nameOfRole(roleOfGrid(name));
  }
}

GridCandidate floats(const char* name) { return {name, "float, fog volume, 8 active voxels", true}; }
GridCandidate vectors(const char* name) { return {name, "vec3s, staggered, 8 active voxels", false}; }

/// Selection and notices as one text.
std::string told(const std::vector<GridCandidate>& grids, const GridWishes& wishes) {
  std::string text;
  try {
    const GridSelection chosen = selectGrids(grids, wishes);
    for (const std::size_t i : chosen.densities) text += grids[i].name + "|";
    if (chosen.temperature) text += "T:" + grids[*chosen.temperature].name + "|";
    if (chosen.factor) text += "F:" + grids[*chosen.factor].name + "|";
    noticeSelection(grids, wishes, chosen, [&](const std::string& line) { text += "\n" + line; });
  } catch (const std::exception& e) {
    text = std::string("error: ") + e.what();
  }
  return text;
}

void expectTold(const std::string& text, const std::vector<const char*>& parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
}

TEST(GridSelection, TellsEveryGridThatIsLeftOut) {
  const std::vector<GridCandidate> pyro = {floats("temperature"),
                                           floats("density"),
                                           floats("heat"),
                                           vectors("vel"),
                                           {"mask", "bool, unknown class", false}};
  expectTold(
      told(pyro, {}),
      {"density|\n", "grid \"temperature\"; it looks like a temperature: --temperature \"temperature\"",
       "grid \"heat\"; it looks like what burns: --Legrid \"heat\"", "\"vel\" (vec3s), \"mask\" (bool)"});
  EXPECT_EQ(told(pyro, {.temperature = "temperature", .factor = "heat"}),
            "density|T:temperature|F:heat|\nleft out, vectors, masks and the like: \"vel\" (vec3s), \"mask\" "
            "(bool)");
  expectTold(told(pyro, {.allDensities = true}),
             {"density|\n", "taken for densities: \"density\"", "--temperature"});
  expectTold(told({floats("density"), floats("steam"), floats("pressure")}, {}),
             {"grid \"steam\"; --grid \"steam\" takes it for a density",
              "grid \"pressure\"; it looks like no density"});
  EXPECT_EQ(told({floats("density")}, {}), "density|");
}

TEST(GridSelection, TemperaturesAndFlamesAreNoDensitiesUnlessNamed) {
  EXPECT_EQ(told({floats("heat"), floats("smoke")}, {}).substr(0, 6), "smoke|");
  EXPECT_EQ(told({floats("a"), floats("b"), floats("fuel")}, {.allDensities = true}).substr(0, 4), "a|b|");
  expectTold(told({floats("temperature")}, {}), {"error: ", "(\"temperature\": a temperature)", "--grid"});
  expectTold(told({floats("flames")}, {.allDensities = true}), {"error: no grid is a density by its name"});
  expectTold(told({floats("flames")}, {.densities = {"flames"}}),
             {"flames|", "taken for a density, as you say"});
  expectTold(told({vectors("vel")}, {}), {"error: no grid is a density (float or double)"});
  expectTold(told({floats("a"), floats("b")}, {}), {"error: several grids could be the density"});
}

TEST(GridSelection, WrongWishesAreRefusedWithAList) {
  const std::vector<GridCandidate> grids = {floats("density"), vectors("vel"), floats("temperature")};
  expectTold(told(grids, {.temperature = "vel"}),
             {"error: --temperature: grid \"vel\" holds vec3s", "2: \"temperature\""});
  expectTold(told(grids, {.factor = "heat"}), {"error: no grid is called \"heat\"", "0: \"density\""});
  EXPECT_EQ(told(grids, {.temperature = "temp"}).substr(0, 22), "density|T:temperature|");
}

}  // namespace
}  // namespace pbrtmedia
