// SPDX-License-Identifier: BSD-2-Clause
// `mpirun pbrt-mpi` as a user runs it, many ranks on this machine: the bits, the messages and the end of one
// process.
#include <gtest/gtest.h>

#ifdef PBRT_MPI_PROGRAM

#include <signal.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "image/image.h"
#include "support/background_program.h"
#include "support/process.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

using namespace std::chrono_literals;

/// Fog around two lights; pixels are sums of samples that lie up to two pixels away.
std::string world(const std::string& outfile, int spp, const std::string& medium) {
  return "Film \"image\" \"integer xresolution\" 30 \"integer yresolution\" 22 \"string filename\" \"" +
         outfile + "\"\nPixelFilter \"gaussian\"\nSampler \"halton\" \"integer pixelsamples\" " +
         std::to_string(spp) +
         "\nIntegrator \"volpath\" \"integer maxdepth\" 6\n"
         "LookAt .5 .5 -2  .5 .5 0  0 1 0 Camera \"perspective\" \"float fov\" 40\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [ .5 .7 1 ]\nLightSource \"point\" \"point from\" [ 2 3 -1 ] "
         "\"rgb I\" [ 9 8 7 ]\nMakeNamedMedium \"fog\" \"rgb sigma_s\" [ 9 8 7 ] \"rgb sigma_a\" [ .5 .5 .5 "
         "] " +
         medium +
         "\nMaterial \"none\" MediumInterface \"fog\" \"\"\nTranslate .5 .5 .5\nShape \"sphere\" \"float "
         "radius\" .9\nWorldEnd\n";
}
const std::string kHomogeneous = "\"string type\" \"homogeneous\"";
const std::string kProgressive =
    "\"string type\" \"perlin\" \"integer octaves\" 3 \"float frequency\" 3 \"integer supervoxels\" 4 "
    "\"string "
    "bounds\" \"progressive\" \"integer warmup\" 1";
/// More samples than anybody waits for.
constexpr int kEndless = 1 << 20;

class PbrtMpi : public testing::Test {
 protected:
  void SetUp() override {
    // Open MPI asks root whether it means it.
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    ::setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    // Under AddressSanitizer: what Open MPI keeps to the end is not ours.
    const char* const options = ::getenv("ASAN_OPTIONS");
    ::setenv("ASAN_OPTIONS",
             ((options != nullptr ? options + std::string(":") : "") + "detect_leaks=0").c_str(), 1);
  }
  static std::vector<std::string> words(int ranks, const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {MPIRUN_PROGRAM, "--oversubscribe", "-n", std::to_string(ranks),
                                    PBRT_MPI_PROGRAM};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return all;
  }
  ProcessResult mpi(int ranks, const std::string& arguments) const {
    return shell("'" MPIRUN_PROGRAM "' --oversubscribe -n " + std::to_string(ranks) +
                 " '" PBRT_MPI_PROGRAM "' " + arguments);
  }
  ProcessResult pbrt(const std::string& arguments) const { return shell("'" PBRT_PROGRAM "' " + arguments); }
  nlohmann::json statistics(const std::string& name) const {
    return nlohmann::json::parse(folder_.read(name)).at("renders");
  }
  bool has(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
  TemporaryFolder folder_;

 private:
  ProcessResult shell(const std::string& command) const {
    return run("cd '" + folder_.path().string() + "' && timeout -s KILL 60 " + command);
  }
};

int countOf(const std::string& text, const std::string& word) {
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

/// Of the last row of a --convergence file: what comes of samples, not of seconds.
std::string errorsOf(const std::string& csv) {
  std::istringstream lines(csv);
  std::string last, text;
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line[0] != '#' && line[0] != 's') last = line;
  }
  std::istringstream cells(last);
  int column = 0;
  for (std::string cell; std::getline(cells, cell, ','); ++column) {
    if (column >= 2 && column < 11) text += cell + ' ';
  }
  return text;
}

