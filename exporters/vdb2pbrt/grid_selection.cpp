// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/grid_selection.h"

#include <algorithm>
#include <stdexcept>

#include "vdb2pbrt/grid_role.h"

namespace pbrtmedia {
namespace {

/// The same grids, of which those with another name than a density's are none.
std::vector<GridCandidate> byRole(std::span<const GridCandidate> grids) {
  std::vector<GridCandidate> result(grids.begin(), grids.end());
  for (GridCandidate& grid : result) {
    grid.isDensity = grid.isDensity && roleOfGrid(grid.name) == GridRole::Density;
  }
  return result;
}

bool anyDensity(const std::vector<GridCandidate>& grids) {
  return std::any_of(grids.begin(), grids.end(), [](const GridCandidate& g) { return g.isDensity; });
}

std::vector<std::size_t> selectDensities(std::span<const GridCandidate> grids, const GridWishes& wishes) {
  std::vector<std::size_t> chosen;
  for (const std::string& wanted : wishes.allDensities ? std::vector<std::string>{} : wishes.densities) {
    const std::size_t found = chooseGrid(grids, wanted);
    if (std::find(chosen.begin(), chosen.end(), found) == chosen.end()) chosen.push_back(found);
  }
  if (!chosen.empty()) return chosen;
  const std::vector<GridCandidate> named = byRole(grids);
  if (!anyDensity(named)) {
    const auto real =
        std::find_if(grids.begin(), grids.end(), [](const GridCandidate& g) { return g.isDensity; });
    throw std::runtime_error(
        real == grids.end() ? "no grid is a density (float or double); the file holds:\n" + listGrids(grids)
                            : "no grid is a density by its name (\"" + real->name +
                                  "\": " + nameOfRole(roleOfGrid(real->name)) +
                                  "); --grid takes one for a density whatever its name. The file holds:\n" +
                                  listGrids(grids));
  }
  if (!wishes.allDensities) return {chooseGrid(named, "")};
  for (std::size_t i = 0; i < named.size(); ++i) {
    if (named[i].isDensity) chosen.push_back(i);
  }
  return chosen;
}

std::optional<std::size_t> selectOther(std::span<const GridCandidate> grids, const std::string& wanted,
                                       const char* option) {
  if (wanted.empty()) return std::nullopt;
  const std::size_t found = chooseGrid(grids, wanted);
  if (!grids[found].isDensity) {
    throw std::runtime_error(std::string(option) + ": grid \"" + grids[found].name + "\" holds " +
                             grids[found].description + ", expected float or double. The file holds:\n" +
                             listGrids(grids));
  }
  return found;
}

void append(std::string& list, const std::string& text) {
  if (!list.empty()) list += ", ";
  list += text;
}

std::string quotedName(const GridCandidate& grid) { return '"' + grid.name + '"'; }

std::string adviceFor(const GridCandidate& grid, bool glows) {
  switch (roleOfGrid(grid.name)) {
    case GridRole::Temperature:
      return "; it looks like a temperature" +
             (glows ? std::string() : ": --temperature " + quotedName(grid) + " makes the medium glow by it");
    case GridRole::Intensity:
      return "; it looks like what burns: --Legrid " + quotedName(grid) + " makes the medium glow by it";
    case GridRole::Other:
      return "; it looks like no density";
    case GridRole::Density:
      break;
  }
  return "; --grid " + quotedName(grid) + " takes it for a density";
}

}  // namespace

GridSelection selectGrids(std::span<const GridCandidate> grids, const GridWishes& wishes) {
  GridSelection selection;
  selection.densities = selectDensities(grids, wishes);
  selection.temperature = selectOther(grids, wishes.temperature, "--temperature");
  selection.factor = selectOther(grids, wishes.factor, "--Legrid");
  return selection;
}

void noticeSelection(std::span<const GridCandidate> grids, const GridWishes& wishes,
                     const GridSelection& selection, const Notice& notice) {
  if (wishes.allDensities) {
    std::string taken;
    for (const std::size_t i : selection.densities) append(taken, quotedName(grids[i]));
    notice("taken for densities: " + taken);
  }
  for (const std::size_t i : selection.densities) {
    if (!grids[i].isDensity || roleOfGrid(grids[i].name) == GridRole::Density) continue;
    notice("grid " + quotedName(grids[i]) + " is taken for a density, as you say; by its name it is " +
           nameOfRole(roleOfGrid(grids[i].name)));
  }
  std::string others;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const bool used =
        std::find(selection.densities.begin(), selection.densities.end(), i) != selection.densities.end() ||
        selection.temperature == i || selection.factor == i;
    if (used) continue;
    if (grids[i].isDensity) {
      notice("left out: grid " + quotedName(grids[i]) +
             adviceFor(grids[i], selection.temperature.has_value()));
    } else {
      append(others, quotedName(grids[i]) + " (" +
                         grids[i].description.substr(0, grids[i].description.find(',')) + ")");
    }
  }
  if (!others.empty()) notice("left out, vectors, masks and the like: " + others);
}

}  // namespace pbrtmedia
