// SPDX-License-Identifier: BSD-2-Clause
#include "image/codecs.h"

#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>

#include "image/decode_error.h"

namespace pbrtmedia {

const char* formatName(ImageFormat format) {
  switch (format) {
    case ImageFormat::Exr:
      return "OpenEXR";
    case ImageFormat::Png:
      return "PNG";
    case ImageFormat::Pfm:
      return "PFM";
    case ImageFormat::Tga:
      return "TGA";
  }
  throw std::logic_error("unknown image format");
}

ImageFormat detectFormat(std::span<const std::byte> bytes, const std::string& name) {
  const std::string_view start(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  if (start.starts_with("\x76\x2f\x31\x01")) return ImageFormat::Exr;
  if (start.starts_with("\x89PNG\r\n\x1a\n")) return ImageFormat::Png;
  if ((start.starts_with("PF") || start.starts_with("Pf")) && start.size() > 2 &&
      std::isspace(static_cast<unsigned char>(start[2]))) {
    return ImageFormat::Pfm;
  }
  std::string extension = std::filesystem::path(name).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension == ".tga") return ImageFormat::Tga;
  if (bytes.empty()) failFile(name, "the file is empty, expected an image");
  failFile(name, "not an OpenEXR, PNG, PFM or TGA (by the name .tga) image");
}

Image decodeImage(ImageFormat format, std::span<const std::byte> bytes, const std::string& name) {
  switch (format) {
    case ImageFormat::Exr:
      return decodeExr(bytes, name);
    case ImageFormat::Png:
      return decodePng(bytes, name);
    case ImageFormat::Pfm:
      return decodePfm(bytes, name);
    case ImageFormat::Tga:
      return decodeTga(bytes, name);
  }
  throw std::logic_error("unknown image format");
}

}  // namespace pbrtmedia
