// SPDX-License-Identifier: BSD-2-Clause
// --checkpoint and --resume: renders that were stopped or killed end in the image of those that were not.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>

#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/diagnostics.h"
#include "base/rng.h"
#include "image/image.h"
#include "main/checkpoint_file.h"
#include "support/background_program.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

using namespace std::chrono_literals;

/// In front of a program that ends by itself: what does not is killed, and its status is none of ours.
constexpr const char* kAtMost = "timeout -s KILL 120";

std::string fogScene(const std::string& sampler, const std::string& medium, int resolution = 24,
                     const std::string& outfile = "fog.pfm",
                     const std::string& integrator = "\"volpath\" \"integer maxdepth\" 8") {
  const std::string edge = std::to_string(resolution);
  return "Film \"image\" \"integer xresolution\" " + edge + " \"integer yresolution\" " + edge +
         " \"string filename\" \"" + outfile + "\"\nSampler " + sampler + "\nIntegrator " + integrator +
         "\n"
         "LookAt .5 .5 -2  .5 .5 0  0 1 0 Camera \"perspective\" \"float fov\" 35\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [ .5 .7 1 ]\nLightSource \"point\" \"point from\" [ 2 3 -1 ] "
         "\"rgb "
         "I\" [ 9 8 7 ]\n"
         "MakeNamedMedium \"fog\" \"string type\" \"perlin\" \"rgb sigma_s\" [ 9 8 7 ] \"rgb sigma_a\" [ .5 "
         ".5 .5 ] "
         "\"integer octaves\" 3 \"float frequency\" 3 \"integer supervoxels\" 4 " +
         medium +
         "\nMaterial \"none\" MediumInterface \"fog\" \"\"\nTranslate .5 .5 .5\nShape \"sphere\" \"float "
         "radius\" .9\nWorldEnd\n";
}
const std::string kProgressive = "\"string bounds\" \"progressive\" \"integer warmup\" 1 ";
std::string random(int spp) { return "\"random\" \"integer pixelsamples\" " + std::to_string(spp); }
std::string halton(int spp) { return "\"halton\" \"integer pixelsamples\" " + std::to_string(spp); }
/// More samples than anybody waits for.
constexpr int kEndless = 1 << 20;

class Checkpoints : public testing::Test {
 protected:
  /// Runs pbrt in the temporary folder; `before` stands in front of the program.
  ProcessResult pbrt(const std::string& arguments, const std::string& before = kAtMost) const {
    return run("cd '" + folder_.path().string() + "' && " + before + " '" PBRT_PROGRAM "' " + arguments);
  }
  nlohmann::json statistics(const std::string& name) const {
    return nlohmann::json::parse(folder_.read(name)).at("renders");
  }
  /// `--resume c.ckpt` with these options is refused, and every text stands in the message.
  void expectRefused(const std::string& arguments, const std::vector<std::string>& texts) const {
    const ProcessResult r = pbrt("--resume c.ckpt " + arguments);
    EXPECT_EQ(r.status, 1) << arguments << '\n' << r.output;
    EXPECT_NE(r.output.find("pbrt: error: --resume \"c.ckpt\": "), std::string::npos) << r.output;
    for (const std::string& text : texts) EXPECT_NE(r.output.find(text), std::string::npos) << r.output;
  }
  /// Renders a.pbrt to the end, with a checkpoint in c.ckpt.
  void render(const std::string& scene, const std::string& more = "") {
    folder_.write("a.pbrt", scene);
    const ProcessResult r = pbrt("--quiet --checkpoint c.ckpt " + more + " a.pbrt");
    ASSERT_EQ(r.status, 0) << r.output;
  }
  /// When the checkpoint was written, nanoseconds; 0: not yet.
  std::int64_t checkpoint() const {
    struct stat found {};
    if (::stat((folder_.path() / "c.ckpt").c_str(), &found) != 0) return 0;
    return std::int64_t{found.st_mtim.tv_sec} * 1'000'000'000 + found.st_mtim.tv_nsec;
  }
  /// pbrt in a process of its own; what it says goes to the file "said".
  BackgroundProgram start(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(), PBRT_PROGRAM);
    return {std::move(arguments), folder_.path(), folder_.path() / "said"};
  }
  TemporaryFolder folder_;
};

