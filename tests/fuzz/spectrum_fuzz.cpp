// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "base/diagnostics.h"
#include "spectrum/spectrum.h"

// Spectrum and lens files of any content, read strictly and as PBRT-v3 reads them: finite numbers and a
// finite colour, or SceneError, or std::invalid_argument for a wavelength that is repeated.
namespace {

void read(std::string_view text, pbrtmedia::Diagnostics* tolerate) {
  using namespace pbrtmedia;
  try {
    for (const float v : parseNumberText(text, "fuzz.dat", tolerate)) {
      if (!std::isfinite(v)) std::abort();
    }
    const std::vector<SpectralSample> samples = parseSpectrumText(text, "fuzz.spd", tolerate);
    if (samples.empty()) std::abort();
    (void)sampledSpectrumToRgb(samples);
  } catch (const SceneError&) {
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read(text, nullptr);
  pbrtmedia::Diagnostics diagnostics;
  read(text, &diagnostics);
  return 0;
}
