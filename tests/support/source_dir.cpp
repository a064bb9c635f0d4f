// SPDX-License-Identifier: BSD-2-Clause
#include "support/source_dir.h"

namespace pbrtmedia::test {

std::filesystem::path sourceDir() { return PBRT_MEDIA_SOURCE_DIR; }

}  // namespace pbrtmedia::test