struct KilledCase {
  const char* name;
  std::string medium, sampler;
  std::uint64_t seed;
  std::string integrator = "\"volpath\" \"integer maxdepth\" 8";
};
class KilledRender : public Checkpoints, public testing::WithParamInterface<KilledCase> {};

/// Ten kills each, at moments drawn from a seed: five so long after the start (while the scene is read and
/// built, in the warm-up, in the first passes), five so long after a new checkpoint.
TEST_P(KilledRender, EndsInTheSameBits) {
  folder_.write("a.pbrt",
                fogScene(GetParam().sampler, GetParam().medium, 16, "fog.pfm", GetParam().integrator));
  ASSERT_EQ(pbrt("--quiet --nthreads 2 --outfile whole.pfm --stats whole.json a.pbrt").status, 0);
  Rng rng(GetParam().seed);
  int kills = 0;
  for (int attempt = 0; attempt < 10; ++attempt) {
    const std::int64_t before = checkpoint();
    BackgroundProgram program = start({"--quiet", "--nthreads", attempt % 3 == 0 ? "1" : "2", "--checkpoint",
                                       "c.ckpt", "--resume", "c.ckpt", "--checkpoint-interval", "0.01",
                                       "--tile-size", attempt % 2 == 0 ? "16" : "5", "a.pbrt"});
    const auto delay = std::chrono::microseconds(static_cast<int>(rng.uniform() * 60e3f));
    if (attempt % 2 == 1) {
      while (checkpoint() == before && !program.isOver()) std::this_thread::sleep_for(200us);
    }
    std::this_thread::sleep_for(delay);
    kills += program.end(SIGKILL) == 128 + SIGKILL;
  }
  EXPECT_EQ(kills, 10) << "the render is too short";
  ASSERT_EQ(pbrt("--quiet --checkpoint c.ckpt --resume c.ckpt --stats s.json a.pbrt").status, 0);
  EXPECT_EQ(folder_.read("fog.pfm"), folder_.read("whole.pfm"));
  const nlohmann::json whole = statistics("whole.json")[0], resumed = statistics("s.json")[0];
  EXPECT_EQ(resumed.at("counters"), whole.at("counters"));
  EXPECT_EQ(resumed.at("learnedBounds"), whole.at("learnedBounds"));
  EXPECT_EQ(resumed.at("samplesTaken"), whole.at("samplesTaken"));
  EXPECT_GT(resumed.at("parts").size(), 3u) << "renders went on where others had been killed";
  EXPECT_FALSE(resumed.at("interrupted"));
  // a.pbrt, whole.pfm, fog.pfm, c.ckpt, said and two of statistics.
  EXPECT_EQ(folder_.fileCount(), 7u) << "no temporary file of a killed process may stay";
}

INSTANTIATE_TEST_SUITE_P(
    Media, KilledRender,
    testing::Values(
        KilledCase{"Fog", "", halton(1024), 1}, KilledCase{"Progressive", kProgressive, random(1024), 2},
        KilledCase{"Bidirectional", kProgressive, random(1024), 4, "\"bdpt\" \"integer maxdepth\" 5"},
        KilledCase{"Photons", "", halton(1), 3, "\"sppm\" \"integer iterations\" 1024 \"float radius\" .1"}),
    [](const auto& tested) { return tested.param.name; });

