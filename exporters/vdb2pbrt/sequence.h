// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "vdb2pbrt/conversion.h"

namespace pbrtmedia {

/// Files whose names hold a place for the frame (base/frame_names.h).
struct SequenceOptions {
  std::string input, output, scene;  ///< scene: "" for none
  std::string frames;                ///< a range (parseFrameRange), or "": all that are there
  bool skipMissing = false;
};

/// Converts every frame. All have the look of the largest file (`settled`) and one camera around all of them;
/// a notice that several frames give is told once. Throws std::runtime_error or SceneError; a missing frame
/// of a given range is found before the first one is converted.
void convertSequence(const SequenceOptions& sequence, const ConversionOptions& options, const Notice& notice,
                     const Progress& progress = {});

}  // namespace pbrtmedia
