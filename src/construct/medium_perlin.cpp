// SPDX-License-Identifier: BSD-2-Clause
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "fields/perlin_density.h"
#include "media/procedural_medium.h"

namespace pbrtmedia {

std::optional<MediumPlan> readPerlinMedium(const MediumInput& input) {
  ParamReader& in = input.in;
  const MediumDescription& medium = input.medium;
  ProceduralMediumParams p;
  readFieldMediumParams(in, medium, DensityKind::Procedural, p);
  PerlinDensity::Params noise;
  // As written in the file: 0.1, not the float next to it.
  const auto number = [&](std::string_view name, double fallback, Range range) {
    const std::optional<float> found = in.optionalFloat(name, range);
    return found ? decimalOf(*found) : fallback;
  };
  noise.octaves = in.findInt("octaves", noise.octaves, Range::closed(1, 32));
  noise.lacunarity = number("lacunarity", noise.lacunarity, Range::closed(1, 16));
  noise.gain = number("gain", noise.gain, {0, 1, true, false});
  noise.frequency = number("frequency", noise.frequency, {0, 1e9, true, true});
  noise.threshold = number("threshold", noise.threshold, {0, 1, false, true});
  noise.seed = static_cast<std::uint32_t>(in.findInt("seed", 0));
  if (!readMediumBox(in, p.field.p0, p.field.p1)) return std::nullopt;
  return [p, noise, place = medium.ctm->start](Textures&) mutable {
    p.field.function = std::make_shared<PerlinDensity>(noise);
    return makeProceduralMedium(p, "perlin", place);
  };
}

}  // namespace pbrtmedia
