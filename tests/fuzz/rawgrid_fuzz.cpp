// SPDX-License-Identifier: BSD-2-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "base/diagnostics.h"
#include "base/files.h"
#include "construct/raw_grid.h"
#include "fields/grid_field.h"
#include "memory_file.h"

// Raw grids, plain and gzip-compressed, of any content: a SceneError, or numbers that a grid takes or
// refuses.

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pbrtmedia;
  constexpr std::size_t kMost = std::size_t{1} << 22;  // bytes unpacked: the fuzzer's own memory is limited
  const test::MemoryFile memory({reinterpret_cast<const char*>(data), size});
  for (const RawFormat format : {RawFormat::Float, RawFormat::Half}) {
    try {
      const FileBytes file = FileBytes::open(memory.path(), kMost);
      std::vector<float> numbers = decodeRaw(file, format);
      if (numbers.size() != file.bytes().size() / bytesOf(format)) std::abort();
      const int n = std::clamp(static_cast<int>(std::cbrt(static_cast<double>(numbers.size()))), 1, 64);
      numbers.resize(static_cast<std::size_t>(n) * static_cast<std::size_t>(n) * static_cast<std::size_t>(n));
      const GridField field({.nx = n, .ny = n, .nz = n, .density = std::move(numbers)}, Transform());
      if (!(field.superVoxels().maximum() >= 0)) std::abort();
    } catch (const SceneError&) {
    }
  }
  return 0;
}
