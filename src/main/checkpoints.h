// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/stopwatch.h"
#include "construct/construct.h"
#include "construct/scene_identity.h"
#include "main/checkpoint_file.h"
#include "main/options.h"
#include "render/render_options.h"
#include "render/render_result.h"
#include "render/render_state.h"

namespace pbrtmedia {

/// `--checkpoint` and `--resume`: what a run of the program goes on from, and what it leaves behind for
/// another one. Of several worlds one file holds the one under way; those before it are done.
class Checkpoints {
 public:
  /// Reads the file to go on from. Throws SceneError when there is none, when it is broken, or when another
  /// checkpoint would be overwritten.
  /// `writes`: false on ranks that only go on from it.
  explicit Checkpoints(const Options& options, bool writes = true);

  /// The world to begin with, of so many. Throws SceneError when the checkpoint is of a later one.
  std::size_t firstWorld(std::size_t worlds) const;
  /// What --stats has of the worlds before the first one, as JSON.
  const std::vector<std::string>& worldsDone() const { return worldsDone_; }

  /// To be called for each world once it is built. Restores what the checkpoint has of it; throws SceneError
  /// when that is of another render, naming all that differs.
  void enter(std::size_t world, const SceneIdentity& identity, const Construction& scene);
  /// Whether the world is one to go on with.
  bool resumes() const { return start_.has_value(); }
  /// Adds what a loop needs to go on, and to leave checkpoints on its way. `scene`, `loop` and this must
  /// stay.
  void attach(const Construction& scene, RenderOptions& loop);
  /// The last checkpoint of the world. False, with a message on standard error, when it could not be written.
  bool finish(const Construction& scene, const RenderResult& result);
  /// What the world cost, a part for each process that rendered some of it.
  const std::vector<RenderPart>& parts() const { return head_.parts; }
  /// The world is done: what --stats has of it.
  void leave(std::string statistics);

 private:
  void restore(const Construction& scene);
  bool isDue() const;
  /// Writes the checkpoint. Whether that worked; otherwise `problem_` says why not.
  bool write(const Construction& scene, const RenderResult& result);
  void notePart(const RenderResult& result);

  const Options& options_;
  bool writes_;
  std::optional<Checkpoint> from_;  ///< until its world is entered
  CheckpointHead head_;             ///< of the world under way
  std::vector<std::string> worldsDone_;
  std::optional<RenderState> start_;
  std::optional<Stopwatch> rendering_;
  double lastWrite_ = 0, lastCost_ = 0;  ///< when, and how long it took; seconds of `rendering_`
  std::optional<std::int64_t> lastSaved_;
  bool isPartial_ = false;  ///< the film has samples of a pass that was left inside
  std::string problem_;     ///< with the last checkpoint; "": none
};

}  // namespace pbrtmedia
