// SPDX-License-Identifier: BSD-2-Clause
#include "display/tev_sender.h"

#include <pthread.h>

#include <ctime>
#include <utility>

#include "base/stopwatch.h"
#include "display/changed_tiles.h"
#include "display/pace.h"
#include "display/tev_packets.h"

namespace pbrtmedia {
namespace {

constexpr int kTileEdge = 128;          ///< pixels; a packet of 200 kB for RGB
constexpr double kLeastInterval = 0.5;  ///< seconds between updates
constexpr double kShare = 0.01;         ///< of one processor's time, at most, for updates

double threadSeconds() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

TevSender::TevSender(Feed& feed, const Params& params, Notice notice)
    : feed_(feed), params_(params), notice_(std::move(notice)) {
  connect();
  thread_ = std::thread([this] { run(); });
  ::pthread_setname_np(thread_.native_handle(), "display-server");
}

TevSender::~TevSender() {
  thread_.join();
  disconnect();
}

bool TevSender::isPatient(double stalledSeconds) {
  if (!feed_.isClosed()) return stalledSeconds < params_.stallSeconds;
  if (!farewell_) farewell_.emplace();
  return stalledSeconds < params_.farewellSeconds && farewell_->seconds() < params_.mostFarewell;
}

void TevSender::connect() {
  try {
    connection_.emplace(params_.viewer,
                        [this](double s) { return s < params_.connectSeconds && isPatient(s); });
    feed_.attach();
  } catch (const std::exception& e) {
    if (isAbsenceTold_) return;
    isAbsenceTold_ = true;
    absence_ = e.what();
    // To look for a name again may take long each time.
    isGivenUp_ = dynamic_cast<const UnknownHost*>(&e) != nullptr;
    notice_("--display-server " + params_.viewer.toString() + ": nobody shows the image there (" + e.what() +
            "); rendering goes on" +
            (isGivenUp_ ? " without a viewer"
                        : ", and a viewer that is started later is found (tev listens at port " +
                              std::to_string(kTevPort) + ')'));
  }
}

void TevSender::disconnect() {
  if (!connection_) return;
  connection_.reset();
  shown_.reset();
  feed_.detach();
}

void TevSender::show(const std::shared_ptr<const Snapshot>& snapshot) {
  const auto patience = [this](double s) { return isPatient(s); };
  const Image& image = snapshot->image;
  const bool isNew = !shown_ || shown_->title != snapshot->title || shown_->image.width() != image.width() ||
                     shown_->image.height() != image.height() || shown_->image.channels() != image.channels();
  if (isNew) {
    // The viewer may know the name from a connection that broke.
    connection_->send(tev::closeImage(snapshot->title), patience);
    connection_->send(tev::createImage(snapshot->title, image.width(), image.height(), image.channels()),
                      patience);
  }
  for (const Bounds2i& tile : changedTiles(isNew ? nullptr : &shown_->image, image, kTileEdge)) {
    if (!isPatient(0)) throw Stalled("it takes too long");
    connection_->send(tev::updateImage(snapshot->title, image, tile), patience);
  }
  shown_ = snapshot;
}

void TevSender::run() {
  const Pace pace(kLeastInterval, kShare);
  while (!isGivenUp_) {
    const std::shared_ptr<const Snapshot> snapshot =
        feed_.waitForNewer(shown_ ? shown_->sequence : 0, connection_ ? 1.0 : params_.retrySeconds);
    if (!connection_) connect();
    if (connection_ && snapshot) {
      const double before = threadSeconds();
      try {
        show(snapshot);
      } catch (const Stalled&) {
        isGivenUp_ = true;
        notice_("--display-server " + params_.viewer.toString() +
                ": the viewer takes nothing any more and is left alone; rendering goes on");
        disconnect();
      } catch (const std::exception& e) {
        isAbsenceTold_ = true;
        isGivenUp_ = feed_.isClosed();
        notice_("--display-server " + params_.viewer.toString() + ": the viewer is gone (" + e.what() +
                "); rendering goes on, and a viewer that is started again is found");
        disconnect();
      }
      if (!feed_.isClosed()) feed_.waitForClose(pace.interval(threadSeconds() - before));
    } else if (feed_.isClosed()) {
      return;
    } else if (!connection_ && snapshot) {
      feed_.waitForClose(params_.retrySeconds);  // an image that waits for a viewer is no reason to hurry
    }
  }
}

}  // namespace pbrtmedia
