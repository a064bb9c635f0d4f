// SPDX-License-Identifier: BSD-2-Clause
#include "display/host_header.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <string>

namespace pbrtmedia {
namespace {

TEST(HostHeader, OfTheLoopbackInterfaceIsAnAddressOrLocalhost) {
  for (const char* header :
       {"127.0.0.1:14200", "127.0.0.1", "localhost:14200", "LocalHost", "[::1]:14200", "10.1.2.3:80"})
    EXPECT_TRUE(isOwnHost(header, "127.0.0.1")) << header;
}

TEST(HostHeader, OfAnotherNameIsRefused) {
  for (const char* header :
       {"", ":", "evil.example:14200", "evil.example", "localhost.evil.example", "127.0.0.1.evil.example",
        "evil.example:127.0.0.1", "[evil.example]:80", "127.0.0.1@evil.example", "[", "[::1", "localhost "})
    EXPECT_FALSE(isOwnHost(header, "127.0.0.1")) << header;
}

TEST(HostHeader, IsTheMachinesNameOnlyWhereOthersAreServed) {
  std::array<char, 256> name{};
  ASSERT_EQ(::gethostname(name.data(), name.size() - 1), 0);
  const std::string header = std::string(name.data()) + ":14200";
  EXPECT_TRUE(isOwnHost(header, "0.0.0.0"));
  if (std::string(name.data()) != "localhost") {
    EXPECT_FALSE(isOwnHost(header, "127.0.0.1"));
  }
  EXPECT_TRUE(isOwnHost("farm.example:14200", "farm.example"));
  EXPECT_FALSE(isOwnHost("evil.example:14200", "farm.example"));
}

}  // namespace
}  // namespace pbrtmedia
