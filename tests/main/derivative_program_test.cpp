// SPDX-License-Identifier: BSD-2-Clause
// --derivative as a user meets it.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "image/image.h"
#include "support/process.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

class DerivativeProgram : public testing::Test {
 protected:
  /// A lamp that moves over a floor; `film`, `integrator` and what else the scene has.
  void write(const std::string& film = "", const std::string& integrator = "\"path\"",
             const std::string& more = "") const {
    std::ofstream(folder_.path() / "s.pbrt")
        << "Define \"lamp\" 1\nDefine \"idle\" 2\nFilm \"image\" \"integer xresolution\" 6 \"integer "
           "yresolution\" 4 \"string filename\" \"a.exr\" "
        << film << "\nSampler \"random\" \"integer pixelsamples\" 4\nIntegrator " << integrator
        << "\nLookAt 0 0 5  0 0 0  0 1 0\nCamera \"perspective\"\nWorldBegin\n"
        << "LightSource \"point\" \"point from\" [ $lamp 0 2 ]\n"
        << more
        << "\nShape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ -9 -9 0 9 -9 0 0 9 0 ]\n"
        << "WorldEnd\n";
  }
  ProcessResult pbrt(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && timeout -s KILL 60 '" PBRT_PROGRAM "' " + arguments);
  }
  ProcessResult imgtool(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && timeout -s KILL 60 '" IMGTOOL_PROGRAM "' " +
               arguments);
  }
  void expectFails(const std::string& arguments, const std::string& part) const {
    const ProcessResult r = pbrt(arguments + " s.pbrt");
    EXPECT_EQ(r.status, 1) << arguments;
    EXPECT_NE(r.output.find(part), std::string::npos) << arguments << '\n' << r.output;
  }
  Image image(const std::string& name) const { return readImage(folder_.path() / name); }

  TemporaryFolder folder_;
};

TEST_F(DerivativeProgram, WritesBothSignsAndSaysWhatItIs) {
  write();
  const ProcessResult r = pbrt("--derivative lamp --step .125 --debias single --stats s.json s.pbrt");
  ASSERT_EQ(r.status, 0) << r.output;
  const Image image = this->image("a.exr");
  const auto [least, most] = std::minmax_element(image.data().begin(), image.data().end());
  EXPECT_LT(*least, 0);
  EXPECT_GT(*most, 0);
  EXPECT_EQ(image.metadata.at("derivative"),
            "d/dlamp at lamp = 1, forward differences of step 0.125, debias single, 1 sample a pass");
  const auto json = nlohmann::json::parse(folder_.read("s.json"))["renders"][0];
  EXPECT_EQ(json["derivative"]["variable"], "lamp");
  EXPECT_EQ(json["derivative"]["value"], 1);
  EXPECT_EQ(json["derivative"]["step"], .125);
  EXPECT_EQ(json["derivative"]["debias"], "single");
  EXPECT_EQ(json["derivative"]["difference"], "forward");
  EXPECT_EQ(json["derivative"]["passes"], 4);
  EXPECT_GE(json["derivative"]["scenesBuilt"], 2);
  EXPECT_EQ(json["counters"]["droppedSamples"]["negative"], 0);
}

/// By hand it is the difference of two renders.
TEST_F(DerivativeProgram, IsTheDifferenceOfTwoRenders) {
  write();
  ASSERT_EQ(pbrt("--define lamp=1 --outfile x.pfm --quiet s.pbrt").status, 0);
  ASSERT_EQ(pbrt("--define lamp=1.5 --outfile y.pfm --quiet s.pbrt").status, 0);
  ASSERT_EQ(pbrt("--derivative lamp --step .5 --outfile d.pfm --quiet s.pbrt").status, 0);
  const Image x = image("x.pfm"), y = image("y.pfm"), d = image("d.pfm");
  for (std::size_t i = 0; i < d.data().size(); ++i)
    EXPECT_NEAR(d.data()[i], 2 * (y.data()[i] - x.data()[i]), 1e-6) << i;
  // At the value of the command line.
  ASSERT_EQ(pbrt("--derivative lamp --define lamp=1.5 --step=-.5 --outfile e.pfm --quiet s.pbrt").status, 0);
  const Image e = image("e.pfm");
  for (std::size_t i = 0; i < d.data().size(); ++i) EXPECT_NEAR(d.data()[i], e.data()[i], 1e-6) << i;
  ASSERT_EQ(pbrt("--derivative lamp --step .5 --difference central --outfile c.pfm --quiet s.pbrt").status,
            0);
  ASSERT_EQ(pbrt("--define lamp=.5 --outfile w.pfm --quiet s.pbrt").status, 0);
  const Image c = image("c.pfm"), w = image("w.pfm");
  for (std::size_t i = 0; i < d.data().size(); ++i)
    EXPECT_NEAR(c.data()[i], y.data()[i] - w.data()[i], 1e-6) << i;
}

