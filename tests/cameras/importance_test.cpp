// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "base/warp.h"
#include "cameras/camera_test_support.h"
#include "cameras/environment.h"
#include "cameras/orthographic.h"
#include "cameras/perspective.h"
#include "support/statistics.h"

// One contract for all cameras: importance (we, pdfWe, sampleWi) is that of the rays they generate.

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::RunningStats;

constexpr Point2i kFilm{48, 32};
constexpr double kPixels = 48 * 32;

struct ImportanceCase {
  std::string name;
  std::shared_ptr<const Camera> camera;
  bool hasLens;     ///< rays leave many points for each raster position
  bool seesOneWay;  ///< all rays have one direction
};
void PrintTo(const ImportanceCase& c, std::ostream* os) { *os << c.name; }

/// Sheared, mirrored and unevenly scaled, and on its way to another place.
const Transform kPlace = Transform::translate({1, -2, 0.5}) * Transform::rotate(40, {1, 2, -1}) *
                         Transform::scale(1.3, -0.8, 1.1) * Transform::rotate(30, {0, 1, 1}) *
                         Transform::scale(1, 1.2, 1);
const AnimatedTransform kFixed(kPlace);
const AnimatedTransform kMoving(kPlace, 0, Transform::translate({0.5, 0.2, 0.3}) * kPlace, 1);

std::vector<ImportanceCase> importanceCases() {
  std::vector<ImportanceCase> cases;
  const ScreenWindow window = screenWindowOfAspect(1.5f);
  const auto perspective = [&](const char* name, const AnimatedTransform& at, float lens) {
    cases.push_back(
        {name,
         std::make_shared<PerspectiveCamera>(at, PerspectiveCamera::Params{.fullResolution = kFilm,
                                                                           .screenWindow = window,
                                                                           .fov = 70,
                                                                           .lensRadius = lens,
                                                                           .focalDistance = 3}),
         lens > 0, false});
  };
  perspective("Pinhole", AnimatedTransform(Transform()), 0);
  perspective("PinholeDeformed", kFixed, 0);
  perspective("ThinLens", AnimatedTransform(Transform()), 0.4f);
  perspective("ThinLensMoving", kMoving, 0.4f);
  const auto orthographic = [&](const char* name, const AnimatedTransform& at, float lens, float focus) {
    cases.push_back(
        {name,
         std::make_shared<OrthographicCamera>(at, OrthographicCamera::Params{.fullResolution = kFilm,
                                                                             .screenWindow = window,
                                                                             .lensRadius = lens,
                                                                             .focalDistance = focus}),
         lens > 0, lens == 0});
  };
  orthographic("Orthographic", AnimatedTransform(Transform()), 0, 3);
  orthographic("OrthographicDeformed", kFixed, 0, 3);
  orthographic("OrthographicLens", AnimatedTransform(Transform()), 0.4f, 3);
  orthographic("OrthographicLensMoving", kMoving, 0.4f, 3);
  const auto environment = [&](const char* name, const AnimatedTransform& at) {
    cases.push_back(
        {name, std::make_shared<EnvironmentCamera>(at, EnvironmentCamera::Params{.fullResolution = kFilm}),
         false, false});
  };
  environment("Environment", AnimatedTransform(Transform()));
  environment("EnvironmentDeformed", kMoving);
  return cases;
}

