// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

namespace pbrtmedia {

struct CatOptions {
  std::string file;
  bool sort = false;  ///< by luminance, darkest first, instead of row by row
};

/// `imgtool cat`: one line "(x, y): value ..." per pixel with the values of all channels; x and y are
/// positions in the picture (the data window says where it starts). Numbers read back as the same floats.
/// Returns 0.
int runCat(const CatOptions& options);

}  // namespace pbrtmedia
