// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/volume.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

#include "vdb2pbrt/vdb_file.h"

namespace pbrtmedia {
namespace {

void noticeChanged(const std::string& name, const VdbDensity::Finding& finding, const char* what,
                   const char* becomes, const Notice& notice) {
  if (finding.count == 0) return;
  std::ostringstream text;
  text << name << ": " << finding.count << (finding.count == 1 ? " voxel is " : " voxels are ") << what
       << ", the first (" << finding.first.x << ", " << finding.first.y << ", " << finding.first.z
       << ") with " << finding.firstValue << "; " << becomes;
  notice(text.str());
}

void check(VdbDensity& grid, bool isDensity, const ConversionOptions& options, const Notice& notice) {
  const std::string name = "grid \"" + grid.name() + "\"";
  if (isDensity && grid.isLevelSet() && options.levelSet == LevelSetRule::Fog) {
    grid.makeFog();
    notice(name + " was a level set; it is a fog volume now, 1 inside");
  } else if (isDensity && grid.isLevelSet() && options.negative != NegativeRule::Keep) {
    throw std::runtime_error(
        name +
        " is a level set: it tells distances, not densities; --level-set fog makes a fog "
        "volume of it, 1 inside and 0 outside");
  }
  const VdbDensity::Findings found = grid.checkValues(options.negative, options.nan);
  noticeChanged(name, found.notFinite, "no finite number", "they are now 0", notice);
  noticeChanged(name, found.negative, "negative",
                options.negative == NegativeRule::Clamp
                    ? "they are now 0"
                    : "they are kept, and the renderer will take them as 0",
                notice);
  if (grid.activeVoxels() == 0) {
    notice(name + " has no active voxels: " + (isDensity ? "the medium is clear" : "nothing glows"));
  }
  if (isDensity && grid.background() != 0) {
    std::ostringstream text;
    text << name << " has the background " << grid.background()
         << ": it counts as density in the box of the active voxels grown by one, and nowhere else";
    notice(text.str());
  }
}

}  // namespace

Bounds3d Volume::box() const {
  Bounds3d box;
  for (const VdbDensity& density : densities()) box.expand(density.worldBox());
  return box;
}

Volume readVolume(const std::filesystem::path& input, const ConversionOptions& options, const Notice& notice,
                  const Progress& progress) {
  const VdbFile file(input);
  Volume volume;
  volume.creator = file.creator();
  try {
    const GridSelection selection = selectGrids(file.grids(), options.grids);
    std::vector<std::size_t> wanted = selection.densities;
    volume.densityCount = wanted.size();
    const auto placeOf = [&](std::optional<std::size_t> grid) -> std::optional<std::size_t> {
      if (!grid) return std::nullopt;
      const auto found = std::find(wanted.begin(), wanted.end(), *grid);
      const auto place = static_cast<std::size_t>(found - wanted.begin());
      if (found == wanted.end()) wanted.push_back(*grid);
      return place;
    };
    volume.temperature = placeOf(selection.temperature);
    volume.factor = placeOf(selection.factor);
    noticeSelection(file.grids(), options.grids, selection, notice);
    for (const std::size_t index : wanted) {
      const std::string what = "reading \"" + file.grids()[index].name + '"';
      if (progress) progress(what, 0);
      volume.grids.push_back(file.read(
          index, progress ? [&](double share) { progress(what, share); } : std::function<void(double)>()));
    }
  } catch (const std::runtime_error& e) {
    const std::string what = e.what();
    throw std::runtime_error(what.starts_with(input.string()) ? what : input.string() + ": " + what);
  }
  try {
    for (std::size_t i = 0; i < volume.grids.size(); ++i) {
      if (progress) progress("checking \"" + volume.grids[i].name() + '"', -1);
      check(volume.grids[i], i < volume.densityCount, options, notice);
    }
  } catch (const std::runtime_error& e) {
    throw std::runtime_error(input.string() + ": " + e.what());
  }
  return volume;
}

}  // namespace pbrtmedia
