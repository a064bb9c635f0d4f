// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include "render/render_state.h"

namespace pbrtmedia {

class ByteReader;
class ByteWriter;

/// Writes what saveState would answer, at the same moments, without a second copy of the film in memory:
/// 32 bytes a pixel (and 8 for each layer, 24 for splats), 16 a super-voxel of learned bounds.
void writeState(ByteWriter& out, const Scene& scene, const Film& film, const RenderResult& result);
/// The state of a scene that was built anew from the same description. Throws std::length_error for what
/// writeState cannot have written; whether film and bounds fit is known to restoreState.
RenderState readState(ByteReader& in, const Scene& scene);

/// Parts of states, for those who render together. Reading throws as readState does.
void writeResult(ByteWriter& out, const Scene& scene, const RenderResult& result);
RenderResult readResult(ByteReader& in, const Scene& scene);
void writeFilm(ByteWriter& out, const Scene& scene, const Film::State& film);
Film::State readFilm(ByteReader& in, const Scene& scene);

}  // namespace pbrtmedia
