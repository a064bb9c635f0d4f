// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>

#include "base/stop_signal.h"
#include "base/stopwatch.h"
#include "construct/construct.h"
#include "main/checkpoints.h"
#include "main/options.h"
#include "main/watching.h"
#include "render/render_result.h"

namespace pbrtmedia {

/// When a run ends early.
struct Ending {
  const StopSignal& stop;
  Stopwatch sinceStart;  ///< of the program
};

struct RenderedImage {
  RenderResult result;    ///< the image is on the film
  PhaseTime measuring;    ///< seconds for --convergence and --error, which are none of rendering
  std::string stoppedBy;  ///< "time", "signal", "lookups" or "error"; "": not stopped early
};

/// Whether the film must keep its halves (Film::keepHalves) for what the options ask.
bool needsHalves(const Options& options);

/// Takes the samples of a scene, from where `checkpoints` has it, with a progress line, and with what
/// measures the image on its way. Throws SceneError for a reference that is none.
RenderedImage renderImage(const Construction& scene, const Options& options, const Ending& ending,
                          Watching& watching, Checkpoints& checkpoints);

}  // namespace pbrtmedia
