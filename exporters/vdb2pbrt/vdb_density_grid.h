// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <openvdb/openvdb.h>

#include "vdb2pbrt/vdb_density.h"

namespace pbrtmedia {

struct VdbDensity::Grid {
  openvdb::FloatGrid::Ptr grid;  ///< never null
};

}  // namespace pbrtmedia
