// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/diagnostics.h"
#include "materials/fourier_scattering.h"
#include "materials/fourier_table.h"

// Any bytes give a SceneError, or a law that can be asked and sampled everywhere.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pbrtmedia;
  try {
    const FourierTable table = FourierTable::parse({reinterpret_cast<const char*>(data), size}, "fuzz.bsdf");
    const FourierScattering law{&table};
    for (const float z : {-1.0f, -0.3f, 0.001f, 0.6f, 1.0f}) {
      const Vector3f wo{std::sqrt(1 - z * z), 0, z};
      for (const Point2f u : {Point2f(0, 0), Point2f(0.3f, 0.7f), Point2f(0.9999f, 0.9999f)}) {
        const LobeSample s = law.sample(wo, u);
        if (s.pdf > 0 && !(std::abs(lengthSquared(s.wi) - 1) < 1e-3f)) std::abort();
        static_cast<void>(law.f(wo, {0.6f, 0, 0.8f}));
        if (law.pdf(wo, {0, 0.6f, -0.8f}) < 0) std::abort();
      }
    }
  } catch (const SceneError&) {
  }
  return 0;
}
