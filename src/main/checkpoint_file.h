// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/byte_stream.h"
#include "base/files.h"
#include "base/stopwatch.h"

namespace pbrtmedia {

/// Something that decides the bits of an image: the seed, a file of the scene.
struct ImageCause {
  std::string name;   ///< as a message calls it
  std::string value;  ///< for people, or a hash: "#1a2b"
  bool operator==(const ImageCause&) const = default;
};

/// One process's share of a render.
struct RenderPart {
  std::int64_t first = 0, end = 0;  ///< sample indices of each pixel
  PhaseTime time;                   ///< of rendering; up to the last checkpoint when the part was killed
  std::uint64_t threads = 0;
  std::string version;  ///< buildText
};

/// What a checkpoint tells of a render before its state.
struct CheckpointHead {
  std::vector<ImageCause> causes;
  std::uint64_t samplesPerPixel = 0, samplesDone = 0;  ///< planned and taken, in every pixel
  std::uint64_t world = 0;                             ///< the one under way: its number, from 0
  std::vector<std::string> worldsDone;                 ///< what --stats has of those before it, as JSON
  std::vector<RenderPart> parts;                       ///< of this world
};

/// A render to go on with, in a file. The file is the same on every machine: "pbrt-media checkpoint 1\n",
/// head, state (render/state_stream.h), a hash of all that, by blocks (u64).
class Checkpoint {
 public:
  /// Throws SceneError at the file when it cannot be read, is of another kind or version, truncated or
  /// corrupt. The state is not looked into.
  static Checkpoint read(const std::filesystem::path& path);
  /// Writes a file atomically; `writeState` adds the state. Throws std::runtime_error; an older file is then
  /// as it was. Answers its size in bytes.
  static std::uint64_t write(const std::filesystem::path& path, const CheckpointHead& head,
                             const std::function<void(ByteWriter&)>& writeState);

  const CheckpointHead& head() const { return head_; }
  std::string_view state() const { return state_; }

 private:
  explicit Checkpoint(FileBytes file) : file_(std::move(file)) {}

  FileBytes file_;
  CheckpointHead head_;
  std::string_view state_;  ///< of file_
};

}  // namespace pbrtmedia
