// SPDX-License-Identifier: BSD-2-Clause
#include "textures/image_texture.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "textures/texture_test_support.h"

namespace pbrtmedia {
namespace {

using test::atUv;

/// Top row: red-ish, green-ish; bottom row: blue-ish, white-ish.
Image fourTexels() {
  Image image(2, 2);
  image.setRgb(0, 0, {0.5f, 0, 0});
  image.setRgb(1, 0, {0, 0.5f, 0});
  image.setRgb(0, 1, {0, 0, 0.5f});
  image.setRgb(1, 1, {0.5f, 0.25f, 1});
  return image;
}

TEST(ImageTexture, HasTZeroAtTheBottomRow) {
  const ImageTexture<Rgb> texture(UvMapping{}, makeTexturePyramid<Rgb>(fourTexels(), {}));
  EXPECT_EQ(texture.evaluate(atUv(0.25f, 0.25f)), Rgb(0, 0, 0.5f));
  EXPECT_EQ(texture.evaluate(atUv(0.75f, 0.25f)), Rgb(0.5f, 0.25f, 1));
  EXPECT_EQ(texture.evaluate(atUv(0.25f, 0.75f)), Rgb(0.5f, 0, 0));
}

TEST(ImageTexture, DecodesEveryChannelAndThenScales) {
  const ImageTexture<Rgb> texture(UvMapping{},
                                  makeTexturePyramid<Rgb>(fourTexels(), {.gamma = true, .scale = 3}));
  const Rgb found = texture.evaluate(atUv(0.75f, 0.25f));
  EXPECT_NEAR(found.r, 3 * 0.2140411f, 1e-5f);  // ((0.5 + 0.055) / 1.055)^2.4
  EXPECT_NEAR(found.g, 3 * 0.0508761f, 1e-5f);
  EXPECT_NEAR(found.b, 3, 1e-5f);
}

TEST(ImageTexture, DecodesTheLuminanceOfTheStoredColourForFloats) {
  const ImageTexture<float> texture(UvMapping{},
                                    makeTexturePyramid<float>(fourTexels(), {.gamma = true, .scale = 2}));
  const float luminance = 0.212671f * 0.5f + 0.715160f * 0.25f + 0.072169f;
  const float expected = 2 * std::pow((luminance + 0.055f) / 1.055f, 2.4f);
  EXPECT_NEAR(texture.evaluate(atUv(0.75f, 0.25f)), expected, 1e-5f);
}

TEST(ImageTexture, SharesAPyramid) {
  const auto pyramid = makeTexturePyramid<Rgb>(fourTexels(), {});
  const ImageTexture<Rgb> a(UvMapping{}, pyramid), b(UvMapping{1, 1, 0.5f, 0}, pyramid, {.trilinear = true});
  EXPECT_EQ(pyramid.use_count(), 3);
  EXPECT_EQ(a.evaluate(atUv(0.75f, 0.25f)), b.evaluate(atUv(0.25f, 0.25f)));
}

TEST(ImageTexture, FiltersWithTheMappedFootprint) {
  const auto pyramid = makeTexturePyramid<Rgb>(fourTexels(), {});
  const ImageTexture<Rgb> trilinear(UvMapping{2, 1, 0, 0}, pyramid, {.trilinear = true});
  const ImageTexture<Rgb> ewa(UvMapping{2, 1, 0, 0}, pyramid);
  SurfaceInteraction si = atUv(0.1f, 0.3f);
  si.dudx = 0.3f;
  si.dvdy = -0.2f;
  EXPECT_EQ(trilinear.evaluate(si), pyramid->trilinear({0.2f, 0.3f}, 0.6f));
  EXPECT_EQ(ewa.evaluate(si), pyramid->ewa({0.2f, 0.3f}, {0.6f, 0}, {0, -0.2f}, 8));
}

TEST(ImageTexture, RefusesWhatItCannotUse) {
  const auto pyramid = makeTexturePyramid<Rgb>(fourTexels(), {});
  EXPECT_THROW(ImageTexture<Rgb>(UvMapping{}, nullptr), std::invalid_argument);
  EXPECT_THROW(ImageTexture<Rgb>(UvMapping{}, pyramid, {.maxAnisotropy = 0}), std::invalid_argument);
  EXPECT_THROW(ImageTexture<Rgb>(UvMapping{}, pyramid, {.maxAnisotropy = 1e9f}), std::invalid_argument);
  EXPECT_THROW(ImageTexture<Rgb>(UvMapping{}, pyramid, {.maxAnisotropy = std::nanf("")}),
               std::invalid_argument);
}

TEST(DefaultGamma, IsTrueForEightBitFormatsInAnyCase) {
  EXPECT_TRUE(defaultGamma("a/wood.png"));
  EXPECT_TRUE(defaultGamma("WOOD.TGA"));
  EXPECT_TRUE(defaultGamma("dir.exr/wood.PnG"));
  EXPECT_FALSE(defaultGamma("wood.exr"));
  EXPECT_FALSE(defaultGamma("wood.pfm"));
  EXPECT_FALSE(defaultGamma("png"));
}

}  // namespace
}  // namespace pbrtmedia
