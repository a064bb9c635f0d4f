// SPDX-License-Identifier: BSD-2-Clause
// A render in ranges of its samples, and together again.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "image/image.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

/// A ball of fog in a coloured sky, under a filter wider than a pixel.
std::string scene(const std::string& sampler, const std::string& medium) {
  return "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16 \"string filename\" "
         "\"whole.exr\" "
         "\"float scale\" 1.7\nPixelFilter \"gaussian\"\nSampler \"" +
         sampler +
         "\" \"integer pixelsamples\" 9\nIntegrator \"volpath\"\nLookAt 0 0 -4  0 0 1  0 1 0\n"
         "Camera \"perspective\" \"float fov\" 40\nWorldBegin\nLightSource \"infinite\" \"rgb L\" [ .3 .6 1 "
         "]\n"
         "MakeNamedMedium \"m\" \"rgb sigma_a\" [ .1 .2 .3 ] \"rgb sigma_s\" [ 1 1 .5 ] " +
         medium + "\nMaterial \"none\"\nMediumInterface \"m\" \"\"\nShape \"sphere\"\nWorldEnd\n";
}
const std::string kFog = "\"string type\" \"homogeneous\"";
const std::string kLearning =
    "\"string type\" \"analytic\" \"string function\" \"ramp\" \"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 "
    "1 ] "
    "\"string bounds\" \"progressive\"";

class SampleRange : public testing::Test {
 protected:
  ProcessResult pbrt(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && '" PBRT_PROGRAM "' --quiet " + arguments);
  }
  ProcessResult merge(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && '" IMGTOOL_PROGRAM "' merge " + arguments);
  }
  Image image(const std::string& name) const { return readImage(folder_.path() / name); }
  void render(const std::string& range, const std::string& options = "") const {
    std::string name = range;
    name[name.find(':')] = '-';
    const ProcessResult r = pbrt("--samples " + range + " --outfile " + name + ".exr " + options + " a.pbrt");
    ASSERT_EQ(r.status, 0) << r.output;
  }
  TemporaryFolder folder_;
};

TEST_F(SampleRange, MergesToTheBitsOfOneRender) {
  for (const std::string sampler : {"random", "halton"}) {
    folder_.write("a.pbrt", scene(sampler, kFog));
    ASSERT_EQ(pbrt("--pixeltype float a.pbrt").status, 0);
    for (const std::string range : {"0:3", "3:4", "4:9"}) render(range);
    const ProcessResult merged = merge("4-9.exr 0-3.exr 3-4.exr -o all.exr");
    ASSERT_EQ(merged.status, 0) << merged.output;
    const Image all = image("all.exr"), whole = image("whole.exr");
    EXPECT_EQ(all.data(), whole.data()) << sampler;
    EXPECT_EQ(all.channels(), whole.channels());
    EXPECT_EQ(all.metadata.at("samples"), "9");
    EXPECT_EQ(all.metadata.at("seed"), "0");
    EXPECT_EQ(all.metadata.at("sceneHash"), whole.metadata.at("sceneHash"));
    EXPECT_FALSE(all.metadata.contains("sampleRange"));
    EXPECT_NE(image("0-3.exr").data(), image("3-4.exr").data()) << "negative control";
  }
}

TEST_F(SampleRange, MergesInSteps) {
  folder_.write("a.pbrt", scene("random", kFog));
  ASSERT_EQ(pbrt("--pixeltype float a.pbrt").status, 0);
  for (const std::string range : {"0:2", "2:5", "7:9", "5:7"}) render(range, "--pixeltype half");
  ASSERT_EQ(merge("0-2.exr 2-5.exr 7-9.exr -o part.exr").status, 0);
  EXPECT_EQ(image("part.exr").metadata.at("sampleRange"), "0:5,7:9");
  EXPECT_EQ(image("part.exr").metadata.at("samples"), "7");
  ASSERT_EQ(merge("5-7.exr part.exr -o all.exr").status, 0);
  EXPECT_EQ(image("all.exr").data(), image("whole.exr").data());
  // A range is an image, too: that of its own samples.
  EXPECT_EQ(image("0-2.exr").metadata.at("samples"), "2");
  double sum = 0, expected = 0;
  for (const char* name : {"0-2.exr", "whole.exr"}) {
    const Image i = image(name);
    for (int x = 0; x < 24; ++x) (name[0] == '0' ? sum : expected) += static_cast<double>(i.rgb(x, 8).b);
  }
  EXPECT_NEAR(sum, expected, .1 * expected);
}

