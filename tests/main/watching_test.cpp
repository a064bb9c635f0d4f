// SPDX-License-Identifier: BSD-2-Clause
// --display-server and --serve as a user meets them.
#include "main/watching.h"

#include <gtest/gtest.h>

#ifdef PBRT_MEDIA_HAS_HTTPLIB
#include <httplib.h>
#endif

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>

#include "filters/box.h"
#include "support/background_program.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "support/tev_viewer.h"

namespace pbrtmedia::test {
namespace {

/// Noise in every pixel, so that every pass changes all of the image.
std::string scene(int edge, const std::string& samples) {
  const std::string size = std::to_string(edge);
  return "Film \"image\" \"integer xresolution\" " + size + " \"integer yresolution\" " + size +
         " \"string filename\" \"a.exr\"\nSampler \"random\" \"integer pixelsamples\" " + samples +
         "\nIntegrator \"volpath\" \"integer maxdepth\" 3\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [ 0.5 0.25 1 ]\nMakeNamedMedium \"fog\" \"string type\" "
         "\"homogeneous\" "
         "\"rgb sigma_a\" [ 0.5 0.5 0.5 ] \"rgb sigma_s\" [ 0.5 0.5 0.5 ]\n"
         "AttributeBegin\nMaterial \"\"\nMediumInterface \"fog\" \"\"\nTranslate 0 0 3\nShape \"sphere\" "
         "\"float radius\" 2\n"
         "AttributeEnd\nWorldEnd\n";
}
const char* const kEndless = "100000000";
constexpr const char* kAtMost = "timeout -s KILL 120";

class WatchingTest : public testing::Test {
 protected:
  ProcessResult pbrt(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && " + kAtMost +
               " '" PBRT_PROGRAM "' --pixeltype float " + arguments);
  }
  std::unique_ptr<BackgroundProgram> start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), {PBRT_PROGRAM, "--pixeltype", "float"});
    return std::make_unique<BackgroundProgram>(std::move(arguments), folder_.path(),
                                               folder_.path() / "output.txt");
  }
  Image image(const std::string& name = "a.exr") const { return readImage(folder_.path() / name); }
  static bool waitFor(const std::function<bool()>& holds) {
    for (int i = 0; i < 3000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return holds();
  }
  /// The image of a viewer that has one, as a file would hold it.
  static Image shownBy(const TevViewer& viewer) {
    const TevPackets packets = viewer.packets();
    if (packets.images.size() != 1) return {};
    const ViewerImage& shown = packets.images.begin()->second;
    Image image(shown.width, shown.height);
    for (std::size_t c = 0; c < 3; ++c) {
      const std::vector<float>& plane = shown.planes.at(image.channels()[c]);
      for (std::size_t i = 0; i < plane.size(); ++i) image.data()[3 * i + c] = plane[i];
    }
    return image;
  }
  TemporaryFolder folder_;
};

TEST_F(WatchingTest, AViewerShowsTheImageThatIsWrittenAndChangesNoBitOfIt) {
  folder_.write("a.pbrt", scene(200, "16"));
  ASSERT_EQ(pbrt("a.pbrt --outfile alone.exr").status, 0);
  const TevViewer viewer;
  const ProcessResult r = pbrt("--display-server " + viewer.endpoint() + " a.pbrt");
  ASSERT_EQ(r.status, 0) << r.output;
  EXPECT_EQ(r.output.find("--display-server"), std::string::npos) << r.output;
  EXPECT_EQ(image().data(), image("alone.exr").data());
  EXPECT_TRUE(viewer.waitFor([&](const TevPackets&) { return shownBy(viewer).data() == image().data(); }));
  EXPECT_EQ(viewer.problem(), "");
  EXPECT_EQ(viewer.packets().images.begin()->first.find("a.exr ("), 0u);
}

