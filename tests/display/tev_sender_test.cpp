// SPDX-License-Identifier: BSD-2-Clause
#include "display/tev_sender.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <mutex>
#include <thread>

#include "support/tev_viewer.h"

namespace pbrtmedia::test {
namespace {

Image ramp(int width, int height, float first, const std::vector<std::string>& channels = {"R", "G", "B"}) {
  Image image(width, height, channels);
  for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = first + static_cast<float>(i);
  return image;
}

bool shows(const TevPackets& viewer, const std::string& name, const Image& image) {
  const auto found = viewer.images.find(name);
  if (found == viewer.images.end() || found->second.width != image.width() ||
      found->second.height != image.height())
    return false;
  for (std::size_t c = 0; c < image.channelCount(); ++c) {
    const auto plane = found->second.planes.find(image.channels()[c]);
    if (plane == found->second.planes.end()) return false;
    for (std::size_t i = 0; i < plane->second.size(); ++i)
      if (plane->second[i] != image.data()[i * image.channelCount() + c]) return false;
  }
  return found->second.planes.size() == image.channelCount();
}

class TevSenderTest : public testing::Test {
 protected:
  TevSender::Params to(int port) const {
    TevSender::Params params;
    params.viewer = {"127.0.0.1", port};
    params.retrySeconds = 0.05;
    return params;
  }
  TevSender::Notice notice() {
    return [this](const std::string& text) {
      const std::lock_guard lock(mutex_);
      notices_ += text + '\n';
    };
  }
  std::string notices() {
    const std::lock_guard lock(mutex_);
    return notices_;
  }
  /// A port where nobody listens.
  static int emptyPort() { return TevViewer().port(); }

  Feed feed_;
  std::mutex mutex_;
  std::string notices_;
};

TEST_F(TevSenderTest, ShowsEveryImageBitForBit) {
  TevViewer viewer;
  const Image first = ramp(300, 200, 0.1f), second = ramp(300, 200, -7);
  {
    TevSender sender(feed_, to(viewer.port()), notice());
    EXPECT_EQ(sender.absence(), "");
    EXPECT_TRUE(feed_.isWatched());
    feed_.give("a", first);
    EXPECT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "a", first); }));
    feed_.give("a", second);
    feed_.close();
  }
  EXPECT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "a", second); }));
  EXPECT_EQ(viewer.packets().created, 1);
  EXPECT_EQ(viewer.problem(), "");
  EXPECT_EQ(notices(), "");
  EXPECT_FALSE(feed_.isWatched());
}

TEST_F(TevSenderTest, SendsTilesThatChangedOnly) {
  TevViewer viewer;
  Image image = ramp(300, 200, 0);
  {
    TevSender sender(feed_, to(viewer.port()), notice());
    feed_.give("a", image);
    ASSERT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "a", image); }));
    EXPECT_EQ(viewer.packets().updates, 6);
    EXPECT_EQ(viewer.packets().pixelsUpdated, 60000u);
    image.at(299, 199, 1) = -1;
    feed_.give("a", image);
    feed_.close();
  }
  EXPECT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "a", image); }));
  EXPECT_EQ(viewer.packets().updates, 7);
  EXPECT_EQ(viewer.packets().pixelsUpdated, 60000u + 44 * 72);
}

TEST_F(TevSenderTest, ShowsAllChannelsAndAnImageOfAnotherKind) {
  TevViewer viewer;
  const Image colours = ramp(9, 9, 1), layered = ramp(9, 9, 2, {"R", "G", "B", "albedo.R", "Z", "N.X", "A"}),
              large = ramp(200, 9, 3);
  {
    TevSender sender(feed_, to(viewer.port()), notice());
    for (const Image* image : {&colours, &layered, &large}) {
      feed_.give("a", *image);
      EXPECT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "a", *image); }));
    }
    feed_.give("b", colours);
    feed_.close();
  }
  EXPECT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "b", colours); }));
  EXPECT_TRUE(shows(viewer.packets(), "a", large)) << "an earlier image stays for comparison";
  EXPECT_EQ(viewer.problem(), "");
}

