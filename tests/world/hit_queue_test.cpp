// SPDX-License-Identifier: BSD-2-Clause
#include "world/hit_queue.h"

#include <gtest/gtest.h>

#include <vector>

namespace pbrtmedia {
namespace {

HitQueue queueOf(int count) {
  HitQueue queue;
  for (int i = 0; i < count; ++i) queue.add({.hit = {.t = static_cast<float>(i), .id = {}, .uv = {}}});
  return queue;
}
std::vector<float> timesOf(const HitQueue& queue) {
  std::vector<float> times;
  for (std::size_t i = 0; i < queue.size(); ++i) times.push_back(queue[i].t());
  return times;
}

TEST(HitQueue, KeepsTheOrderInPlaceAndBeyond) {
  HitQueue queue = queueOf(7);
  EXPECT_EQ(timesOf(queue), (std::vector<float>{0, 1, 2, 3, 4, 5, 6}));
  queue.erase(4);
  queue.erase(1);
  EXPECT_EQ(timesOf(queue), (std::vector<float>{0, 2, 3, 5, 6}));
  EXPECT_EQ(queue.front().t(), 0);
  for (int left = 4; left >= 1; --left) queue.erase(0);
  EXPECT_EQ(timesOf(queue), (std::vector<float>{6}));
  queue.add({.hit = {.t = 9, .id = {}, .uv = {}}});
  EXPECT_EQ(timesOf(queue), (std::vector<float>{6, 9}));
  queue.clear();
  EXPECT_TRUE(queue.isEmpty());
}

TEST(HitQueue, CopiesAreTheirOwn) {
  for (const int count : {0, 2, 7}) {
    HitQueue queue = queueOf(count), assigned = queueOf(5);
    const HitQueue copy = queue;
    assigned = queue;
    queue.add({.hit = {.t = 9, .id = {}, .uv = {}}});
    EXPECT_EQ(timesOf(copy), timesOf(queueOf(count))) << count;
    EXPECT_EQ(timesOf(assigned), timesOf(queueOf(count))) << count;
  }
}

}  // namespace
}  // namespace pbrtmedia
