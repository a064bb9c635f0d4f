// SPDX-License-Identifier: BSD-2-Clause
// Layers through files: ranges, checkpoints, early ends, and what becomes of them elsewhere.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "image/image.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

/// Clouds before a wall, under a filter wider than a pixel.
const std::string kScene =
    "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16 \"string filename\" \"whole.exr\" "
    "\"float scale\" 1.7\nPixelFilter \"gaussian\"\nSampler \"random\" \"integer pixelsamples\" 9\n"
    "Integrator \"volpath\"\nLookAt 0 0 -4  0 0 1  0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
    "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ .3 .6 1 ]\n"
    "MakeNamedMedium \"m\" \"rgb sigma_a\" [ .1 .2 .3 ] \"rgb sigma_s\" [ 1 1 .5 ] \"string type\" "
    "\"perlin\" "
    "\"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 ] \"integer octaves\" 2 \"integer supervoxels\" 4\n"
    "AttributeBegin\nMaterial \"matte\"\nTranslate .5 0 2\nShape \"disk\"\nAttributeEnd\n"
    "Material \"none\"\nMediumInterface \"m\" \"\"\nShape \"sphere\"\nWorldEnd\n";

constexpr double kRounding = 1e-14;

class LayerFiles : public testing::Test {
 protected:
  LayerFiles() { folder_.write("a.pbrt", kScene); }
  ProcessResult pbrt(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && timeout -s KILL 120 '" PBRT_PROGRAM "' --quiet " +
               arguments);
  }
  ProcessResult imgtool(const std::string& arguments) const {
    return run("cd '" + folder_.path().string() + "' && '" IMGTOOL_PROGRAM "' " + arguments);
  }
  Image image(const std::string& name) const { return readImage(folder_.path() / name); }
  static double sumOf(const Image& image, const std::string& channel) {
    double sum = 0;
    for (std::size_t i = image.channelIndex(channel).value(); i < image.data().size();
         i += image.channelCount())
      sum += static_cast<double>(image.data()[i]);
    return sum;
  }
  /// All channels but seconds, which are other ones each time. Variances are differences of sums, so the last
  /// bits of these show where hardly anything varies: `rounding`, as a share of the colour's square.
  static void expectSame(const Image& a, const Image& b, double rounding = 0) {
    ASSERT_EQ(a.channels(), b.channels());
    for (std::size_t c = 0; c < a.channelCount(); ++c) {
      const std::string& name = a.channels()[c];
      if (name == "seconds") continue;
      for (int y = 0; y < a.height(); ++y) {
        for (int x = 0; x < a.width(); ++x) {
          if (rounding > 0 && name.starts_with("variance.")) {
            const double colour = a.rgb(x, y).max(), variance = a.at(x, y, c);
            ASSERT_NEAR(variance, b.at(x, y, c), rounding * colour * colour + 1e-6 * variance) << name;
          } else {
            ASSERT_EQ(a.at(x, y, c), b.at(x, y, c)) << name;
          }
        }
      }
    }
  }
  TemporaryFolder folder_;
};

TEST_F(LayerFiles, RangesMergeToTheLayersOfOneRender) {
  ASSERT_EQ(pbrt("--layers all --pixeltype float a.pbrt").status, 0);
  for (const char* range : {"0:3", "3:4", "4:9"}) {
    const std::string name = std::string("p") + range[0] + ".exr";
    ASSERT_EQ(pbrt("--layers all --samples " + std::string(range) + " --outfile " + name + " a.pbrt").status,
              0);
  }
  const ProcessResult merged = imgtool("merge p4.exr p0.exr p3.exr -o all.exr");
  ASSERT_EQ(merged.status, 0) << merged.output;
  const Image whole = image("whole.exr"), all = image("all.exr");
  expectSame(all, whole, kRounding);
  EXPECT_EQ(all.metadata.at("layers"), whole.metadata.at("layers"));
  EXPECT_NEAR(sumOf(all, "seconds"),
              sumOf(image("p0.exr"), "seconds") + sumOf(image("p3.exr"), "seconds") +
                  sumOf(image("p4.exr"), "seconds"),
              1e-5);
  // In steps, too.
  ASSERT_EQ(imgtool("merge p0.exr p4.exr -o some.exr").status, 0);
  ASSERT_EQ(imgtool("merge some.exr p3.exr -o again.exr").status, 0);
  expectSame(image("again.exr"), whole, kRounding);
  // Ranges with other layers do not belong together.
  ASSERT_EQ(pbrt("--layers depth --samples 3:4 --outfile p3.exr a.pbrt").status, 0);
  EXPECT_NE(imgtool("merge p0.exr p3.exr -o all.exr").status, 0);
}

