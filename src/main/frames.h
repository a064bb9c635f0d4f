// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "main/options.h"

namespace pbrtmedia {

/// The options of one frame of a sequence: `$frame` and the places for its number in names of files filled
/// in.
Options optionsOfFrame(const Options& options, int frame);

/// Throws SceneError where one frame of a sequence would be written over another: a file without a place for
/// the number of the frame. Reads the scene of two frames to know, unless --outfile names the images.
void checkFrames(const Options& options);

}  // namespace pbrtmedia