TEST_F(PbrtMpi, RendersTheImagesOfOneProcessForAnyRanksAndThreads) {
  folder_.write("a.pbrt", world("fog.pfm", 7, kHomogeneous) + world("cloud.pfm", 7, kProgressive));
  ASSERT_EQ(pbrt("--quiet --stats one.json a.pbrt").status, 0);
  const std::string fog = folder_.read("fog.pfm"), cloud = folder_.read("cloud.pfm");
  const nlohmann::json one = statistics("one.json");
  for (int ranks = 1; ranks <= 4; ++ranks) {
    for (const char* threads : {"1", "2"}) {
      for (const char* name : {"fog.pfm", "cloud.pfm"}) std::filesystem::remove(folder_.path() / name);
      const ProcessResult r =
          mpi(ranks, std::string("--quiet --stats many.json --nthreads ") + threads + " a.pbrt");
      ASSERT_EQ(r.status, 0) << r.output;
      EXPECT_EQ(r.output, "");
      EXPECT_TRUE(folder_.read("fog.pfm") == fog) << ranks << " ranks, " << threads << " threads";
      EXPECT_TRUE(folder_.read("cloud.pfm") == cloud) << ranks << " ranks, " << threads << " threads";
      const nlohmann::json many = statistics("many.json");
      ASSERT_EQ(many.size(), 2u);
      for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(many[i].at("counters"), one[i].at("counters")) << ranks;
        EXPECT_EQ(many[i].at("learnedBounds"), one[i].at("learnedBounds")) << ranks;
        EXPECT_EQ(many[i].at("samplesTaken"), one[i].at("samplesTaken"));
        const nlohmann::json& shares = many[i].at("ranks");
        ASSERT_EQ(shares.size(), ranks == 1 ? 0u : static_cast<std::size_t>(ranks));
        double cpu = 0;
        for (const auto& share : shares) {
          EXPECT_EQ(share.at("threads").dump(), threads);
          EXPECT_GT(share.at("bytesSent"), 0);
          EXPECT_GT(share.at("messages"), 0);
          const double lost = share.at("secondsLost"), passes = share.at("passes");
          EXPECT_GT(lost, 0);
          EXPECT_DOUBLE_EQ(
              lost, share.at("secondsWaiting").get<double>() + share.at("secondsMoving").get<double>());
          EXPECT_DOUBLE_EQ(share.at("secondsLostPerPass").get<double>() * passes, lost);
          cpu += share.at("cpuSeconds").get<double>();
        }
        if (ranks > 1) {
          const double told = many[i].at("seconds").at("render").at("cpu").get<double>();
          EXPECT_LE(told, 1.05 * cpu + .02);
          EXPECT_GT(told, shares[0].at("cpuSeconds").get<double>()) << "that of all ranks, not of the first";
        }
      }
    }
  }
}

/// What light paths bring to pixels of other ranks is summed in the order of one process, in halves too.
TEST_F(PbrtMpi, RendersBdptAsOneProcessDoes) {
  std::string scene = world("lit.exr", 6, kProgressive);
  scene.replace(scene.find("volpath"), 7, "bdpt");
  folder_.write("a.pbrt", scene);
  const std::string options = "--quiet --pixeltype float --layers variance,lookups --error 1e-9 ";
  ASSERT_EQ(pbrt(options + "--stats one.json --convergence one.csv a.pbrt").status, 0);
  const Image one = readImage(folder_.path() / "lit.exr");
  for (int ranks = 1; ranks <= 4; ++ranks) {
    std::filesystem::remove(folder_.path() / "lit.exr");
    const ProcessResult r =
        mpi(ranks, options + "--stats many.json --convergence many.csv --nthreads 2 a.pbrt");
    ASSERT_EQ(r.status, 0) << r.output;
    const Image many = readImage(folder_.path() / "lit.exr");
    EXPECT_EQ(many.data(), one.data()) << ranks << " ranks";
    EXPECT_EQ(many.channels(), one.channels());
    EXPECT_EQ(statistics("many.json")[0].at("counters"), statistics("one.json")[0].at("counters")) << ranks;
    EXPECT_EQ(errorsOf(folder_.read("many.csv")), errorsOf(folder_.read("one.csv"))) << ranks;
  }
  EXPECT_FALSE(errorsOf(folder_.read("one.csv")).empty());
}

