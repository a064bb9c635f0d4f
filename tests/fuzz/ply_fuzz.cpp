// SPDX-License-Identifier: BSD-2-Clause
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

#include "base/diagnostics.h"
#include "shapes/ply.h"

// Any bytes give a mesh or a SceneError; a mesh that validates can be built.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace pbrtmedia;
  try {
    const PlyMesh ply = parsePly({reinterpret_cast<const char*>(data), size}, "fuzz.ply");
    for (const MeshProblem& problem : TriangleMesh::validate(ply.mesh)) {
      if (problem.severity == Severity::Error) return 0;
    }
    const TriangleMesh mesh(ply.mesh, {});
    static_cast<void>(mesh.isClosed());
  } catch (const SceneError&) {
  }
  return 0;
}
