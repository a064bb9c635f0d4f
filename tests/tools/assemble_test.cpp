// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <stdexcept>

#include "tools/imgtool/assemble.h"

namespace pbrtmedia {
namespace {

constexpr Bounds2i kDisplay{{10, 20}, {14, 22}};

NamedImage tile(const std::string& name, Bounds2i window, float value) {
  NamedImage out{name, Image(window.width(), window.height(), {"Y"})};
  for (float& v : out.image.data()) v = value;
  out.image.dataWindow = window;
  out.image.displayWindow = kDisplay;
  out.image.metadata = {{"sceneHash", "abc"}, {"command", name}};
  return out;
}

TEST(AssembleTiles, PutsTilesWhereTheirDataWindowsSay) {
  const Assembly a =
      assembleTiles({tile("right", {{12, 20}, {14, 22}}, 2), tile("left", {{10, 20}, {12, 22}}, 1)});
  EXPECT_EQ(a.image.data(), (std::vector<float>{1, 1, 2, 2, 1, 1, 2, 2}));
  EXPECT_EQ(a.image.dataWindow, kDisplay);
  EXPECT_EQ(a.image.displayWindow, kDisplay);
  EXPECT_EQ(a.missing, 0);
  EXPECT_EQ(a.overlapping, 0);
  EXPECT_EQ(a.image.metadata,
            (std::map<std::string, std::string>{{"sceneHash", "abc"}, {"command", "right\nleft"}}));
}

TEST(AssembleTiles, CountsGapsAndSaysWhereTheFirstIs) {
  const Assembly a =
      assembleTiles({tile("top", {{10, 20}, {14, 21}}, 1), tile("b", {{10, 21}, {11, 22}}, 2)});
  EXPECT_EQ(a.missing, 3);
  EXPECT_EQ(a.firstMissing, (Point2i{11, 21}));
  EXPECT_EQ(a.image.data(), (std::vector<float>{1, 1, 1, 1, 2, 0, 0, 0}));
}

TEST(AssembleTiles, CountsOverlapsAndContradictions) {
  const Assembly same = assembleTiles({tile("a", kDisplay, 1), tile("b", {{10, 20}, {12, 21}}, 1)});
  EXPECT_EQ(same.overlapping, 2);
  EXPECT_EQ(same.contradicting, 0);
  const Assembly other = assembleTiles({tile("a", kDisplay, 1), tile("b", {{10, 20}, {12, 21}}, 5)});
  EXPECT_EQ(other.contradicting, 2);
  EXPECT_EQ(other.image.at(0, 0, 0), 5);
}

void expectRefused(const std::vector<NamedImage>& tiles, const std::string& part) {
  try {
    assembleTiles(tiles);
    ADD_FAILURE() << "assembled; expected an error with \"" << part << "\"";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
  }
}

TEST(AssembleTiles, KeepsThatBoundsOfATileWereRising) {
  NamedImage left = tile("left", {{10, 20}, {12, 22}}, 1), right = tile("right", {{12, 20}, {14, 22}}, 2);
  const auto stateOf = [&](const char* ofLeft, const char* ofRight) {
    left.image.metadata["boundsState"] = ofLeft;
    right.image.metadata["boundsState"] = ofRight;
    const Assembly a = assembleTiles({left, right});
    return a.image.metadata.count("boundsState") > 0 ? a.image.metadata.at("boundsState") : "none";
  };
  EXPECT_EQ(stateOf("settled", "settled"), "settled");
  EXPECT_EQ(stateOf("settled", "rising"), "rising");
  EXPECT_EQ(stateOf("rising", "cached"), "rising");
  EXPECT_EQ(stateOf("settled", "cached"), "none");
}

TEST(AssembleTiles, RefusesTilesThatDoNotBelongTogether) {
  const NamedImage a = tile("a.exr", kDisplay, 1);
  expectRefused({}, "nothing to assemble");
  NamedImage b = a;
  b.name = "b.exr";
  b.image.displayWindow.max.x += 1;
  expectRefused({a, b}, "a.exr and b.exr: different display windows");
  expectRefused({tile("c.exr", {{9, 20}, {11, 21}}, 1)}, "c.exr: the data window (9, 20) - (11, 21) leaves");
  NamedImage rgb{"rgb.exr", Image(4, 2)};
  rgb.image.dataWindow = rgb.image.displayWindow = kDisplay;
  expectRefused({a, rgb}, "different channels");
  NamedImage giant = a;
  giant.image.displayWindow = {{0, 0}, {1000000, 1000000}};
  expectRefused({giant}, "too large");
}

}  // namespace
}  // namespace pbrtmedia
