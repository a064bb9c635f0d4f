// SPDX-License-Identifier: BSD-2-Clause
#include "display/tev_packets.h"

#include <gtest/gtest.h>

#include "support/tev_viewer.h"

namespace pbrtmedia::test {
namespace {

std::string bytes(const tev::Packet& packet) { return {packet.begin(), packet.end()}; }

TEST(TevPackets, OfACreatedImageIsThisVeryText) {
  const std::string expected("\x19\0\0\0\x04\0ab\0\x03\0\0\0\x02\0\0\0\x02\0\0\0R\0Z\0", 25);
  EXPECT_EQ(bytes(tev::createImage("ab", 3, 2, {"R", "Z"})), expected);
}

TEST(TevPackets, OfAClosedImageIsThisVeryText) {
  EXPECT_EQ(bytes(tev::closeImage("ab")), std::string("\x08\0\0\0\x02"
                                                      "ab\0",
                                                      8));
}

TEST(TevPackets, OfAnUpdateIsThisVeryText) {
  Image image(2, 1, {"R", "Z"});
  image.at(1, 0, 0) = 1;   // 00 00 80 3f
  image.at(1, 0, 1) = -2;  // 00 00 00 c0
  std::string expected("\0\0\0\0\x06\0a\0\x02\0\0\0R\0Z\0", 16);
  expected += std::string("\x01\0\0\0\0\0\0\0\x01\0\0\0\x01\0\0\0", 16);  // x, y, width, height
  expected += std::string("\0\0\0\0\0\0\0\0\x01\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0\x02\0\0\0\0\0\0\0",
                          32);  // offsets, strides
  expected += std::string("\0\0\x80\x3f\0\0\0\xc0", 8);
  expected[0] = static_cast<char>(expected.size());
  EXPECT_EQ(bytes(tev::updateImage("a", image, {{1, 0}, {2, 1}})), expected);
}

TEST(TevPackets, TilesPutAnImageTogetherAgain) {
  const std::vector<std::string> channels = {"R", "G", "B", "albedo.R", "Z", "N.X"};
  Image image(7, 5, channels);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<float>(i) / 7;
  TevPackets viewer;
  viewer.take(bytes(tev::createImage("a", 7, 5, channels)));
  for (const Bounds2i tile : {Bounds2i{{0, 0}, {4, 3}}, {{4, 0}, {7, 3}}, {{0, 3}, {7, 5}}})
    viewer.take(bytes(tev::updateImage("a", image, tile)));
  const ViewerImage& shown = viewer.images.at("a");
  for (int y = 0; y < 5; ++y)
    for (int x = 0; x < 7; ++x)
      for (std::size_t c = 0; c < channels.size(); ++c)
        EXPECT_EQ(shown.planes.at(channels[c])[static_cast<std::size_t>(7 * y + x)], image.at(x, y, c));
  viewer.take(bytes(tev::closeImage("a")));
  EXPECT_TRUE(viewer.images.empty());
}

}  // namespace
}  // namespace pbrtmedia::test
