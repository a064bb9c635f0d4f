// SPDX-License-Identifier: BSD-2-Clause
#include "display/endpoint.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <stdexcept>

namespace pbrtmedia {
namespace {

constexpr int kMostPort = 65535;

std::optional<int> portOf(std::string_view text, int least) {
  int port = 0;
  const auto [at, status] = std::from_chars(text.data(), text.data() + text.size(), port);
  if (text.empty() || status != std::errc() || at != text.data() + text.size()) return std::nullopt;
  if (port < least || port > kMostPort) return std::nullopt;
  return port;
}

bool isHost(std::string_view text, bool inBrackets) {
  constexpr std::string_view kOfNames = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
  constexpr std::string_view kOfAddresses = "abcdefABCDEF0123456789:.%";
  return !text.empty() &&
         (inBrackets ? text.find(':') != text.npos &&
                           text.substr(0, text.find('%')).find_first_not_of(kOfAddresses) == text.npos
                     : text.find_first_not_of(kOfNames) == text.npos);
}

/// "HOST:PORT", "[ADDRESS]:PORT"; `portElse` stands for a port that is not there. Nothing for another text.
std::optional<Endpoint> parse(std::string_view text, int leastPort, std::optional<int> portElse) {
  const bool inBrackets = text.starts_with('[');
  const std::size_t hostEnd = inBrackets ? text.find(']') : std::min(text.find(':'), text.size());
  if (hostEnd == text.npos) return std::nullopt;
  const std::string_view host = text.substr(inBrackets ? 1 : 0, hostEnd - (inBrackets ? 1 : 0));
  std::string_view rest = text.substr(hostEnd + (inBrackets ? 1 : 0));
  std::optional<int> port = portElse;
  if (!rest.empty()) port = rest.starts_with(':') ? portOf(rest.substr(1), leastPort) : std::nullopt;
  if (!isHost(host, inBrackets) || !port) return std::nullopt;
  return Endpoint{std::string(host), *port};
}

}  // namespace

std::string Endpoint::toString() const {
  const bool isV6 = host.find(':') != std::string::npos;
  return (isV6 ? '[' + host + ']' : host) + ':' + std::to_string(port);
}

Endpoint parseViewer(std::string_view text) {
  if (const std::optional<Endpoint> endpoint = parse(text, 1, kTevPort)) return *endpoint;
  throw std::invalid_argument(
      "found " + std::string(text) + ", expected HOST:PORT with a port from 1 to 65535 (tev listens at " +
      Endpoint{"127.0.0.1", kTevPort}.toString() + "; an IPv6 address stands in brackets)");
}

Endpoint parseServed(std::string_view text) {
  if (const std::optional<int> port = portOf(text, 0)) return {"127.0.0.1", *port};
  if (const std::optional<Endpoint> endpoint = parse(text, 0, std::nullopt)) return *endpoint;
  throw std::invalid_argument("found " + std::string(text) +
                              ", expected a port from 0 to 65535 (0: any free one), or ADDRESS:PORT to serve "
                              "others than this machine");
}

bool looksServed(std::string_view word) {
  constexpr std::string_view kDigits = "0123456789";
  if (word.empty() || word == "." || word == "..") return false;
  if (word.find_first_not_of("0123456789.") == word.npos) return true;
  const std::size_t colon = word.rfind(':');
  const bool endsByPort = colon != word.npos && colon + 1 < word.size() &&
                          word.find_first_not_of(kDigits, colon + 1) == word.npos;
  return endsByPort && word.find('/') == word.npos;
}

}  // namespace pbrtmedia
