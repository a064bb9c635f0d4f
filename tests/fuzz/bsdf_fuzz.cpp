// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/diagnostics.h"
#include "materials/fourier_scattering.h"
#include "materials/fourier_table.h"

namespace {

void abortUnless(bool holds) {
  if (!holds) std::abort();
}
bool isFinite(pbrtmedia::Rgb f) { return std::isfinite(f.r) && std::isfinite(f.g) && std::isfinite(f.b); }

}  // namespace

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
        abortUnless(s.pdf >= 0 && std::isfinite(s.pdf) && isFinite(s.f));
        if (s.pdf > 0) abortUnless(std::abs(lengthSquared(s.wi) - 1) < 1e-3f);
        abortUnless(isFinite(law.f(wo, {0.6f, 0, 0.8f})));
        const float pdf = law.pdf(wo, {0, 0.6f, -0.8f});
        abortUnless(pdf >= 0 && std::isfinite(pdf));
      }
    }
  } catch (const SceneError&) {
  }
  return 0;
}
