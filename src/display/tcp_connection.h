// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <functional>
#include <span>
#include <stdexcept>

#include "display/endpoint.h"

namespace pbrtmedia {

/// The other side was given up because it took nothing for too long.
class Stalled : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The name of a host leads nowhere.
class UnknownHost : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A connection to another program that bytes are sent to. Waits no longer than it is told, raises no signal.
class TcpConnection {
 public:
  /// Asked a few times a second while nothing moves, with the seconds for which nothing did: whether to go
  /// on.
  using Patience = std::function<bool(double stalledSeconds)>;

  /// Throws std::runtime_error with the reason: UnknownHost, Stalled when the patience is over. To look up a
  /// name may take as long as the system likes.
  TcpConnection(const Endpoint& to, const Patience& patience);
  ~TcpConnection();
  TcpConnection(TcpConnection&& other) noexcept;
  TcpConnection& operator=(TcpConnection&& other) noexcept;
  TcpConnection(const TcpConnection&) = delete;
  TcpConnection& operator=(const TcpConnection&) = delete;

  /// All of the bytes. Throws as the constructor; then the connection is of no use any more.
  void send(std::span<const char> bytes, const Patience& patience);

 private:
  int socket_ = -1;
};

}  // namespace pbrtmedia
