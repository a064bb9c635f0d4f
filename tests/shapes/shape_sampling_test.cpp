// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "shapes/shape_probe.h"
#include "support/z_test.h"

// Sampling of points on shapes, by area and toward a reference point. Every test runs over all quadrics in
// all placements, and a mesh.

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::makeRay;
using test::Probe;
using test::RunningStats;

/// Calls f(shape, its mesh of n x n cells) for every quadric in every placement.
template <class F>
void forEachShape(int n, F f) {
  for (const auto& quadric : test::quadricCases()) {
    for (const auto& place : test::placements()) {
      SCOPED_TRACE(quadric.name + ", " + place.name);
      const auto shape = quadric.make(place.placement);
      f(*shape, test::tessellate(quadric, place.placement.worldFromObject, n));
    }
  }
}

/// Integral of g over a mesh, by the centre of each triangle.
double integral(const TriangleMesh::Params& mesh, const std::function<double(Vec3d)>& g) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) {
      return Vec3d(mesh.P[static_cast<std::size_t>(mesh.indices[i + k])]);
    };
    const Vec3d a = corner(0), b = corner(1), c = corner(2);
    sum += 0.5 * length(cross(b - a, c - a)) * g((a + b + c) / 3.0);
  }
  return sum;
}

/// Three functions that together see a density that is wrong along or around the axis.
const std::vector<std::function<double(Vec3d)>>& probes() {
  static const std::vector<std::function<double(Vec3d)>> functions{
      [](Vec3d) { return 1.0; }, [](Vec3d p) { return p.x + 0.5 * p.y; },
      [](Vec3d p) { return sqr(p.z) + std::sin(2 * p.x); }};
  return functions;
}

TEST(ShapeSampling, AreaIsThatOfAFineMesh) {
  forEachShape(300, [](const Shape& shape, const TriangleMesh::Params& mesh) {
    const double truth = integral(mesh, [](Vec3d) { return 1.0; });
    EXPECT_NEAR(shape.area(0) / truth, 1, 2e-4);
  });
}

TEST(ShapeSampling, DensityByAreaIntegratesFunctionsOverTheSurface) {
  constexpr std::uint64_t kSamples = 20000;
  forEachShape(300, [](const Shape& shape, const TriangleMesh::Params& mesh) {
    for (const auto& g : probes()) {
      const auto estimate = [&](Rng& rng) {
        const float a = rng.uniform(), b = rng.uniform();
        const ShapeSample s = shape.sample(0, {a, b});
        return g(Vec3d(s.p)) / s.pdf;
      };
      // The facets' error (2e-4 of the area) stays below a standard error.
      const auto z = test::runZTest(estimate, integral(mesh, g), 17, kSamples);
      const bool isExact = z.standardError < 1e-5 * std::abs(z.truth);  // constant density, constant g
      if (isExact) {
        EXPECT_NEAR(z.mean / z.truth, 1, 2e-4);
      } else {
        EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
      }
    }
  });
}

TEST(ShapeSampling, SamplesLieOnTheirShapeWithTheNormalOfHits) {
  forEachShape(1, [](const Shape& shape, const TriangleMesh::Params&) {
    const Probe probe(shape);
    Rng rng(5);
    for (int i = 0; i < 300; ++i) {
      const float a = rng.uniform(), b = rng.uniform();
      const ShapeSample s = shape.sample(0, {a, b});
      const auto hits = probe.all(makeRay(s.p + 0.01f * s.n, -s.n));
      ASSERT_FALSE(hits.empty());
      EXPECT_LT(distance(hits[0].p, s.p), 1e-5f);
      EXPECT_LT(length(hits[0].n - s.n), 1e-4f);
    }
  });
}

/// Reference points near (often inside), at some distance and far.
std::vector<Point3f> references(const Shape& shape) {
  const Bounds3f b = shape.bounds();
  const float size = length(b.diagonal());
  return {b.centre() + size * Vector3f(0.03f, -0.05f, 0.08f), b.centre() + size * Vector3f(0.5f, 0.3f, -0.4f),
          b.centre() + size * Vector3f(-3, 1, 4)};
}

