// SPDX-License-Identifier: BSD-2-Clause
#include "display/feed.h"

#include <utility>

namespace pbrtmedia {
namespace {

using Clock = std::chrono::steady_clock;

Clock::duration duration(double seconds) {
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

}  // namespace

bool Feed::isWatched() const {
  return attached_ > 0 || Clock::now().time_since_epoch().count() < wantedUntil_;
}

void Feed::want(double seconds) {
  wantedUntil_ = (Clock::now() + duration(seconds)).time_since_epoch().count();
}

void Feed::give(std::string title, Image image) {
  auto snapshot = std::make_shared<Snapshot>();
  snapshot->title = std::move(title);
  snapshot->image = std::move(image);
  {
    const std::lock_guard lock(mutex_);
    snapshot->sequence = latest_ ? latest_->sequence + 1 : 1;
    latest_ = std::move(snapshot);
  }
  changed_.notify_all();
}

std::shared_ptr<const Snapshot> Feed::latest() const {
  const std::lock_guard lock(mutex_);
  return latest_;
}

std::shared_ptr<const Snapshot> Feed::waitForNewer(std::uint64_t sequence, double seconds) const {
  std::unique_lock lock(mutex_);
  const auto isNewer = [&] { return latest_ && latest_->sequence > sequence; };
  changed_.wait_for(lock, duration(seconds), [&] { return isClosed_ || isNewer(); });
  return isNewer() ? latest_ : nullptr;
}

void Feed::update(const std::function<void(RenderStatus&)>& change) {
  const std::lock_guard lock(mutex_);
  change(status_);
}

RenderStatus Feed::status() const {
  const std::lock_guard lock(mutex_);
  return status_;
}

void Feed::close() {
  {
    const std::lock_guard lock(mutex_);
    isClosed_ = true;
  }
  changed_.notify_all();
}

bool Feed::isClosed() const {
  const std::lock_guard lock(mutex_);
  return isClosed_;
}

bool Feed::waitForClose(double seconds) const {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, duration(seconds), [this] { return isClosed_; });
}

}  // namespace pbrtmedia
