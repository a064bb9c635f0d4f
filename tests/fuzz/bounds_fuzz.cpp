// SPDX-License-Identifier: BSD-2-Clause
#include <cstdint>
#include <string>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "media/bounds_cache.h"
#include "media/grid_medium.h"
#include "memory_file.h"

// Bounds caches of any content, and of any content under a right hash: a SceneError, or bounds that a medium
// takes or refuses with a reason.

namespace {

using namespace pbrtmedia;

Medium& learner() {
  static const std::unique_ptr<Medium> medium = [] {
    GridMediumParams params;
    params.name = "m";
    params.sigmaA = params.sigmaS = Rgb(1);
    params.grid = {.nx = 2, .ny = 2, .nz = 2, .density = {1, 2, 3, 4, 5, 6, 7, 8}};
    params.bounds.source = BoundsParams::Source::Progressive;
    params.bounds.cells = {{2, 2, 2}};
    return makeGridMedium(params, Transform());
  }();
  return *medium;
}

void read(const std::string& text) {
  const test::MemoryFile file(text);
  try {
    BoundsCache cache = BoundsCache::read(file.path());
    (void)cache.restore("scene.pbrt #0", learner());
    cache.keep("scene.pbrt #0", learner());
  } catch (const SceneError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  constexpr std::size_t kHashBytes = 8;
  if (size < kHashBytes) return 0;
  std::string right = text.substr(0, size - kHashBytes);
  const std::uint64_t hash = hashBytes(right);
  for (std::size_t i = 0; i < kHashBytes; ++i) right += static_cast<char>(hash >> (8 * i) & 0xff);
  read(right);
  return 0;
}