TEST_F(SampleRange, RefusesWhatDoesNotBelongTogether) {
  folder_.write("a.pbrt", scene("random", kFog));
  for (const std::string range : {"0:3", "2:5"}) render(range);
  const auto refused = [&](const std::string& inputs, const std::string& why) {
    const ProcessResult r = merge(inputs + " -o all.exr");
    EXPECT_NE(r.status, 0);
    EXPECT_NE(r.output.find(why), std::string::npos) << r.output;
  };
  refused("0-3.exr 2-5.exr", "2-5.exr: its samples 2:5 are in another of the images too");
  refused("0-3.exr 0-3.exr", "its samples 0:3 are in another");
  render("3:5", "--seed 4");
  refused("0-3.exr 3-5.exr", "have the same \"seed\"; found 0 and 4");
  render("3:5", "--spp 16");
  refused("0-3.exr 3-5.exr", "samples");
  ASSERT_EQ(pbrt("--seed 7 a.pbrt").status, 0);
  refused("0-3.exr whole.exr", "merge the ranges first");
  // Sums that were changed are none.
  render("3:5");
  Image changed = image("3-5.exr");
  changed.at(4, 3, *changed.channelIndex("sums.g.0")) += 1;
  writeImage(folder_.path() / "3-5.exr", changed, {.pixelType = PixelType::Float});
  refused("0-3.exr 3-5.exr", "as pbrt --samples wrote them");
}

TEST_F(SampleRange, SaysWhatARangeMayBe) {
  folder_.write("a.pbrt", scene("random", kFog));
  const auto refused = [&](const std::string& options, const std::string& why) {
    const ProcessResult r = pbrt(options + " a.pbrt");
    EXPECT_EQ(r.status, 1) << options;
    EXPECT_NE(r.output.find(why), std::string::npos) << r.output;
  };
  for (const char* range : {"3", "3:", ":3", "3:3", "4:3", "-1:3", "a:b", "0:3x", "0:1:2"})
    refused(std::string("--samples=") + range, "expected FIRST:LAST");
  refused("--samples 3:10", "there are 9 samples of each pixel");
  refused("--samples 0:3 --outfile a.png", "EXR");
  EXPECT_EQ(pbrt("--samples 3:10 --spp 10 a.pbrt").status, 0);
  std::string photons = scene("random", kFog);
  photons.replace(photons.find("\"volpath\""), 9, "\"sppm\" \"integer iterations\" 9");
  folder_.write("a.pbrt", photons);
  refused("--samples 0:3", "the image cannot be rendered in parts: the radii of an iteration");
  EXPECT_EQ(pbrt("--spp 2 a.pbrt").status, 0);
  EXPECT_EQ(image("whole.exr").metadata.at("samples"), "2") << "iterations";
}

TEST_F(SampleRange, MergesWhatWasStoppedEarlyAndSaysSo) {
  folder_.write("a.pbrt", scene("random", kFog));
  render("0:4", "--spp 4000000 --error 1000");
  render("4:4000000", "--spp 4000000 --error 1000");
  ASSERT_EQ(merge("0-4.exr 4-4000000.exr -o all.exr").status, 0);
  EXPECT_EQ(image("all.exr").metadata.at("stoppedBy"), "error");
}

