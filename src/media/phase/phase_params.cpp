// SPDX-License-Identifier: BSD-2-Clause
#include "media/phase/phase_params.h"

#include <utility>

#include "media/phase/henyey_greenstein.h"
#include "media/phase/phase_mixture.h"
#include "media/phase/rayleigh.h"

namespace pbrtmedia {
namespace {

std::unique_ptr<PhaseFunction> makeLobe(const PhaseLobe& lobe) {
  switch (lobe.kind) {
    case PhaseLobe::Kind::Rayleigh:
      return std::make_unique<Rayleigh>();
    case PhaseLobe::Kind::Isotropic:
      return std::make_unique<HenyeyGreenstein>(0.0f);
    case PhaseLobe::Kind::HenyeyGreenstein:
      break;
  }
  return std::make_unique<HenyeyGreenstein>(lobe.g);
}

}  // namespace

std::unique_ptr<PhaseFunction> makePhaseFunction(const std::vector<PhaseLobe>& lobes) {
  if (lobes.size() == 1) return makeLobe(lobes.front());
  std::vector<PhaseMixture::Lobe> parts;
  for (const PhaseLobe& lobe : lobes) parts.push_back({makeLobe(lobe), lobe.weight});
  return std::make_unique<PhaseMixture>(std::move(parts));
}

}  // namespace pbrtmedia
