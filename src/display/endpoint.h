// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <string>
#include <string_view>

namespace pbrtmedia {

/// Where a program listens: a name or an address, and a port.
struct Endpoint {
  std::string host;  ///< an IPv6 address without brackets
  int port = 0;

  /// "localhost:14158", "[::1]:14158".
  std::string toString() const;
  bool operator==(const Endpoint&) const = default;
};

/// Where tev listens unless it is told otherwise.
inline constexpr int kTevPort = 14158;
/// Where the page is served unless it is said otherwise or somebody else is there.
inline constexpr int kPagePort = 14200;

/// "HOST:PORT", or "HOST" alone for tev's port; an IPv6 address in brackets. Throws std::invalid_argument
/// that says what was found and what was expected.
Endpoint parseViewer(std::string_view text);
/// "PORT" of the loopback interface, or "ADDRESS:PORT"; port 0: any that is free. Throws as parseViewer.
Endpoint parseServed(std::string_view text);
/// Whether a word is meant for parseServed, rightly written or not: numbers, an address, or what ends by a
/// port. A name of a file is not.
bool looksServed(std::string_view word);

}  // namespace pbrtmedia
