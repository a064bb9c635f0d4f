// SPDX-License-Identifier: BSD-2-Clause
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/diagnostics.h"
#include "fields/nano_vdb_field.h"
#include "fields/nano_vdb_file.h"
#include "memory_file.h"

// .nvdb files of any content: a SceneError, or grids whose bounds and densities are finite and not negative.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pbrtmedia;
  const test::MemoryFile file({reinterpret_cast<const char*>(data), size});
  try {
    const NanoVdbFile directory(file.path());
    (void)listGrids(directory.candidates());
    for (const NanoVdbGridInfo& grid : directory.grids()) {
      try {
        const NanoVdbField field({file.path(), grid.name, {}}, Transform());
        const SuperVoxels bounds = field.superVoxels();
        const float density = field.density(field.localBox().centre());
        if (!(density >= 0) || !std::isfinite(density) || !(bounds.maximum() >= 0)) std::abort();
      } catch (const SceneError&) {
      }
    }
  } catch (const SceneError&) {
  }
  return 0;
}
