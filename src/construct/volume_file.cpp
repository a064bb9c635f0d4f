// SPDX-License-Identifier: BSD-2-Clause
#include "construct/volume_file.h"

#include <array>
#include <fstream>

#include "construct/tolerance.h"

namespace pbrtmedia {

VolumeFile volumeFileOf(const std::filesystem::path& path) {
  using namespace std::string_view_literals;
  std::array<char, 8> head{};
  std::ifstream(path, std::ios::binary).read(head.data(), head.size());
  const std::string_view bytes(head.data(), head.size());
  if (bytes == " BDV\0\0\0\0"sv) return VolumeFile::OpenVdb;
  if (bytes.substr(0, 7) == "NanoVDB") return VolumeFile::NanoVdb;
  return VolumeFile::Other;
}

std::optional<std::filesystem::path> requireVolumeFile(ParamReader& in) {
  std::optional<std::filesystem::path> file = requireFile(in, "filename");
  if (!file || (file->extension() != ".vdb" && volumeFileOf(*file) != VolumeFile::OpenVdb)) return file;
  std::string text = "this is an OpenVDB file, which is not read here; \"vdb2pbrt ";
  text += file->filename().string();
  text += "\" makes an .nvdb file of it, for a medium of type \"nanovdb\"";
  in.error(ParamKind::String, "filename", text);
  return std::nullopt;
}

void tellNegatives(const NegativeDensities& negatives, std::string_view grid, const SourceLocation& named,
                   std::string_view context, Diagnostics& diagnostics) {
  if (negatives.count == 0) return;
  std::string what = "the grid";
  if (!grid.empty()) what.append(" \"").append(grid).append("\"");
  diagnostics.tolerated(named, std::string(context) + ": " + what + ' ' +
                                   negativesMessage(negatives.count, negatives.first, negatives.density));
}

}  // namespace pbrtmedia