TEST_F(Checkpoints, AStoppedRenderGoesOnToTheSameImage) {
  folder_.write("a.pbrt", fogScene(halton(512), kProgressive, 24, "part.exr"));
  ASSERT_EQ(pbrt("--quiet --outfile whole.pfm --stats whole.json a.pbrt").status, 0);
  const nlohmann::json whole = statistics("whole.json")[0];
  std::int64_t samples = 0;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    const std::int64_t before = checkpoint();
    BackgroundProgram program = start({"--resume", "c.ckpt", "--checkpoint", "c.ckpt",
                                       "--checkpoint-interval", ".01", "--stats", "part.json", "a.pbrt"});
    while (checkpoint() == before && !program.isOver()) std::this_thread::sleep_for(1ms);
    ASSERT_EQ(program.end(signal), 0) << folder_.read("said");
    const std::string said = folder_.read("said");
    EXPECT_NE(said.find("checkpoint c.ckpt has "), std::string::npos) << said;
    EXPECT_NE(said.find("; go on with --resume c.ckpt\n"), std::string::npos) << said;
    EXPECT_TRUE(folder_.has("part.exr"));
    const nlohmann::json part = statistics("part.json")[0];
    EXPECT_TRUE(part.at("interrupted"));
    EXPECT_GT(part.at("samplesTaken"), samples);
    samples = part.at("samplesTaken");
  }
  const ProcessResult timed = pbrt("--resume c.ckpt --checkpoint c.ckpt --time .1 a.pbrt");
  const ProcessResult r = pbrt("--resume c.ckpt --nthreads 1 --outfile fog.pfm --stats s.json a.pbrt");
  ASSERT_EQ(r.status, 0) << r.output;
  EXPECT_EQ(folder_.read("fog.pfm"), folder_.read("whole.pfm"));
  const nlohmann::json resumed = statistics("s.json")[0];
  EXPECT_EQ(resumed.at("counters"), whole.at("counters"));
  EXPECT_EQ(resumed.at("learnedBounds"), whole.at("learnedBounds"));
  const nlohmann::json& parts = resumed.at("parts");
  ASSERT_GE(parts.size(), 4u);
  double wall = 0;
  std::int64_t sample = 0;
  for (const auto& part : parts) {
    EXPECT_EQ(part.at("firstSample"), sample);
    sample = part.at("endSample");
    wall += part.at("seconds").at("wall").get<double>();
  }
  EXPECT_EQ(sample, 512);
  EXPECT_EQ(parts.back().at("threads"), 1);
  EXPECT_NEAR(resumed.at("seconds").at("render").at("wall").get<double>(), wall, .05);
  EXPECT_NE(r.output.find("  part      samples 0 to "), std::string::npos) << r.output;
}

TEST_F(Checkpoints, TheHeaderIsOfAllParts) {
  render(fogScene(random(3), ""));
  ASSERT_EQ(pbrt("--quiet --resume c.ckpt --spp 8 --outfile fog.exr a.pbrt").status, 0);
  const Image image = readImage(folder_.path() / "fog.exr");
  EXPECT_EQ(image.metadata.at("samples"), "8");
  const std::string parts = image.metadata.at("parts");
  EXPECT_EQ(parts.find("samples 0 to 3 of each pixel in "), 0u) << parts;
  EXPECT_NE(parts.find("\nsamples 3 to 8 of each pixel in "), std::string::npos) << parts;
  ASSERT_EQ(pbrt("--quiet --outfile whole.exr a.pbrt").status, 0);
  EXPECT_EQ(readImage(folder_.path() / "whole.exr").metadata.count("parts"), 0u);
}

