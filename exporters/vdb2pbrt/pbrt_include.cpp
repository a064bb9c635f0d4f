// SPDX-License-Identifier: BSD-2-Clause
#include "vdb2pbrt/pbrt_include.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <stdexcept>

namespace pbrtmedia {
namespace {

template <class T>
void put(std::string& out, T number) {
  std::array<char, 32> digits;
  out.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
}

std::string bare(VoxelIndex v) {
  return std::to_string(v.x) + " " + std::to_string(v.y) + " " + std::to_string(v.z);
}

/// Only what stands in a string of a scene file, and a comment, as it is.
bool isPlain(const std::string& name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) {
    return static_cast<unsigned char>(c) >= 0x20 && c != '"' && c != '\\' && c != 0x7f;
  });
}

void putHeader(std::string& out, const std::string& source) {
  out += "# Made by vdb2pbrt from " + inComment(source) + ".\n";
}

void putFacts(std::string& out, const VdbDensity& density) {
  out += "\n# Grid \"" + inComment(density.name()) + "\": " + std::to_string(density.activeVoxels()) +
         " active voxels";
  if (density.activeVoxels() > 0) {
    out += " in [" + bare(density.activeMin()) + "] .. [" + bare(density.activeMax()) + "]";
    const Bounds3d inIndex{Vec3d(density.activeMin()), Vec3d(density.activeMax())};
    Bounds3d world;
    for (int i = 0; i < 8; ++i) world.expand(density.worldFromIndex().point(inIndex.corner(i)));
    out += ",\n# centres of voxels in world space [";
    putVector(out, world.min);
    out += "] .. [";
    putVector(out, world.max);
    out += "]";
  }
  out += ", background ";
  put(out, density.background());
  out += "\n";
  if (density.background() != 0) {
    out += "# The background counts as density inside the box; outside of it is nothing.\n";
  }
}

/// `several`: media of one include overlap, and are all there.
void putCoefficients(std::string& out, const IncludeOptions& options, bool several) {
  out += "  \"rgb sigma_a\" [ ";
  putVector(out, options.sigmaA);
  out += " ] \"rgb sigma_s\" [ ";
  putVector(out, options.sigmaS);
  out += " ]";
  if (options.scale != 1) {
    out += " \"float scale\" ";
    put(out, options.scale);
  }
  if (several) out += " \"string overlap\" \"add\"";
}

/// World from index; column after column, as ConcatTransform reads it.
void putTransform(std::string& out, const Transform& transform) {
  out += "  ConcatTransform [";
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      out += ' ';
      put(out, transform.matrix().m[row][column]);
    }
  }
  out += " ]\n";
}

/// The box where the density can be above 0, in index space, its triangles facing outward.
void putBoundary(std::string& out, const VdbDensity& density, const std::string& medium) {
  const Vec3d lo = Vec3d(density.activeMin()) - Vec3d(1, 1, 1),
              hi = Vec3d(density.activeMax()) + Vec3d(1, 1, 1);
  out += "  MediumInterface " + quoted(medium) +
         " \"\"\n  Material \"none\"\n  Shape \"trianglemesh\"\n    \"point P\" [";
  for (int i = 0; i < 8; ++i) {
    out += i % 4 == 0 ? "\n      " : "  ";
    putVector(out, {(i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z});
  }
  // Corner numbers: x + 2 y + 4 z.
  out +=
      " ]\n    \"integer indices\" [ 0 4 2  2 4 6  1 3 5  3 7 5  0 1 4  1 5 4  2 6 3  3 6 7  0 2 1  1 2 3  4 "
      "5 6  "
      "5 7 6 ]\n";
}

void putRadiance(std::string& out, const IncludeEmission& emission) {
  if (emission.temperature != nullptr) {
    out += "\n ";
    if (emission.temperatureScale != 1) {
      out += " \"float temperaturescale\" ";
      put(out, emission.temperatureScale);
    }
    if (emission.temperatureOffset != 0) {
      out += " \"float temperatureoffset\" ";
      put(out, emission.temperatureOffset);
    }
  } else {
    out += "\n  \"rgb Le\" [ ";
    putVector(out, emission.le);
    out += " ]";
  }
}

void putLescale(std::string& out, double scale) {
  out += " \"float Lescale\" ";
  put(out, scale);
}

/// As the medium "nanovdb" reads it.
void putEmission(std::string& out, const IncludeEmission& emission) {
  if (!emission.isThere()) return;
  putRadiance(out, emission);
  putLescale(out, emission.leScale);
  if (emission.temperature != nullptr) {
    out += "\n  \"string temperaturegrid\" " + quoted(emission.temperatureGrid);
  }
  if (emission.factor != nullptr) out += "\n  \"string Legrid\" " + quoted(emission.factorGrid);
}

void putSamples(std::string& out, const std::string& name, const std::vector<float>& samples,
                std::int64_t perRow, double scale = 1) {
  out += "\n  \"float " + name + "\" [";
  for (std::size_t i = 0; i < samples.size(); ++i) {
    out += i % static_cast<std::size_t>(perRow) == 0 ? '\n' : ' ';
    put(out, scale == 1 ? samples[i] : static_cast<float>(scale * static_cast<double>(samples[i])));
  }
  out += " ]";
}

/// As the medium "heterogeneous" reads it: a number for each sample lo..hi.
void putDenseEmission(std::string& out, const IncludeEmission& emission, const Transform& worldFromIndex,
                      VoxelIndex lo, VoxelIndex hi) {
  if (!emission.isThere()) return;
  putRadiance(out, emission);
  const std::int64_t perRow = hi.x - lo.x + 1;
  if (emission.factor == nullptr) {
    putLescale(out, emission.leScale);
  } else {
    putSamples(out, "Lescale", emission.factor->samplesAt(worldFromIndex, lo, hi), perRow, emission.leScale);
  }
  if (emission.temperature != nullptr) {
    putSamples(out, "temperature", emission.temperature->samplesAt(worldFromIndex, lo, hi), perRow);
  }
}

}  // namespace

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

