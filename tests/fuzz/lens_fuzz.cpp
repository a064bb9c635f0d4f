// SPDX-License-Identifier: BSD-2-Clause
// Lens files of any content, strict and not: a SceneError, a lens that is refused, or one whose rays are
// finite.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

#include "construct/lens_file.h"

namespace {

using namespace pbrtmedia;

void trace(const LensSystem& lens) {
  for (int i = 0; i < 64; ++i) {
    const double x = i % 8 / 8.0, y = i / 8 / 4.0 - 1, radius = lens.rearApertureRadius();
    const Vec3d film{0.02 * x, 0, 0}, rear{radius * x, radius * y, lens.rearZ()};
    const auto out = lens.traceFromFilm({film, rear - film});
    if (out && (!isFinite(out->o) || !isFinite(out->d))) std::abort();
  }
}

void read(std::string_view text, Diagnostics* tolerate) {
  try {
    LensFile file = parseLensText(text, "fuzz.dat", tolerate);
    (void)file.setAperture(3);
    const LensSystem lens(file.elements);
    trace(lens);
    trace(lens.focusedAt(2, 3.5e-5));
  } catch (const SceneError&) {
  } catch (const std::invalid_argument&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read(text, nullptr);
  Diagnostics diagnostics;
  read(text, &diagnostics);
  return 0;
}