TEST_F(Checkpoints, AnotherRenderIsRefusedByAllThatDiffers) {
  render(fogScene(halton(2), ""), "--seed 1");
  expectRefused("--seed 2 a.pbrt", {"what differs: --seed (1, here 2)\n"});
  expectRefused("--seed 1 --quick a.pbrt",
                {"--quick (no, here yes)", "the resolution (24 x 24, here 6 x 6)", "--cropwindow (pixels"});
  expectRefused("--seed 1 --cropwindow 0 .5 0 1 a.pbrt",
                {"what differs: --cropwindow (pixels 0 24 0 24, here pixels 0 12 0 24)\n"});
  expectRefused("--seed 1 --mediumparams '\"float g\" .5' a.pbrt",
                {"what differs: --mediumparams (none, here \"float g\" 0.5)\n"});
  folder_.write("b.pbrt", fogScene(halton(2), "\"float g\" .1"));
  expectRefused("--seed 1 b.pbrt", {"what differs: the text of the scene\n"});
  expectRefused("--seed 3 b.pbrt", {"the text of the scene, --seed (1, here 3)\n"});
  // What changes no bit is welcome.
  const ProcessResult r = pbrt(
      "--resume c.ckpt --seed 1 --nthreads 3 --tile-size 7 --outfile other.png --pixeltype float --time 9 "
      "--strict a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_TRUE(folder_.has("other.png"));
}

TEST_F(Checkpoints, OptionsAreComparedByTheirValues) {
  render(fogScene(halton(2), "\"float g\" $g \"string transmittance\" \"${t}\""),
         "--define g=.20 --define t=ratio --mediumparams '\"rgb sigma_s\" [ 9.0 8 7 ] \"float scale\" 1.'");
  const std::string params = " --mediumparams '\"float scale\" [ 1 ]  \"rgb sigma_s\" [ 9 8e0 7 ]' a.pbrt";
  const ProcessResult same = pbrt("--resume c.ckpt --define g=2e-1 --define t=ratio" + params);
  EXPECT_EQ(same.status, 0) << same.output;
  expectRefused("--define g=.3 --define t=ratio" + params, {"what differs: $g (0.2, here 0.3)\n"});
  expectRefused("--define g=.2 --define t=residual-ratio" + params,
                {"what differs: $t (\"ratio\", here \"residual-ratio\")\n"});
}

TEST_F(Checkpoints, OtherVolumesAreRefused) {
  const auto writeVolume = [&](float last) {
    const float density[8] = {1, 1, 1, 1, 1, 1, 1, last};
    folder_.write("fog.raw", std::string(reinterpret_cast<const char*>(density), sizeof density));
  };
  writeVolume(1);
  std::string scene = fogScene(halton(2), "");
  const std::string perlin = "\"perlin\"";
  scene.replace(
      scene.find(perlin), perlin.size(),
      "\"heterogeneous\" \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 \"string filename\" \"fog.raw\"");
  render(scene);
  writeVolume(2);
  expectRefused("a.pbrt", {"what differs: the content of \"fog.raw\"\n"});
  std::filesystem::rename(folder_.path() / "fog.raw", folder_.path() / "same.raw");
  scene.replace(scene.find("fog.raw"), 7, "same.raw");
  folder_.write("a.pbrt", scene);
  expectRefused("a.pbrt", {"the text of the scene", "the content of \"same.raw\" (only here)",
                           "the content of \"fog.raw\" (only there)"});
}

TEST_F(Checkpoints, FinishedRendersGetMoreSamplesWhereThatHasAMeaning) {
  render(fogScene(random(8), ""));
  ASSERT_EQ(pbrt("--quiet --spp 24 --outfile whole.pfm a.pbrt").status, 0);
  // Finished: the same image again.
  const std::string eight = folder_.read("fog.pfm");
  std::filesystem::remove(folder_.path() / "fog.pfm");
  ASSERT_EQ(pbrt("--quiet --resume c.ckpt a.pbrt").status, 0);
  EXPECT_EQ(folder_.read("fog.pfm"), eight);
  ASSERT_EQ(pbrt("--quiet --resume c.ckpt --spp 24 --stats s.json a.pbrt").status, 0);
  EXPECT_EQ(folder_.read("fog.pfm"), folder_.read("whole.pfm"));
  EXPECT_EQ(statistics("s.json")[0].at("samplesTaken"), statistics("s.json")[0].at("samplesPlanned"));
  EXPECT_FALSE(statistics("s.json")[0].at("interrupted"));
  expectRefused("--spp 4 a.pbrt", {"(8, here 4), of which 8 are taken"});

  std::filesystem::remove(folder_.path() / "c.ckpt");
  render(fogScene(halton(8), ""));
  expectRefused("--spp 24 a.pbrt",
                {"sampler \"halton\" spreads all samples of a pixel together", "imgtool merge"});

  std::filesystem::remove(folder_.path() / "c.ckpt");
  folder_.write("a.pbrt", fogScene(random(kEndless), ""));
  BackgroundProgram program = start({"--checkpoint", "c.ckpt", "--checkpoint-interval", ".01", "a.pbrt"});
  while (checkpoint() == 0 && !program.isOver()) std::this_thread::sleep_for(1ms);
  ASSERT_EQ(program.end(SIGKILL), 128 + SIGKILL) << folder_.read("said");
  expectRefused("--spp 2000000 a.pbrt", {"(1048576, here 2000000)", "only a finished render"});
}

TEST_F(Checkpoints, NoRenderIsLostByAccident) {
  folder_.write("a.pbrt", fogScene(random(2), ""));
  const ProcessResult missing = pbrt("--resume c.ckpt a.pbrt");
  EXPECT_EQ(missing.status, 1);
  EXPECT_NE(missing.output.find("c.ckpt"), std::string::npos) << missing.output;
  EXPECT_FALSE(folder_.has("fog.pfm"));
  EXPECT_EQ(pbrt("--resume c.ckpt --checkpoint other.ckpt a.pbrt").status, 1);
  // For a job that is started by one command, however often.
  const ProcessResult first = pbrt("--resume c.ckpt --checkpoint ./c.ckpt a.pbrt");
  EXPECT_EQ(first.status, 0);
  EXPECT_NE(first.output.find("note: there is no \"c.ckpt\" yet: starting at the beginning"),
            std::string::npos)
      << first.output;
  EXPECT_EQ(pbrt("--resume c.ckpt --checkpoint ./c.ckpt a.pbrt").status, 0);
  const std::string kept = folder_.read("c.ckpt");
  const ProcessResult again = pbrt("--checkpoint c.ckpt a.pbrt");
  EXPECT_EQ(again.status, 1);
  EXPECT_NE(again.output.find("go on with it by --resume \"c.ckpt\", or remove it"), std::string::npos)
      << again.output;
  EXPECT_EQ(folder_.read("c.ckpt"), kept);
  const ProcessResult nowhere = pbrt("--checkpoint no/such/c.ckpt a.pbrt");
  EXPECT_EQ(nowhere.status, 1);
  EXPECT_EQ(nowhere.output.find("pbrt: error: --checkpoint \"no/such/c.ckpt\": cannot be written"), 0u)
      << nowhere.output;
  EXPECT_EQ(pbrt("--checkpoint-interval 3 a.pbrt").status, 1) << "of which checkpoint?";
  EXPECT_EQ(pbrt("--checkpoint d.ckpt --checkpoint-interval 0 a.pbrt").status, 1);
}

TEST_F(Checkpoints, AFullDiskCostsNoImage) {
  folder_.write("a.pbrt", fogScene(random(2), ""));
  const ProcessResult r = pbrt("--checkpoint /dev/full a.pbrt");
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("pbrt: error: --checkpoint: cannot write /dev/full"), std::string::npos)
      << r.output;
  EXPECT_TRUE(folder_.has("fog.pfm"));
}