std::string inComment(const std::string& text) {
  std::string out;
  for (const char c : text) out += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? '?' : c;
  return out;
}

void putNumber(std::string& out, double number) { put(out, number); }

void putVector(std::string& out, Vec3d v) {
  for (std::size_t a = 0; a < 3; ++a) {
    if (a > 0) out += ' ';
    put(out, v[a]);
  }
}

std::string nvdbInclude(std::span<const IncludeGrid> grids, const IncludeEmission& emission,
                        const std::string& nvdb, const std::string& source, const IncludeOptions& options) {
  std::string out;
  putHeader(out, source);
  for (const IncludeGrid& grid : grids) {
    putFacts(out, *grid.density);
    out += "MakeNamedMedium " + quoted(grid.medium) + " \"string type\" \"nanovdb\"\n  \"string filename\" " +
           quoted(nvdb) + " \"string grid\" " + quoted(grid.grid) + "\n";
    putCoefficients(out, options, grids.size() > 1);
    putEmission(out, emission);
    out += "\nAttributeBegin  # index space; the medium itself has this transformation from its file\n";
    putTransform(out, grid.density->worldFromIndex());
    putBoundary(out, *grid.density, grid.medium);
    out += "AttributeEnd\n";
  }
  return out;
}

std::string denseInclude(std::span<const IncludeGrid> grids, const IncludeEmission& emission,
                         const std::string& source, const IncludeOptions& options) {
  std::string out;
  putHeader(out, source);
  for (const IncludeGrid& grid : grids) {
    const VdbDensity& density = *grid.density;
    const VoxelIndex lo = density.activeMin() - VoxelIndex(1, 1, 1),
                     hi = density.activeMax() + VoxelIndex(1, 1, 1);
    const VoxelIndex n = hi - lo + VoxelIndex(1, 1, 1);
    if (static_cast<double>(n.x) * static_cast<double>(n.y) * static_cast<double>(n.z) >
        static_cast<double>(kMaxDenseSamples)) {
      throw std::runtime_error("grid \"" + density.name() + "\" has " + bare(n) +
                               " samples when dense, more than " + std::to_string(kMaxDenseSamples) +
                               " in all; write .nvdb instead");
    }
    putFacts(out, density);
    out += "AttributeBegin  # index space\n";
    putTransform(out, density.worldFromIndex());
    // Samples lie in the middle of PBRT's voxels.
    const Vec3d half(0.5, 0.5, 0.5);
    out +=
        "  MakeNamedMedium " + quoted(grid.medium) + " \"string type\" \"heterogeneous\"\n  \"point p0\" [ ";
    putVector(out, Vec3d(lo) - half);
    out += " ] \"point p1\" [ ";
    putVector(out, Vec3d(hi) + half);
    out += " ]\n  \"integer nx\" " + std::to_string(n.x) + " \"integer ny\" " + std::to_string(n.y) +
           " \"integer nz\" " + std::to_string(n.z) + "\n";
    putCoefficients(out, options, grids.size() > 1);
    putDenseEmission(out, emission, density.worldFromIndex(), lo, hi);
    putSamples(out, "density", density.samples(lo, hi), n.x);
    out += "\n";
    putBoundary(out, density, grid.medium);
    out += "AttributeEnd\n";
  }
  return out;
}

std::vector<std::string> mediumNames(std::span<const VdbDensity> grids, const std::string& stem) {
  std::vector<std::string> names;
  for (const VdbDensity& density : grids) {
    const std::string wanted = isPlain(density.name()) ? density.name() : stem;
    std::string name = wanted;
    for (int n = 2; std::find(names.begin(), names.end(), name) != names.end(); ++n) {
      name = wanted + "-" + std::to_string(n);
    }
    names.push_back(name);
  }
  return names;
}

std::vector<std::string> gridSelectors(std::span<const VdbDensity> grids) {
  std::vector<std::string> selectors;
  for (std::size_t i = 0; i < grids.size(); ++i) {
    const std::string& name = grids[i].name();
    const auto same =
        std::count_if(grids.begin(), grids.end(), [&](const VdbDensity& g) { return g.name() == name; });
    selectors.push_back(isPlain(name) && same == 1 ? name : std::to_string(i));
  }
  return selectors;
}

}  // namespace pbrtmedia
