// SPDX-License-Identifier: BSD-2-Clause
#include <filesystem>

#include "construct/emission.h"
#include "construct/medium_kinds.h"
#include "construct/medium_params.h"
#include "construct/plugins.h"
#include "construct/volume_file.h"
#include "media/nano_vdb_medium.h"

namespace pbrtmedia {

std::optional<MediumPlan> readNanoVdbMedium(const MediumInput& input) {
  ParamReader& in = input.in;
  const MediumDescription& medium = input.medium;
  NanoVdbMediumParams p;
  readFieldMediumParams(in, medium, DensityKind::InPieces, p);
  p.field.grid = in.optionalString("grid").value_or("");
  p.field.map.scale = in.findFloat("densityscale", 1, Range::nonNegative());
  p.field.map.offset = in.findFloat("densityoffset", 0);
  const std::optional<std::filesystem::path> file = requireVolumeFile(in);
  const EmissionPlan emission = readNanoVdbEmission(input, file.value_or(""), p);
  if (!file) return std::nullopt;
  p.field.file = *file;
  // A grid that is not there is told at its name, what is wrong with the file at the file.
  const ParamKind kind = ParamKind::String;
  const SourceLocation named = in.locationOf(kind, in.has(kind, "grid") ? "grid" : "filename");
  return [p = std::move(p), emission, named, context = in.context(), place = medium.ctm->start,
          &building = input.building](Textures&) mutable {
    if (emission) p.emissionPattern = emission(place);
    return builtAt(named, context, [&] {
      NegativeDensities negatives;
      p.field.map.negatives = &negatives;
      auto made = makeNanoVdbMedium(p, place);
      tellNegatives(negatives, p.field.grid, named, context, building);
      return made;
    });
  };
}

}  // namespace pbrtmedia
