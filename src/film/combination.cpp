// SPDX-License-Identifier: BSD-2-Clause
#include "film/combination.h"

#include <glog/logging.h>

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "base/parallel.h"

namespace pbrtmedia {
namespace {

using SumsOfState = std::vector<Film::Sums> Film::State::*;

bool haveSameWeights(std::span<const FilmTerm> terms, SumsOfState part) {
  const std::vector<Film::Sums>& first = terms.front().film->state().*part;
  return std::all_of(terms.begin(), terms.end(), [&](const FilmTerm& term) {
    const std::vector<Film::Sums>& sums = term.film->state().*part;
    return std::equal(sums.begin(), sums.end(), first.begin(), first.end(),
                      [](const Film::Sums& a, const Film::Sums& b) { return a.weight == b.weight; });
  });
}

void addPart(std::span<const FilmTerm> terms, SumsOfState part, int rows, std::vector<Film::Sums>& to) {
  if (to.empty()) return;
  const std::size_t perRow = to.size() / static_cast<std::size_t>(rows);
  parallelFor(static_cast<std::size_t>(rows), [&](std::size_t row) {
    for (std::size_t i = row * perRow; i < (row + 1) * perRow; ++i) {
      Film::Sums sum;
      for (const FilmTerm& term : terms) {
        const Film::Sums& one = (term.film->state().*part)[i];
        sum.r += term.factor * one.r;
        sum.g += term.factor * one.g;
        sum.b += term.factor * one.b;
      }
      sum.weight = (terms.front().film->state().*part)[i].weight;
      to[i] += sum;
    }
  });
}

using SplatsOfState = std::vector<SplatSum> Film::State::*;

bool haveSamePaths(std::span<const FilmTerm> terms) {
  const Film::State& first = terms.front().film->state();
  return std::all_of(terms.begin(), terms.end(), [&](const FilmTerm& term) {
    const Film::State& state = term.film->state();
    return state.paths == first.paths && state.oddPaths == first.oddPaths;
  });
}

/// `to` is empty until some film has splats.
void addSplats(std::span<const FilmTerm> terms, SplatsOfState part, std::size_t pixels,
               std::vector<SplatSum>& to) {
  for (const FilmTerm& term : terms) {
    const std::vector<SplatSum>& splats = term.film->state().*part;
    if (splats.empty()) continue;
    to.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      to[i] += {term.factor * splats[i].r, term.factor * splats[i].g, term.factor * splats[i].b};
    }
  }
}

}  // namespace

bool addCombination(Film& film, std::span<const FilmTerm> terms) {
  CHECK(!terms.empty());
  Film::State sum = film.state();
  for (const FilmTerm& term : terms) {
    CHECK(term.film->state().layers.empty());
    if (term.film->state().odd.size() != sum.odd.size()) return false;
  }
  if (terms.front().film->state().sums.size() != sum.sums.size()) return false;
  if (!haveSameWeights(terms, &Film::State::sums) || !haveSameWeights(terms, &Film::State::odd)) return false;
  if (!haveSamePaths(terms)) return false;
  const int rows = film.pixelBounds().height();
  addPart(terms, &Film::State::sums, rows, sum.sums);
  addPart(terms, &Film::State::odd, rows, sum.odd);
  addSplats(terms, &Film::State::splats, sum.sums.size(), sum.splats);
  addSplats(terms, &Film::State::oddSplats, sum.sums.size(), sum.oddSplats);
  const Film::State& one = terms.front().film->state();
  if (one.paths.count > 0) sum.paths = {sum.paths.count + one.paths.count, one.paths.area};
  sum.oddPaths += one.oddPaths;
  return film.restore(std::move(sum));
}

}  // namespace pbrtmedia
