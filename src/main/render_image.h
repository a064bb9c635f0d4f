// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "construct/construct.h"
#include "film/side_images.h"
#include "main/checkpoints.h"
#include "main/options.h"
#include "main/together.h"
#include "main/watching.h"
#include "render/ranks.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// When a run ends early.
struct Ending {
  const StopSignal& stop;
  Stopwatch sinceStart;  ///< of the program
};

/// What one of several ranks did.
struct RankShare {
  unsigned threads = 0;
  double cpu = 0;  ///< seconds of its threads
  std::uint64_t passes = 0;
  RankTraffic traffic;  ///< while the image was rendered
};

struct RenderedImage {
  RenderResult result;              ///< the image is on the film
  PhaseTime measuring;              ///< seconds for --convergence and --error, which are none of rendering
  std::string stoppedBy;            ///< "time", "signal", "lookups" or "error"; "": not stopped early
  std::optional<SideImages> sides;  ///< of an integrator that makes some
  std::vector<RankShare> ranks;     ///< of all ranks, on the first; empty where there is but one
};

/// Whether the film must keep its halves (Film::keepHalves) for what the options ask.
bool needsHalves(const Options& options);

/// Takes the samples of a scene, from where `checkpoints` has it, with a progress line, and with what
/// measures the image on its way. Throws SceneError for a reference that is none.
RenderedImage renderImage(const Construction& scene, const Options& options, const Ending& ending,
                          Watching& watching, Checkpoints& checkpoints, const Together& together);

}  // namespace pbrtmedia