TEST_F(Checkpoints, OfSeveralWorldsTheOneUnderWayIsKept) {
  std::string two = fogScene(random(4), kProgressive, 8, "one.pfm");
  two += fogScene(random(8), kProgressive, 16, "two.pfm") + fogScene(random(4), "", 8, "three.pfm");
  folder_.write("a.pbrt", two);
  ASSERT_EQ(pbrt("--quiet --stats whole.json a.pbrt").status, 0);
  std::map<std::string, std::string> images;
  for (const char* name : {"one.pfm", "two.pfm", "three.pfm"}) images[name] = folder_.read(name);
  // Killed in the second of them.
  std::string endless = two;
  const std::string eight = "\"integer pixelsamples\" 8";
  ASSERT_NE(endless.find(eight), std::string::npos);
  endless.replace(endless.find(eight), eight.size(), "\"integer pixelsamples\" 1000000");
  folder_.write("endless.pbrt", endless);
  {
    BackgroundProgram program =
        start({"--checkpoint", "c.ckpt", "--checkpoint-interval", ".01", "endless.pbrt"});
    const auto isInSecond = [&] {
      return checkpoint() != 0 && Checkpoint::read(folder_.path() / "c.ckpt").head().world == 1;
    };
    while (!isInSecond() && !program.isOver()) std::this_thread::sleep_for(1ms);
    ASSERT_EQ(program.end(SIGKILL), 128 + SIGKILL) << folder_.read("said");
  }
  EXPECT_EQ(folder_.read("one.pfm"), images["one.pfm"]) << "written before the second world began";
  std::filesystem::remove(folder_.path() / "one.pfm");
  const ProcessResult more = pbrt("--resume c.ckpt --time 1 endless.pbrt");
  EXPECT_EQ(more.status, 0);
  EXPECT_NE(more.output.find("note: going on with world 2; the images of those before are written"),
            std::string::npos)
      << more.output;
  EXPECT_FALSE(folder_.has("one.pfm"));
  std::filesystem::remove(folder_.path() / "c.ckpt");
  // The last one is kept when all is done; --stats has all worlds.
  ASSERT_EQ(pbrt("--quiet --checkpoint c.ckpt a.pbrt").status, 0);
  for (const char* name : {"one.pfm", "two.pfm", "three.pfm"}) std::filesystem::remove(folder_.path() / name);
  ASSERT_EQ(pbrt("--quiet --resume c.ckpt --stats s.json a.pbrt").status, 0);
  EXPECT_FALSE(folder_.has("two.pfm"));
  const ProcessResult extended = pbrt("--quiet --resume c.ckpt --spp 16 a.pbrt");
  EXPECT_EQ(extended.status, 1);
  EXPECT_NE(extended.output.find("of the last of several worlds"), std::string::npos) << extended.output;
  EXPECT_EQ(folder_.read("three.pfm"), images["three.pfm"]);
  const nlohmann::json whole = statistics("whole.json"), resumed = statistics("s.json");
  ASSERT_EQ(resumed.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(resumed[i].at("counters"), whole[i].at("counters"));
    EXPECT_EQ(resumed[i].at("outfile"), whole[i].at("outfile"));
  }
  folder_.write("a.pbrt", fogScene(random(4), "", 8, "one.pfm"));
  expectRefused("a.pbrt", {"it is of world 3 of a scene, and here there are 1"});
}

