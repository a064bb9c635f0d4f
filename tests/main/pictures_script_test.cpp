// SPDX-License-Identifier: BSD-2-Clause
// scripts/make_pictures.sh on a repository of one small scene: what it makes, and what its --check tells
// apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "image/image.h"
#include "support/process.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

/// A ball of fog of the given scattering coefficient under a sky.
std::string ballOf(const std::string& sigmaS) {
  return "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16 \"string filename\" "
         "\"ball.exr\"\n"
         "Sampler \"halton\" \"integer pixelsamples\" 4\nIntegrator \"volpath\"\n"
         "LookAt 0 0 -4  0 0 0  0 1 0\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [ 0.5 0.25 1 ]\n"
         "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 1 1 1 ] \"rgb sigma_s\" "
         "[ " +
         sigmaS + " " + sigmaS + " " + sigmaS +
         " ]\nMaterial \"none\"\nMediumInterface \"fog\" \"\"\nShape \"sphere\"\nWorldEnd\n";
}

class PicturesScript : public testing::Test {
 protected:
  PicturesScript() {
    const std::filesystem::path script =
        folder_.write("scripts/make_pictures.sh", "");  // beside docs and scenes, as in the repository
    std::filesystem::copy_file(sourceDir() / "scripts/make_pictures.sh", script,
                               std::filesystem::copy_options::overwrite_existing);
    folder_.write("scenes/ball.pbrt", ballOf("2"));
    folder_.write("docs/gallery.md", "# Gallery\n\n![A ball](images/ball.png)\n");
    std::filesystem::create_directories(folder_.path() / "docs/images");
  }
  ProcessResult script(const std::string& arguments = "") const {
    const std::filesystem::path bin = std::filesystem::path(PBRT_PROGRAM).parent_path();
    return run("bash '" + (folder_.path() / "scripts/make_pictures.sh").string() + "' '" + bin.string() +
               "' " + arguments);
  }
  std::string picture() const { return folder_.read("docs/images/ball.png"); }

  TemporaryFolder folder_;
};

TEST_F(PicturesScript, MakesWhatTheGalleryShowsTheSameEachTime) {
  const ProcessResult r = script();
  ASSERT_EQ(r.status, 0) << r.output;
  const std::string first = picture();
  EXPECT_EQ(readImage(folder_.path() / "docs/images/ball.png").width(), 24);
  EXPECT_TRUE(readImage(folder_.path() / "docs/images/ball.png").metadata.empty())
      << "times, commits and folders are none of a picture's business";
  ASSERT_EQ(script("ball").status, 0);
  EXPECT_EQ(picture(), first);
  EXPECT_EQ(folder_.fileCount(), 3u) << "scripts, scenes, docs";
}

TEST_F(PicturesScript, ChecksWithoutWriting) {
  ASSERT_EQ(script().status, 0);
  const ProcessResult same = script("--check");
  EXPECT_EQ(same.status, 0) << same.output;
  EXPECT_EQ(same.output, "docs/images/ball.png is what scenes/ball.pbrt renders\n");

  const std::string before = picture();
  folder_.write("scenes/ball.pbrt", ballOf("2.1"));
  const ProcessResult other = script("--check ball");
  EXPECT_EQ(other.status, 1) << other.output;
  EXPECT_NE(other.output.find("docs/images/ball.png is not what scenes/ball.pbrt renders"),
            std::string::npos);
  EXPECT_NE(other.output.find("pixels differ"), std::string::npos) << other.output;
  EXPECT_EQ(picture(), before);

  std::filesystem::remove(folder_.path() / "docs/images/ball.png");
  EXPECT_EQ(script("--check").status, 1);
  EXPECT_FALSE(folder_.has("docs/images/ball.png"));
}

/// A path that rounding sends elsewhere changes a pixel by a level; a level everywhere is another picture.
TEST_F(PicturesScript, TellsRoundingFromAnotherPicture) {
  ASSERT_EQ(script().status, 0);
  const std::filesystem::path file = folder_.path() / "docs/images/ball.png";
  const auto changed = [&](int dx, int dy) {  // one level more in every dx-th and dy-th pixel
    Image image = readImage(file);
    for (int y = 0; y < image.height(); ++y) {
      for (int x = 0; x < image.width(); ++x) {
        for (std::size_t c = 0; c < 3; ++c) {
          const float encoded = image.at(x, y, c);  // what a PNG holds; writing encodes
          const bool here = x % dx == 0 && y % dy == 0 && c == 0;
          image.at(x, y, c) = decodeSrgb(here ? std::min(encoded + 1.0f / 255, 1.0f) : encoded);
        }
      }
    }
    return image;
  };
  writeImage(file, changed(24, 16));
  const ProcessResult rounding = script("--check");
  EXPECT_EQ(rounding.status, 0) << rounding.output;
  EXPECT_NE(rounding.output.find("but for rounding"), std::string::npos) << rounding.output;
  EXPECT_NE(rounding.output.find("1 pixels differ"), std::string::npos) << rounding.output;

  writeImage(file, changed(1, 1));
  EXPECT_EQ(script("--check").status, 1);
}

TEST_F(PicturesScript, RefusesASceneThatIsNotThere) {
  const ProcessResult r = script("bowl");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("no scenes/bowl.pbrt"), std::string::npos) << r.output;
  EXPECT_NE(run("bash '" + (folder_.path() / "scripts/make_pictures.sh").string() + "'").status, 0);
}

}  // namespace
}  // namespace pbrtmedia::test