TEST_F(PbrtMpi, AKilledRankEndsTheJobAndLeavesACheckpoint) {
  const std::string scene = world("cloud.pfm", 200, kProgressive);
  folder_.write("a.pbrt", scene);
  ASSERT_EQ(pbrt("--quiet --outfile whole.pfm --stats whole.json a.pbrt").status, 0);
  {
    BackgroundProgram job(words(3, {"--quiet", "--nthreads", "1", "--checkpoint", "c.ckpt",
                                    "--checkpoint-interval", ".01", "a.pbrt"}),
                          folder_.path(), folder_.path() / "said");
    while (!has("c.ckpt") && !job.isOver()) std::this_thread::sleep_for(1ms);
    std::string list;
    const std::string id = std::to_string(job.process());
    std::getline(std::ifstream("/proc/" + id + "/task/" + id + "/children"), list);
    std::istringstream children(list);
    std::vector<pid_t> ranks;
    for (pid_t rank = 0; children >> rank;) ranks.push_back(rank);
    ASSERT_EQ(ranks.size(), 3u) << list << folder_.read("said");
    ::kill(ranks.back(), SIGKILL);
    const auto status = job.wait(20);
    ASSERT_TRUE(status) << "the job goes on without a rank";
    EXPECT_NE(*status, 0);
  }
  EXPECT_FALSE(has("cloud.pfm")) << "the render was over before the rank was killed";
  const std::string checkpoint = folder_.read("c.ckpt");
  // One process goes on, and so do four.
  ASSERT_EQ(pbrt("--quiet --resume c.ckpt --stats s.json a.pbrt").status, 0);
  EXPECT_TRUE(folder_.read("cloud.pfm") == folder_.read("whole.pfm"));
  EXPECT_EQ(statistics("s.json")[0].at("counters"), statistics("whole.json")[0].at("counters"));
  EXPECT_EQ(statistics("s.json")[0].at("learnedBounds"), statistics("whole.json")[0].at("learnedBounds"));
  EXPECT_EQ(statistics("s.json")[0].at("parts").size(), 2u);
  std::filesystem::remove(folder_.path() / "cloud.pfm");
  const ProcessResult four = mpi(4, "--quiet --resume c.ckpt --checkpoint c.ckpt --stats s.json a.pbrt");
  ASSERT_EQ(four.status, 0) << four.output;
  EXPECT_TRUE(folder_.read("cloud.pfm") == folder_.read("whole.pfm"));
  EXPECT_EQ(statistics("s.json")[0].at("counters"), statistics("whole.json")[0].at("counters"));
  EXPECT_NE(folder_.read("c.ckpt"), checkpoint) << "the last one is of the whole render";
}

TEST_F(PbrtMpi, TellsWhatIsWrongOnce) {
  folder_.write("bad.pbrt", "WorldBegin\nShape \"sphere\" \"float radius\" [ \"x\" ]\nWorldEnd\n");
  struct Case {
    const char *arguments, *message;
  };
  for (const Case& c :
       {Case{"bad.pbrt", "bad.pbrt:2:"}, Case{"nowhere.pbrt", "cannot open \"nowhere.pbrt\""},
        Case{"--resume no.ckpt bad.pbrt", "no.ckpt"}, Case{"--nonsense bad.pbrt", "unknown option"},
        Case{"--stats no/such/file bad.pbrt", "--stats"}, Case{"- < bad.pbrt", "standard input"},
        Case{"--derivative x --step 1 bad.pbrt", "several processes cannot share"}}) {
    const ProcessResult r = mpi(3, std::string("--strict --quick ") + c.arguments);
    EXPECT_EQ(r.status, 1) << c.arguments;
    EXPECT_EQ(countOf(r.output, "error: "), 1) << r.output;
    EXPECT_NE(r.output.find(c.message), std::string::npos) << r.output;
  }
}

