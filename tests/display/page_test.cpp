// SPDX-License-Identifier: BSD-2-Clause
// The page as a browser shows it.
#include "display/page.h"

#include <gtest/gtest.h>

#ifdef PBRT_MEDIA_HAS_HTTPLIB
#include <httplib.h>

#include <atomic>
#include <nlohmann/json.hpp>
#include <thread>

#include "display/page_data.h"
#include "display/page_server.h"
#include "support/browser.h"

namespace pbrtmedia::test {
namespace {

Image layered() {
  Image image(8, 4, {"R", "G", "B", "Z"});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 8; ++x) {
      for (std::size_t c = 0; c < 4; ++c)
        image.at(x, y, c) = static_cast<float>(x + 8 * y) + 0.25f * static_cast<float>(c);
    }
  }
  return image;
}

RenderStatus statusOfARender() {
  RenderStatus s;
  s.run = "one";
  s.title = "fog & <smoke>.pbrt";
  s.outfile = "fog.exr";
  s.version = "pbrt-media 1";
  s.phase = "rendering";
  s.samplesDone = 4000;
  s.samplesTotal = 16000;
  s.samplesPerPixel = 64;
  s.seed = 5;
  s.threads = 2;
  s.seconds = 30;
  s.secondsLeft = 90;
  s.errors = {{"seconds", "spp", "rmse", "relmse"},
              {{1, 1, 0.4, 0.16}, {4, 4, 0.2, 0.04}, {16, 16, 0.1, 0.01}},
              "against ref.exr"};
  s.bounds.push_back({.medium = "cloud",
                      .restored = false,
                      .passes = 3,
                      .cells = 1000,
                      .visited = 250,
                      .raised = 12,
                      .largest = 7.5f,
                      .shortfall = 0.0125});
  s.warnings = {"fog.pbrt:3:1: warning: <b>thick</b>"};
  return s;
}

class Page : public testing::Test {
 protected:
  void SetUp() override {
    const std::optional<std::string> program = Browser::program();
    if (!program) GTEST_SKIP() << "no Chromium is installed";
    browser_.emplace(*program);
  }
  static std::size_t timesIn(const std::string& text, const std::string& word) {
    std::size_t count = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
    return count;
  }
  std::optional<Browser> browser_;
};

TEST_F(Page, ShowsARenderUnderItsOwnSecurityPolicy) {
  Feed feed;
  const PageServer server(feed, {.at = {"127.0.0.1", 0}, .farewellSeconds = 0}, [] {});
  feed.update([](RenderStatus& s) { s = statusOfARender(); });
  feed.give("a", layered());
  const std::string document = browser_->documentOf(server.url() + "&pixel=3,2&view=channel.Z", 2000);
  feed.close();
  for (const char* text :
       {">fog &amp; &lt;smoke&gt;.pbrt</h1>", "class=\"phase on\" role=\"status\">rendering<", ">25 %<",
        ">16 of 64<", ">30.0 s<", ">1m 30s<", ">133<", ">fog.exr<", ">8 × 4, update 1<", ">cloud<",
        ">25.0 %<", ">12<", ">7.5<", ">1.3 %<", "&lt;b&gt;thick&lt;/b&gt;", "relmse, against ref.exr",
        "(3, 2)   R 19   G 19.25   B 19.5   Z 19.75", "slope −1)"})
    EXPECT_NE(document.find(text), std::string::npos) << text << "\n"
                                                      << document.substr(document.find("<body"), 3000);
  EXPECT_EQ(timesIn(document.substr(0, document.find("<script")), "<circle"), 3u);
  EXPECT_NE(document.find("id=\"empty\" hidden"), std::string::npos);
  EXPECT_EQ(document.find("id=\"scale\" hidden"), std::string::npos) << "a channel is shown in false colours";
  EXPECT_EQ(document.find("id=\"stop\" disabled"), std::string::npos);
}

