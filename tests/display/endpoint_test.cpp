// SPDX-License-Identifier: BSD-2-Clause
#include "display/endpoint.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace pbrtmedia {
namespace {

TEST(Endpoint, OfAViewerIsHostAndPort) {
  EXPECT_EQ(parseViewer("localhost:14158"), (Endpoint{"localhost", 14158}));
  EXPECT_EQ(parseViewer("127.0.0.1:1"), (Endpoint{"127.0.0.1", 1}));
  EXPECT_EQ(parseViewer("render-7.example.org:65535"), (Endpoint{"render-7.example.org", 65535}));
  EXPECT_EQ(parseViewer("[::1]:14158"), (Endpoint{"::1", 14158}));
}

TEST(Endpoint, OfAViewerWithoutAPortIsWhereTevListens) {
  EXPECT_EQ(parseViewer("localhost"), (Endpoint{"localhost", 14158}));
  EXPECT_EQ(parseViewer("[fe80::1%eth0]"), (Endpoint{"fe80::1%eth0", 14158}));
}

TEST(Endpoint, OfAViewerRefusesOtherTexts) {
  for (const char* text :
       {"", ":", ":14158", "localhost:", "localhost:0", "localhost:65536", "localhost:-1", "localhost:12x",
        "localhost:1 ", "local host:1", "a:1:2", "::1", "::1:14158", "[::1", "[]:1", "[::1]14158",
        "[localhost]:1", "http://localhost:1", "localhost:99999999999999999999"}) {
    try {
      parseViewer(text);
      FAIL() << text;
    } catch (const std::invalid_argument& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find("found " + std::string(text) + ", expected HOST:PORT"), 0u) << message;
    }
  }
}

TEST(Endpoint, ToServeAtIsOfTheLoopbackInterfaceUnlessSaid) {
  EXPECT_EQ(parseServed("8080"), (Endpoint{"127.0.0.1", 8080}));
  EXPECT_EQ(parseServed("0"), (Endpoint{"127.0.0.1", 0}));
  EXPECT_EQ(parseServed("0.0.0.0:8080"), (Endpoint{"0.0.0.0", 8080}));
  EXPECT_EQ(parseServed("[::1]:0"), (Endpoint{"::1", 0}));
}

TEST(Endpoint, ToServeAtRefusesOtherTexts) {
  for (const char* text : {"", "-", "65536", "-1", "scene.pbrt", "0.0.0.0", "scenes/cloud.pbrt",
                           "a.pbrt:", "8080x", "../8080", "0.0.0.0:65536"}) {
    try {
      parseServed(text);
      FAIL() << text;
    } catch (const std::invalid_argument& e) {
      const std::string message = e.what();
      EXPECT_EQ(message.find("found " + std::string(text) + ", expected a port from 0 to 65535"), 0u)
          << message;
    }
  }
}

TEST(Endpoint, ToServeAtIsToldFromTheNameOfAScene) {
  for (const char* word :
       {"0", "8080", "99999", "0.0.0.0", "0.0.0.0:80", "[::1]:14200", "localhost:14200", "host:99999"})
    EXPECT_TRUE(looksServed(word)) << word;
  for (const char* word : {"", "-", ".", "..", "scene.pbrt", "scenes/8080", "./8080", "8080.pbrt", "--quick",
                           "a:b", "scenes:2/a:1", "a:"})
    EXPECT_FALSE(looksServed(word)) << word;
}

TEST(Endpoint, PrintsAsItIsRead) {
  for (const char* text : {"localhost:14158", "[::1]:7", "10.0.0.1:80"})
    EXPECT_EQ(parseViewer(text).toString(), text);
}

}  // namespace
}  // namespace pbrtmedia