TEST_F(LayerFiles, RendersGoOnToTheSameLayers) {
  ASSERT_EQ(pbrt("--layers all --pixeltype float a.pbrt").status, 0);
  // Stopped after the pass that reaches so many look-ups, then gone on with.
  ASSERT_EQ(pbrt("--layers all --lookups 200 --checkpoint c.ckpt --outfile part.exr a.pbrt").status, 0);
  EXPECT_LT(image("part.exr").at(5, 5, image("part.exr").channelIndex("samples").value()), 9);
  const ProcessResult rest = pbrt("--layers all --pixeltype float --resume c.ckpt --outfile rest.exr a.pbrt");
  ASSERT_EQ(rest.status, 0) << rest.output;
  expectSame(image("rest.exr"), image("whole.exr"));
  const ProcessResult other = pbrt("--layers depth --resume c.ckpt --outfile rest.exr a.pbrt");
  EXPECT_EQ(other.status, 1);
  EXPECT_NE(other.output.find("the layers"), std::string::npos) << other.output;
}

TEST_F(LayerFiles, SamplesAreThoseThatWereTaken) {
  folder_.write("box.pbrt",
                kScene.substr(0, kScene.find("PixelFilter")) + kScene.substr(kScene.find("Sampler")));
  for (const std::string stop :
       {"--spp 4000 --time 1", "--spp 4000 --error 0.05", "--spp 4000 --lookups 5000", ""}) {
    ASSERT_EQ(pbrt("--layers samples,lookups,seconds --stats s.json " + stop + " box.pbrt").status, 0)
        << stop;
    const Image i = image("whole.exr");
    const auto stats = nlohmann::json::parse(folder_.read("s.json")).at("renders").at(0);
    EXPECT_EQ(sumOf(i, "samples"), stats.at("samplesTaken").get<double>()) << stop;
    EXPECT_LE(sumOf(i, "lookups"), stats.at("counters").at("densityLookups").get<double>()) << stop;
    EXPECT_GT(sumOf(i, "seconds"), 0);
  }
}

TEST_F(LayerFiles, AreInOneFileAndThePngHasColoursAlone) {
  ASSERT_EQ(pbrt("--layers alpha,albedo,position --png a.pbrt").status, 0);
  EXPECT_EQ(image("whole.png").channelCount(), 3u);
  const std::string info = imgtool("info whole.exr").output;
  for (const char* text :
       {"albedo.R half", "A half", "P.X float", "P.Y float", "layers: alpha,albedo,position"})
    EXPECT_NE(info.find(text), std::string::npos) << text << '\n' << info;
  const ProcessResult wrong = pbrt("--layers alpha --outfile a.png a.pbrt");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.output.find("--layers: layers are channels of an OpenEXR file"), std::string::npos)
      << wrong.output;
}

TEST_F(LayerFiles, SeedsMergeToAVarianceThatFalls) {
  for (const char* seed : {"1", "2"})
    ASSERT_EQ(
        pbrt(std::string("--layers variance,samples --outfile s") + seed + ".exr --seed " + seed + " a.pbrt")
            .status,
        0);
  ASSERT_EQ(imgtool("merge s1.exr s2.exr -o both.exr").status, 0);
  const double one = sumOf(image("s1.exr"), "variance.G"), two = sumOf(image("s2.exr"), "variance.G");
  EXPECT_NEAR(sumOf(image("both.exr"), "variance.G"), (one + two) / 4, 1e-6 * one);
  EXPECT_EQ(image("both.exr").at(3, 3, image("both.exr").channelIndex("samples").value()), 18);
}

}  // namespace
}  // namespace pbrtmedia::test
