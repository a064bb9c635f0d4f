// SPDX-License-Identifier: BSD-2-Clause
#include "display/host_header.h"

#include <arpa/inet.h>
#include <unistd.h>

#include <array>
#include <cctype>
#include <string>

namespace pbrtmedia {
namespace {

std::string inSmallLetters(std::string_view text) {
  std::string small(text);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

std::string thisMachine() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? inSmallLetters(name.data()) : std::string();
}

bool isAddress(const std::string& host) {
  in6_addr address{};
  return ::inet_pton(AF_INET, host.c_str(), &address) == 1 ||
         ::inet_pton(AF_INET6, host.c_str(), &address) == 1;
}

bool isLoopback(std::string_view host) { return host == "127.0.0.1" || host == "::1" || host == "localhost"; }

}  // namespace

bool isOwnHost(std::string_view header, std::string_view servedHost) {
  const bool inBrackets = header.starts_with('[');
  if (inBrackets && header.find(']') == header.npos) return false;
  const std::size_t end = inBrackets ? header.find(']') : header.find(':');
  const std::string host = inSmallLetters(
      header.substr(inBrackets ? 1 : 0, end == header.npos ? end : end - (inBrackets ? 1 : 0)));
  if (host == "localhost" || isAddress(host)) return true;
  if (isLoopback(servedHost) || host.empty()) return false;
  return host == inSmallLetters(servedHost) || host == thisMachine();
}

}  // namespace pbrtmedia
