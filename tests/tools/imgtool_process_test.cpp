// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "image/image.h"
#include "support/process.h"
#include "support/temporary_folder.h"

// Runs the built program, as a user would.

namespace pbrtmedia {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

using test::ProcessResult;

class Imgtool : public ::testing::Test {
 protected:
  /// Runs imgtool inside the test's folder.
  ProcessResult run(const std::string& arguments) const {
    return test::run("cd '" + folder_.path().string() + "' && '" PBRT_MEDIA_IMGTOOL "' " + arguments);
  }
  void write(const std::string& name, const Image& image) const {
    writeImage(folder_.path() / name, image, {.pixelType = PixelType::Float});
  }
  Image read(const std::string& name) const { return readImage(folder_.path() / name); }
  std::string bytes(const std::string& name) const { return folder_.read(name); }

  TemporaryFolder folder_;
};

Image ramp(int width, int height, float offset = 0) {
  Image image(width, height);
  int i = 0;
  for (float& v : image.data()) v = offset + static_cast<float>(i++) / 16.0f;
  return image;
}

void expectIn(const ProcessResult& result, const std::string& part) {
  EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
}

TEST_F(Imgtool, HelpAndMistakesHaveTheRightStatus) {
  EXPECT_EQ(run("--help").status, 0);
  for (const char* command : {"info", "convert", "diff", "cat", "merge", "assemble"}) {
    const ProcessResult help = run(std::string(command) + " --help");
    EXPECT_EQ(help.status, 0);
    expectIn(help, "Usage: imgtool " + std::string(command));
  }
  EXPECT_EQ(run("").status, 1);
  const ProcessResult unknown = run("convrt a b");
  EXPECT_EQ(unknown.status, 1);
  expectIn(unknown, "imgtool: error: unknown command \"convrt\"; did you mean \"convert\"? known: ");
  const ProcessResult version = run("--version");
  EXPECT_EQ(version.status, 0);
  EXPECT_EQ(version.output.find("pbrt-media "), 0u) << version.output;
  expectIn(version, ", commit ");
  for (const char* option :
       {"--scale nan", "--exposure x", "--crop 0 1 0 -1", "--repeatpix 0", "--bloomlevel -1",
        "--bloomlevel 1 --bloomiters 0", "--despike -2", "--tonemap --maxluminance 0"}) {
    const ProcessResult wrong = run(std::string("convert a.exr b.exr ") + option);
    EXPECT_EQ(wrong.status, 1) << option;
    EXPECT_EQ(wrong.output.find("imgtool: error: --"), 0u) << wrong.output;
    expectIn(wrong, ", expected a ");
    EXPECT_LT(wrong.output.find('\n'), 120u) << "a short range: " << wrong.output;
  }
  EXPECT_EQ(run("diff onlyone.exr").status, 1);
  EXPECT_EQ(run("cat --unknown a.exr").status, 1);
}

TEST_F(Imgtool, ErrorsNameTheFile) {
  for (const char* command : {"info no.exr", "cat no.exr", "diff no.exr no.exr", "convert no.exr out.png",
                              "merge no.exr -o out.exr", "assemble no.exr -o out.exr"}) {
    const ProcessResult result = run(command);
    EXPECT_EQ(result.status, 1);
    expectIn(result, "no.exr");
    expectIn(result, "error: ");
  }
  write("a.exr", ramp(2, 2));
  const ProcessResult result = run("convert a.exr out.jpg");
  EXPECT_EQ(result.status, 1);
  expectIn(result, "out.jpg");
  expectIn(result, ".exr, .pfm, .png, .tga");
}

TEST_F(Imgtool, OutputsAreProbedBeforeInputsAreRead) {
  for (const std::string command :
       {"convert nothing.exr no/a.png", "merge nothing.exr --outfile no/a.exr",
        "assemble nothing.exr --outfile no/a.exr", "diff nothing.exr nothing.exr --outfile no/a.exr"}) {
    const ProcessResult r = run(command);
    EXPECT_EQ(r.status, 1);
    EXPECT_EQ(r.output.find("imgtool: error: cannot write \"no/a."), 0u) << r.output;
    EXPECT_NE(r.output.find("folder \"no\" does not exist"), std::string::npos) << r.output;
  }
}

TEST_F(Imgtool, InfoReportsWhatTheFileHolds) {
  Image image = ramp(4, 2);
  image.metadata = {{"samples", "16"}};
  image.displayWindow = {{0, 0}, {8, 8}};
  image.dataWindow = {{2, 3}, {6, 5}};
  image.at(0, 0, 0) = std::numeric_limits<float>::quiet_NaN();
  image.at(1, 0, 0) = std::numeric_limits<float>::infinity();
  write("a.exr", image);
  const ProcessResult text = run("info a.exr");
  EXPECT_EQ(text.status, 0);
  expectIn(text, "4 x 2 pixels");
  expectIn(text, "data window     (2, 3) - (6, 5)");
  expectIn(text, "samples: 16");
  const ProcessResult result = run("info --json a.exr");
  ASSERT_EQ(result.status, 0);
  const json info = json::parse(result.output).at(0);
  EXPECT_EQ(info["width"], 4);
  EXPECT_EQ(info["displayWindow"], (json{0, 0, 8, 8}));
  EXPECT_EQ(info["metadata"]["samples"], "16");
  EXPECT_EQ(info["channels"][0]["nan"], 1);
  EXPECT_EQ(info["channels"][0]["inf"], 1);
  EXPECT_EQ(info["channels"][1]["min"], 1 / 16.0);
  EXPECT_EQ(info["channels"][1]["max"], 22 / 16.0);
  EXPECT_TRUE(info.contains("logAverageLuminance"));
}

TEST_F(Imgtool, InfoSaysHowPixelsAreStored) {
  Image image = ramp(4, 2);
  image.metadata = {{"command", "one\ntwo"}};
  for (const char* type : {"half", "float"}) {
    for (const auto& [word, compression] : {std::pair{"none", ExrCompression::None},
                                            {"zip", ExrCompression::Zip},
                                            {"piz", ExrCompression::Piz}}) {
      writeImage(folder_.path() / "a.exr", image,
                 {.pixelType = std::string(type) == "half" ? PixelType::Half : PixelType::Float,
                  .compression = compression});
      const ProcessResult text = run("info a.exr");
      expectIn(text, std::string("4 x 2 pixels, ") + type + ", compression " + word + '\n');
      expectIn(text, "  command: one\n    two\n");
      const json info = json::parse(run("info --json a.exr").output).at(0);
      EXPECT_EQ(info["pixelType"], type);
      EXPECT_EQ(info["compression"], word);
    }
  }
  for (const auto& [file, stored] : {std::pair{"a.png", "8 bits, compression deflate"},
                                     {"a.pfm", "float, compression none"},
                                     {"a.tga", "24 bits, compression none"}}) {
    write(file, image);
    expectIn(run(std::string("info ") + file), stored);
  }
}

TEST_F(Imgtool, InfoNamesEveryFormat) {
  for (const auto& [file, format] :
       {std::pair{"a.exr", "OpenEXR"}, {"a.png", "PNG"}, {"a.pfm", "PFM"}, {"a.tga", "TGA"}}) {
    write(file, ramp(4, 2));
    const ProcessResult text = run(std::string("info ") + file);
    EXPECT_EQ(text.status, 0);
    expectIn(text, format);
    EXPECT_EQ(json::parse(run(std::string("info --json ") + file).output).at(0)["format"], format);
  }
}

TEST_F(Imgtool, ConvertDespikesAndPreservesColours) {
  Image image(3, 3);
  for (float& v : image.data()) v = 0.25f;
  image.setRgb(1, 1, Rgb(100));
  write("spike.exr", image);
  ASSERT_EQ(run("convert --despike 10 --pixeltype float spike.exr flat.exr").status, 0);
  EXPECT_EQ(read("flat.exr").rgb(1, 1), Rgb(0.25f));
  image.setRgb(1, 1, {4, 2, 1});
  write("bright.exr", image);
  ASSERT_EQ(run("convert --preservecolors --pixeltype float bright.exr kept.exr").status, 0);
  EXPECT_EQ(read("kept.exr").rgb(1, 1), Rgb(1, 0.5f, 0.25f));
  EXPECT_EQ(read("kept.exr").rgb(0, 0), Rgb(0.25f));
}

TEST_F(Imgtool, ConvertFromPngToPngIsTheIdentity) {
  Image image(16, 16);
  int i = 0;
  for (float& v : image.data()) v = decodeSrgb(static_cast<float>(i++ % 256) / 255.0f);
  write("a.png", image);
  ASSERT_EQ(run("convert a.png b.png").status, 0);
  EXPECT_EQ(bytes("a.png"), bytes("b.png"));
  ASSERT_EQ(run("convert a.png c.tga").status, 0);
  ASSERT_EQ(run("convert c.tga d.png").status, 0);
  EXPECT_EQ(bytes("a.png"), bytes("d.png"));
}

TEST_F(Imgtool, ConvertAppliesItsOptions) {
  write("a.exr", ramp(4, 4));
  ASSERT_EQ(
      run("convert --exposure -1 --crop 1 3 0 2 --repeatpix 2 --flipy --pixeltype float a.exr b.exr").status,
      0);
  const Image b = read("b.exr");
  EXPECT_EQ(b.width(), 4);
  EXPECT_EQ(b.rgb(0, 3), 0.5f * ramp(4, 4).rgb(1, 0));
  ASSERT_EQ(run("convert --resize 2x1 --resizefilter lanczos a.exr c.pfm").status, 0);
  EXPECT_EQ(read("c.pfm").width(), 2);
  EXPECT_EQ(run("convert --pixeltype quarter a.exr d.exr").status, 1);
  EXPECT_EQ(run("convert --compression lzw a.exr d.exr").status, 1);
  EXPECT_EQ(run("convert --crop 0 9 0 1 a.exr d.exr").status, 1);
  EXPECT_EQ(run("convert --bloomwidth 4 --bloomlevel 1 a.exr d.exr").status, 1);
  EXPECT_EQ(run("convert --bloomwidth 5 a.exr d.exr").status, 1);
  EXPECT_FALSE(fs::exists(folder_.path() / "d.exr"));
  for (const char* compression : {"none", "zip", "piz"}) {
    ASSERT_EQ(
        run(std::string("convert --pixeltype float --compression ") + compression + " a.exr e.exr").status,
        0);
    EXPECT_EQ(read("e.exr").data(), read("a.exr").data());
  }
}

TEST_F(Imgtool, ConvertWritesHalfUnlessToldOtherwise) {
  Image image(1, 1);
  image.data() = {1.0f / 3.0f, 0, 0};
  write("a.exr", image);
  ASSERT_EQ(run("convert a.exr half.exr").status, 0);
  ASSERT_EQ(run("convert --pixeltype float a.exr float.exr").status, 0);
  EXPECT_NE(read("half.exr").data()[0], 1.0f / 3.0f);
  EXPECT_EQ(read("float.exr").data()[0], 1.0f / 3.0f);
}

TEST_F(Imgtool, DiffAgreesOnlyWithinItsLimits) {
  write("a.exr", ramp(4, 4));
  write("same.exr", ramp(4, 4));
  write("b.exr", ramp(4, 4, 0.25f));
  EXPECT_EQ(run("diff a.exr same.exr").status, 0);
  EXPECT_EQ(run("diff a.exr same.exr --max-mse 0 --max-relmse 0 --max-abs 0 --max-flip 0").status, 0);
  EXPECT_EQ(run("diff a.exr b.exr").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --difftol 0").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --max-mse 0.0626").status, 0);
  EXPECT_EQ(run("diff a.exr b.exr --max-mse 0.0624").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --max-abs 0.25").status, 0);
  EXPECT_EQ(run("diff a.exr b.exr --max-abs 0.24").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --max-abs 0.25 --max-mse 0.01").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --max-relmse 1e-9").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --max-flip 1e-6").status, 1);
  // Means 1.46875 and 1.71875: 14.5 % of the reference.
  EXPECT_EQ(run("diff a.exr b.exr --difftol 15").status, 0);
  EXPECT_EQ(run("diff a.exr b.exr --difftol 14").status, 1);
  EXPECT_EQ(run("diff a.exr b.exr --max-mse=-1").status, 1);
}

TEST_F(Imgtool, DiffPrintsItsNumbers) {
  write("a.exr", ramp(4, 4));
  Image b = ramp(4, 4);
  b.at(1, 0, 1) += 0.5f;
  write("b.exr", b);
  const ProcessResult text = run("diff a.exr b.exr --flip");
  EXPECT_EQ(text.status, 1);
  expectIn(text, "(a - b)^2 / (b^2 + 0.01)");
  expectIn(text, "max 0.5 at (1 0)");
  expectIn(text, "FLIP");
  expectIn(text, "1 pixels differ");
  const ProcessResult result = run("diff --json --flip a.exr b.exr");
  EXPECT_EQ(result.status, 1);
  const json report = json::parse(result.output);
  EXPECT_EQ(report["agree"], false);
  EXPECT_EQ(report["maxAt"], (json{1, 0}));
  EXPECT_EQ(report["maxChannel"], "G");
  EXPECT_DOUBLE_EQ(report["mse"].get<double>(), 0.25 / 48);
  EXPECT_DOUBLE_EQ(report["channels"]["G"]["meanSigned"].get<double>(), -0.5 / 16);
  EXPECT_GT(report["flip"].get<double>(), 0);
}

TEST_F(Imgtool, DiffWritesItsImageOnlyWhenTheImagesDiffer) {
  write("a.exr", ramp(2, 2));
  write("b.exr", ramp(2, 2, 0.5f));
  EXPECT_EQ(run("diff a.exr a.exr --outfile d.exr").status, 0);
  EXPECT_FALSE(fs::exists(folder_.path() / "d.exr"));
  EXPECT_EQ(run("diff a.exr b.exr --outfile d.exr").status, 1);
  EXPECT_EQ(read("d.exr").rgb(1, 1), Rgb(0.5f));
  EXPECT_EQ(run("diff a.exr b.exr --outfile d.jpg").status, 1);
}

TEST_F(Imgtool, DiffWritesTheMapOfFlipErrors) {
  write("a.exr", ramp(8, 8));
  Image b = ramp(8, 8);
  b.at(2, 5, 1) = 0;
  write("b.exr", b);
  EXPECT_EQ(run("diff a.exr a.exr --flip-map same.exr").status, 0);
  EXPECT_EQ(read("same.exr").at(2, 5, 0), 0);
  const ProcessResult result = run("diff --json a.exr b.exr --flip-map map.exr");
  EXPECT_EQ(result.status, 1);
  const Image map = read("map.exr");
  double sum = 0, largest = 0;
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      sum += map.at(x, y, 0);
      largest = std::max<double>(largest, map.at(x, y, 0));
    }
  }
  EXPECT_GT(largest, 0);
  EXPECT_EQ(map.at(2, 5, 0), largest);
  EXPECT_NEAR(json::parse(result.output)["flip"].get<double>(), sum / 64, 1e-7);
  EXPECT_EQ(run("diff a.exr b.exr --flip-map map.jpg").status, 1);
}

