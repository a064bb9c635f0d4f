// SPDX-License-Identifier: BSD-2-Clause
#include "display/page_server.h"

#include <gtest/gtest.h>

#ifdef PBRT_MEDIA_HAS_HTTPLIB
#include <httplib.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "base/stopwatch.h"
#include "display/page.h"

namespace pbrtmedia {
namespace {

class PageServerTest : public testing::Test {
 protected:
  PageServerTest() {
    params_.at = {"127.0.0.1", 0};
    params_.farewellSeconds = 0;
    server_ = start(params_);
  }
  ~PageServerTest() override { feed_.close(); }

  std::unique_ptr<PageServer> start(const PageServer::Params& params) {
    return std::make_unique<PageServer>(feed_, params, [this] { ++stops_; });
  }
  httplib::Client client() const { return httplib::Client("127.0.0.1", server_->at().port); }
  static Image image() {
    Image image(3, 2);
    for (std::size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<float>(i) / 3;
    return image;
  }

  Feed feed_;
  std::atomic<int> stops_{0};
  PageServer::Params params_;
  std::unique_ptr<PageServer> server_;
};

TEST_F(PageServerTest, ServesAPageThatLoadsNothingFromElsewhere) {
  const httplib::Result page = client().Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_EQ(page->get_header_value("Content-Type"), "text/html; charset=utf-8");
  EXPECT_EQ(page->body.find("@NONCE@"), std::string::npos);
  for (const char* word : {"http://", "https://", "//cdn", "src=", "@import", "url("}) {
    const std::size_t at = page->body.find(word);
    EXPECT_TRUE(at == std::string::npos || page->body.compare(at, 9, "url(#insi") == 0) << word;
  }
  const std::string policy = page->get_header_value("Content-Security-Policy");
  for (const char* rule :
       {"default-src 'none'", "connect-src 'self'", "frame-ancestors 'none'", "base-uri 'none'"})
    EXPECT_NE(policy.find(rule), std::string::npos) << policy;
  EXPECT_EQ(policy.find("unsafe"), std::string::npos) << policy;
  const std::size_t nonce = policy.find("script-src 'nonce-");
  ASSERT_NE(nonce, std::string::npos) << policy;
  EXPECT_NE(page->body.find("<script nonce=\"" + policy.substr(nonce + 18, 32) + "\">"), std::string::npos);
  const httplib::Result again = client().Get("/");
  ASSERT_TRUE(again);
  EXPECT_NE(policy, again->get_header_value("Content-Security-Policy")) << "a nonce is used once";
  EXPECT_EQ(page->body.find(server_->token()), std::string::npos) << "the page tells nobody the token";
}

TEST_F(PageServerTest, ServesTheStatus) {
  feed_.update([](RenderStatus& s) { s.samplesDone = 7; });
  const httplib::Result status = client().Get("/status");
  ASSERT_TRUE(status);
  EXPECT_EQ(status->get_header_value("Content-Type"), "application/json");
  EXPECT_EQ(status->get_header_value("Cache-Control"), "no-store");
  EXPECT_EQ(status->get_header_value("Access-Control-Allow-Origin"), "") << "other pages may not read it";
  EXPECT_EQ(nlohmann::json::parse(status->body)["samplesDone"], 7);
  EXPECT_EQ(status->body.find(server_->token()), std::string::npos);
  EXPECT_FALSE(feed_.isWatched()) << "who asks for numbers needs no image";
}

TEST_F(PageServerTest, ServesTheImageBitForBit) {
  EXPECT_FALSE(feed_.isWatched());
  httplib::Result answer = client().Get("/image?after=0");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 204) << "none yet";
  EXPECT_TRUE(feed_.isWatched());
  feed_.give("a", image());
  answer = client().Get("/image?after=0");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  ASSERT_EQ(answer->body.size(), 24u + 8 + 18 * 4);
  EXPECT_EQ(answer->body.substr(0, 4), "PMI1");
  EXPECT_EQ(std::memcmp(answer->body.data() + 32, image().data().data(), 18 * 4), 0);
  answer = client().Get("/image?after=1");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 204);
  answer = client().Get("/image?after=5");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200) << "5 is of another run";
}

TEST_F(PageServerTest, ServesALargeImageInPieces) {
  Image large(1000, 400);
  for (std::size_t i = 0; i < large.data().size(); ++i) large.data()[i] = static_cast<float>(i);
  feed_.give("a", large);
  const httplib::Result answer = client().Get("/image");
  ASSERT_TRUE(answer);
  ASSERT_EQ(answer->body.size(), 32 + large.data().size() * 4);
  EXPECT_EQ(std::memcmp(answer->body.data() + 32, large.data().data(), large.data().size() * 4), 0);
}

TEST_F(PageServerTest, StopsForTheTokenAlone) {
  const std::string token = server_->token();
  EXPECT_EQ(token.size(), 32u);
  EXPECT_EQ(token.find_first_not_of("0123456789abcdef"), std::string::npos);
  std::string almost = token;
  almost.back() = almost.back() == '0' ? '1' : '0';
  for (const std::string& body : {std::string(), almost, token.substr(0, 31), token + "0"}) {
    const httplib::Result answer = client().Post("/stop", body, "text/plain");
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 403) << body;
  }
  const httplib::Result got = client().Get("/stop?token=" + token);
  ASSERT_TRUE(got);
  EXPECT_EQ(got->status, 404) << "a link cannot stop a render";
  EXPECT_EQ(stops_, 0);
  const httplib::Result answer = client().Post("/stop", token, "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_EQ(stops_, 1);
}

