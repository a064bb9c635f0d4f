// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/describe_volume.h"

#include <array>
#include <fstream>
#include <sstream>
#include <string_view>

#include "fields/nano_vdb_file.h"
#include "vdb2pbrt/grid_role.h"
#include "vdb2pbrt/vdb_file.h"

namespace pbrtmedia {
namespace {

std::string shown(VoxelIndex v) {
  std::ostringstream text;
  text << '(' << v.x << ", " << v.y << ", " << v.z << ')';
  return text.str();
}

std::string describeNanoVdb(const NanoVdbFile& file) {
  std::ostringstream text;
  text << "NanoVDB, " << file.grids().size() << " grids\n" << listGrids(file.candidates()) << '\n';
  for (std::size_t i = 0; i < file.grids().size(); ++i) {
    const NanoVdbGridInfo& g = file.grids()[i];
    text << "grid " << i << " \"" << g.name << "\": version " << g.version << ", codec " << g.codec << ", "
         << g.bytesInFile << " bytes in the file, voxel size " << g.voxelSize << '\n';
    if (g.activeVoxels > 0) text << "    world box " << g.world.min << " .. " << g.world.max << '\n';
  }
  return text.str();
}

void describeDensity(std::ostream& text, const VdbDensity& density) {
  const VdbDensity::Range range = density.range();
  text << "    values " << range.min << " .. " << range.max << ", background " << density.background() << ", "
       << density.activeVoxels() << " active voxels";
  if (density.activeVoxels() > 0)
    text << " in " << shown(density.activeMin()) << " .. " << shown(density.activeMax());
  text << '\n';
  for (std::size_t row = 0; row < 3; ++row) {
    text << (row == 0 ? "    world from index [" : "                     [");
    for (std::size_t column = 0; column < 4; ++column) {
      text << ' ' << density.worldFromIndex().matrix().m[row][column];
    }
    text << " ]\n";
  }
}

}  // namespace

std::string describeVolume(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 8> magic{};
  stream.read(magic.data(), magic.size());
  const std::string_view start(magic.data(), magic.size());
  if (start.starts_with("NanoVDB")) return describeNanoVdb(NanoVdbFile(file));
  const VdbFile vdb(file);
  std::ostringstream text;
  text << "OpenVDB " << vdb.version() << ", " << vdb.grids().size() << " grids\n";
  for (std::size_t i = 0; i < vdb.grids().size(); ++i) {
    const GridCandidate& grid = vdb.grids()[i];
    text << "grid " << i << " \"" << grid.name << "\": " << grid.description;
    if (grid.isDensity && roleOfGrid(grid.name) != GridRole::Density) {
      text << ", looks like " << nameOfRole(roleOfGrid(grid.name));
    }
    text << '\n';
    if (grid.isDensity) describeDensity(text, vdb.read(i));
  }
  return text.str();
}

}  // namespace pbrtmedia
