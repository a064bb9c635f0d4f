// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <array>
#include <filesystem>

#include "base/files.h"
#include "construct/emission.h"
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "construct/plugins.h"
#include "construct/raw_grid.h"
#include "media/grid_medium.h"

namespace pbrtmedia {
namespace {

std::string sizeText(const GridField::Params& grid) {
  std::string text = "nx*ny*nz = ";
  text += std::to_string(grid.nx);
  text += '*';
  text += std::to_string(grid.ny);
  text += '*';
  text += std::to_string(grid.nz);
  text += " = ";
  return text;
}

/// The density that stands in the scene. False after an error.
bool takeDensity(ParamReader& in, std::size_t expected, GridField::Params& grid) {
  const std::size_t found = in.floats("density").size();
  if (found != expected) {
    in.error(
        ParamKind::Float, "density",
        "found " + std::to_string(found) + " values, expected " + sizeText(grid) + std::to_string(expected));
    return false;
  }
  grid.density = in.takeFloats("density");
  for (std::size_t i = 0; i < expected; ++i) {
    if (grid.density[i] >= 0) continue;
    const std::size_t nx = static_cast<std::size_t>(grid.nx), ny = static_cast<std::size_t>(grid.ny);
    in.error(ParamKind::Float, "density",
             "voxel (" + std::to_string(i % nx) + ", " + std::to_string(i / nx % ny) + ", " +
                 std::to_string(i / (nx * ny)) + ") is negative: " + std::to_string(grid.density[i]));
    return false;
  }
  return true;
}

/// A raw file of the right size, not yet decoded.
struct RawFile {
  FileBytes bytes;
  RawFormat format;
};

/// Null after an error. Compares sizes before anything is unpacked that would not fit.
std::shared_ptr<const RawFile> openRaw(ParamReader& in, const std::filesystem::path& path,
                                       std::size_t expected, const GridField::Params& grid) {
  const auto format = static_cast<RawFormat>(in.findChoice("format", kRawFormats, 0));
  const std::size_t bytes = expected * bytesOf(format);
  const auto refuse = [&](std::size_t found) {
    std::string text = '"' + path.string() + "\" holds ";
    text += std::to_string(found);
    text += " bytes, expected ";
    text += std::to_string(bytes);
    text += ": ";
    text += std::to_string(bytesOf(format));
    text += " for each of " + sizeText(grid) + std::to_string(expected) + " numbers";
    in.error(ParamKind::String, "filename", text);
    return nullptr;
  };
  try {
    FileBytes file = FileBytes::open(path, bytes + 1);
    if (file.bytes().size() != bytes) return refuse(file.bytes().size());
    return std::make_shared<const RawFile>(RawFile{std::move(file), format});
  } catch (const SceneError& e) {
    in.diagnostics().add(e);
    return nullptr;
  }
}

}  // namespace

std::optional<MediumPlan> readHeterogeneousMedium(ParamReader& in, const MediumDescription& medium) {
  const std::optional<std::filesystem::path> path = in.findInputFile("filename");
  if (path && path->extension() == ".nvdb") return readNanoVdbMedium(in, medium);
  auto p = std::make_shared<GridMediumParams>();
  readFieldMediumParams(in, medium, DensityKind::InPieces, *p);
  GridField::Params& grid = p->grid;
  const Range size = Range::closed(1, 1 << 20);
  grid.nx = in.findInt("nx", 1, size);
  grid.ny = in.findInt("ny", 1, size);
  grid.nz = in.findInt("nz", 1, size);
  constexpr std::array<std::string_view, 2> kBorders = {"zero", "clamp"}, kPrecisions = {"float", "half"};
  constexpr std::array<std::string_view, 3> kLayouts = {"automatic", "linear", "bricked"};
  grid.border = static_cast<GridBorder>(in.findChoice("border", kBorders, 0));
  grid.precision = static_cast<GridPrecision>(in.findChoice("precision", kPrecisions, 0));
  grid.layout = static_cast<GridLayout>(in.findChoice("layout", kLayouts, 0));
  if (!readMediumBox(in, grid.p0, grid.p1)) return std::nullopt;
  const std::size_t expected = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) *
                               static_cast<std::size_t>(grid.nz);
  const EmissionPlan emission = readGridEmission(in, grid, *p);
  const bool isInline = in.has(ParamKind::Float, "density");
  if (in.has(ParamKind::String, "filename")) {
    if (isInline) in.error(ParamKind::String, "filename", "\"float density\" is given too: one of them");
    if (!path || isInline) return std::nullopt;
    std::shared_ptr<const RawFile> file = openRaw(in, *path, expected, grid);
    if (!file) return std::nullopt;
    return [p, file = std::move(file), emission, place = medium.ctm->start, context = in.context(),
            named = in.locationOf(ParamKind::String, "filename")](Textures&) mutable {
      if (emission) p->emissionPattern = emission(place);
      p->grid.density = decodeRaw(file->bytes, file->format);
      file.reset();
      return builtAt(named, context, [&] {
        auto made = makeGridMedium(*p, place);
        *p = {};
        return made;
      });
    };
  }
  if (!isInline) {
    in.error("parameter \"float density\" or \"string filename\" is missing");
    return std::nullopt;
  }
  if (!takeDensity(in, expected, grid)) return std::nullopt;
  return [p, emission, place = medium.ctm->start](Textures&) {
    if (emission) p->emissionPattern = emission(place);
    auto made = makeGridMedium(*p, place);
    *p = {};  // the input values are not needed any more
    return made;
  };
}

}  // namespace pbrtmedia
