// SPDX-License-Identifier: BSD-2-Clause
#include <cstdlib>

#include "base/diagnostics.h"
#include "image/codecs.h"

// Image files of any content. A file without a signature is taken as TGA, which has none. What decodes must
// be whole and survive being written; everything else must be refused by SceneError.

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace pbrtmedia;
  const std::span<const std::byte> bytes(reinterpret_cast<const std::byte*>(data), size);
  try {
    const ImageFormat format = detectFormat(bytes, "fuzz.tga");
    const Image image = decodeImage(format, bytes, "fuzz.tga");
    const std::size_t pixels =
        static_cast<std::size_t>(image.width()) * static_cast<std::size_t>(image.height());
    if (image.data().size() != pixels * image.channelCount() || pixels == 0) std::abort();
    if (pixels <= 4096 && image.channelCount() <= 8) {
      const std::string again = encodeExr(image, {PixelType::Float, ExrCompression::Zip});
      const Image back = decodeExr(
          std::span<const std::byte>(reinterpret_cast<const std::byte*>(again.data()), again.size()),
          "again");
      if (back.width() != image.width() || back.height() != image.height()) std::abort();
    }
  } catch (const SceneError&) {
  } catch (const std::runtime_error&) {
    // encodeExr: metadata that EXR cannot hold under its name
  }
  return 0;
}