TEST_F(WatchingTest, AViewerGetsEachLayerWithTheNumbersThatAreWritten) {
  folder_.write("a.pbrt", scene(150, "4"));
  const TevViewer viewer;
  const ProcessResult r = pbrt("--layers all --display-server " + viewer.endpoint() + " a.pbrt");
  ASSERT_EQ(r.status, 0) << r.output;
  const Image written = image();
  EXPECT_GT(written.channelCount(), 30u);
  const auto isShown = [&](const TevPackets& packets) {
    if (packets.images.size() != 1) return false;
    const auto& planes = packets.images.begin()->second.planes;
    if (planes.size() != written.channelCount()) return false;
    for (std::size_t c = 0; c < written.channelCount(); ++c) {
      const auto plane = planes.find(written.channels()[c]);
      if (plane == planes.end()) return false;
      for (std::size_t i = 0; i < plane->second.size(); ++i) {
        if (plane->second[i] != written.data()[i * written.channelCount() + c]) return false;
      }
    }
    return true;
  };
  EXPECT_TRUE(viewer.waitFor(isShown));
  EXPECT_EQ(viewer.problem(), "");
}

TEST_F(WatchingTest, AViewerSeesTheImageGrow) {
  folder_.write("a.pbrt", scene(32, kEndless));
  const TevViewer viewer;
  const auto program = start({"--display-server", viewer.endpoint(), "--time", "60", "a.pbrt"});
  EXPECT_TRUE(viewer.waitFor([](const TevPackets& p) { return p.updates >= 4; }));
  EXPECT_FALSE(shownBy(viewer).rgb(16, 16).isBlack());
  EXPECT_TRUE(program->threads().count("display-server"));
}