TEST_F(Checkpoints, ABoundsCacheIsNotLookedAtByWhoGoesOn) {
  render(fogScene(random(4), kProgressive), "--bounds-cache b.bounds");
  ASSERT_EQ(pbrt("--quiet --outfile whole.pfm --spp 8 a.pbrt").status, 0);
  const ProcessResult r = pbrt("--resume c.ckpt --bounds-cache b.bounds --spp 8 --stats s.json a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_FALSE(statistics("s.json")[0]["learnedBounds"][0]["restored"])
      << "the bounds are those of the checkpoint";
  EXPECT_EQ(folder_.read("fog.pfm"), folder_.read("whole.pfm"));
}

/// Of the last row of a --convergence file: samples, look-ups, rays, and the errors that need no seconds.
std::string lastErrors(const std::string& csv) {
  const std::size_t end = csv.rfind("\n# measuring took"), begin = csv.rfind('\n', end - 1) + 1;
  std::vector<std::string> cells(1);
  for (const char c : csv.substr(begin, end - begin)) {
    if (c == ',') {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  std::string text;
  for (std::size_t i = 2; i < cells.size() && i < 11; ++i) text += cells[i] + ' ';
  return text;
}

TEST_F(Checkpoints, HalvesOfTheSamplesGoAlong) {
  render(fogScene(random(5), ""), "--error 1e-9");
  ASSERT_EQ(pbrt("--quiet --spp 12 --convergence whole.csv --outfile whole.pfm a.pbrt").status, 0);
  ASSERT_EQ(pbrt("--quiet --spp 12 --convergence part.csv --resume c.ckpt a.pbrt").status, 0);
  EXPECT_EQ(folder_.read("fog.pfm"), folder_.read("whole.pfm"));
  const std::string errors = lastErrors(folder_.read("whole.csv"));
  EXPECT_EQ(errors.find("12 "), 0u) << folder_.read("whole.csv");
  EXPECT_EQ(lastErrors(folder_.read("part.csv")), errors);
  ASSERT_EQ(pbrt("--quiet --spp 12 --resume c.ckpt a.pbrt").status, 0) << "nobody needs to look at them";
  EXPECT_EQ(folder_.read("fog.pfm"), folder_.read("whole.pfm"));
  std::filesystem::remove(folder_.path() / "c.ckpt");
  render(fogScene(random(5), ""));
  expectRefused("--spp 12 --error 1e-9 a.pbrt", {"does not have the halves of the samples"});
}

std::string messageOf(const std::filesystem::path& file) {
  try {
    (void)Checkpoint::read(file);
    return "";
  } catch (const SceneError& e) {
    return e.what();
  }
}

class CheckpointFile : public testing::Test {
 protected:
  void SetUp() override {
    head_.causes = {{"--seed", "3"}, {"the text of the scene", "#12ab"}};
    head_.samplesPerPixel = 64;
    head_.samplesDone = 12;
    head_.world = 1;
    head_.worldsDone = {"{}"};
    head_.parts = {{0, 5, {1.5, 2.5}, 2, "v1"}, {5, 12, {3.5, 4.5}, 3, "v2"}};
    file_ = folder_.path() / "c.ckpt";
    bytes_ = Checkpoint::write(file_, head_, [](ByteWriter& out) { out.addPlain("state"); });
  }
  TemporaryFolder folder_;
  CheckpointHead head_;
  std::filesystem::path file_;
  std::uint64_t bytes_ = 0;
};

TEST_F(CheckpointFile, HoldsHeadAndState) {
  const Checkpoint read = Checkpoint::read(file_);
  EXPECT_EQ(read.state(), "state");
  EXPECT_EQ(bytes_, std::filesystem::file_size(file_));
  const CheckpointHead& head = read.head();
  EXPECT_EQ(head.causes, head_.causes);
  EXPECT_EQ(head.samplesPerPixel, 64u);
  EXPECT_EQ(head.samplesDone, 12u);
  EXPECT_EQ(head.world, 1u);
  EXPECT_EQ(head.worldsDone, head_.worldsDone);
  ASSERT_EQ(head.parts.size(), 2u);
  EXPECT_EQ(head.parts[1].first, 5);
  EXPECT_EQ(head.parts[1].end, 12);
  EXPECT_EQ(head.parts[1].time.wall, 3.5);
  EXPECT_EQ(head.parts[1].time.cpu, 4.5);
  EXPECT_EQ(head.parts[1].threads, 3u);
  EXPECT_EQ(head.parts[1].version, "v2");
}

TEST_F(CheckpointFile, RefusesEveryWrongByteAndEveryShorterText) {
  const std::string good = folder_.read("c.ckpt");
  for (std::size_t at = 0; at < good.size(); ++at) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 4);
    folder_.write("bad.ckpt", bad);
    EXPECT_NE(messageOf(folder_.path() / "bad.ckpt"), "") << at;
    folder_.write("bad.ckpt", good.substr(0, at));
    EXPECT_NE(messageOf(folder_.path() / "bad.ckpt"), "") << at;
  }
  folder_.write("bad.ckpt", good + "x");
  EXPECT_EQ(messageOf(folder_.path() / "bad.ckpt"), "checkpoint: the file is truncated or corrupt");
  folder_.write("bad.ckpt", "PF\n1 1\n");
  EXPECT_EQ(messageOf(folder_.path() / "bad.ckpt"), "checkpoint: this is no such file");
  std::string next = good;
  next[next.find('2')] = '3';
  folder_.write("bad.ckpt", next);
  EXPECT_EQ(messageOf(folder_.path() / "bad.ckpt"), "checkpoint: version 3, expected 2");
}

TEST_F(CheckpointFile, OfSeveralBlocksIsTheSame) {
  std::string state;
  Rng rng(1);
  while (state.size() < 2 * ByteWriter::kBlock + 1000)
    state += static_cast<char>(static_cast<int>(rng.uniform() * 255) - 128);
  Checkpoint::write(file_, head_, [&](ByteWriter& out) { out.addPlain(state); });
  EXPECT_EQ(Checkpoint::read(file_).state(), state);
  std::string bad = folder_.read("c.ckpt");
  bad[ByteWriter::kBlock + 77] = static_cast<char>(bad[ByteWriter::kBlock + 77] ^ 1);
  folder_.write("bad.ckpt", bad);
  EXPECT_EQ(messageOf(folder_.path() / "bad.ckpt"), "checkpoint: the file is truncated or corrupt");
}

}  // namespace
}  // namespace pbrtmedia::test
