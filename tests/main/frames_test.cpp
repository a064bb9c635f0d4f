// SPDX-License-Identifier: BSD-2-Clause
// --define and --frames as a user meets them.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <thread>

#include "base/stopwatch.h"
#include "support/background_program.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

class Frames : public testing::Test {
 protected:
  /// A sphere of fog at a distance.
  void write(const std::string& filename, const std::string& distance = "$distance",
             const std::string& samples = "2") const {
    std::ofstream(folder_.path() / "s.pbrt")
        << "Define \"tau\" 1\nDefine \"radius\" 1\n"
        << "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" \""
        << filename << "\"\nSampler \"random\" \"integer pixelsamples\" " << samples
        << "\nIntegrator \"volpath\"\nCamera \"perspective\"\nWorldBegin\nTranslate 0 0 " << distance
        << "\n"
           "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ $tau $tau $tau ]\n"
           "LightSource \"infinite\"\nMediumInterface \"m\" \"\"\nMaterial \"\"\n"
           "Shape \"sphere\" \"float radius\" $radius\nWorldEnd\n";
  }
  ProcessResult pbrt(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && timeout -s KILL 60 '" PBRT_PROGRAM "' " + arguments);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_.path() / name); }
  void expectFails(const std::string& arguments, const std::string& part) const {
    const ProcessResult r = pbrt(arguments);
    EXPECT_EQ(r.status, 1) << arguments;
    EXPECT_NE(r.output.find(part), std::string::npos) << r.output;
  }

  TemporaryFolder folder_;
};

TEST_F(Frames, AreTheRendersOfTheirNumbers) {
  write("a-####.pfm", "$frame");
  const ProcessResult all = pbrt("--frames 3:8:2 --stats s-##.json --define tau=2 s.pbrt --quiet");
  ASSERT_EQ(all.status, 0) << all.output;
  for (const int frame : {3, 5, 7}) {
    const std::string number = std::to_string(frame), image = "a-000" + number + ".pfm";
    ASSERT_TRUE(exists(image));
    EXPECT_TRUE(exists("s-0" + number + ".json"));
    ASSERT_EQ(pbrt("--define frame=" + number + " --define tau=2 --outfile one.pfm s.pbrt --quiet").status,
              0);
    EXPECT_TRUE(folder_.read(image) == folder_.read("one.pfm")) << frame;
  }
  EXPECT_TRUE(folder_.read("a-0003.pfm") != folder_.read("a-0005.pfm"));
  EXPECT_FALSE(exists("a-0004.pfm"));
  EXPECT_FALSE(exists("a-0009.pfm"));
}

TEST_F(Frames, AreNotWrittenOverEachOther) {
  write("a.pfm");
  const std::string defined = " --define distance=4 --quiet s.pbrt";
  expectFails("--frames 1:2" + defined, "every frame would write the image \"a.pfm\"; write \"a-####.pfm\"");
  expectFails("--frames 1:2 --outfile b.pfm" + defined, "every frame would write --outfile \"b.pfm\"");
  for (const std::string option : {"--stats", "--convergence", "--checkpoint", "--bounds-cache"}) {
    expectFails("--frames 1:2 --outfile b-##.pfm " + option + " f" + defined, option + " \"f\"");
  }
  EXPECT_FALSE(exists("a.pfm"));
  EXPECT_EQ(pbrt("--frames 5" + defined).status, 0);
  EXPECT_TRUE(exists("a.pfm")) << "one frame needs no number";
  write("a-${frame}.pfm");
  EXPECT_EQ(pbrt("--frames 1:2" + defined).status, 0);
  EXPECT_TRUE(exists("a-1.pfm") && exists("a-2.pfm"));
}

/// Variables, and the number of the frame, in --mediumparams too.
TEST_F(Frames, AreFilledInInParametersOfMedia) {
  std::ofstream(folder_.path() / "s.pbrt")
      << "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 \"string filename\" "
         "\"a-#.pfm\"\nSampler \"random\" \"integer pixelsamples\" 2\nIntegrator \"volpath\"\n"
         "Camera \"perspective\"\nWorldBegin\nTranslate 0 0 4\nMakeNamedMedium \"m\" \"string type\" "
         "\"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 1 \"point p0\" [ -1 -1 -1 ] "
         "\"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" [ 0 0 0 ]\nLightSource \"infinite\"\n"
         "MediumInterface \"m\" \"\"\nMaterial \"\"\nShape \"sphere\"\nWorldEnd\n";
  for (const int frame : {1, 2}) {
    const float density = .5f * static_cast<float>(frame);
    std::ofstream(folder_.path() / ("v-0" + std::to_string(frame) + ".raw"), std::ios::binary)
        .write(reinterpret_cast<const char*>(&density), sizeof density);
  }
  const std::string params =
      " --mediumparams '\"string filename\" \"v-##.raw\" \"rgb sigma_a\" [ $frame $k 1 ]'";
  const ProcessResult all = pbrt("--frames 1:2 --quiet --define k=3" + params + " s.pbrt");
  ASSERT_EQ(all.status, 0) << all.output;
  for (const std::string frame : {"1", "2"}) {
    const ProcessResult one = pbrt("--quiet --outfile one.pfm --mediumparams '\"string filename\" \"v-0" +
                                   frame + ".raw\" \"rgb sigma_a\" [ " + frame + " 3 1 ]' s.pbrt");
    ASSERT_EQ(one.status, 0) << one.output;
    EXPECT_TRUE(folder_.read("a-" + frame + ".pfm") == folder_.read("one.pfm")) << frame;
  }
  EXPECT_TRUE(folder_.read("a-1.pfm") != folder_.read("a-2.pfm"));
  expectFails("--frames 1:2 --quiet" + params + " s.pbrt", "--mediumparams:1:53: error: no variable \"k\"");
}

TEST_F(Frames, OfOneSceneAreNamedWhereTheyAreMixed) {
  write("a-#.exr", "$frame");
  for (const std::string frame : {"1", "2"})
    ASSERT_EQ(pbrt("--quiet --frames " + frame + " --seed " + frame + " s.pbrt").status, 0);
  const ProcessResult r =
      run("cd '" + folder_.path().string() + "' && '" IMGTOOL_PROGRAM "' merge a-1.exr a-2.exr -o b.exr");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("different scenes: the variable $frame (1 and 2) differs"), std::string::npos)
      << r.output;
}