/// Serves the page with a script behind it that does what a user does, and writes what it finds into the
/// document.
class PageWithScript : public Page {
 protected:
  /// What the script answered, after the page had its first image.
  nlohmann::json result(const std::string& script) {
    httplib::Server http;
    http.Get("/", [&](const httplib::Request&, httplib::Response& response) {
      const std::string after =
          "<pre id=\"result\"></pre><script>\n"
          "const until = async test => { while (!test()) await pause(20); };\n"
          "(async () => {\n  await until(() => image);\n  let answer;\n  try { answer = await (async () => "
          "{" +
          script +
          "})(); } catch (e) { answer = {failed: String(e)}; }\n  $('result').textContent = "
          "JSON.stringify(answer); })();\n</script>";
      response.set_content(std::string(kPage) + after, "text/html; charset=utf-8");
    });
    http.Get("/status", [&](const httplib::Request&, httplib::Response& response) {
      response.set_content(statusText(status_), "application/json");
    });
    http.Get("/image", [&](const httplib::Request&, httplib::Response& response) {
      Snapshot snapshot{.sequence = 1, .title = "", .image = image_};
      std::string body = imageHeader(snapshot);
      body.append(reinterpret_cast<const char*>(image_.data().data()), image_.data().size() * sizeof(float));
      response.set_content(body, "application/octet-stream");
    });
    http.Post("/stop", [&](const httplib::Request& request, httplib::Response& response) {
      stops_ += request.body + ' ';
      if (request.body != kToken) response.status = 403;
      response.set_content(response.status == 403 ? "wrong token" : "stops", "text/plain");
    });
    const int port = http.bind_to_any_port("127.0.0.1");
    std::thread serving([&] { http.listen_after_bind(); });
    const std::string document =
        browser_->documentOf("http://127.0.0.1:" + std::to_string(port) + "/" + hash_, 12000);
    http.stop();
    serving.join();
    const std::string begin = "<pre id=\"result\">";
    const std::size_t from = document.find(begin), to = document.find("</pre>", from);
    if (from == std::string::npos || to == std::string::npos)
      return {{"failed", "no result in " + document.substr(0, 200)}};
    nlohmann::json json =
        nlohmann::json::parse(document.substr(from + begin.size(), to - from - begin.size()), nullptr, false);
    return json.is_discarded() ? nlohmann::json{{"failed", "not JSON"}} : json;
  }

  static constexpr const char* kToken = "0123456789abcdef0123456789abcdef";
  RenderStatus status_ = statusOfARender();
  Image image_ = layered();
  std::string hash_ = std::string("#") + kToken;
  std::string stops_;
};