class CameraImportance : public testing::TestWithParam<ImportanceCase> {
 protected:
  const Camera& camera() const { return *GetParam().camera; }
  bool isDeltaDirection() const { return GetParam().seesOneWay; }
  /// Within the film by more than rounding can carry it.
  static Point2f filmPoint(Rng& rng) {
    return {0.01f + rng.uniform() * (kFilm.x - 0.02f), 0.01f + rng.uniform() * (kFilm.y - 0.02f)};
  }
  bool isOrthographic() const { return GetParam().name.rfind("Orthographic", 0) == 0; }
  Vec3d lensNormal() const {
    const auto at = [&](Point2f lens) { return Vec3d(camera().generateRay({20, 13}, lens, 0.25f).ray.o); };
    return normalize(cross(at({0.9f, 0.5f}) - at({0.5f, 0.5f}), at({0.5f, 0.9f}) - at({0.5f, 0.5f})));
  }
  Ray rayAt(Point2f film, Rng& rng) const {
    const Point2f lens{rng.uniform(), rng.uniform()};
    return camera().generateRay(film, lens, 0.25f).ray;
  }
};
INSTANTIATE_TEST_SUITE_P(All, CameraImportance, testing::ValuesIn(importanceCases()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(CameraImportance, KnowsWhereOnTheFilmARayComesFrom) {
  Rng rng(1);
  for (int i = 0; i < 1000; ++i) {
    const Point2f film = filmPoint(rng);
    const Importance seen = camera().we(rayAt(film, rng));
    ASSERT_GT(seen.value, 0) << film.x << ' ' << film.y;
    EXPECT_NEAR(seen.film.x, film.x, 2e-3f);
    EXPECT_NEAR(seen.film.y, film.y, 2e-3f);
  }
}

TEST_P(CameraImportance, IsBlackBehindAndBesideTheFilm) {
  Rng rng(2);
  for (int i = 0; i < 200; ++i) {
    const Point2f film = filmPoint(rng);
    if (GetParam().name.rfind("Environment", 0) == 0) continue;  // sees all around
    for (const Point2f beside : {Point2f{film.x, -1.5f}, Point2f{film.x, kFilm.y + 1.5f},
                                 Point2f{-1.5f, film.y}, Point2f{kFilm.x + 1.5f, film.y}}) {
      const Ray ray = rayAt(beside, rng);
      EXPECT_EQ(camera().we(ray).value, 0);
      EXPECT_EQ(camera().pdfWe(ray).position + camera().pdfWe(ray).direction, 0);
    }
    const Ray ray = rayAt(film, rng);
    EXPECT_EQ(camera().sampleWi(ray.at(-2), {0.5f, 0.5f}, ray.time).pdf, 0) << "behind";
  }
}

/// Importance is the density of rays: over the film, the lens, and nothing else.
TEST_P(CameraImportance, IsTheProductOfItsDensities) {
  Rng rng(3);
  for (int i = 0; i < 500; ++i) {
    const Ray ray = rayAt(filmPoint(rng), rng);
    const float value = camera().we(ray).value;
    const WePdf pdf = camera().pdfWe(ray);
    EXPECT_EQ(pdf.direction > 0, !isDeltaDirection());
    EXPECT_EQ(pdf.position > 0, isDeltaDirection() || GetParam().hasLens);
    if (pdf.position == 0 || pdf.direction == 0) {
      EXPECT_EQ(value, pdf.position + pdf.direction);
      continue;
    }
    // A perspective camera counts positions by the area of the lens, importance by that across the ray.
    const Vec3d normal = isOrthographic() ? Vec3d(ray.d) : lensNormal();
    EXPECT_NEAR(value * absDot(normal, Vec3d(ray.d)), double{pdf.position} * pdf.direction,
                1e-4 * double{value});
  }
}

/// Solid angle of the directions (or area across them, of the origins) of a small part of the film, by its
/// corners.
double measureOfPixel(const Camera& camera, bool ofOrigins, Point2f film, Point2f lens, float time) {
  constexpr float kStep = 0.25f;
  const auto corner = [&](float x, float y) {
    const Ray ray = camera.generateRay({film.x + x * kStep, film.y + y * kStep}, lens, time).ray;
    return std::pair(Vec3d(ray.o), Vec3d(ray.d));
  };
  const auto [o0, d0] = corner(-1, 0);
  const auto [o1, d1] = corner(1, 0);
  const auto [o2, d2] = corner(0, -1);
  const auto [o3, d3] = corner(0, 1);
  const Vec3d along(camera.generateRay(film, lens, time).ray.d);
  const Vec3d area = ofOrigins ? cross(o1 - o0, o3 - o2) : cross(d1 - d0, d3 - d2);
  return absDot(area, along) / sqr(2.0 * kStep);
}

/// The Jacobian from the film to directions (positions), by differences of generated rays.
TEST_P(CameraImportance, HasTheDensityOfGeneratedRays) {
  Rng rng(4);
  for (int i = 0; i < 300; ++i) {
    const Point2f film{2 + rng.uniform() * (kFilm.x - 4), 2 + rng.uniform() * (kFilm.y - 4)};
    const Point2f lens{rng.uniform(), rng.uniform()};
    const Ray ray = camera().generateRay(film, lens, 0.25f).ray;
    const double measure = measureOfPixel(camera(), isOrthographic(), film, lens, 0.25f);
    const WePdf pdf = camera().pdfWe(ray);
    const double found = double{isOrthographic() ? pdf.position : pdf.direction} * measure * kPixels;
    EXPECT_NEAR(found, 1, 5e-3) << "film " << film.x << ' ' << film.y;
  }
}

/// One over the area of the lens (perspective), or over the solid angle under which it is seen
/// (orthographic).
TEST_P(CameraImportance, HasTheDensityOfTheLens) {
  if (!GetParam().hasLens) return;
  const Point2f film{20, 13};
  int compared = 0;
  Rng rng(5);
  for (int i = 0; i < 300; ++i) {
    const Point2f u{0.05f + 0.9f * rng.uniform(), 0.05f + 0.9f * rng.uniform()};
    if (std::abs(std::abs(2 * u.x - 1) - std::abs(2 * u.y - 1)) < 0.02f) continue;  // the map has a kink
    constexpr float kStep = 1e-3f;
    const auto at = [&](float x, float y) {
      const Ray ray = camera().generateRay(film, {u.x + x * kStep, u.y + y * kStep}, 0.25f).ray;
      return isOrthographic() ? Vec3d(ray.d) : Vec3d(ray.o);
    };
    const double area = length(cross(at(1, 0) - at(-1, 0), at(0, 1) - at(0, -1))) / sqr(2.0 * double{kStep});
    const Ray ray = camera().generateRay(film, u, 0.25f).ray;
    const WePdf pdf = camera().pdfWe(ray);
    EXPECT_NEAR(double{isOrthographic() ? pdf.direction : pdf.position} * area, 1, 1e-2);
    ++compared;
  }
  EXPECT_GT(compared, 200);
}

TEST_P(CameraImportance, SeesAPointThatARayMeetsAtTheRastersPositionOfTheRay) {
  Rng rng(6);
  for (int i = 0; i < 1000; ++i) {
    const Point2f film = filmPoint(rng), lens{rng.uniform(), rng.uniform()};
    const Ray ray = camera().generateRay(film, lens, 0.25f).ray;
    const float far = 0.5f + 5 * rng.uniform();
    const WiSample s = camera().sampleWi(ray.at(far), lens, ray.time);
    ASSERT_GT(s.pdf, 0);
    EXPECT_NEAR(s.film.x, film.x, 2e-3f);
    EXPECT_NEAR(s.film.y, film.y, 2e-3f);
    EXPECT_NEAR(distance(s.wi, -ray.d), 0, 3e-6f);
    EXPECT_NEAR(s.distance, far, 1e-5f * (1 + far));
    // And what arrives there is what the ray has.
    const float value = camera().we(ray).value;
    const float spread = GetParam().hasLens || isDeltaDirection() ? 1 : far * far;
    EXPECT_NEAR(s.importance * spread, value, 1e-3f * value);
    EXPECT_EQ(s.pdf == 1, !GetParam().hasLens);
  }
}

TEST_P(CameraImportance, HasAPointOnTheLensAsOftenAsItsDensitySays) {
  // pdf dω = pdfLens dA at the lens; rays of an orthographic camera have the direction as such.
  if (!GetParam().hasLens) return;
  Rng rng(7);
  for (int i = 0; i < 300; ++i) {
    const Point2f lens{rng.uniform(), rng.uniform()};
    const Ray ray = camera().generateRay({20, 13}, lens, 0.25f).ray;
    const WePdf pdf = camera().pdfWe(ray);
    const WiSample s = camera().sampleWi(ray.at(2.5f), lens, ray.time);
    const double ratio = double{s.importance} / s.pdf;
    if (isOrthographic()) {
      EXPECT_NEAR(s.pdf, pdf.direction, 1e-3f * pdf.direction);
      EXPECT_NEAR(ratio, pdf.position, 1e-3 * double{pdf.position});
    } else {
      EXPECT_NEAR(ratio * sqr(2.5), pdf.direction, 1e-3 * double{pdf.direction});
    }
  }
}

/// By points of a sphere around the camera: a radiance of 1 that comes from everywhere fills the film.
TEST_P(CameraImportance, IntegratesToOneOverTheFilm) {
  const double radius = isOrthographic() ? 6 : 30;  // holds the film, which is not much smaller
  const Vec3d centre = camera().worldFromCamera().at(0.25).point(Vec3d{0, 0, 0});
  Rng rng(8);
  RunningStats whole, left;
  for (int i = 0; i < 400000; ++i) {
    const Vector3f out = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const Point3f p(centre + radius * Vec3d(out));
    const WiSample s = camera().sampleWi(p, {rng.uniform(), rng.uniform()}, 0.25f);
    const double area = 4 * std::numbers::pi * sqr(radius);
    // A surface that faces inward: importance goes with its cosine.
    const double value = s.pdf > 0 ? area * double{s.importance} * absDot(out, s.wi) / s.pdf : 0;
    whole.add(value);
    left.add(s.film.x < 12 ? value : 0);
  }
  const test::ZTest z = zTest(whole, 1), quarter = zTest(left, 0.25);
  EXPECT_LT(z.standardError, 0.02);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
  EXPECT_LT(std::abs(quarter.z()), kMaxAbsZ) << quarter;
  EXPECT_GT(std::abs(zTest(whole, 1.25).z()), kMaxAbsZ) << "the test sees what is a quarter off";
}

TEST(OrthographicCamera, WithALensFocusedAtInfinitySeesOneDirectionBlurred) {
  const OrthographicCamera camera(AnimatedTransform(Transform()), {.fullResolution = kFilm,
                                                                   .screenWindow = screenWindowOfAspect(1.5f),
                                                                   .lensRadius = 0.1f,
                                                                   .focalDistance = kInfinity});
  const WiSample middle = camera.sampleWi({0, 0, 5}, {0.5f, 0.5f}, 0),
                 aside = camera.sampleWi({0, 0, 5}, {1, 0.5f}, 0);
  EXPECT_EQ(middle.pdf, 1);
  EXPECT_EQ(middle.film, (Point2f{24, 16}));
  EXPECT_EQ(aside.wi, (Vector3f{0, 0, -1}));
  EXPECT_NEAR(aside.film.x, 24 - 0.1f * 16, 1e-4f);
  EXPECT_NEAR(middle.importance, 1.0f / 6, 1e-6f);  // the film is 3 x 2 large
}

}  // namespace
}  // namespace pbrtmedia
