// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <memory>

#include "construct/construct_options.h"
#include "samplers/sampler.h"
#include "scene/description.h"

namespace pbrtmedia {

/// Reads Sampler and makes it. Null after an error.
std::unique_ptr<Sampler> readSampler(SceneDescription& scene, const ConstructOptions& options,
                                     Diagnostics& diagnostics);

}  // namespace pbrtmedia
