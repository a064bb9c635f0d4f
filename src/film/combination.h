// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <span>

#include "film/film.h"

namespace pbrtmedia {

struct FilmTerm {
  const Film* film = nullptr;
  double factor = 0;
};

/// Adds the sum of factor times film, colour by colour, as if it had been one render with such samples: what
/// the samples weigh, and how many paths bring splats, is added once. Films without layers. False, changing
/// nothing, for films of other sizes, without the halves that `film` has, or whose samples weigh differently.
/// Parallel over rows.
bool addCombination(Film& film, std::span<const FilmTerm> terms);

}  // namespace pbrtmedia
