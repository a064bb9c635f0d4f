// SPDX-License-Identifier: BSD-2-Clause
#include "media/coefficients.h"

#include <sstream>

#include "base/diagnostics.h"

namespace pbrtmedia {

void checkCoefficients(Rgb sigmaA, Rgb sigmaS, std::string_view mediumName) {
  const auto check = [&](Rgb sigma, std::string_view parameter) {
    if (sigma.isFinite() && sigma.min() >= 0) return;
    std::ostringstream message;
    message << "medium \"" << mediumName << "\": " << parameter
            << " must be finite and >= 0 in every channel; found " << sigma;
    throw SceneError(SourceLocation{}, message.str());
  };
  check(sigmaA, "\"sigma_a\"");
  check(sigmaS, "\"sigma_s\"");
  check(sigmaA + sigmaS, "sigma_a + sigma_s");
}

}  // namespace pbrtmedia