TEST(ShapeSampling, PdfOfTheHitIsThatOfTheSample) {
  forEachShape(1, [](const Shape& shape, const TriangleMesh::Params&) {
    const Probe probe(shape);
    Rng rng(6);
    int compared = 0;
    for (const Point3f& reference : references(shape)) {
      for (int i = 0; i < 200; ++i) {
        const float a = rng.uniform(), b = rng.uniform();
        const ShapeSample s = shape.sample(0, reference, {a, b});
        if (!(s.pdf > 0)) continue;
        const Vector3f wi = normalize(s.p - reference);
        for (const auto& si : probe.all(makeRay(reference, wi))) {
          const float miss = distance(si.p, s.p), cosine = absDot(wi, s.n);
          if (miss > 1e-3f) continue;
          // The hit is as far from the sample as wi is rounded. With it turn the normal and wi: the cosine
          // and the stretch of areas (below 4 here) change by as much.
          const float turn = 1e-6f + length(si.n - s.n) + miss / distance(s.p, reference);
          const float change = 4 * turn / cosine;
          if (change > 0.1f) continue;
          ++compared;
          EXPECT_NEAR(shape.pdf(0, reference, wi, si.p, si.n) / s.pdf, 1, 1e-5f + change);
        }
      }
    }
    EXPECT_GT(compared, 200);
  });
}

/// The density toward a reference, integrated two ways: over directions of the sphere with pdf() of every
/// hit, and over sample(). The test function |cos| keeps the variance finite at silhouettes.
void expectPdfIsThatOfSamples(const Shape& shape, Point3f reference, std::uint64_t n, double distort = 1) {
  const Probe probe(shape);
  Rng rng(21);
  RunningStats directions, samples;
  // From outside the bounding sphere only the directions to it, so that few miss.
  const Bounds3f b = shape.bounds();
  const float d = distance(b.centre(), reference), r = 0.51f * length(b.diagonal());
  const Vector3f toCentre = (b.centre() - reference) / d;
  const float cone = d > r ? 1 - std::sqrt(1 - sqr(r / d)) : 2;
  for (std::uint64_t i = 0; i < n; ++i) {
    const float u0 = rng.uniform(), u1 = rng.uniform();
    const Vector3f wi = Frame::fromZ(toCentre).toWorld(sampleUniformCone({u0, u1}, cone));
    double sum = 0;
    for (const auto& si : probe.all(makeRay(reference, wi))) {
      if (si.primitive.primitive == 0) sum += shape.pdf(0, reference, wi, si.p, si.n) * absDot(si.n, wi);
    }
    directions.add(distort * sum / pdfUniformCone(cone));
    const float u2 = rng.uniform(), u3 = rng.uniform();
    const ShapeSample s = shape.sample(0, reference, {u2, u3});
    samples.add(absDot(s.n, normalize(s.p - reference)));
  }
  const auto z = test::zTest(directions, samples, 21);
  if (distort == 1) {
    EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
  } else {
    EXPECT_GT(std::abs(z.z()), kMaxAbsZ) << z;
  }
}

/// Their normals are not those of the surface, by which densities go.
TEST(ShapeSampling, PdfOfAHyperboloidWithItsWaistElsewhereIntegratesToSamples) {
  const Transform placed = Transform::rotate(30, {1, 2, 3}) * Transform::scale(1, 1.5, 0.75);
  for (const Hyperboloid::Params& params :
       {Hyperboloid::Params{.p1 = {1, 0, -1}, .p2 = {1, 1, 1}},
        Hyperboloid::Params{.p1 = {2, 0, -1}, .p2 = {1, 0.5f, 1}},
        Hyperboloid::Params{.p1 = {2, 0, -2}, .p2 = {0.2f, 0.3f, 1.5f}, .phimax = 200}}) {
    const Hyperboloid hyperboloid(params, {placed, false});
    for (const Point3f& reference : references(hyperboloid))
      expectPdfIsThatOfSamples(hyperboloid, reference, 40000);
  }
}

TEST(ShapeSampling, PdfIntegratesToTheSameAsSamples) {
  forEachShape(1, [](const Shape& shape, const TriangleMesh::Params&) {
    const auto points = references(shape);
    expectPdfIsThatOfSamples(shape, points[0], 10000);
    expectPdfIsThatOfSamples(shape, points[1], 10000);
  });
}

TEST(ShapeSampling, TheIntegralTestSeesAWrongPdf) {
  const Sphere sphere({}, {});
  expectPdfIsThatOfSamples(sphere, {1.5f, 0, 0}, 20000, 1.25);
  const Cone cone({}, {});
  expectPdfIsThatOfSamples(cone, {1.5f, 0, 0}, 20000, 1.25);
}

