// SPDX-License-Identifier: BSD-2-Clause
#include "tools/build_info.h"

#include "fields/grid_batch.h"

namespace pbrtmedia {

std::string buildText() {
  std::string text = "pbrt-media " PBRT_MEDIA_VERSION ", ";
  text += commitText();
  return text + ", " PBRT_MEDIA_COMPILER ", " PBRT_MEDIA_BUILD_TYPE ", " + gridBatchTarget();
}

}  // namespace pbrtmedia