TEST_F(TevSenderTest, TellsOnceThatNobodyListensAndFindsAViewerLater) {
  const int port = emptyPort();
  TevSender sender(feed_, to(port), notice());
  EXPECT_EQ(sender.absence(), "Connection refused");
  EXPECT_FALSE(feed_.isWatched()) << "no image is to be made for nobody";
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const std::string told = notices();
  EXPECT_NE(told.find("--display-server 127.0.0.1:" + std::to_string(port) +
                      ": nobody shows the image there (Connection refused)"),
            std::string::npos)
      << told;
  EXPECT_EQ(std::count(told.begin(), told.end(), '\n'), 1) << told;
  const Image image = ramp(5, 5, 1);
  feed_.give("a", image);
  const TevViewer viewer({.port = port});
  EXPECT_TRUE(viewer.waitFor([&](const TevPackets& p) { return shows(p, "a", image); }));
  EXPECT_TRUE(feed_.isWatched());
  feed_.close();
}

TEST_F(TevSenderTest, DoesNotLookForAnUnknownHostAgain) {
  TevSender::Params params = to(14158);
  params.viewer.host = "viewer.invalid";
  TevSender sender(feed_, params, notice());
  EXPECT_NE(sender.absence(), "");
  EXPECT_NE(notices().find("rendering goes on without a viewer"), std::string::npos) << notices();
  EXPECT_FALSE(feed_.isWatched());
  feed_.close();
}

TEST_F(TevSenderTest, OutlivesAViewerThatDiesAndFindsTheNext) {
  int port = 0;
  TevSender::Params params;
  {
    TevViewer viewer({.packetsBeforeDeath = 3});
    port = viewer.port();
    params = to(port);
    params.farewellSeconds = 0.5;
  }
  auto first = std::make_unique<TevViewer>(TevViewer::Manners{.packetsBeforeDeath = 3, .port = port});
  TevSender sender(feed_, params, notice());
  for (int i = 0; i < 400 && notices().empty(); ++i) {
    feed_.give("a", ramp(300, 200, static_cast<float>(i)));
    std::this_thread::sleep_for(std::chrono::milliseconds(25));
  }
  EXPECT_TRUE(first->isDead());
  EXPECT_NE(notices().find("the viewer is gone"), std::string::npos) << notices();
  first.reset();
  const TevViewer second({.port = port});
  const Image last = ramp(300, 200, -1);
  feed_.give("a", last);
  EXPECT_TRUE(second.waitFor([&](const TevPackets& p) { return shows(p, "a", last); }));
  EXPECT_EQ(second.problem(), "");
  feed_.close();
}

TEST_F(TevSenderTest, LeavesAViewerAloneThatReadsNothing) {
  const TevViewer viewer({.reads = false});
  TevSender::Params params = to(viewer.port());
  params.stallSeconds = 0.3;
  TevSender sender(feed_, params, notice());
  feed_.give("a", ramp(2000, 2000, 0));  // more than the system keeps for it
  for (int i = 0; i < 1000 && notices().empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_NE(notices().find("takes nothing any more and is left alone"), std::string::npos) << notices();
  EXPECT_FALSE(feed_.isWatched());
  feed_.close();
}

TEST_F(TevSenderTest, DoesNotWaitLongInTheEnd) {
  const TevViewer viewer({.reads = false});
  TevSender::Params params = to(viewer.port());
  params.stallSeconds = 60;
  params.farewellSeconds = 0.2;
  const Stopwatch watch;
  {
    TevSender sender(feed_, params, notice());
    feed_.give("a", ramp(2000, 2000, 0));
    feed_.close();
  }
  EXPECT_LT(watch.seconds(), 20);
}

}  // namespace
}  // namespace pbrtmedia::test