TEST_F(Imgtool, DiffNeverPassesWhatCannotBeCompared) {
  const std::string generous = " --max-mse 1e9 --max-abs 1e9 --difftol 1e9";
  write("a.exr", ramp(2, 2));
  write("large.exr", ramp(3, 2));
  write("grey.exr", Image(2, 2, {"Y"}));
  Image nan = ramp(2, 2);
  nan.at(1, 1, 0) = std::numeric_limits<float>::quiet_NaN();
  write("nan.exr", nan);
  Image moved = ramp(2, 2);
  moved.dataWindow = {{5, 5}, {7, 7}};
  moved.displayWindow = {{0, 0}, {9, 9}};
  write("moved.exr", moved);
  for (const char* other : {"large.exr", "grey.exr", "nan.exr", "moved.exr"}) {
    const ProcessResult result = run("diff a.exr " + std::string(other) + generous);
    EXPECT_EQ(result.status, 1) << other;
    expectIn(result, "cannot be compared");
    const ProcessResult asJson = run("diff --json a.exr " + std::string(other) + generous);
    EXPECT_EQ(json::parse(asJson.output)["agree"], false);
  }
  EXPECT_EQ(run("diff nan.exr nan.exr" + generous).status, 1);
}

TEST_F(Imgtool, CatPrintsEveryPixelAndSorts) {
  Image image(2, 1);
  image.setRgb(0, 0, {0.5f, 0.1f, 2});
  image.setRgb(1, 0, Rgb(0.25f));
  image.dataWindow = {{3, 4}, {5, 5}};
  image.displayWindow = {{0, 0}, {9, 9}};
  write("a.exr", image);
  EXPECT_EQ(run("cat a.exr").output, "# x, y: R G B\n(3, 4): 0.5 0.1 2\n(4, 4): 0.25 0.25 0.25\n");
  image.setRgb(0, 0, Rgb(1));
  write("a.exr", image);
  EXPECT_EQ(run("cat --sort a.exr").output, "# x, y: R G B\n(4, 4): 0.25 0.25 0.25\n(3, 4): 1 1 1\n");
}