TEST_F(DerivativeProgram, GoesOnToTheSameBits) {
  write();
  const std::string common = "--derivative lamp --step .25 --debias single --pass-samples 2 --quiet ";
  ASSERT_EQ(pbrt(common + "--spp 12 --outfile whole.pfm s.pbrt").status, 0);
  ASSERT_EQ(pbrt(common + "--spp 6 --checkpoint c --outfile part.pfm s.pbrt").status, 0);
  ASSERT_EQ(pbrt(common + "--spp 12 --resume c --outfile end.pfm s.pbrt").status, 0);
  EXPECT_TRUE(folder_.read("whole.pfm") == folder_.read("end.pfm"));
  EXPECT_TRUE(folder_.read("whole.pfm") != folder_.read("part.pfm"));
  expectFails("--derivative lamp --step .5 --resume c --quiet --spp 12 --outfile b.pfm",
              "it is of another render; what differs: --derivative");
  expectFails("--resume c --quiet --spp 12 --outfile b.pfm", "--derivative (only there)");
}

TEST_F(DerivativeProgram, MeasuresItsError) {
  write();
  const ProcessResult r = pbrt("--derivative lamp --step .25 --convergence c.csv --spp 32 --quiet s.pbrt");
  ASSERT_EQ(r.status, 0) << r.output;
  const std::string rows = folder_.read("c.csv");
  EXPECT_GT(std::count(rows.begin(), rows.end(), '\n'), 3);
}

TEST_F(DerivativeProgram, RefusesWhatItIsNotOf) {
  write();
  expectFails("--derivative lmap --step .1", "no such variable; did you mean \"lamp\"?");
  expectFails("--derivative idle --step .1", "nothing in the scene uses $idle");
  expectFails("--derivative lamp", "--step");
  expectFails("--step .1", "--derivative");
  expectFails("--derivative lamp --step 0", "a step of 0 from 1 is lost in single precision");
  expectFails("--derivative lamp --step .1 --define lamp=red", "not one number");
  expectFails("--derivative lamp --step .1 --debias some", "none");
  expectFails("--derivative lamp --step .1 --png", "a PNG has no negative values");
  expectFails("--derivative lamp --step .1 --outfile a.png",
              "has negative values, which \"a.png\" would lose");
  expectFails("--derivative lamp --step .1 --layers depth", "layers (depth) are of one image");
  expectFails("--derivative lamp --step .1 --samples 0:2", "the samples of a pass share their step");
  write("\"float scale\" $lamp");
  expectFails("--derivative lamp --step .1", "the film, the number of samples or the integrator is another");
  write("", "\"path\"", "Material \"glass\" \"float eta\" $lamp WorldEnd WorldBegin");
  expectFails("--derivative lamp --step .1", "2 WorldBegin");
}

/// What is wrong with another value is told as of that.
TEST_F(DerivativeProgram, TellsWhichValueMakesNoScene) {
  write(
      "", "\"volpath\"",
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"float g\" $lamp\nMediumInterface \"m\" \"m\"");
  const std::string at = "--define lamp=.5 --derivative lamp --step .5";
  expectFails(at, "there is no scene at lamp = 1; take another --step");
  expectFails(at, "s.pbrt:10:59: error: medium \"m\": parameter \"g\": found 1, expected in (-1, 1)");
  EXPECT_EQ(pbrt("--define lamp=.5 --derivative lamp --step=-.5 s.pbrt").status, 0);
}

