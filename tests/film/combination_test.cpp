// SPDX-License-Identifier: BSD-2-Clause
#include "film/combination.h"

#include <gtest/gtest.h>

#include <array>

#include "filters/box.h"

namespace pbrtmedia {
namespace {

/// Two pixels, of which the second has twice the radiance.
Film film(float radiance, int samples = 1, bool halves = false) {
  Film film({.resolution = {2, 1}}, BoxFilter({}));
  film.keepNegatives();
  if (halves) film.keepHalves();
  SamplePass pass(film.sampleBounds(), samples);
  for (int x = 0; x < 2; ++x) {
    for (int s = 0; s < samples; ++s)
      pass.at({x, 0}, s) = {{.5f, .5f}, Rgb(1, 2, 3) * (radiance * static_cast<float>(x + 1)), true};
  }
  film.accumulate(pass);
  return film;
}

TEST(Combination, IsOfEachColour) {
  Film sum = film(10);
  const Film a = film(5), b = film(1);
  const std::array terms = {FilmTerm{&a, 2}, FilmTerm{&b, -16}};
  ASSERT_TRUE(addCombination(sum, terms));
  // The mean of two samples: of 10, and of 2 * 5 - 16.
  EXPECT_EQ(sum.develop().rgb(0, 0), Rgb(2, 4, 6));
  EXPECT_EQ(sum.develop().rgb(1, 0), Rgb(4, 8, 12));
}

TEST(Combination, HasHalves) {
  Film sum({.resolution = {2, 1}}, BoxFilter({}));
  sum.keepHalves();
  const Film a = film(5, 2, true), b = film(4, 2, true);
  const std::array terms = {FilmTerm{&a, 1}, FilmTerm{&b, -1}};
  ASSERT_TRUE(addCombination(sum, terms));
  EXPECT_EQ(sum.state().odd[0], (WeightedSums{1, 2, 3, 1}));
  EXPECT_EQ(sum.state().sums[0], (WeightedSums{2, 4, 6, 2}));
  const Film without = film(4, 2);
  const std::array other = {FilmTerm{&a, 1}, FilmTerm{&without, -1}};
  EXPECT_FALSE(addCombination(sum, other));
}

/// One path brings `value` to the first pixel, another nothing.
Film withSplat(float value, bool halves = false) {
  Film film({.resolution = {2, 1}}, BoxFilter({}));
  film.keepNegatives();
  if (halves) film.keepHalves();
  SplatBuffer splats;
  splats.begin(1, /*isOdd=*/true);
  splats.add({.5f, .5f}, Rgb(value, 0, 0));
  film.addSplats({&splats, 1}, {2, 1}, 1);
  return film;
}

TEST(Combination, HasSplatsOfAsManyPathsAsOneFilm) {
  Film sum({.resolution = {2, 1}}, BoxFilter({}));
  sum.keepNegatives();
  const Film a = withSplat(5), b = withSplat(4);
  const std::array terms = {FilmTerm{&a, 2}, FilmTerm{&b, -3}};
  for (int pass = 0; pass < 2; ++pass) ASSERT_TRUE(addCombination(sum, terms));
  EXPECT_EQ(sum.state().splats[0], (SplatSum{-4, 0, 0}));
  EXPECT_EQ(sum.state().splats[1], SplatSum{});
  EXPECT_EQ(sum.state().paths, (SplatPaths{4, 1}));
  EXPECT_EQ(sum.state().oddPaths, 2u);
  EXPECT_TRUE(sum.state().oddSplats.empty());
  EXPECT_EQ(sum.develop().rgb(0, 0).r, -1) << "the mean of four paths";
}

TEST(Combination, HasSplatsOfHalves) {
  Film sum({.resolution = {2, 1}}, BoxFilter({}));
  sum.keepHalves();
  const Film a = withSplat(5, true), b = withSplat(4, true);
  const std::array terms = {FilmTerm{&a, 2}, FilmTerm{&b, -3}};
  ASSERT_TRUE(addCombination(sum, terms));
  EXPECT_EQ(sum.state().oddSplats[0], (SplatSum{-2, 0, 0}));
}

TEST(Combination, IsRefusedWherePathsAreOthers) {
  Film sum({.resolution = {2, 1}}, BoxFilter({}));
  const Film a = withSplat(5), b({.resolution = {2, 1}}, BoxFilter({}));
  const std::array terms = {FilmTerm{&a, 1}, FilmTerm{&b, -1}};
  EXPECT_FALSE(addCombination(sum, terms));
}

TEST(Combination, IsRefusedWhereSamplesWeighDifferently) {
  Film sum = film(10);
  const Film::State before = sum.state();
  const Film a = film(5), b = film(5, 2), c({.resolution = {3, 1}}, BoxFilter({}));
  for (const Film* other : {&b, &c}) {
    const std::array terms = {FilmTerm{&a, 1}, FilmTerm{other, -1}};
    EXPECT_FALSE(addCombination(sum, terms));
  }
  EXPECT_EQ(sum.state(), before);
}

}  // namespace
}  // namespace pbrtmedia
