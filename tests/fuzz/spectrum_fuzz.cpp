// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <cstdlib>
#include <string_view>

#include "base/diagnostics.h"
#include "spectrum/spectrum.h"

// Spectrum and lens files of any content: finite numbers and a finite colour, or SceneError.

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  using namespace pbrtmedia;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    for (const float v : parseNumberText(text, "fuzz.dat")) {
      if (!std::isfinite(v)) std::abort();
    }
    const std::vector<SpectralSample> samples = parseSpectrumText(text, "fuzz.spd");
    if (samples.empty()) std::abort();
    (void)sampledSpectrumToRgb(samples);
  } catch (const SceneError&) {
  }
  return 0;
}
