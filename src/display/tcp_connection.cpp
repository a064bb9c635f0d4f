// SPDX-License-Identifier: BSD-2-Clause
#include "display/tcp_connection.h"

#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include "base/stopwatch.h"

namespace pbrtmedia {
namespace {

constexpr int kSlice = 100;  ///< milliseconds between questions to the patience

std::string reasonOf(int error) { return std::strerror(error); }

void waitUntilWritable(int socket, const Stopwatch& stalled, const TcpConnection::Patience& patience) {
  for (;;) {
    pollfd wanted{.fd = socket, .events = POLLOUT, .revents = 0};
    const int ready = ::poll(&wanted, 1, kSlice);
    if (ready > 0) return;  // an error too: the next call tells it
    if (ready < 0 && errno != EINTR) throw std::runtime_error(reasonOf(errno));
    if (!patience(stalled.seconds())) throw Stalled("it takes nothing");
  }
}

/// A connected socket; throws.
int connectTo(const addrinfo& address, const TcpConnection::Patience& patience) {
  const int socket =
      ::socket(address.ai_family, address.ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, address.ai_protocol);
  if (socket < 0) throw std::runtime_error(reasonOf(errno));
  try {
    const Stopwatch stalled;
    if (::connect(socket, address.ai_addr, address.ai_addrlen) != 0) {
      if (errno != EINPROGRESS) throw std::runtime_error(reasonOf(errno));
      waitUntilWritable(socket, stalled, patience);
      int error = 0;
      socklen_t size = sizeof error;
      ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &error, &size);
      if (error != 0) throw std::runtime_error(reasonOf(error));
    }
    const int on = 1;  // the last tile of an update shall not wait for the next update
    ::setsockopt(socket, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  } catch (...) {
    ::close(socket);
    throw;
  }
  return socket;
}

}  // namespace

TcpConnection::TcpConnection(const Endpoint& to, const Patience& patience) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(to.host.c_str(), std::to_string(to.port).c_str(), &hints, &found);
  if (failed != 0) throw UnknownHost(::gai_strerror(failed));
  const std::unique_ptr<addrinfo, void (*)(addrinfo*)> addresses(found, ::freeaddrinfo);
  for (const addrinfo* address = addresses.get(); address; address = address->ai_next) {
    try {
      socket_ = connectTo(*address, patience);
      return;
    } catch (const std::runtime_error&) {
      if (!address->ai_next) throw;  // "localhost" is two addresses, and the viewer listens at one of them
    }
  }
}

TcpConnection::~TcpConnection() {
  if (socket_ >= 0) ::close(socket_);
}

TcpConnection::TcpConnection(TcpConnection&& other) noexcept : socket_(std::exchange(other.socket_, -1)) {}

TcpConnection& TcpConnection::operator=(TcpConnection&& other) noexcept {
  std::swap(socket_, other.socket_);
  return *this;
}

void TcpConnection::send(std::span<const char> bytes, const Patience& patience) {
  Stopwatch stalled;
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent > 0) {
      bytes = bytes.subspan(static_cast<std::size_t>(sent));
      stalled = Stopwatch();
    } else if (sent < 0 && errno != EINTR && errno != EAGAIN && errno != EWOULDBLOCK) {
      throw std::runtime_error(reasonOf(errno));
    } else {
      waitUntilWritable(socket_, stalled, patience);
    }
  }
}

}  // namespace pbrtmedia
