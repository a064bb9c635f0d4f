// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/screen_window.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

namespace pbrtmedia {
namespace {

TEST(ScreenWindow, SpansPlusMinusOneOnTheShorterSide) {
  EXPECT_EQ(screenWindowOfAspect(2), (ScreenWindow{-2, 2, -1, 1}));
  EXPECT_EQ(screenWindowOfAspect(0.5f), (ScreenWindow{-1, 1, -2, 2}));
  EXPECT_EQ(screenWindowOfAspect(1), (ScreenWindow{-1, 1, -1, 1}));
}

TEST(ScreenWindow, ComesFromTheFullFilmUnlessTheSceneSaysOtherwise) {
  EXPECT_EQ(resolveScreenWindow({200, 100}, {}, {}), (ScreenWindow{-2, 2, -1, 1}));
  EXPECT_EQ(resolveScreenWindow({100, 200}, {}, {}), (ScreenWindow{-1, 1, -2, 2}));
  EXPECT_EQ(resolveScreenWindow({100, 200}, 4.0f, {}), (ScreenWindow{-4, 4, -1, 1}));
  EXPECT_EQ(resolveScreenWindow({100, 200}, 4.0f, ScreenWindow{0, 1, 2, 5}), (ScreenWindow{0, 1, 2, 5}));
}

TEST(ScreenWindow, RefusesAspectsThatAreNoRatio) {
  for (const float a : {0.0f, -1.0f, std::numeric_limits<float>::infinity(), std::nanf("")}) {
    EXPECT_THROW(screenWindowOfAspect(a), std::invalid_argument) << a;
  }
}

TEST(ResolveFov, PrefersAPositiveHalfAngle) {
  EXPECT_EQ(resolveFov(90, -1), 90);
  EXPECT_EQ(resolveFov(90, 0), 90);
  EXPECT_EQ(resolveFov(90, 20), 40);
}

TEST(ScreenFromRaster, PutsRasterOriginAtTheUpperLeftCorner) {
  const ScreenFromRaster screen({200, 100}, {-2, 2, -1, 1});
  EXPECT_EQ(screen(0, 0), (Point2d{-2, 1}));
  EXPECT_EQ(screen(200, 100), (Point2d{2, -1}));
  EXPECT_EQ(screen(100, 50), (Point2d{0, 0}));
  EXPECT_EQ(screen(50, 75), (Point2d{-1, -0.5}));
}

TEST(ScreenFromRaster, MirrorsForReversedWindows) {
  const ScreenFromRaster screen({10, 10}, {1, -1, 1, -1});
  EXPECT_EQ(screen(0, 0), (Point2d{1, -1}));
}

TEST(ScreenFromRaster, RefusesEmptyFilmsAndWindows) {
  EXPECT_THROW(ScreenFromRaster({0, 100}, {}), std::invalid_argument);
  EXPECT_THROW(ScreenFromRaster({100, -1}, {}), std::invalid_argument);
  EXPECT_THROW(ScreenFromRaster({100, 100}, {1, 1, -1, 1}), std::invalid_argument);
  EXPECT_THROW(ScreenFromRaster({100, 100}, {-1, 1, 0, 0}), std::invalid_argument);
  EXPECT_THROW(ScreenFromRaster({100, 100}, {-1, std::nanf(""), -1, 1}), std::invalid_argument);
}

TEST(CameraScales, SeesScaleButNeitherRotationNorMirror) {
  const Transform rotated = Transform::translate({3, 4, 5}) * Transform::rotate(33, {1, 2, 3});
  EXPECT_FALSE(cameraScales(AnimatedTransform(rotated)));
  EXPECT_FALSE(cameraScales(AnimatedTransform(rotated * Transform::scale(-1, 1, 1))));
  EXPECT_FALSE(cameraScales(AnimatedTransform(Transform::scale(1.0004, 1, 1))));
  EXPECT_TRUE(cameraScales(AnimatedTransform(Transform::scale(1.0006, 1, 1))));
  EXPECT_TRUE(cameraScales(AnimatedTransform(rotated, 0, rotated * Transform::scale(1, 1, 2), 1)));
}

}  // namespace
}  // namespace pbrtmedia
