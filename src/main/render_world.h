// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "base/stopwatch.h"
#include "main/checkpoints.h"
#include "main/kept_bounds.h"
#include "main/options.h"
#include "main/render_image.h"
#include "main/statistics_report.h"
#include "main/together.h"
#include "scene/description.h"

namespace pbrtmedia {

// Exit statuses, the worst first.
constexpr int kExitBadInput = 1;  ///< or an image that is not where it should be
constexpr int kExitStrict = 2;    ///< with --strict: samples were dropped, or a bound was violated
constexpr int kExitEarly = 3;     ///< with --strict: fewer samples than planned

/// What stopped runs say on standard error.
constexpr const char* kNothingYet =
    "\nstopping before the first sample: there is no image (again to end at once)\n";
constexpr const char* kImageSoFar = "\nstopping; the image so far will be written (again to end at once)\n";

/// What the worlds of a run share.
struct Run {
  const Options& options;
  const Ending& ending;
  Watching& watching;
  KeptBounds& bounds;
  Checkpoints& checkpoints;
  Together& together;
  const ParamList& mediumParams;  ///< those of --mediumparams
};

/// Of what came of two worlds or frames. 0 is the best.
int worseStatus(int a, int b);

/// Which of them it is.
struct WorldId {
  std::size_t number = 0;  ///< from 0
  std::string name;        ///< what a cache of bounds calls it
};

/// One world: built, rendered, and by the first rank written; told about on standard error. Takes its arrays.
/// Sets `status` where it is not 0, and answers the numbers; nothing for a world that cannot be built. Throws
/// Interrupted when it is to stop before the first sample.
std::optional<RenderStatistics> renderWorld(SceneDescription& description, const WorldId& id, const Run& run,
                                            const PhaseTime& parseTime, int& status);

/// File names of the command line, for people.
std::string sceneNames(const Options& options);

}  // namespace pbrtmedia