TEST(ShapeSampling, TrianglesAreSampledByArea) {
  TriangleMesh::Params params;
  params.P = {{1, 0, 0}, {0, 2, 0}, {0, 0, 3}, {1, 1, 1}};
  params.indices = {0, 1, 2, 1, 2, 3};
  const TriangleMesh mesh(params, {Transform::scale(1, -2, 1), true});
  expectPdfIsThatOfSamples(mesh, {-1, -1, 0.5f}, 20000);
  for (const auto& g : probes()) {
    double truth = 0;  // midpoints of cells of the square, folded into the triangle
    constexpr int kCells = 200;
    const auto corners = mesh.corners(0);
    const Vec3d a(corners[0]), b(corners[1]), c(corners[2]);
    for (int i = 0; i < kCells; ++i) {
      for (int j = 0; j < kCells; ++j) {
        double u = (i + 0.5) / kCells, v = (j + 0.5) / kCells;
        if (u + v > 1) {
          u = 1 - u;
          v = 1 - v;
        }
        truth += g(a + u * (b - a) + v * (c - a)) * mesh.area(0) / sqr(kCells);
      }
    }
    const auto z = test::runZTest(
        [&](Rng& rng) {
          const float x = rng.uniform(), y = rng.uniform();
          const ShapeSample s = mesh.sample(0, {x, y});
          return g(Vec3d(s.p)) / s.pdf;
        },
        truth, 4, 50000);
    if (z.standardError < 1e-5 * std::abs(z.truth)) {
      EXPECT_NEAR(z.mean / z.truth, 1, 1e-5);
    } else {
      EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
    }
  }
}

TEST(ShapeSampling, ASphereIsSampledByItsConeOfDirections) {
  const Sphere sphere({.radius = 0.5f}, {Transform::translate({1, 2, 3}), true});
  const Point3f reference(1, 2, 6);
  // sin = r / d = 1/6
  const double solidAngle = 2 * std::numbers::pi * (1 - std::sqrt(1 - 1.0 / 36));
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const float a = rng.uniform(), b = rng.uniform();
    const ShapeSample s = sphere.sample(0, reference, {a, b});
    EXPECT_NEAR(s.pdf * solidAngle, 1, 1e-5);
    EXPECT_NEAR(distance(s.p, {1, 2, 3}), 0.5f, 1e-6f);
    EXPECT_GE(dot(s.n, s.p - reference), -1e-4f);  // reversed: the near side faces away from the reference
  }
}

TEST(ShapeSampling, TinyAndFarSpheresKeepTheirDigits) {
  for (const double distance : {1.0, 1e4, 1e8}) {
    const Sphere sphere({.radius = 1e-3f}, {});
    const Point3f reference(0, 0, static_cast<float>(distance));
    const double sine = 1e-3 / distance, solidAngle = std::numbers::pi * sine * sine;  // to 1e-6 relative
    Rng rng(3);
    RunningStats z;
    for (int i = 0; i < 2000; ++i) {
      const float a = rng.uniform(), b = rng.uniform();
      const ShapeSample s = sphere.sample(0, reference, {a, b});
      EXPECT_NEAR(s.pdf * solidAngle, 1, 1e-5) << distance;
      EXPECT_NEAR(length(Vec3d(s.p)), 1e-3, 1e-9);
      EXPECT_GE(s.p.z, 0);
      z.add(sqr(s.p.x / 1e-3) + sqr(s.p.y / 1e-3));  // uniform on the disk it appears as: mean 1/2
      const Vector3f wi = normalize(s.p - reference);
      EXPECT_NEAR(sphere.pdf(0, reference, wi, s.p, s.n) / s.pdf, 1, 1e-5);
    }
    EXPECT_LT(std::abs(test::zTest(z, 0.5, 3).z()), kMaxAbsZ);
  }
}

TEST(ShapeSampling, FromItsOwnSurfaceASphereIsSampledByArea) {
  const Sphere sphere({}, {Transform::translate({20, 0, 0}), false});
  Rng rng(4);
  for (int i = 0; i < 1000; ++i) {
    const float a = rng.uniform(), b = rng.uniform(), c = rng.uniform(), d = rng.uniform();
    const Point3f reference = sphere.sample(0, {a, b}).p;
    const ShapeSample s = sphere.sample(0, reference, {c, d});
    if (distance(s.p, reference) < 1e-2f) continue;
    EXPECT_GT(dot(s.n, s.p - reference), 0);  // across the inside: seen from behind
  }
}

}  // namespace
}  // namespace pbrtmedia
