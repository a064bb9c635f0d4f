// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/conversion.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <sstream>
#include <stdexcept>

#include "base/files.h"
#include "fields/nano_vdb_file.h"
#include "vdb2pbrt/vdb_file.h"

namespace pbrtmedia {
namespace {

void writeText(const std::filesystem::path& path, const std::string& text, bool gz) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    const auto failed = [&] { return std::runtime_error("cannot write \"" + path.string() + '"'); };
    if (!gz) {
      std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
      out.write(text.data(), static_cast<std::streamsize>(text.size()));
      out.close();
      if (!out) throw failed();
      return;
    }
    std::unique_ptr<gzFile_s, int (*)(gzFile)> out(gzopen(temporary.c_str(), "wb6"), gzclose);
    if (!out || gzfwrite(text.data(), 1, text.size(), out.get()) != text.size()) throw failed();
    if (gzclose(out.release()) != Z_OK) throw failed();
  });
}

std::vector<std::size_t> chosenGrids(const VdbFile& file, const ConversionOptions& options) {
  std::vector<std::size_t> chosen;
  if (options.allGrids) {
    for (std::size_t i = 0; i < file.grids().size(); ++i) {
      if (file.grids()[i].isDensity) chosen.push_back(i);
    }
    if (chosen.empty())
      throw std::runtime_error("no grid is a density; the file holds:\n" + listGrids(file.grids()));
    return chosen;
  }
  if (options.grids.empty()) return {chooseGrid(file.grids(), "")};
  for (const std::string& wanted : options.grids) {
    const std::size_t found = chooseGrid(file.grids(), wanted);
    if (std::find(chosen.begin(), chosen.end(), found) == chosen.end()) chosen.push_back(found);
  }
  return chosen;
}

std::string shown(VoxelIndex v) {
  std::ostringstream text;
  text << '(' << v.x << ", " << v.y << ", " << v.z << ')';
  return text.str();
}

void check(VdbDensity& density, const ConversionOptions& options, const Notice& notice) {
  const std::string name = "grid \"" + density.name() + "\"";
  if (density.isLevelSet() && options.negative != NegativeRule::Keep) {
    throw std::runtime_error(
        name +
        " is a level set: it tells distances, not densities. Make a fog volume of it first, "
        "or keep its values with --negative keep");
  }
  const VdbDensity::Negatives negatives = density.checkValues(options.negative);
  if (negatives.count > 0) {
    std::ostringstream text;
    text << name << ": " << negatives.count << " voxels are negative, the first " << shown(negatives.first)
         << " with " << negatives.firstValue
         << (options.negative == NegativeRule::Clamp ? "; they are now 0"
                                                     : "; they are kept, and the renderer will refuse them");
    notice(text.str());
  }
  if (density.activeVoxels() == 0) notice(name + " has no active voxels: the medium is clear");
  if (density.background() != 0) {
    std::ostringstream text;
    text << name << " has the background " << density.background()
         << ": it counts as density in the box of the active voxels grown by one, and nowhere else";
    notice(text.str());
  }
}

}  // namespace

void convertVdb(const std::filesystem::path& input, const std::filesystem::path& output,
                const ConversionOptions& options, const Notice& notice) {
  const std::string extension = output.extension().string();
  if (extension == ".nvdb" || extension == ".vdb") {
    throw std::runtime_error("the output is a .pbrt include (the .nvdb file gets its name); found \"" +
                             output.string() + '"');
  }
  const VdbFile file(input);
  std::vector<VdbDensity> densities;
  try {
    for (const std::size_t index : chosenGrids(file, options)) densities.push_back(file.read(index));
  } catch (const std::runtime_error& e) {
    const std::string what = e.what();
    throw std::runtime_error(what.starts_with(input.string()) ? what : input.string() + ": " + what);
  }
  for (VdbDensity& density : densities) check(density, options, notice);

  const std::vector<std::string> media = mediumNames(densities, input.stem().string());
  const std::vector<std::string> selectors = gridSelectors(densities);
  std::vector<IncludeGrid> grids;
  for (std::size_t i = 0; i < densities.size(); ++i) {
    const bool named = densities.size() == 1 && !options.medium.empty();
    grids.push_back({&densities[i], named ? options.medium : media[i], selectors[i]});
  }
  if (options.dense != DenseForm::None) {
    const std::string text = denseInclude(grids, input.filename().string(), options.include);
    writeText(output, text, options.dense == DenseForm::Gz);
    return;
  }
  std::filesystem::path nvdb = output;
  nvdb.replace_extension(".nvdb");
  const std::string text =
      nvdbInclude(grids, nvdb.filename().string(), input.filename().string(), options.include);
  writeNvdb(nvdb, densities, options.nvdb);
  writeText(output, text, false);
}

namespace {

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
    text << "grid " << i << " \"" << grid.name << "\": " << grid.description << '\n';
    if (grid.isDensity) describeDensity(text, vdb.read(i));
  }
  return text.str();
}

}  // namespace pbrtmedia