TEST_F(WatchingTest, AViewerThatDiesCostsNothing) {
  folder_.write("a.pbrt", scene(200, "16"));
  ASSERT_EQ(pbrt("a.pbrt --outfile alone.exr").status, 0);
  const TevViewer viewer({.packetsBeforeDeath = 3});
  const ProcessResult r = pbrt("--display-server " + viewer.endpoint() + " a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_TRUE(viewer.isDead());
  EXPECT_EQ(image().data(), image("alone.exr").data());
}

TEST_F(WatchingTest, AViewerThatReadsNothingCostsAMoment) {
  folder_.write("a.pbrt", scene(1000, "1"));
  const TevViewer viewer({.reads = false});
  const ProcessResult r = pbrt("--display-server " + viewer.endpoint() + " a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("takes nothing any more"), std::string::npos) << r.output;
  EXPECT_EQ(image().width(), 1000);
}

TEST_F(WatchingTest, NobodyListening) {
  folder_.write("a.pbrt", scene(8, "1"));
  const std::string nowhere = TevViewer().endpoint();
  const ProcessResult r = pbrt("--display-server " + nowhere + " a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("pbrt: warning: --display-server " + nowhere +
                          ": nobody shows the image there (Connection refused)"),
            std::string::npos)
      << r.output;
  EXPECT_EQ(image().width(), 8);
  EXPECT_EQ(pbrt("--quiet --display-server " + nowhere + " a.pbrt").output, "");

  const ProcessResult strict = pbrt("--strict --outfile strict.exr --display-server " + nowhere + " a.pbrt");
  EXPECT_EQ(strict.status, 1) << strict.output;
  EXPECT_NE(strict.output.find("pbrt: error: --display-server " + nowhere + ": nobody shows"),
            std::string::npos)
      << strict.output;
  EXPECT_EQ(strict.output.find("rendering goes on"), std::string::npos) << strict.output;
  EXPECT_FALSE(folder_.has("strict.exr"));
}

TEST_F(WatchingTest, WrongPlacesAreToldBeforeAnythingIsRead) {
  for (const std::string words : {"--display-server localhost:0", "--display-server :14158",
                                  "--display-server a:b", "--serve 65536", "--serve 0.0.0.0"}) {
    const ProcessResult r = pbrt(words + " nothing.pbrt");
    EXPECT_EQ(r.status, 1) << words;
    const std::string option = words.substr(0, words.find(' '));
    EXPECT_NE(r.output.find(option + ": found " + words.substr(words.find(' ') + 1) + ", expected "),
              std::string::npos)
        << r.output;
    EXPECT_EQ(r.output.find("nothing.pbrt"), std::string::npos) << r.output;
  }
}

TEST_F(WatchingTest, NothingIsMadeWithoutTheOptions) {
  folder_.write("a.pbrt", scene(32, kEndless));
  const auto program = start({"--nthreads", "1", "--time", "60", "--progress", "plain", "a.pbrt"});
  ASSERT_TRUE(waitFor([&] { return !program->threads().empty(); }));
  std::this_thread::sleep_for(std::chrono::seconds(1));
  const std::multiset<std::string> threads = program->threads();
  EXPECT_EQ(threads.count("display-server") + threads.count("serve"), 0u);
  const Watching off{Options{}};
  EXPECT_FALSE(off.isOn());
}

#ifdef PBRT_MEDIA_HAS_HTTPLIB

class Serving : public WatchingTest {
 protected:
  /// Starts pbrt and waits for what it says of the page.
  void serve(std::vector<std::string> arguments) {
    program_ = start(std::move(arguments));
    const std::string before = "pbrt: watch it at http://127.0.0.1:";
    std::string url;
    ASSERT_TRUE(waitFor([&] {
      const std::string text = program_->output();
      const std::size_t at = text.find(before);
      if (at == std::string::npos || text.find('\n', at) == std::string::npos) return false;
      url = text.substr(at + before.size(), text.find('\n', at) - at - before.size());
      return true;
    })) << program_->output();
    port_ = std::stoi(url);
    token_ = url.substr(url.find('#') + 1);
  }
  httplib::Client client() const { return httplib::Client("127.0.0.1", port_); }
  nlohmann::json status() const {
    const httplib::Result answer = client().Get("/status");
    return answer ? nlohmann::json::parse(answer->body) : nlohmann::json{{"phase", "no answer"}};
  }

  std::unique_ptr<BackgroundProgram> program_;
  int port_ = 0;
  std::string token_;
};

TEST_F(Serving, ShowsTheImageGrowAndStopsForTheToken) {
  folder_.write("a.pbrt", scene(32, kEndless));
  serve({"--quiet", "--serve", "0", "a.pbrt"});
  EXPECT_TRUE(program_->threads().count("serve"));
  ASSERT_TRUE(waitFor([&] { return status()["phase"] == "rendering"; })) << program_->output();
  std::string latest;
  int images = 0;
  ASSERT_TRUE(waitFor([&] {
    const httplib::Result answer = client().Get("/image");
    if (answer && answer->status == 200 && answer->body != latest) {
      latest = answer->body;
      ++images;
    }
    return images >= 3;
  }));
  const nlohmann::json now = status();
  EXPECT_EQ(now["title"], "a.pbrt");
  EXPECT_EQ(now["outfile"], "a.exr");
  EXPECT_GT(now["samplesDone"], 0);
  EXPECT_EQ(now["samplesTotal"], std::uint64_t{32 * 32} * 100000000);
  EXPECT_GT(now["secondsLeft"], 0.0);
  EXPECT_GE(now["errors"]["rows"].size(), 1u);

  const httplib::Result wrong = client().Post("/stop", std::string(32, '0'), "text/plain");
  ASSERT_TRUE(wrong);
  EXPECT_EQ(wrong->status, 403);
  EXPECT_FALSE(program_->wait(0.5).has_value()) << "it goes on";
  ASSERT_TRUE(client().Post("/stop", token_, "text/plain"));
  // Who looks on sees the end: the image that is in the file.
  nlohmann::json last;
  for (;;) {
    const nlohmann::json next = status();
    if (next["phase"] == "no answer") break;
    last = next;
    const httplib::Result answer = client().Get("/image");
    if (answer && answer->status == 200) latest = answer->body;
  }
  EXPECT_EQ(program_->wait(20).value_or(-1), 0) << program_->output();
  EXPECT_EQ(last["phase"], "stopped");
  EXPECT_EQ(last["message"], "wrote a.exr");
  const Image written = image();
  ASSERT_EQ(latest.size(), 32 + written.data().size() * sizeof(float));
  EXPECT_EQ(std::memcmp(latest.data() + 32, written.data().data(), latest.size() - 32), 0);
}

TEST_F(Serving, TakesNoSceneForAPortAndNoBitFromTheImage) {
  folder_.write("a.pbrt", scene(64, "16"));
  ASSERT_EQ(pbrt("a.pbrt --outfile alone.exr").status, 0);
  serve({"--serve", "a.pbrt"});
  for (bool isSeen = false; !isSeen && !program_->wait(0.01);)
    isSeen = client().Get("/image") && status()["phase"] == "finished";
  EXPECT_EQ(program_->wait(60).value_or(-1), 0) << program_->output();
  EXPECT_EQ(image().data(), image("alone.exr").data());
}

TEST_F(Serving, ShowsWarningsAndLearnedBounds) {
  std::string text = scene(16, kEndless);
  const std::string fog = "\"string type\" \"homogeneous\"";
  text.replace(text.find(fog), fog.size(),
               "\"string type\" \"perlin\" \"string bounds\" \"progressive\" \"float unknownthing\" 1");
  folder_.write("a.pbrt", text);
  serve({"--serve", "0", "a.pbrt"});
  ASSERT_TRUE(waitFor([&] { return status()["phase"] == "rendering" && !status()["bounds"].empty(); }))
      << program_->output();
  const nlohmann::json now = status();
  EXPECT_EQ(now["bounds"][0]["medium"], "fog");
  EXPECT_GT(now["bounds"][0]["cells"], 0);
  EXPECT_GT(now["bounds"][0]["largest"], 0.0);
  ASSERT_FALSE(now["warnings"].empty());
  EXPECT_NE(now["warnings"].dump().find("unknownthing"), std::string::npos) << now["warnings"];
}

TEST_F(Serving, ShowsErrorsThatAreMeasured) {
  folder_.write("a.pbrt", scene(16, kEndless));
  serve({"--serve", "0", "--convergence", "error.csv", "a.pbrt"});
  ASSERT_TRUE(waitFor([&] {
    const nlohmann::json now = status();
    return now["phase"] == "rendering" && now["errors"]["rows"].size() >= 3 &&
           now["errors"]["columns"].size() == 7;
  })) << program_->output();
  const nlohmann::json errors = status()["errors"];
  EXPECT_EQ(errors["columns"][4], "relmse");
  EXPECT_EQ(errors["source"], "estimated from two halves of the samples");
  const nlohmann::json& row = errors["rows"][2];
  EXPECT_NEAR(row[3].get<double>() * row[3].get<double>(), row[2].get<double>(), 1e-9) << "rmse and mse";
  EXPECT_NE(folder_.read("error.csv").find(",halves\n"), std::string::npos);
}

TEST_F(Serving, AnImageIsMadeForThoseWhoLookOnly) {
  Options options;
  options.serve = Endpoint{"127.0.0.1", 0};
  testing::internal::CaptureStderr();
  Watching watching(options);
  const std::string url = testing::internal::GetCapturedStderr(), host = "127.0.0.1:";
  port_ = std::stoi(url.substr(url.find(host) + host.size()));
  const Film film({.resolution = {4, 4}}, BoxFilter(BoxFilter::Params{}));
  const RenderResult result;
  watching.begin("a.exr", 16);
  watching.afterPass({{16, 256, 1}, result}, film);
  EXPECT_EQ(client().Get("/image")->status, 204) << "nobody had asked";
  watching.afterPass({{32, 256, 2}, result}, film);
  EXPECT_EQ(client().Get("/image")->status, 200);
  EXPECT_EQ(client().Get("/image?after=1")->status, 204);
  watching.afterPass({{48, 256, 2.1}, result}, film);
  EXPECT_EQ(client().Get("/image?after=1")->status, 204) << "too soon";
}

TEST_F(Serving, APortThatIsTakenIsAnErrorWhereItWasAskedFor) {
  const TevViewer other;
  folder_.write("a.pbrt", scene(8, "1"));
  const ProcessResult r = pbrt("--serve " + std::to_string(other.port()) + " a.pbrt");
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("pbrt: error: --serve: cannot listen at " + other.endpoint() +
                          " (Address already in use)"),
            std::string::npos)
      << r.output;
  EXPECT_FALSE(folder_.has("a.exr"));
}

#else

TEST_F(WatchingTest, ServingSaysWhatItWasBuiltWithout) {
  folder_.write("a.pbrt", scene(8, "1"));
  const ProcessResult r = pbrt("--serve a.pbrt");
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("libcpp-httplib-dev"), std::string::npos) << r.output;
}

#endif

}  // namespace
}  // namespace pbrtmedia::test
