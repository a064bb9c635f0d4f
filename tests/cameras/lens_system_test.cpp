// SPDX-License-Identifier: BSD-2-Clause
#include "cameras/lens_system.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "base/rng.h"
#include "cameras/exit_pupil.h"

namespace pbrtmedia {
namespace {

constexpr double kFront = 0.05, kRear = -0.08, kThick = 0.006, kIndex = 1.6;  // metres

/// A biconvex lens and behind it the stop.
LensSystem biconvex(double stopRadius = 0.002) {
  return LensSystem({{kFront, kThick, kIndex, 0.01}, {kRear, 0.004, 1, 0.01}, {0, 0.05, 1, stopRadius}});
}

/// The lens maker's equation of a thick lens in air.
double focalLength() {
  return 1 / ((kIndex - 1) * (1 / kFront - 1 / kRear + (kIndex - 1) * kThick / (kIndex * kFront * kRear)));
}

TEST(LensSystem, BringsAxialRaysToTheFocusOfTheLensMaker) {
  const LensSystem lens = biconvex();
  const double height = 1e-6;
  const auto out = lens.traceFromScene({{height, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(out);
  // The angle behind the lens is height / f.
  EXPECT_NEAR(out->d.x / -out->d.z, -height / focalLength(), 1e-6 * height / focalLength());
  const auto back = lens.traceFromFilm({{height, 0, 0}, {0, 0, 1}});
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->d.x / back->d.z, -height / focalLength(), 1e-6 * height / focalLength());
}

TEST(LensSystem, IsFocusedAtTheDistanceFromTheFilm) {
  for (const double distance : {0.3, 1.0, 7.0, 1000.0}) {
    const LensSystem lens = biconvex().focusedAt(distance, 1e-5);
    // Gauss: 1/f = 1/b + 1/g, measured from principal planes that are less than the lens apart.
    EXPECT_GT(lens.rearZ() + 0.004 + kThick, focalLength());
    const Vec3d d = normalize(Vec3d{1e-4, 0, 1});
    const auto out = lens.traceFromFilm({{0, 0, 0}, d});
    ASSERT_TRUE(out);
    const double meets = out->o.z - out->o.x / out->d.x * out->d.z;
    EXPECT_NEAR(1 / meets, 1 / distance, 2e-4) << distance;
  }
  EXPECT_THROW(biconvex().focusedAt(0.1, 1e-5), std::invalid_argument);  // below four focal lengths
}

TEST(LensSystem, RaysTakeTheSameWayBack) {
  const LensSystem lens = biconvex(0.009);
  Rng rng(3);
  int through = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3d film{0.02 * (rng.uniform() - 0.5), 0.02 * (rng.uniform() - 0.5), 0};
    const Vec3d rear{0.02 * (rng.uniform() - 0.5), 0.02 * (rng.uniform() - 0.5), lens.rearZ()};
    const auto out = lens.traceFromFilm({film, rear - film});
    if (!out) continue;
    ++through;
    EXPECT_NEAR(length(out->d), 1, 1e-12);
    const auto back = lens.traceFromScene({out->o + 0.5 * out->d, -out->d});
    ASSERT_TRUE(back);
    const Vec3d where = back->o - back->o.z / back->d.z * back->d;
    EXPECT_LT(length(where - film), 1e-12);
  }
  EXPECT_GT(through, 500);
}

TEST(LensSystem, RaysBendBySnellsLawAndStopAtTotalReflection) {
  // Half a ball: from inside, at its centre, nothing bends; beside it by Snell's law.
  const LensSystem ball({{1, 1, 1.5, 0.99}});
  const auto straight = ball.traceFromFilm({{0, 0, 0}, {0.3, 0.2, 1}});
  ASSERT_TRUE(straight);
  EXPECT_LT(length(straight->d - normalize(Vec3d{0.3, 0.2, 1})), 1e-12);
  const auto bent = ball.traceFromFilm({{0.5, 0, 0}, {0, 0, 1}});
  ASSERT_TRUE(bent);
  // It meets the sphere under 30 degrees.
  EXPECT_NEAR(std::asin(-bent->d.x), std::asin(1.5 * 0.5) - std::asin(0.5), 1e-12);
  EXPECT_FALSE(ball.traceFromFilm({{0.7, 0, 0}, {0, 0, 1}})) << "1.5 * 0.7 > 1";
}

TEST(LensSystem, AperturesStopRays) {
  const LensSystem stop({{0, 1, 1, 0.1}});
  EXPECT_TRUE(stop.traceFromFilm({{0, 0, 0}, {0.0999, 0, 1}}));
  EXPECT_FALSE(stop.traceFromFilm({{0, 0, 0}, {0.1001, 0, 1}}));
  EXPECT_FALSE(stop.traceFromFilm({{0, 0, 0}, {0, 0, -1}}));
  EXPECT_FALSE(stop.traceFromScene({{0, 0, 2}, {0, 0, 1}}));
  EXPECT_TRUE(stop.traceFromScene({{0, 0, 2}, {0.0999, 0, -1}}));
}

TEST(LensSystem, RejectsWhatIsNoLens) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto rejects = [](const LensElement& e, const std::string& what) {
    try {
      LensSystem({{0.1, 0.1, 1.5, 0.1}, e});
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find("lens 2: " + what), std::string::npos) << error.what();
      return;
    }
    ADD_FAILURE() << "not rejected: " << what;
  };
  EXPECT_THROW(LensSystem({}), std::invalid_argument);
  rejects({nan, 1, 1, 1}, "curvature radius");
  rejects({1, nan, 1, 1}, "distance");
  rejects({1, 1, 0, 1}, "index of refraction");
  rejects({1, 1, -1.5, 1}, "index of refraction");
  rejects({1, 1, 1, 0}, "aperture diameter");
  EXPECT_THROW(LensSystem({{0, 1, 1, 0.1}}).focusedAt(1, 1e-5), std::invalid_argument) << "it does not bend";
  EXPECT_THROW(biconvex(1e-9).focusedAt(1, 1e-5), std::invalid_argument) << "too small a stop";
}

TEST(ExitPupil, OfAStopAtTheRearIsTheStop) {
  const double radius = 0.002;
  const LensSystem lens = biconvex(radius);
  const ExitPupil pupil(lens, 0.02);
  // Margins are those of PBRT-v3: 2 * sqrt(2) * 3 radii / 1024 at the centre.
  const double margin = 2 * std::sqrt(2) * 3 * radius / 1024;
  EXPECT_NEAR(pupil.centralArea(), 4 * (radius + margin) * (radius + margin), 2e-3 * 4 * radius * radius);
  for (const double distance : {0.0, 0.001, 0.01, 0.0199, 0.1}) {
    const ExitPupil::Rectangle& r = pupil.at(distance);
    for (const double border : {-r.min.x, -r.min.y, r.max.x, r.max.y}) {
      EXPECT_GE(border, radius) << distance;
      EXPECT_LE(border, 1.04 * radius) << distance;
    }
  }
}

TEST(ExitPupil, HoldsEveryRayThatComesThrough) {
  // A stop in front of the lens, and a narrow front: the pupil shrinks toward the border of the film.
  const LensSystem lens =
      LensSystem({{0, 0.01, 1, 0.004}, {kFront, kThick, kIndex, 0.006}, {kRear, 0.05, 1, 0.006}})
          .focusedAt(2, 1e-5);
  const ExitPupil pupil(lens, 0.02);
  Rng rng(11);
  int through = 0;
  for (int i = 0; i < 200000; ++i) {
    const double x = 0.02 * rng.uniform(), u = 0.02 * (rng.uniform() - 0.5), v = 0.02 * (rng.uniform() - 0.5);
    const Vec3d film{x, 0, 0}, rear{u, v, lens.rearZ()};
    if (!lens.traceFromFilm({film, rear - film})) continue;
    ++through;
    const ExitPupil::Rectangle& r = pupil.at(x);
    EXPECT_TRUE(u >= r.min.x && u <= r.max.x && v >= r.min.y && v <= r.max.y) << x << ' ' << u << ' ' << v;
  }
  EXPECT_GT(through, 5000);
  EXPECT_LT(pupil.at(0.0199).area(), 0.8 * pupil.at(0).area());
}

}  // namespace
}  // namespace pbrtmedia