/// What light paths bring to other pixels has sums of its own in the file.
TEST_F(SampleRange, HoldsWhatLightPathsBringElsewhere) {
  std::string text = scene("halton", kFog);
  text.replace(text.find("volpath"), 7, "bdpt");
  // The camera sees the lamp's light mostly by light paths that hit it.
  const std::string lamp = "LightSource \"point\" \"point from\" [ 0 .2 -.3 ] \"rgb I\" [ 4 5 6 ]\n";
  text.insert(text.find("MakeNamedMedium"), lamp);
  folder_.write("a.pbrt", text);
  for (const std::string options : {"", "--layers variance,samples"}) {
    ASSERT_EQ(pbrt("--pixeltype float " + options + " a.pbrt").status, 0);
    const Image whole = image("whole.exr");
    for (const std::string range : {"0:3", "3:4", "4:9"}) render(range, options);
    const ProcessResult part = merge("3-4.exr 0-3.exr -o part.exr");
    ASSERT_EQ(part.status, 0) << part.output;
    const Image between = image("part.exr");
    EXPECT_EQ(between.metadata.at("splatPaths"), std::to_string(4 * 28 * 20))
        << "of each sample, those around the image too";
    const ProcessResult merged = merge("4-9.exr part.exr -o all.exr");
    ASSERT_EQ(merged.status, 0) << merged.output;
    const Image all = image("all.exr");
    EXPECT_EQ(all.channels(), whole.channels());
    EXPECT_FALSE(all.metadata.contains("splatPaths"));
    EXPECT_FALSE(all.metadata.contains("sampleRange"));
    // Sums of sums: in double they may differ by rounding, which a float seldom shows.
    int differing = 0;
    for (int y = 0; y < whole.height(); ++y) {
      for (int x = 0; x < whole.width(); ++x) {
        for (std::size_t c = 0; c < whole.channelCount(); ++c) {
          const float a = all.at(x, y, c), b = whole.at(x, y, c);
          const bool isVariance = whole.channels()[c].starts_with("variance");  // a difference of sums
          differing += a != b && !isVariance ? 1 : 0;
          EXPECT_NEAR(a, b, 2e-7f * std::abs(b) + (isVariance ? 1e-14f : 0.0f)) << x << ' ' << y << ' ' << c;
        }
      }
    }
    EXPECT_LE(differing, whole.width() * whole.height() / 100);
  }
  // Without the sums of its splats a range is none, and one without any is of another image.
  Image stripped = image("4-9.exr");
  stripped.metadata.erase("splatPaths");
  writeImage(folder_.path() / "stripped.exr", stripped, {.pixelType = PixelType::Float});
  const ProcessResult r = merge("0-3.exr stripped.exr -o all.exr");
  EXPECT_NE(r.status, 0);
  EXPECT_NE(r.output.find("splatPaths"), std::string::npos) << r.output;
}

TEST_F(SampleRange, GoesOnFromACheckpointOfItsOwn) {
  folder_.write("a.pbrt", scene("random", kFog));
  render("2:7");
  const Image whole = image("2-7.exr");
  ASSERT_EQ(pbrt("--samples 2:7 --checkpoint c.bin --outfile 2-7.exr a.pbrt").status, 0);
  const ProcessResult other = pbrt("--samples 3:7 --resume c.bin a.pbrt");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.output.find("--samples (2:7, here 3:7)"), std::string::npos) << other.output;
  EXPECT_EQ(pbrt("--resume c.bin a.pbrt").status, 1);
  ASSERT_EQ(pbrt("--samples 2:7 --resume c.bin --outfile 2-7.exr a.pbrt").status, 0);
  EXPECT_EQ(image("2-7.exr").data(), whole.data());
}

TEST_F(SampleRange, TakesBoundsThatAreLearnedFromACacheOnly) {
  folder_.write("a.pbrt", scene("random", kLearning));
  const ProcessResult r = pbrt("--samples 0:3 a.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("medium \"m\" learns its bounds while it is rendered"), std::string::npos)
      << r.output;
  EXPECT_EQ(pbrt("--samples 0:3 --bounds-cache none.bounds a.pbrt").status, 1)
      << "an empty cache fixes nothing";
  ASSERT_EQ(pbrt("--seed 5 --bounds-cache b.bounds a.pbrt").status, 0);
  const std::string cache = folder_.read("b.bounds");
  for (const std::string range : {"0:9", "0:4", "4:9"}) render(range, "--bounds-cache b.bounds");
  EXPECT_EQ(folder_.read("b.bounds"), cache) << "what is fixed stays";
  ASSERT_EQ(merge("0-4.exr 4-9.exr -o all.exr").status, 0);
  ASSERT_EQ(merge("0-9.exr -o one.exr").status, 0);
  EXPECT_EQ(image("all.exr").data(), image("one.exr").data());
}

}  // namespace
}  // namespace pbrtmedia::test
