// SPDX-License-Identifier: BSD-2-Clause
#include "display/feed.h"

#include <gtest/gtest.h>

#include <thread>

#include "base/stopwatch.h"
#include "display/pace.h"

namespace pbrtmedia {
namespace {

Image grey(float value) {
  Image image(2, 1);
  for (float& v : image.data()) v = value;
  return image;
}

TEST(Feed, IsWatchedWhileSomebodyIsAttachedOrAskedLately) {
  Feed feed;
  EXPECT_FALSE(feed.isWatched());
  feed.attach();
  feed.attach();
  feed.detach();
  EXPECT_TRUE(feed.isWatched());
  feed.detach();
  EXPECT_FALSE(feed.isWatched());
  feed.want(0.05);
  EXPECT_TRUE(feed.isWatched());
  std::this_thread::sleep_for(std::chrono::milliseconds(60));
  EXPECT_FALSE(feed.isWatched());
}

TEST(Feed, GivesTheLatestOnly) {
  Feed feed;
  EXPECT_EQ(feed.latest(), nullptr);
  feed.give("a", grey(1));
  feed.give("b", grey(2));
  const auto snapshot = feed.waitForNewer(0, 0);
  ASSERT_NE(snapshot, nullptr);
  EXPECT_EQ(snapshot->sequence, 2u);
  EXPECT_EQ(snapshot->title, "b");
  EXPECT_EQ(snapshot->image.at(0, 0, 0), 2);
  EXPECT_EQ(feed.waitForNewer(2, 0), nullptr);
}

TEST(Feed, WakesThoseWhoWait) {
  Feed feed;
  std::shared_ptr<const Snapshot> got;
  std::thread waiting([&] { got = feed.waitForNewer(0, 60); });
  feed.give("a", grey(1));
  waiting.join();
  ASSERT_NE(got, nullptr);
  bool isClosed = false;
  std::thread waitingForMore([&] {
    got = feed.waitForNewer(1, 60);
    isClosed = feed.waitForClose(60);
  });
  feed.close();
  waitingForMore.join();
  EXPECT_EQ(got, nullptr);
  EXPECT_TRUE(isClosed);
}

TEST(Feed, KeepsItsLastImageWhenItIsClosed) {
  Feed feed;
  feed.give("a", grey(1));
  feed.close();
  EXPECT_TRUE(feed.isClosed());
  EXPECT_NE(feed.waitForNewer(0, 60), nullptr);
}

TEST(Feed, WhoGivesDoesNotWaitForWhoTakes) {
  Feed feed;
  feed.give("a", grey(1));
  const auto held = feed.latest();  // a viewer that is busy with it
  for (int i = 0; i < 100; ++i) feed.give("b", grey(2));
  EXPECT_EQ(held->title, "a");
  EXPECT_EQ(held->image.at(1, 0, 2), 1);
  EXPECT_EQ(feed.latest()->sequence, 101u);
}

TEST(Feed, CarriesTheStatus) {
  Feed feed;
  EXPECT_EQ(feed.status().phase, "reading");
  feed.update([](RenderStatus& s) { s.samplesDone = 7; });
  EXPECT_EQ(feed.status().samplesDone, 7u);
}

TEST(Pace, IsDueAtOnceThenAfterTheInterval) {
  Pace pace(0.5, 0.01);
  EXPECT_TRUE(pace.isDue(-3));
  pace.done(10, 0.001);
  EXPECT_FALSE(pace.isDue(10.49));
  EXPECT_TRUE(pace.isDue(10.5));
}

TEST(Pace, LetsACostlyTaskTakeItsShareOnly) {
  Pace pace(0.5, 0.01);
  pace.done(10, 0.02);
  EXPECT_FALSE(pace.isDue(11.99));
  EXPECT_TRUE(pace.isDue(12));
}

}  // namespace
}  // namespace pbrtmedia
