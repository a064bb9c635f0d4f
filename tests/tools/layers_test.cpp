// SPDX-License-Identifier: BSD-2-Clause
#include "tools/imgtool/layers.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

/// As a file has them: R, G, B, A, then by name.
Image layered() {
  Image image(
      1, 1,
      {"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "Z", "albedo.B", "albedo.G", "albedo.R", "odd.U", "odd.V"});
  for (std::size_t c = 0; c < image.channelCount(); ++c) image.at(0, 0, c) = static_cast<float>(c) / 16;
  image.metadata["layers"] = "alpha,depth,normal,albedo";
  return image;
}

std::string messageOf(const std::string& name) {
  try {
    layerAlone("a.exr", layered(), name);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return "";
}

TEST(LayerAlone, IsFoundByNamePrefixOrChannel) {
  using Values = std::vector<float>;
  const auto values = [](const std::string& name) {
    Image image = layerAlone("a.exr", layered(), name);
    Values v = image.data();
    for (float& x : v) x *= 16;
    return v;
  };
  EXPECT_EQ(values("normal"), (Values{4, 5, 6}));
  EXPECT_EQ(values("N"), (Values{4, 5, 6}));
  EXPECT_EQ(values("N.Y"), (Values{5}));
  EXPECT_EQ(values("albedo"), (Values{10, 9, 8})) << "red first";
  EXPECT_EQ(values("depth"), (Values{7}));
  EXPECT_EQ(values("alpha"), (Values{3}));
  EXPECT_EQ(values("colour"), (Values{0, 1, 2}));
  EXPECT_EQ(layerAlone("a.exr", layered(), "albedo").channels(), (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_EQ(layerAlone("a.exr", layered(), "depth").channels(), (std::vector<std::string>{"Y"}));
  EXPECT_TRUE(layerAlone("a.exr", layered(), "depth").hasRgb());
}

TEST(LayerAlone, StaysWhatItIsTheSecondTime) {
  const Image once = layerAlone("a.exr", layered(), "albedo");
  EXPECT_EQ(layerAlone("b.exr", once, "albedo").data(), once.data());
}

/// A half float holds no distance beyond 65504, and no variance of 1e-9.
TEST(LayerAlone, OfDataKeepsItsNumbers) {
  const TemporaryFolder folder;
  Image image(
      1, 1,
      {"R", "G", "B", "Z", "variance.B", "variance.G", "variance.R", "albedo.B", "albedo.G", "albedo.R"});
  for (std::size_t c = 0; c < image.channelCount(); ++c) image.at(0, 0, c) = 1e-9f;
  image.at(0, 0, 3) = 1e6f;
  image.metadata = {{"layers", "depth,variance,albedo"}, {"samples", "4"}, {"seed", "1"}};
  writeImage(folder.path() / "a.exr", image);
  const auto alone = [&](const std::string& layer) {
    const ProcessResult r = run("cd '" + folder.path().string() +
                                "' && '" PBRT_MEDIA_IMGTOOL "' convert a.exr b.exr --layer " + layer);
    EXPECT_EQ(r.status, 0) << r.output;
    return readImage(folder.path() / "b.exr");
  };
  for (const std::string depth : {"depth", "Z"}) EXPECT_EQ(alone(depth).at(0, 0, 0), 1e6f);
  for (const std::string variance : {"variance", "variance.G"}) EXPECT_EQ(alone(variance).at(0, 0, 0), 1e-9f);
  EXPECT_EQ(alone("albedo").at(0, 0, 0), 0) << "a colour is half";
  EXPECT_FALSE(alone("depth").metadata.contains("samples")) << "merge would average it as a colour";
}

TEST(LayerAlone, SaysWhatThereIs) {
  EXPECT_EQ(
      messageOf("albdeo"),
      "a.exr: there is no layer \"albdeo\"; did you mean \"albedo\"? known: albedo, alpha, odd, colour, "
      "depth, normal, N");
  EXPECT_NE(messageOf("transmittance").find("no layer"), std::string::npos);
  EXPECT_NE(messageOf("").find("no layer"), std::string::npos);
  EXPECT_EQ(messageOf("odd"), "a.exr: layer \"odd\" has 2 channels; name one of them: odd.U, odd.V, ...");
}

TEST(LayerOption, OfConvertDiffAndInfo) {
  const TemporaryFolder folder;
  const auto imgtool = [&](const std::string& arguments) {
    return run("cd '" + folder.path().string() + "' && '" PBRT_MEDIA_IMGTOOL "' " + arguments);
  };
  writeImage(folder.path() / "a.exr", layered());
  Image other = layered();
  other.at(0, 0, 0) = 1;
  writeImage(folder.path() / "b.exr", other);
  EXPECT_EQ(imgtool("convert a.exr n.png --layer normal --scale 0.5 --offset 0.5").status, 0);
  EXPECT_NEAR(decodeSrgb(readImage(folder.path() / "n.png").at(0, 0, 1)), .5f + 5 / 32.0f, .01f);
  EXPECT_EQ(imgtool("diff a.exr b.exr").status, 1);
  EXPECT_EQ(imgtool("diff a.exr b.exr --layer colour").status, 1);
  EXPECT_EQ(imgtool("diff a.exr b.exr --layer albedo").status, 0);
  EXPECT_EQ(imgtool("convert b.exr albedo.exr --layer albedo").status, 0);
  EXPECT_EQ(imgtool("diff a.exr albedo.exr --layer albedo").status, 0) << "one that was taken out before";
  const std::string info = imgtool("info a.exr --layer N").output;
  EXPECT_NE(info.find("channel N.X"), std::string::npos) << info;
  EXPECT_EQ(info.find("channel albedo.R"), std::string::npos) << info;
  const ProcessResult wrong = imgtool("info a.exr --layer nromal");
  EXPECT_NE(wrong.status, 0);
  EXPECT_NE(wrong.output.find("did you mean \"normal\"?"), std::string::npos) << wrong.output;
}

}  // namespace
}  // namespace pbrtmedia::test