/// Whole numbers are what a number begins with, as in PBRT-v3, so that small steps change nothing.
TEST_F(DerivativeProgram, TellsOfWholeNumbers) {
  write("", "\"path\" \"integer maxdepth\" $idle");
  const ProcessResult r = pbrt("--derivative idle --step .5 s.pbrt");
  EXPECT_EQ(r.status, 0);
  EXPECT_NE(r.output.find("warning: the derivative is 0 everywhere"), std::string::npos) << r.output;
  EXPECT_EQ(pbrt("--derivative lamp --step .5 s.pbrt --define idle=1").output.find("0 everywhere"),
            std::string::npos);
}

/// Bounds that are learned go on from checkpoints, and come from caches.
TEST_F(DerivativeProgram, GoesOnWithBoundsThatBothSidesLearn) {
  write("", "\"volpath\"",
        "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"integer nx\" 1 \"integer ny\" 1 \"integer "
        "nz\" 1 \"float density\" $lamp \"string bounds\" \"progressive\" \"integer warmup\" 0\n"
        "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"\"\nShape \"sphere\"\nAttributeEnd\n");
  const std::string common = "--derivative lamp --step .25 --debias single --pass-samples 2 --quiet ";
  ASSERT_EQ(pbrt(common + "--spp 12 --outfile whole.pfm s.pbrt").status, 0);
  ASSERT_EQ(pbrt(common + "--spp 6 --checkpoint c --outfile part.pfm s.pbrt").status, 0);
  ASSERT_EQ(pbrt(common + "--spp 12 --resume c --outfile end.pfm s.pbrt").status, 0);
  EXPECT_TRUE(folder_.read("whole.pfm") == folder_.read("end.pfm"));
  EXPECT_TRUE(folder_.read("whole.pfm") != folder_.read("part.pfm"));
  ASSERT_EQ(pbrt(common + "--spp 6 --bounds-cache b --outfile cached.pfm s.pbrt").status, 0);
  ASSERT_EQ(pbrt(common + "--spp 6 --bounds-cache b --outfile cached.pfm s.pbrt").status, 0);
  EXPECT_TRUE(folder_.read("cached.pfm") != folder_.read("part.pfm")) << "it begins with what was learned";
}

TEST_F(DerivativeProgram, IsShownInColours) {
  write();
  ASSERT_EQ(pbrt("--derivative lamp --step .125 --quiet s.pbrt").status, 0);
  const ProcessResult shown = imgtool("convert a.exr a.png --signed");
  ASSERT_EQ(shown.status, 0) << shown.output;
  EXPECT_NE(shown.output.find("red is "), std::string::npos) << shown.output;
  const ProcessResult scaled = imgtool("convert a.exr b.png --signed --scale 4 --zero black");
  EXPECT_NE(scaled.output.find("red is 0.25, blue -0.25"), std::string::npos) << scaled.output;
  const Image image = this->image("a.png");
  int reds = 0, blues = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) {
      reds += image.rgb(x, y).r > image.rgb(x, y).b;
      blues += image.rgb(x, y).r < image.rgb(x, y).b;
    }
  }
  EXPECT_GT(reds, 0);
  EXPECT_GT(blues, 0);
}

/// The example of docs/derivatives.md.
TEST_F(DerivativeProgram, IsOfEveryVariableOfTheExample) {
  const std::string scene = (sourceDir() / "scenes" / "derivatives" / "ball.pbrt").string();
  for (const std::string variable : {"height", "lamp", "roughness", "fog"}) {
    const ProcessResult r = pbrt("--derivative " + variable +
                                 " --step .01 --quick --strict --quiet --outfile a.exr '" + scene + "'");
    EXPECT_EQ(r.status, 0) << variable << r.output;
    const Image image = this->image("a.exr");
    EXPECT_TRUE(std::any_of(image.data().begin(), image.data().end(), [](float v) { return v != 0; }))
        << variable;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