TEST_F(PbrtMpi, StopsWhereOneProcessStops) {
  folder_.write("a.pbrt", world("cloud.pfm", 1000, kHomogeneous));
  folder_.write("endless.pbrt", world("endless.pfm", kEndless, kProgressive));
  const std::string lookups = "--quiet --strict --lookups 100000 --outfile ";
  ASSERT_EQ(pbrt(lookups + "one.pfm --stats one.json endless.pbrt").status, 3);
  EXPECT_EQ(mpi(3, lookups + "many.pfm --stats many.json endless.pbrt").status, 3);
  EXPECT_TRUE(folder_.read("many.pfm") == folder_.read("one.pfm")) << "the look-ups of all ranks count";
  EXPECT_EQ(statistics("many.json")[0].at("stoppedBy"), "lookups");
  EXPECT_EQ(statistics("many.json")[0].at("counters"), statistics("one.json")[0].at("counters"));

  const ProcessResult timed = mpi(3, "--quiet --strict --time .6 --stats many.json endless.pbrt");
  EXPECT_EQ(timed.status, 3) << timed.output;
  EXPECT_EQ(statistics("many.json")[0].at("stoppedBy"), "time");
  EXPECT_LT(statistics("many.json")[0].at("seconds").at("render").at("wall"), 2);

  const std::string error = "--quiet --strict --error .2 --convergence ";
  ASSERT_EQ(pbrt(error + "one.csv --outfile one.pfm --stats one.json a.pbrt").status, 3);
  EXPECT_EQ(mpi(3, error + "many.csv --outfile many.pfm --stats many.json a.pbrt").status, 3);
  EXPECT_EQ(statistics("many.json")[0].at("stoppedBy"), "error");
  EXPECT_EQ(statistics("many.json")[0].at("samplesTaken"), statistics("one.json")[0].at("samplesTaken"));
  EXPECT_TRUE(folder_.read("many.pfm") == folder_.read("one.pfm"));
  EXPECT_EQ(countOf(folder_.read("many.csv"), "# convergence of"), 1);
}

TEST_F(PbrtMpi, TheTableOfThePageIsWhatTheProgramPrints) {
  const ProcessResult r = mpi(1, "--message-pattern");
  EXPECT_EQ(r.status, 0);
  EXPECT_GT(countOf(r.output, "| 1024 |"), 0) << r.output;
  std::ostringstream page;
  page << std::ifstream(sourceDir() / "docs/scaling.md").rdbuf();
  EXPECT_NE(page.str().find(r.output), std::string::npos) << "docs/scaling.md should have:\n" << r.output;
}

TEST_F(PbrtMpi, TheFirstRankShowsThePage) {
  folder_.write("a.pbrt", world("cloud.pfm", 20, kProgressive));
  ASSERT_EQ(pbrt("--quiet --outfile one.pfm a.pbrt").status, 0);
  const ProcessResult r = mpi(2, "--quiet --serve --outfile many.pfm a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
#ifdef PBRT_MEDIA_HAS_HTTPLIB
  EXPECT_EQ(countOf(r.output, "watch it at"), 1) << r.output;
#endif
  EXPECT_TRUE(folder_.read("many.pfm") == folder_.read("one.pfm"));
}

TEST_F(PbrtMpi, WritesTheImageSoFarWhenTheJobIsToEnd) {
  folder_.write("endless.pbrt", world("endless.pfm", kEndless, kProgressive));
  BackgroundProgram job(words(3, {"--nthreads", "1", "--checkpoint", "c.ckpt", "--checkpoint-interval", ".01",
                                  "--progress", "none", "endless.pbrt"}),
                        folder_.path(), folder_.path() / "said");
  while (!has("c.ckpt") && !job.isOver()) std::this_thread::sleep_for(1ms);
  const auto status = job.end(SIGTERM);
  ASSERT_TRUE(status) << folder_.read("said");
  EXPECT_TRUE(has("endless.pfm")) << folder_.read("said");
  EXPECT_EQ(countOf(folder_.read("said"), "stopping; the image so far"), 1) << folder_.read("said");
}

}  // namespace
}  // namespace pbrtmedia::test

#else

TEST(PbrtMpi, IsLeftOut) { GTEST_SKIP() << "built without MPI (libopenmpi-dev)"; }

#endif