TEST_F(Imgtool, MergeAveragesAndRefusesEqualSeeds) {
  Image a = ramp(3, 2), b = ramp(3, 2, 1);
  a.metadata = {{"samples", "10"}, {"seed", "1"}, {"sceneHash", "s"}};
  b.metadata = {{"samples", "30"}, {"seed", "2"}, {"sceneHash", "s"}};
  write("a.exr", a);
  write("b.exr", b);
  const ProcessResult result = run("merge a.exr b.exr -o m.exr");
  ASSERT_EQ(result.status, 0) << result.output;
  const Image merged = read("m.exr");
  EXPECT_EQ(merged.data(), ramp(3, 2, 0.75f).data());
  EXPECT_EQ(merged.metadata.at("samples"), "40");
  const ProcessResult twice = run("merge a.exr m.exr -o n.exr");
  EXPECT_EQ(twice.status, 1);
  expectIn(twice, "both used seed 1");
  EXPECT_FALSE(fs::exists(folder_.path() / "n.exr"));
  ASSERT_EQ(run("convert --scale 2 a.exr scaled.exr").status, 0);
  EXPECT_EQ(run("merge scaled.exr b.exr -o n.exr").status, 1);
}

TEST_F(Imgtool, AssembleUndoesCropping) {
  Image picture = ramp(6, 4);
  write("a.exr", picture);
  ASSERT_EQ(run("convert --pixeltype float --crop 0 3 0 4 a.exr left.exr").status, 0);
  ASSERT_EQ(run("convert --pixeltype float --crop 3 6 0 4 a.exr right.exr").status, 0);
  ASSERT_EQ(run("convert --pixeltype float --crop 2 4 1 2 a.exr middle.exr").status, 0);
  ASSERT_EQ(run("assemble --pixeltype float left.exr right.exr --outfile whole.exr").status, 0);
  EXPECT_EQ(run("diff whole.exr a.exr").status, 0);
  const ProcessResult gaps = run("assemble --pixeltype float left.exr middle.exr --outfile part.exr");
  EXPECT_EQ(gaps.status, 1);
  expectIn(gaps, "overlaps: 1 pixels, 0 of them with different values");
  expectIn(gaps, "gaps: 11 pixels of no tile, the first at (3 0)");
  EXPECT_FALSE(fs::exists(folder_.path() / "part.exr"));
  EXPECT_EQ(run("assemble --allow-gaps left.exr middle.exr --outfile part.exr").status, 0);
  EXPECT_EQ(read("part.exr").rgb(5, 3), Rgb(0));
}

TEST_F(Imgtool, SurvivesBrokenFiles) {
  write("a.exr", ramp(8, 8));
  const std::string whole = bytes("a.exr");
  std::ofstream(folder_.path() / "cut.exr", std::ios::binary) << whole.substr(0, whole.size() / 2);
  const ProcessResult result = run("info cut.exr");
  EXPECT_EQ(result.status, 1);
  expectIn(result, "cut.exr: error: OpenEXR: ");
}

}  // namespace
}  // namespace pbrtmedia
