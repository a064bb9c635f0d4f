// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <array>
#include <filesystem>

#include "base/files.h"
#include "construct/emission.h"
#include "construct/enum_parameter.h"
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "construct/plugins.h"
#include "construct/raw_grid.h"
#include "construct/tolerance.h"
#include "construct/volume_file.h"
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

/// The density that stands in the scene. False if it does not fit, which PBRT-v3 takes as vacuum.
bool takeDensity(ParamReader& in, std::size_t expected, GridField::Params& grid) {
  const std::size_t found = in.floats("density").size();
  if (found != expected) {
    tolerate(in, ParamKind::Float, "density",
             "found " + std::to_string(found) + " values, expected " + sizeText(grid) +
                 std::to_string(expected) + "; the medium is vacuum, as in PBRT-v3");
    return false;
  }
  grid.density = in.takeFloats("density");
  const SourceLocation at = in.locationOf(ParamKind::Float, "density");
  clampNegatives(grid.density, grid.nx, grid.ny, "parameter \"density\"", at, in.context(), in.diagnostics());
  return true;
}

/// A raw file of the right size, not yet decoded.
struct RawFile {
  FileBytes bytes;
  RawFormat format;
};

/// Null after an error. Compares sizes before anything is unpacked that would not fit.
std::shared_ptr<const RawFile> openRaw(ParamReader& in, const std::filesystem::path& path, RawFormat format,
                                       std::size_t expected, const GridField::Params& grid) {
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

/// Everything of the grid but its numbers. False where there is no grid, which is told.
bool readGrid(const MediumInput& input, FieldMediumParams& medium, GridField::Params& grid) {
  ParamReader& in = input.in;
  readFieldMediumParams(in, input.medium, DensityKind::InPieces, medium);
  const std::size_t errorsBefore = in.diagnostics().errorCount();
  const Range size{.max = 1 << 20};
  grid.nx = in.findInt("nx", 1, size);
  grid.ny = in.findInt("ny", 1, size);
  grid.nz = in.findInt("nz", 1, size);
  constexpr std::array<std::string_view, 2> kBorders = {"zero", "clamp"}, kPrecisions = {"float", "half"};
  constexpr std::array<std::string_view, 3> kLayouts = {"automatic", "linear", "bricked"};
  grid.border = findOwnEnum(in, "border", kBorders, GridBorder::Zero);
  grid.precision = findOwnEnum(in, "precision", kPrecisions, GridPrecision::Float);
  grid.layout = findOwnEnum(in, "layout", kLayouts, GridLayout::Automatic);
  const bool hasRoom = readMediumBox(in, grid.p0, grid.p1);
  if (std::min({grid.nx, grid.ny, grid.nz}) < 1) {
    tolerate(in, "found a grid of " + std::to_string(grid.nx) + " x " + std::to_string(grid.ny) + " x " +
                     std::to_string(grid.nz) +
                     " samples (nx, ny, nz), expected at least 1 each; the medium is "
                     "vacuum, as in PBRT-v3");
    return false;
  }
  return hasRoom && in.diagnostics().errorCount() == errorsBefore;
}

/// The medium whose numbers stand in a file; they are decoded when it is built.
MediumPlan planOfFile(const MediumInput& input, std::shared_ptr<GridMediumParams> p,
                      const EmissionPlan& emission, std::shared_ptr<const RawFile> file) {
  return [p = std::move(p), file = std::move(file), emission, place = input.medium.ctm->start,
          context = input.in.context(), named = input.in.locationOf(ParamKind::String, "filename"),
          &building = input.building](Textures&) mutable {
    if (emission) p->emissionPattern = emission(place);
    GridField::Params& read = p->grid;
    read.density = decodeRaw(file->bytes, file->format);
    file.reset();
    clampNegatives(read.density, read.nx, read.ny, "the file", named, context, building);
    return builtAt(named, context, [&] {
      auto made = makeGridMedium(*p, place);
      *p = {};
      return made;
    });
  };
}

}  // namespace

std::optional<MediumPlan> readHeterogeneousMedium(const MediumInput& input) {
  ParamReader& in = input.in;
  const bool hasFile = !in.findString("filename", "").empty();
  std::optional<std::filesystem::path> path;
  if (hasFile) path = requireVolumeFile(in);
  if (path && (path->extension() == ".nvdb" || volumeFileOf(*path) == VolumeFile::NanoVdb)) {
    return readNanoVdbMedium(input);
  }
  auto p = std::make_shared<GridMediumParams>();
  GridField::Params& grid = p->grid;
  const bool isInline = in.has(ParamKind::Float, "density");
  if (!readGrid(input, *p, grid)) return std::nullopt;
  const std::size_t expected = static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny) *
                               static_cast<std::size_t>(grid.nz);
  const EmissionPlan emission = readGridEmission(input, grid, *p);
  if (hasFile) {
    if (isInline) in.error(ParamKind::String, "filename", "\"float density\" is given too: one of them");
    if (!path || isInline) return std::nullopt;
    const auto format = findOwnEnum(in, "format", kRawFormats, RawFormat::Float);
    if (!input.isUsed) return std::nullopt;  // it is there; more is not asked of what nobody sees
    std::shared_ptr<const RawFile> file = openRaw(in, *path, format, expected, grid);
    if (!file) return std::nullopt;
    return planOfFile(input, std::move(p), emission, std::move(file));
  }
  if (!isInline) {
    tolerate(in,
             "parameter \"float density\" (or \"string filename\") is missing; the medium is vacuum, as in "
             "PBRT-v3");
    in.reportUnused();  // it may stand there under another type
    return std::nullopt;
  }
  if (!takeDensity(in, expected, grid)) return std::nullopt;
  return [p, emission, place = input.medium.ctm->start](Textures&) {
    if (emission) p->emissionPattern = emission(place);
    auto made = makeGridMedium(*p, place);
    *p = {};  // the input values are not needed any more
    return made;
  };
}

}  // namespace pbrtmedia
