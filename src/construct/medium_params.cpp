// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_params.h"

#include <array>

#include "construct/phase.h"
#include "construct/transmittance.h"
#include "media/presets.h"

namespace pbrtmedia {

void readMediumParams(ParamReader& in, const MediumDescription& medium, MediumParams& p) {
  p.name = medium.name;
  if (const std::optional<std::string> name = in.optionalString("preset")) {
    if (const std::optional<MediumPreset> preset = findPreset(*name)) {
      p.sigmaA = preset->sigmaA;
      p.sigmaS = preset->sigmaPrimeS;
    } else {
      std::vector<std::string_view> names;
      for (const MediumPreset& known : mediumPresets()) names.push_back(known.name);
      in.diagnostics().lenientError(
          in.locationOf(ParamKind::String, "preset"),
          in.context() + ": unknown preset \"" + *name + "\"" + suggestion(*name, names));
    }
  }
  const float scale = in.findFloat("scale", 1, Range::nonNegative());
  p.sigmaA = in.findSpectrum("sigma_a", p.sigmaA) * scale;
  p.sigmaS = in.findSpectrum("sigma_s", p.sigmaS) * scale;
  for (const auto& [name, sigma] :
       {std::pair<std::string_view, Rgb>{"sigma_a", p.sigmaA}, {"sigma_s", p.sigmaS}}) {
    if (sigma.min() < 0)
      in.error(ParamKind::Spectrum, name, "found a negative coefficient, expected numbers >= 0");
  }
  p.phase = readPhase(in);

  constexpr std::array<std::string_view, 3> kRules = {"boundary", "add", "priority"};
  p.overlap.mode = std::array{OverlapRule::Mode::Boundary, OverlapRule::Mode::Add,
                              OverlapRule::Mode::Priority}[in.findChoice("overlap", kRules, 0)];
  if (const std::optional<int> priority = in.optionalInt("priority")) {
    // A priority alone says which rule is meant.
    if (!in.has(ParamKind::String, "overlap")) p.overlap.mode = OverlapRule::Mode::Priority;
    if (p.overlap.mode != OverlapRule::Mode::Priority) {
      in.error(ParamKind::Integer, "priority", "needs \"string overlap\" \"priority\"");
    }
    p.overlap.priority = *priority;
  }
}

void readFieldMediumParams(ParamReader& in, const MediumDescription& medium, FieldMediumParams& p) {
  readMediumParams(in, medium, p);
  p.estimator = readTransmittance(in, p.estimator);
  if (!std::holds_alternative<ExponentialLaw>(lawOf(p.estimator)) && p.sigmaS.max() > 0) {
    in.error(ParamKind::String, "law",
             "free flights follow the exponential law only: under another one the medium must not scatter "
             "(sigma_s 0)");
  }
}

}  // namespace pbrtmedia
