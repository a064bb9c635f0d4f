// SPDX-License-Identifier: BSD-2-Clause
#include <array>

#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "media/grid_medium.h"

namespace pbrtmedia {

std::optional<MediumPlan> readHeterogeneousMedium(ParamReader& in, const MediumDescription& medium) {
  auto p = std::make_shared<GridMediumParams>();
  readFieldMediumParams(in, medium, *p);
  const Range size = Range::closed(1, 1 << 20);
  p->grid.nx = in.findInt("nx", 1, size);
  p->grid.ny = in.findInt("ny", 1, size);
  p->grid.nz = in.findInt("nz", 1, size);
  p->grid.p0 = in.findPoint3("p0", p->grid.p0);
  p->grid.p1 = in.findPoint3("p1", p->grid.p1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p->grid.p0[axis] == p->grid.p1[axis]) {
      in.error(ParamKind::Point3, "p1", "the box is flat: p0 and p1 agree in " + std::string(1, "xyz"[axis]));
      return std::nullopt;
    }
  }
  constexpr std::array<std::string_view, 2> kBorders = {"zero", "clamp"};
  p->grid.border = in.findChoice("border", kBorders, 0) == 0 ? GridBorder::Zero : GridBorder::Clamp;
  if (!in.has(ParamKind::Float, "density")) {
    in.error("parameter \"float density\" is missing");
    return std::nullopt;
  }
  const std::size_t found = in.floats("density").size();
  const std::size_t expected = static_cast<std::size_t>(p->grid.nx) * static_cast<std::size_t>(p->grid.ny) *
                               static_cast<std::size_t>(p->grid.nz);
  if (found != expected) {
    in.error(ParamKind::Float, "density",
             "found " + std::to_string(found) + " values, expected nx*ny*nz = " + std::to_string(p->grid.nx) +
                 "*" + std::to_string(p->grid.ny) + "*" + std::to_string(p->grid.nz) + " = " +
                 std::to_string(expected));
    return std::nullopt;
  }
  p->grid.density = in.takeFloats("density");
  for (std::size_t i = 0; i < expected; ++i) {
    if (p->grid.density[i] >= 0) continue;
    const std::size_t nx = static_cast<std::size_t>(p->grid.nx), ny = static_cast<std::size_t>(p->grid.ny);
    in.error(ParamKind::Float, "density",
             "voxel (" + std::to_string(i % nx) + ", " + std::to_string(i / nx % ny) + ", " +
                 std::to_string(i / (nx * ny)) + ") is negative: " + std::to_string(p->grid.density[i]));
    return std::nullopt;
  }
  return [p, place = medium.ctm->start] {
    auto made = makeGridMedium(*p, place);
    *p = {};  // the input values are not needed any more
    return made;
  };
}

}  // namespace pbrtmedia
