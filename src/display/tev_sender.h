// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "base/stopwatch.h"
#include "display/feed.h"
#include "display/tcp_connection.h"

namespace pbrtmedia {

/// Sends what comes in a feed to the image viewer tev, or to another program that listens for its packets:
/// the tiles that changed, on a thread of its own. A viewer that is absent, slow or dies is told once and
/// costs the render nothing; one that comes later, or comes back, gets the whole image.
class TevSender {
 public:
  struct Params {
    Endpoint viewer{};
    double connectSeconds = 2;   ///< of waiting for an answer
    double retrySeconds = 2;     ///< between attempts
    double stallSeconds = 10;    ///< a viewer that takes nothing for so long gets nothing any more
    double farewellSeconds = 2;  ///< the same for the last image, which the program waits for
    double mostFarewell = 30;    ///< all of it
  };
  /// Gets one line without a full stop; called on any thread.
  using Notice = std::function<void(const std::string&)>;

  /// Tries to connect before it returns. `feed` and what `notice` refers to must outlive the object.
  TevSender(Feed& feed, const Params& params, Notice notice);
  /// The feed must be closed: sends its last image, and ends.
  ~TevSender();
  TevSender(const TevSender&) = delete;
  TevSender& operator=(const TevSender&) = delete;

  /// Why there was no viewer at the start; "": there was one.
  const std::string& absence() const { return absence_; }

 private:
  void run();
  void connect();
  void disconnect();
  void show(const std::shared_ptr<const Snapshot>& snapshot);
  bool isPatient(double stalledSeconds);

  Feed& feed_;
  Params params_;
  Notice notice_;
  std::optional<TcpConnection> connection_;
  std::shared_ptr<const Snapshot> shown_;  ///< by the viewer of this connection
  std::string absence_;
  bool isAbsenceTold_ = false, isGivenUp_ = false;
  std::optional<Stopwatch> farewell_;
  std::thread thread_;
};

}  // namespace pbrtmedia
