// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "textures/bilerp.h"
#include "textures/mix.h"
#include "textures/scale.h"
#include "textures/texture_test_support.h"
#include "textures/uv.h"

namespace pbrtmedia {
namespace {

using test::atUv;

TEST(ConstantTexture, IsItsValue) {
  EXPECT_EQ(ConstantTexture<float>(0.25f).evaluate({}), 0.25f);
  EXPECT_EQ(ConstantTexture<Rgb>(Rgb(1, 2, 3)).evaluate({}), Rgb(1, 2, 3));
}

TEST(ScaleTexture, Multiplies) {
  const ConstantTexture<float> half(0.5f), three(3.0f);
  EXPECT_EQ(ScaleTexture<float>(half, three).evaluate({}), 1.5f);
  const ConstantTexture<Rgb> a(Rgb(1, 2, 3)), b(Rgb(4, 5, 6));
  EXPECT_EQ(ScaleTexture<Rgb>(a, b).evaluate({}), Rgb(4, 10, 18));
}

TEST(MixTexture, ShowsTheSecondTextureAtAmountOne) {
  const ConstantTexture<Rgb> a(Rgb(1, 0, 4)), b(Rgb(0, 1, 8));
  const ConstantTexture<float> zero(0), quarter(0.25f), one(1);
  EXPECT_EQ(MixTexture<Rgb>(a, b, zero).evaluate({}), Rgb(1, 0, 4));
  EXPECT_EQ(MixTexture<Rgb>(a, b, one).evaluate({}), Rgb(0, 1, 8));
  EXPECT_EQ(MixTexture<Rgb>(a, b, quarter).evaluate({}), Rgb(0.75f, 0.25f, 5));
  EXPECT_EQ(MixTexture<float>(one, zero, quarter).evaluate({}), 0.75f);
}

TEST(BilerpTexture, HasItsCornersWithTheFirstIndexAlongS) {
  const BilerpTexture<float> texture(UvMapping{}, {.v00 = 1, .v01 = 2, .v10 = 3, .v11 = 5});
  EXPECT_EQ(texture.evaluate(atUv(0, 0)), 1);
  EXPECT_EQ(texture.evaluate(atUv(0, 1)), 2);
  EXPECT_EQ(texture.evaluate(atUv(1, 0)), 3);
  EXPECT_EQ(texture.evaluate(atUv(1, 1)), 5);
  EXPECT_EQ(texture.evaluate(atUv(0.5f, 0.5f)), 2.75f);
}

TEST(BilerpTexture, IsARampAlongTByDefault) {
  EXPECT_EQ(BilerpTexture<Rgb>(UvMapping{}, {}).evaluate(atUv(0.3f, 0.25f)), Rgb(0.25f));
}

TEST(UvTexture, ShowsFractionalCoordinates) {
  const UvTexture texture(UvMapping{});
  EXPECT_EQ(texture.evaluate(atUv(0.25f, 0.75f)), Rgb(0.25f, 0.75f, 0));
  EXPECT_EQ(texture.evaluate(atUv(2.25f, -0.25f)), Rgb(0.25f, 0.75f, 0));
}

}  // namespace
}  // namespace pbrtmedia