/// What keeps one frame from being rendered does not keep the others.
TEST_F(Frames, GoOnBehindOneThatFails) {
  write("a-####.pfm", "4");
  std::ofstream(folder_.path() / "c-2.checkpoint") << "something else";
  const ProcessResult r = pbrt("--frames 1:3 --checkpoint c-#.checkpoint s.pbrt");
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_TRUE(exists("a-0001.pfm") && exists("a-0003.pfm")) << r.output;
  EXPECT_FALSE(exists("a-0002.pfm")) << r.output;
  EXPECT_NE(r.output.find("c-2.checkpoint"), std::string::npos) << r.output;
}

TEST_F(Frames, TellWhichWorldsATimeLeavesOut) {
  write("a.pfm", "4", "100000000");
  const std::string scene = folder_.read("s.pbrt");
  std::string second = scene;
  second.replace(second.find("a.pfm"), 5, "b.pfm");
  std::ofstream(folder_.path() / "s.pbrt") << scene << second;
  const ProcessResult r = pbrt("--time 0.3 s.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("warning: stopped: 1 of 2 worlds are not rendered"), std::string::npos) << r.output;
}

TEST_F(Frames, EndWhereASignalCame) {
  write("a-####.pfm", "4", "100000000");
  BackgroundProgram program({PBRT_PROGRAM, "--frames", "1:3", "--progress", "plain", "s.pbrt"},
                            folder_.path(), folder_.path() / "output.txt");
  const Stopwatch waiting;
  while (program.output().find(" samples") == std::string::npos && waiting.seconds() < 30) {
    ASSERT_FALSE(program.isOver()) << program.output();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(program.end(SIGINT), 0) << program.output();
  EXPECT_TRUE(exists("a-0001.pfm")) << program.output();
  EXPECT_FALSE(exists("a-0002.pfm")) << program.output();
}

TEST_F(Frames, MistakesOfTheCommandLine) {
  write("a-####.pfm");
  for (const std::string wrong : {"2:1", "a", "1:2:0", "-1:3", "1:", "1:2:3:4", "1:2000000000000", ""}) {
    expectFails("--frames '" + wrong + "' s.pbrt", "--frames");
  }
  for (const std::string wrong : {"x", "=1", "1x=2", "a-b=3"}) {
    expectFails("--define '" + wrong + "' s.pbrt", "--define: found " + wrong + ", expected NAME=VALUE");
  }
  expectFails("--define distance=4 --define raduis=2 s.pbrt", "did you mean \"radius\"?");
  expectFails("--frames 1:2 - < s.pbrt", "standard input can be read once only");
  EXPECT_EQ(pbrt("--frames 1:2 --cat --define distance=4 s.pbrt").status, 0);
}

}  // namespace
}  // namespace pbrtmedia::test
