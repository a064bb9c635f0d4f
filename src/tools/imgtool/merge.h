// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/imgtool/common.h"
#include "tools/imgtool/same_scene.h"

namespace pbrtmedia {

/// The average of renders of one scene, weighted by their metadata "samples"; accumulated in double.
/// "samples" and "seconds" of the result are sums, "seed" lists all seeds, "command" and "version" those that
/// differ, a line each; what tells the scene stays. Throws std::runtime_error naming the files for: no input,
/// no or senseless "samples" or "seed", different size, windows, channels or "sceneHash", a seed that occurs
/// twice, a value that is not finite, or several of which one was rendered while bounds were being learned
/// ("boundsState" is "rising"). For a filter wider than a pixel the result is close to one long render, not
/// equal to it: each input is already divided by its own filter weights.
Image mergeRenders(const std::vector<NamedImage>& inputs);

struct MergeOptions {
  std::vector<std::string> inputs;
  std::string outfile;
  WriteOptions write{.pixelType = PixelType::Float};
};

/// `imgtool merge`: of ranges of one render (mergeRanges), or of renders with seeds of their own. Returns 0.
int runMerge(const MergeOptions& options);

}  // namespace pbrtmedia
