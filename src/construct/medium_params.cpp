// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_params.h"

#include <array>
#include <cmath>

#include "construct/emission.h"
#include "construct/enum_parameter.h"
#include "construct/freeflight.h"
#include "construct/medium_bounds.h"
#include "construct/phase.h"
#include "construct/tolerance.h"
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
      tolerate(in, ParamKind::String, "preset",
               "unknown preset \"" + *name + "\"" + suggestion(*name, names) +
                   "; the defaults are taken, as in PBRT-v3");
    }
  }
  const float scale = in.findFloat("scale", 1, Range::nonNegative());
  p.sigmaA = nonNegative(in, "sigma_a", in.findSpectrum("sigma_a", p.sigmaA)) * scale;
  p.sigmaS = nonNegative(in, "sigma_s", in.findSpectrum("sigma_s", p.sigmaS)) * scale;
  readEmission(in, medium, p);
  p.phase = readPhase(in);

  constexpr std::array<std::string_view, 3> kRules = {"boundary", "add", "priority"};
  p.overlap.mode = findOwnEnum(in, "overlap", kRules, OverlapRule::Mode::Boundary);
  if (const std::optional<int> priority = in.optionalInt("priority")) {
    // A priority alone says which rule is meant.
    if (!in.has(ParamKind::String, "overlap")) p.overlap.mode = OverlapRule::Mode::Priority;
    if (p.overlap.mode != OverlapRule::Mode::Priority) {
      in.error(ParamKind::Integer, "priority", "needs \"string overlap\" \"priority\"");
    }
    p.overlap.priority = *priority;
  }
}

bool readMediumBox(ParamReader& in, Point3f& p0, Point3f& p1) {
  p0 = in.findPoint3("p0", p0);
  p1 = in.findPoint3("p1", p1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (p0[axis] != p1[axis]) continue;
    std::string text = "the box is flat: p0 and p1 agree in ";
    text += "xyz"[axis];
    in.error(ParamKind::Point3, "p1", text);
    return false;
  }
  return true;
}

void readFieldMediumParams(ParamReader& in, const MediumDescription& medium, DensityKind kind,
                           FieldMediumParams& p) {
  readMediumParams(in, medium, p);
  const bool inPieces = kind == DensityKind::InPieces;
  p.bounds = readBounds(in, p.bounds.source);
  const bool walksPieces = inPieces && p.bounds.source == BoundsParams::Source::Exact;
  p.estimator = readTransmittance(in, walksPieces);
  const AnyLaw law = p.estimator ? lawOf(*p.estimator) : AnyLaw();
  p.flights = readFreeFlight(in, law, walksPieces, p.sigmaS.max() > 0);
  p.pattern = findOwnEnum(in, "pattern", kPatternNames, p.pattern);
  if (const float sigmaT = (p.sigmaA + p.sigmaS).max();
      sigmaT > 0 && !std::isfinite(p.bounds.majorant / sigmaT)) {
    in.error(ParamKind::Float, "majorant", "divided by the largest sigma_t it is no finite density");
  }
  checkPieces(in, p, inPieces);
}

}  // namespace pbrtmedia
