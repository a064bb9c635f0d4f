// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <filesystem>
#include <string>

#include "base/diagnostics.h"
#include "construct/construct_options.h"
#include "film/layers.h"
#include "render/integrator.h"
#include "scene/param_reader.h"

namespace pbrtmedia {

/// Layers as they are asked for, and where.
struct LayerRequest {
  LayerMask mask;
  bool all = false;  ///< whatever the integrator can fill
  SourceLocation at;
  std::string context;  ///< for messages: "Film \"image\": \"layers\"" or "--layers"
};

/// Reads Film "layers", or those of the command line, which win. Names that no layer has, and files that hold
/// none, are errors.
LayerRequest readLayers(ParamReader& film, const ConstructOptions& options,
                        const std::filesystem::path& outfile, Diagnostics& diagnostics);

/// What the film is to keep; layers that the integrator cannot fill are errors.
LayerSet chooseLayers(const LayerRequest& request, const Integrator& integrator, Diagnostics& diagnostics);

}  // namespace pbrtmedia
