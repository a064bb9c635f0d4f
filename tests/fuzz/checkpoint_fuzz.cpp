// SPDX-License-Identifier: BSD-2-Clause
#include <cstdint>
#include <stdexcept>
#include <string>

#include "base/diagnostics.h"
#include "base/hash.h"
#include "checkpoint_scene.h"
#include "main/checkpoint_file.h"
#include "memory_file.h"
#include "render/state_stream.h"

// Checkpoints of any content, and of any content under a right hash: a SceneError, or a state that the scene
// takes or refuses.

namespace {

using namespace pbrtmedia;

void read(const std::string& text) {
  static const std::unique_ptr<Scene> scene = test::checkpointScene();
  static Film film = test::checkpointFilm();
  const test::MemoryFile file(text);
  try {
    const Checkpoint checkpoint = Checkpoint::read(file.path());
    ByteReader in(checkpoint.state());
    const RenderState state = readState(in, *scene);
    if (!restoreState(state, *scene, film)) return;
    (void)film.develop();
    for (Medium* learner : scene->learners()) learner->learnedBounds()->publish();
  } catch (const SceneError&) {
  } catch (const std::length_error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  read(text);
  constexpr std::size_t kHashBytes = 8;
  if (size < kHashBytes || size > ByteWriter::kBlock) return 0;
  std::string right = text.substr(0, size - kHashBytes);
  ByteWriter hash;
  hash.add(hashText(right, 1));
  read(right + hash.text());
  return 0;
}