TEST_F(PageServerTest, RefusesALargeBody) {
  const httplib::Result answer = client().Post("/stop", std::string(100000, 'a'), "text/plain");
  if (answer) {
    EXPECT_EQ(answer->status, 413);
  }
  EXPECT_EQ(stops_, 0);
  EXPECT_TRUE(client().Get("/status")) << "it goes on";
}

TEST_F(PageServerTest, RefusesRequestsForAnotherName) {
  feed_.give("a", image());
  for (const char* path : {"/", "/status", "/image"}) {
    const httplib::Result answer =
        client().Get(path, {{"Host", "evil.example:" + std::to_string(server_->at().port)}});
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 403) << path;
    EXPECT_EQ(answer->body.find("PMI1"), std::string::npos);
  }
  const httplib::Result stop =
      client().Post("/stop", {{"Host", "evil.example"}}, server_->token(), "text/plain");
  ASSERT_TRUE(stop);
  EXPECT_EQ(stop->status, 403);
  EXPECT_EQ(stops_, 0);
  EXPECT_EQ(client().Get("/status", {{"Host", "localhost"}})->status, 200);
}

TEST_F(PageServerTest, SaysWhatThereIsInsteadOfAnotherPath) {
  for (const char* path : {"/nothing", "/../etc/passwd", "/image/", "/status.json"}) {
    const httplib::Result answer = client().Get(path);
    ASSERT_TRUE(answer);
    EXPECT_EQ(answer->status, 404) << path;
    EXPECT_NE(answer->body.find("known: GET /, /status, /image, POST /stop"), std::string::npos);
  }
  EXPECT_EQ(client().Get("/favicon.ico")->status, 204);
}

TEST_F(PageServerTest, ListensToThisMachineOnly) {
  EXPECT_EQ(server_->at().host, "127.0.0.1");
  EXPECT_EQ(server_->url(),
            "http://127.0.0.1:" + std::to_string(server_->at().port) + "/#" + server_->token());
  // 127.0.0.2 is this machine too, but not the address that is served.
  EXPECT_FALSE(httplib::Client("127.0.0.2", server_->at().port).Get("/status"));
}

TEST_F(PageServerTest, TakesAnotherPortOnlyWhereNoneWasAskedFor) {
  PageServer::Params params = params_;
  params.at = server_->at();
  try {
    start(params);
    FAIL() << "two servers at one port";
  } catch (const std::runtime_error& e) {
    EXPECT_EQ(std::string(e.what()).find("cannot listen at " + params.at.toString()), 0u) << e.what();
  }
  params.isPortFixed = false;
  const auto other = start(params);
  EXPECT_NE(other->at().port, params.at.port);
  EXPECT_NE(other->token(), server_->token());
  feed_.close();
}

TEST_F(PageServerTest, IdleConnectionsDoNotKeepItAlive) {
  const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(server_->at().port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
  ASSERT_EQ(::send(socket, "GET /sta", 8, 0), 8);  // and nothing more
  EXPECT_TRUE(client().Get("/status")) << "others are served meanwhile";
  feed_.close();
  const Stopwatch watch;
  server_.reset();
  EXPECT_LT(watch.seconds(), 20);
  ::close(socket);
}

TEST_F(PageServerTest, WhoLooksOnGetsTheLastImage) {
  PageServer::Params params = params_;
  params.farewellSeconds = 30;
  auto server = start(params);
  httplib::Client browser("127.0.0.1", server->at().port);
  ASSERT_TRUE(browser.Get("/image?after=0"));
  feed_.give("a", image());
  feed_.update([](RenderStatus& s) { s.phase = "finished"; });
  feed_.close();
  std::string phase;
  int imageStatus = 0;
  std::thread asking([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    if (const httplib::Result status = browser.Get("/status"))
      phase = nlohmann::json::parse(status->body)["phase"];
    if (const httplib::Result last = browser.Get("/image?after=0")) imageStatus = last->status;
  });
  server.reset();  // waits
  asking.join();
  EXPECT_EQ(phase, "finished");
  EXPECT_EQ(imageStatus, 200);
}

TEST_F(PageServerTest, NobodyLooksOnSoItEndsAtOnce) {
  PageServer::Params params = params_;
  params.farewellSeconds = 30;
  auto server = start(params);
  feed_.close();
  const Stopwatch watch;
  server.reset();
  EXPECT_LT(watch.seconds(), 5);
}

}  // namespace
}  // namespace pbrtmedia

#else

namespace pbrtmedia {
namespace {

TEST(PageServer, SaysWhatItWasBuiltWithout) {
  EXPECT_FALSE(PageServer::isAvailable());
  Feed feed;
  try {
    const PageServer server(feed, {}, [] {});
    FAIL();
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("libcpp-httplib-dev"), std::string::npos);
  }
}

}  // namespace
}  // namespace pbrtmedia

#endif
