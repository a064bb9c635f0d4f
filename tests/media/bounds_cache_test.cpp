// SPDX-License-Identifier: BSD-2-Clause
#include "media/bounds_cache.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "base/diagnostics.h"
#include "fields/learned_bounds.h"
#include "media/grid_medium.h"
#include "support/grids.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

std::unique_ptr<Medium> medium(const std::string& name = "m", int cells = 2, float epsilon = .25f,
                               float slack = 0) {
  GridMediumParams params;
  params.name = name;
  params.sigmaA = params.sigmaS = Rgb(1);
  params.grid = {.nx = 2, .ny = 2, .nz = 2, .density = {1, 2, 3, 4, 5, 6, 7, 8}};
  params.bounds.source = BoundsParams::Source::Progressive;
  params.bounds.cells = {{cells, cells, cells}};
  params.bounds.epsilon = epsilon;
  params.bounds.slack = slack;
  return makeGridMedium(params, Transform());
}

/// The same after some look-ups.
std::unique_ptr<Medium> learned(const std::string& name = "m") {
  std::unique_ptr<Medium> m = medium(name);
  Rng rng(1);
  RenderCounters counters;
  for (int pass = 0; pass < 4; ++pass) {
    for (int n = 0; n < 500; ++n) {
      m->transmittance({{-1, rng.uniform(), rng.uniform()}, {1, 0, 0}, 0, 3}, rng, counters);
    }
    m->learnedBounds()->publish();
  }
  return m;
}

std::string textOf(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class BoundsCacheFile : public testing::Test {
 protected:
  std::string failure(const std::string& text) const {
    std::ofstream(path_, std::ios::binary) << text;
    try {
      BoundsCache::read(path_);
    } catch (const SceneError& e) {
      EXPECT_NE(e.location().file, nullptr);
      return e.what();
    }
    return "";
  }
  TemporaryFolder folder_;
  std::filesystem::path path_ = folder_.path() / "b.bounds";
};

TEST_F(BoundsCacheFile, StartsAnotherMediumWithWhatWasLearned) {
  const auto first = learned(), other = learned("other");
  ASSERT_GT(first->learnedBounds()->inForce().maximum(), 1.0f);
  BoundsCache cache;
  cache.keep("scene", *first);
  cache.keep("scene", *other);
  cache.keep("another scene", *medium());
  cache.write(path_);
  const BoundsCache back = BoundsCache::read(path_);
  EXPECT_EQ(back.size(), 3u);
  const auto second = medium();
  EXPECT_EQ(back.restore("scene", *second), "");
  EXPECT_EQ(second->learnedBounds()->save(), first->learnedBounds()->save());
  back.write(folder_.path() / "again");
  EXPECT_EQ(textOf(path_), textOf(folder_.path() / "again")) << "reading and writing change no byte";
}

TEST_F(BoundsCacheFile, IsTheSameOnEveryMachine) {
  BoundsCache cache;
  cache.keep("s", *medium("m", 0, 3));
  cache.write(path_);
  // sigma_t is 2: epsilon 3 is a density of 1.5, the first bound one of 0.005.
  const std::string expected = std::string("pbrt-media bounds 1\n") + std::string("\1\0\0\0\0\0\0\0", 8) +
                               std::string("\1\0\0\0s\1\0\0\0m", 10) + std::string("\1\0\0\0\0\0\0\0", 8) +
                               std::string("\1\0\0\0\0\0\0\0", 8) + std::string("\1\0\0\0\0\0\0\0", 8) +
                               std::string("\0\0\xc0\x3f\0\0\0\0", 8) +
                               std::string("\x0a\xd7\xa3\x3b\0\0\0\0", 8);
  const std::string found = textOf(path_);
  EXPECT_EQ(found.substr(0, found.size() - 8), expected);
}

TEST_F(BoundsCacheFile, SaysWhyAMediumStartsAfresh) {
  BoundsCache cache;
  cache.keep("scene", *learned());
  for (const auto& [m, reason] :
       {std::pair(medium("n"), "does not know this medium of scene \"scene\""),
        std::pair(medium("m", 3),
                  "the cache has 2 x 2 x 2 super-voxels, epsilon 0.125 and slack 0; here there are 3"),
        std::pair(medium("m", 2, .5f), "here there are 2 x 2 x 2 super-voxels, epsilon 0.25 and slack 0"),
        std::pair(medium("m", 2, .25f, .5f),
                  "here there are 2 x 2 x 2 super-voxels, epsilon 0.125 and slack 0.5")}) {
    const std::vector<float> before = m->learnedBounds()->save();
    EXPECT_NE(cache.restore("scene", *m).find(reason), std::string::npos) << cache.restore("scene", *m);
    EXPECT_EQ(m->learnedBounds()->save(), before);
  }
  EXPECT_NE(cache.restore("other", *medium()), "");
}

TEST_F(BoundsCacheFile, IsRefusedWhenBroken) {
  BoundsCache cache;
  cache.keep("scene", *learned());
  cache.write(path_);
  const std::string good = textOf(path_);
  EXPECT_EQ(failure(good), "");
  for (std::size_t length = 0; length < good.size(); ++length)
    ASSERT_NE(failure(good.substr(0, length)), "") << length;
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 1);
    ASSERT_NE(failure(bad), "") << at;
  }
  EXPECT_NE(failure(good + "x"), "");
  EXPECT_EQ(failure("PNG"), "bounds cache: this is no such file");
  std::string newer = good;
  newer[18] = '2';
  EXPECT_EQ(failure(newer), "bounds cache: version 2, expected 1");
}

}  // namespace
}  // namespace pbrtmedia