TEST_F(PageWithScript, PaintsWithExposure) {
  image_ = Image(3, 1);
  image_.setRgb(0, 0, Rgb(0.25f, 0.5f, 1));
  image_.setRgb(1, 0, Rgb(0, -1, 100));
  const nlohmann::json r = result(R"(
    const bytes = () => [...picture.getContext('2d').getImageData(0, 0, 3, 1).data];
    const before = bytes();
    $('exposure').value = 1; $('exposure').oninput();
    return {before, after: bytes(), text: $('stops').textContent};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  // encodeSrgb: 0.25 is 137, 0.5 is 188 (by 1/4096 of linear light, which is less than a unit here).
  EXPECT_EQ(r["before"], nlohmann::json({137, 188, 255, 255, 0, 0, 255, 255, 0, 0, 0, 255}));
  EXPECT_EQ(r["after"], nlohmann::json({188, 255, 255, 255, 0, 0, 255, 255, 0, 0, 0, 255}));
  EXPECT_EQ(r["text"], "+1 EV");
}

TEST_F(PageWithScript, OffersEveryChannelInFalseColours) {
  image_ = Image(4, 1, {"R", "G", "B", "albedo.R", "albedo.G", "albedo.B", "Z"});
  for (int x = 0; x < 4; ++x) image_.at(x, 0, 6) = static_cast<float>(x);
  const nlohmann::json r = result(R"(
    const keys = [...$('view').options].map(o => o.value);
    const isHidden = $('scale').hidden;
    $('view').value = 'channel.Z'; $('curve').value = 'linear'; $('view').onchange();
    const bytes = [...picture.getContext('2d').getImageData(0, 0, 4, 1).data];
    return {keys, isHidden, shown: !$('scale').hidden, low: bytes.slice(0, 3), high: bytes.slice(12, 15),
            range: [$('least').textContent, $('middle').textContent, $('most').textContent]};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  EXPECT_EQ(r["keys"], nlohmann::json({"colour", "luminance", "albedo", "albedo.luminance", "channel.R",
                                       "channel.G", "channel.B", "channel.albedo.R", "channel.albedo.G",
                                       "channel.albedo.B", "channel.Z"}));
  EXPECT_EQ(r["isHidden"], true);
  EXPECT_EQ(r["shown"], true);
  EXPECT_EQ(r["low"], nlohmann::json({0x44, 0x01, 0x54}));
  EXPECT_EQ(r["high"], nlohmann::json({0xfd, 0xe7, 0x25}));
  EXPECT_EQ(r["range"], nlohmann::json({"0", "1.5", "3"}));
}

TEST_F(PageWithScript, ZoomsAboutThePointerAndReadsItsPixel) {
  const nlohmann::json r = result(R"(
    const box = canvas.getBoundingClientRect();
    const fittedZoom = place.zoom;
    const at = {clientX: box.left + box.width / 2 + 1.2 * place.zoom, clientY: box.top + box.height / 2 - 0.7 * place.zoom, bubbles: true, cancelable: true};
    canvas.dispatchEvent(new PointerEvent('pointermove', at));
    const before = $('pixel').textContent;
    canvas.dispatchEvent(new WheelEvent('wheel', {...at, deltaY: -250}));
    canvas.dispatchEvent(new PointerEvent('pointermove', at));
    const zoomed = place.zoom / fittedZoom, after = $('pixel').textContent;
    $('fit').onclick();
    return {before, after, zoomed, fits: Math.abs(place.zoom - fittedZoom) < 1e-9, isFitted: place.isFitted,
            whole: fittedZoom * 8 <= box.width + 1e-6 && fittedZoom * 4 <= box.height + 1e-6};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  EXPECT_EQ(r["before"], "(5, 1)   R 13   G 13.25   B 13.5   Z 13.75");
  EXPECT_EQ(r["after"], r["before"]);
  EXPECT_NEAR(r["zoomed"].get<double>(), 2, 1e-9);
  EXPECT_EQ(r["fits"], true);
  EXPECT_EQ(r["isFitted"], true);
  EXPECT_EQ(r["whole"], true);
}

TEST_F(PageWithScript, StopsOnTheSecondClickOnly) {
  const nlohmann::json r = result(R"(
    $('stop').click();
    const asked = $('stop').textContent;
    await pause(100);
    $('stop').click();
    await until(() => isStopping);
    return {asked, text: $('stop').textContent, disabled: $('stop').disabled};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  EXPECT_EQ(r["asked"], "Really stop?");
  EXPECT_EQ(r["text"], "Stopping…");
  EXPECT_EQ(r["disabled"], true);
  EXPECT_EQ(stops_, std::string(kToken) + ' ');
}

TEST_F(PageWithScript, AsksForTheTokenWhereTheAddressHasNone) {
  hash_.clear();
  const nlohmann::json r = result(R"(
    const hidden = $('token').hidden;
    $('stop').click();
    const shown = !$('token').hidden;
    $('token').value = 'wrong';
    $('stop').click(); $('stop').click();
    await until(() => $('message').textContent === 'wrong token');
    $('token').value = ' 0123456789abcdef0123456789abcdef ';
    $('stop').click(); $('stop').click();
    await until(() => isStopping);
    return {hidden, shown};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  EXPECT_EQ(r["hidden"], true);
  EXPECT_EQ(r["shown"], true);
  EXPECT_EQ(stops_, "wrong " + std::string(kToken) + ' ');
}

TEST_F(PageWithScript, FitsAPhone) {
  // A window cannot be as narrow in every browser, but a frame can.
  const nlohmann::json r = result(R"(
    if (window !== top) return {};
    const frame = document.createElement('iframe');
    frame.style.cssText = 'width: 360px; height: 740px; border: 0';
    frame.src = '/';
    document.body.append(frame);
    const inside = id => frame.contentDocument && frame.contentDocument.getElementById(id);
    await until(() => inside('size') && inside('size').textContent.startsWith('8'));
    const root = frame.contentDocument.documentElement;
    return {width: root.scrollWidth, picture: inside('image').clientWidth, height: inside('image').clientHeight,
            stop: inside('stop').getBoundingClientRect().right};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  EXPECT_LE(r["width"].get<int>(), 360) << "nothing sticks out";
  EXPECT_GE(r["picture"].get<int>(), 330);
  EXPECT_GE(r["height"].get<int>(), 200);
  EXPECT_LE(r["stop"].get<double>(), 360);
}

TEST_F(PageWithScript, PlotsStraightLinesForPowers) {
  status_.errors = {{"seconds", "rmse"}, {{1, 1}, {10, 0.1}, {100, 0.01}, {200, 0}}, "estimated"};
  const nlohmann::json r = result(R"(
    const dots = [...document.querySelectorAll('.dot')].map(d => [Number(d.getAttribute('cx')), Number(d.getAttribute('cy'))]);
    return {dots, hidden: $('error').hidden, source: $('source').textContent};)");
  ASSERT_FALSE(r.contains("failed")) << r;
  ASSERT_EQ(r["dots"].size(), 3u) << "0 has no logarithm";
  const auto d = [&](std::size_t i, std::size_t k) { return r["dots"][i][k].get<double>(); };
  EXPECT_NEAR(d(1, 0) - d(0, 0), d(2, 0) - d(1, 0), 0.2);
  EXPECT_NEAR(d(1, 1) - d(0, 1), d(2, 1) - d(1, 1), 0.2);
  EXPECT_GT(d(1, 0), d(0, 0));
  EXPECT_GT(d(1, 1), d(0, 1)) << "smaller errors are lower";
  EXPECT_EQ(r["hidden"], true);
  EXPECT_EQ(r["source"], "rmse, estimated");
}

}  // namespace
}  // namespace pbrtmedia::test

#else

TEST(Page, IsLeftOut) { GTEST_SKIP() << "built without cpp-httplib (libcpp-httplib-dev)"; }

#endif
