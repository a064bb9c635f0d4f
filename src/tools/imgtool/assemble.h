// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tools/imgtool/merge.h"

namespace pbrtmedia {

struct Assembly {
  Image image;                     ///< fills the display window; pixels of no tile are 0
  std::int64_t missing = 0;        ///< pixels of no tile
  std::int64_t overlapping = 0;    ///< pixels of more than one tile: the last one counts
  std::int64_t contradicting = 0;  ///< overlapping pixels where tiles differ
  Point2i firstMissing;            ///< in picture coordinates, when missing > 0
};

/// Puts crops together by their data windows. Metadata that all tiles agree on is kept. Throws
/// std::runtime_error naming the files for no input, different display windows or channels, or a tile that
/// leaves the display window.
Assembly assembleTiles(const std::vector<NamedImage>& tiles);

struct AssembleOptions {
  std::vector<std::string> inputs;
  std::string outfile;
  bool allowGaps = false;
  WriteOptions write;
};

/// `imgtool assemble`: reports overlaps and gaps; writes nothing and returns 1 when there are gaps, unless
/// they are allowed.
int runAssemble(const AssembleOptions& options);

}  // namespace pbrtmedia
