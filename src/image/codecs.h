// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "image/image.h"

// Image formats as bytes in memory. `name` is only shown in errors. Decoders throw SceneError (location: the
// file as a whole) for anything truncated, contradictory or unreasonable, and check the sizes of a header
// against the bytes that are there before they take memory. Encoders throw std::runtime_error without the
// path, which `writeImage` adds.

namespace pbrtmedia {

enum class ImageFormat { Exr, Png, Pfm, Tga };

/// "OpenEXR", "PNG", "PFM" or "TGA".
const char* formatName(ImageFormat format);
/// Whether files of this format hold sRGB-encoded values (PNG, TGA) rather than linear ones.
constexpr bool isSrgbEncoded(ImageFormat f) { return f == ImageFormat::Png || f == ImageFormat::Tga; }
/// By how a name ends, in capital letters or small ones; nothing for another extension, or none.
std::optional<ImageFormat> formatByExtension(const std::filesystem::path& path);
/// By the first bytes; TGA, which has no signature, by the name. Throws SceneError when it is none of them.
ImageFormat detectFormat(std::span<const std::byte> bytes, const std::string& name);

Image decodeImage(ImageFormat format, std::span<const std::byte> bytes, const std::string& name);
/// Half, float and integer channels of any names; scan lines or tiles (largest level); the first part of a
/// multi-part file. R, G, B come first, then A, then the rest by name. Luminance-chroma files become R, G, B.
/// String attributes become metadata.
Image decodeExr(std::span<const std::byte> bytes, const std::string& name);
/// All PNGs, /255 or /65535: R, G, B or Y, and A where there is transparency. Text chunks become metadata.
Image decodePng(std::span<const std::byte> bytes, const std::string& name);
/// R, G, B ("PF") or Y ("Pf"); values are multiplied by |scale|.
Image decodePfm(std::span<const std::byte> bytes, const std::string& name);
/// Mono, palette and true colour of 8 to 32 bits, plain or run-length encoded, any origin; /255 (/31 for
/// 15 and 16 bits). A only when the header says that there are alpha bits.
Image decodeTga(std::span<const std::byte> bytes, const std::string& name);

/// All channels, with windows and metadata. Values beyond 65504 become infinite as half.
std::string encodeExr(const Image& image, const WriteOptions& options);
/// 8 bits; grey stays grey, A is kept (linear). Metadata become text chunks.
std::string encodePng(const Image& image);
/// R, G, B or grey as 32-bit little-endian floats.
std::string encodePfm(const Image& image);
/// 24 bits, uncompressed, top row first.
std::string encodeTga(const Image& image);

/// floor(clamp(255 e(v) + 1/2, 0, 255)) with e = `encodeSrgb`; NaN becomes 0.
unsigned char quantizeSrgb(float linear);

}  // namespace pbrtmedia
