// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>

#include "display/status.h"
#include "image/image.h"

namespace pbrtmedia {

/// An image on its way.
struct Snapshot {
  std::uint64_t sequence = 0;  ///< counts from 1
  std::string title;
  Image image;
};

/// Hands the image so far and the state of a render from the thread that renders to those who show them. Who
/// renders never waits: it leaves the latest here, and a slow viewer misses what came in between.
/// Thread-safe.
class Feed {
 public:
  /// Whether somebody wants images now: who renders need not make any else.
  bool isWatched() const;
  /// Wants images from now on, until `detach`; counted.
  void attach() { ++attached_; }
  void detach() { --attached_; }
  /// Wants images for so long.
  void want(double seconds);

  void give(std::string title, Image image);
  /// The latest; null: none yet.
  std::shared_ptr<const Snapshot> latest() const;
  /// One that is newer than `sequence`, as soon as there is one; null when there is none after so many
  /// seconds or the feed is closed without one.
  std::shared_ptr<const Snapshot> waitForNewer(std::uint64_t sequence, double seconds) const;

  void update(const std::function<void(RenderStatus&)>& change);
  RenderStatus status() const;

  /// Nothing comes any more.
  void close();
  bool isClosed() const;
  /// Waits so long, or until the feed is closed. Whether it is.
  bool waitForClose(double seconds) const;

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  std::shared_ptr<const Snapshot> latest_;
  RenderStatus status_;
  bool isClosed_ = false;
  std::atomic<int> attached_{0};
  std::atomic<std::chrono::steady_clock::rep> wantedUntil_{0};
};

}  // namespace pbrtmedia
