// SPDX-License-Identifier: BSD-2-Clause
#include "media/coefficients.h"

#include <sstream>

#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

void check(Rgb value, std::string_view parameter, std::string_view mediumName) {
  if (value.isFinite() && value.min() >= 0) return;
  std::ostringstream message;
  message << "medium \"" << mediumName << "\": " << parameter
          << " must be finite and >= 0 in every channel; found " << value;
  throw SceneError(SourceLocation{}, message.str());
}

}  // namespace

void checkCoefficients(Rgb sigmaA, Rgb sigmaS, std::string_view mediumName) {
  check(sigmaA, "\"sigma_a\"", mediumName);
  check(sigmaS, "\"sigma_s\"", mediumName);
  check(sigmaA + sigmaS, "sigma_a + sigma_s", mediumName);
}

void checkEmission(Rgb le, Rgb emission, std::string_view mediumName) {
  check(le, "\"Le\" times \"Lescale\"", mediumName);
  check(emission, "sigma_a times Le", mediumName);
}

Rgb albedoOf(Rgb sigmaS, Rgb sigmaT) {
  Rgb albedo;
  for (std::size_t c = 0; c < 3; ++c) albedo[c] = sigmaT[c] > 0 ? sigmaS[c] / sigmaT[c] : 0.0f;
  return albedo;
}

}  // namespace pbrtmedia
