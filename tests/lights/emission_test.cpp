// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lights/diffuse_area.h"
#include "lights/distant.h"
#include "lights/goniometric.h"
#include "lights/infinite.h"
#include "lights/light_test_support.h"
#include "lights/point.h"
#include "lights/projection.h"
#include "lights/spot.h"
#include "shapes/cone.h"
#include "shapes/disk.h"
#include "shapes/sphere.h"
#include "shapes/triangle_mesh.h"

// One contract for all lights: rays sent out (sampleLe, pdfLe) are of the light that is looked for (sample).

namespace pbrtmedia {
namespace {

using test::kMaxAbsZ;
using test::makePicture;
using test::RunningStats;

/// A disc on which light falls from its normal's side.
struct Receiver {
  Point3f centre;
  Normal3f n;
  float radius;
};

struct EmissionCase {
  std::string name;
  std::shared_ptr<Light> light;
  Receiver receiver;
  std::optional<double> power = std::nullopt;  ///< of the red channel, where a closed form exists
  std::shared_ptr<const Shape> shape = nullptr;
};
void PrintTo(const EmissionCase& c, std::ostream* os) { *os << c.name; }

constexpr Bounds3f kSceneBounds{{-2, -2, -2}, {2, 2, 2}};
const double kSceneDisc = std::numbers::pi * 12;  // of the bounding sphere

const Transform kStretched = Transform::rotate(20, {1, 2, 3}) * Transform::scale(1.6, 1, 0.7);

Image picture(int width, int height) {
  return makePicture(width, height,
                     [](int x, int y) { return Rgb(static_cast<float>((x * 7 + y * 5) % 6), 1, 1); });
}

Transform at(Vec3d p) { return Transform::translate(p); }

void addPointLights(std::vector<EmissionCase>& cases) {
  const double pi = std::numbers::pi;
  const Receiver below{{0, 0, 0}, normalize(Vector3f{0.2f, 0, -1}), 0.8f};  // light comes from -z, along +z
  cases.push_back({"Point",
                   std::make_shared<PointLight>(at({0, 0.3, -1}), PointLight::Params{.intensity = Rgb(2)}),
                   below, 8 * pi});
  const auto spot = [&](const char* name, const Transform& place, float cone, float ring, bool isRigid) {
    const SpotLight::Params params{.intensity = Rgb(3), .coneAngle = cone, .coneDeltaAngle = ring};
    const double edge = std::cos(radians(double{cone})), start = std::cos(radians(double{cone} - ring));
    const double power = 3 * 2 * pi * (1 - start + (start - edge) / 5);
    cases.push_back({name, std::make_shared<SpotLight>(at({0, 0, -1}) * place, params), below,
                     isRigid ? std::optional(power) : std::nullopt});
  };
  spot("Spot", Transform(), 50, 30, true);
  spot("SpotWithoutRing", Transform::rotate(10, {1, 0, 0}), 30, 0, true);
  spot("SpotAllRing", Transform(), 100, 100, true);
  spot("SpotStretched", kStretched, 40, 20, false);
  cases.push_back(
      {"GoniometricWithoutMap",
       std::make_shared<GoniometricLight>(at({0, 0, -1}), GoniometricLight::Params{.intensity = Rgb(2)}),
       below, 8 * pi});
  for (const auto& [name, place] : {std::pair("Goniometric", Transform::rotate(30, {1, 1, 0})),
                                    std::pair("GoniometricStretched", kStretched)}) {
    cases.push_back({name,
                     std::make_shared<GoniometricLight>(at({0, 0, -1}) * place,
                                                        GoniometricLight::Params{.map = picture(8, 4)}),
                     below});
  }
  const double tan30 = std::tan(radians(30.0)), tan2 = tan30 * tan30;
  cases.push_back({"ProjectionWithoutMap",
                   std::make_shared<ProjectionLight>(at({0, 0, -1}), ProjectionLight::Params{.fov = 60}),
                   below, 4 * std::atan(tan2 / std::sqrt(1 + 2 * tan2))});
  cases.push_back(
      {"Projection",
       std::make_shared<ProjectionLight>(
           at({0, 0, -1}), ProjectionLight::Params{.intensity = Rgb(2), .fov = 80, .map = picture(8, 4)}),
       below});
  cases.push_back({"ProjectionStretched",
                   std::make_shared<ProjectionLight>(
                       at({0, 0, -1}) * kStretched, ProjectionLight::Params{.fov = 50, .map = picture(5, 7)}),
                   below});
}

void addLightsAtInfinity(std::vector<EmissionCase>& cases) {
  const Receiver receiver{{0.3f, 0.2f, -0.1f}, normalize(Vector3f{0.2f, -0.3f, -1}), 1};
  cases.push_back({"Distant",
                   std::make_shared<DistantLight>(
                       Transform(), DistantLight::Params{.radiance = Rgb(2), .to = {0.2f, 0.5f, 1}}),
                   receiver, 2 * kSceneDisc});
  cases.push_back({"Infinite",
                   std::make_shared<InfiniteLight>(Transform(), InfiniteLight::Params{.radiance = Rgb(2)}),
                   receiver, 2 * 4 * std::numbers::pi * kSceneDisc});
  for (const auto& [name, place] : {std::pair("InfiniteMap", Transform::rotate(30, {1, 1, 0})),
                                    std::pair("InfiniteMapStretched", kStretched)}) {
    cases.push_back({name,
                     std::make_shared<InfiniteLight>(place, InfiniteLight::Params{.map = picture(8, 4)}),
                     receiver});
  }
}

void addAreaLights(std::vector<EmissionCase>& cases) {
  const double pi = std::numbers::pi;
  const auto area = [&](const char* name, std::shared_ptr<const Shape> shape, const Receiver& receiver,
                        const DiffuseAreaLight::Params& params) {
    const double sides = params.twoSided ? 2 : 1;
    const double power = sides * pi * shape->area(0) * double{params.radiance.r};
    cases.push_back({name, std::make_shared<DiffuseAreaLight>(*shape, 0, params), receiver, power, shape});
  };
  const Receiver up{{0, 0, 0}, {0, 0, 1}, 1}, sideways{{0, 0, 0}, {1, 0, 0}, 1};
  area("Disk", std::make_shared<Disk>(Disk::Params{.height = 1.5f}, ShapePlacement{Transform(), true}), up,
       {.radiance = Rgb(3)});
  TriangleMesh::Params mesh;
  mesh.indices = {0, 1, 2};
  mesh.P = {{-1, -1, 1}, {0.5f, 1.5f, 1.5f}, {1.5f, -0.5f, 0.5f}};
  area("TwoSidedTriangle", std::make_shared<TriangleMesh>(mesh, ShapePlacement{}), up, {.twoSided = true});
  area("Sphere",
       std::make_shared<Sphere>(Sphere::Params{.radius = 0.5f}, ShapePlacement{at({0, 0, 1.2}), false}), up,
       {.radiance = Rgb(2)});
  area("Ellipsoid",
       std::make_shared<Sphere>(Sphere::Params{.radius = 0.5f},
                                ShapePlacement{at({0, 0, 1.5}) * kStretched, false}),
       up, {.radiance = Rgb(2)});
  area("MirroredSphere",
       std::make_shared<Sphere>(Sphere::Params{.radius = 0.5f},
                                ShapePlacement{at({0, 0, 1.2}) * Transform::scale(-1, 1, 1), false}),
       up, {});
  area("StretchedCone",
       std::make_shared<Cone>(Cone::Params{},
                              ShapePlacement{at({1.5, 0.2, 0}) * Transform::scale(0.6, 0.6, 1.5), false}),
       sideways, {});
}

std::vector<EmissionCase> emissionCases() {
  std::vector<EmissionCase> cases;
  addPointLights(cases);
  addLightsAtInfinity(cases);
  addAreaLights(cases);
  for (const EmissionCase& c : cases) {
    c.light->preprocess(kSceneBounds);
    c.light->prepareEmission();
  }
  return cases;
}

class Emission : public testing::TestWithParam<EmissionCase> {
 protected:
  const Light& light() const { return *GetParam().light; }
  bool isAtPoint() const { return light().deltaPosition().has_value(); }
  bool isDistant() const { return light().typeName() == "distant"; }
  LeSample sampleLe(Rng& rng) const {
    const Point2f position{rng.uniform(), rng.uniform()}, direction{rng.uniform(), rng.uniform()};
    return light().sampleLe(position, direction, 0.25f);
  }
  /// Power, red channel, that a sample stands for.
  static double powerOf(const LeSample& s) {
    if (!(s.pdf.direction > 0)) return 0;
    return double{s.radiance.r} * absDot(s.normal, s.ray.d) / (double{s.pdf.position} * s.pdf.direction);
  }
};
INSTANTIATE_TEST_SUITE_P(All, Emission, testing::ValuesIn(emissionCases()),
                         [](const auto& tested) { return tested.param.name; });

TEST_P(Emission, SamplesAgreeWithTheirDensities) {
  Rng rng(1);
  int atBorder = 0;
  for (int i = 0; i < 5000; ++i) {
    const LeSample s = sampleLe(rng);
    ASSERT_GT(s.pdf.direction, 0);
    ASSERT_GT(s.pdf.position, 0);
    EXPECT_NEAR(length(s.ray.d), 1, 5e-7f);
    EXPECT_NEAR(length(s.normal), 1, 5e-7f);
    EXPECT_EQ(s.ray.time, 0.25f);
    const LePdf pdf = light().pdfLe(s.ray, s.normal);
    if (isAtPoint()) {
      EXPECT_EQ(s.pdf.position, 1);
      EXPECT_EQ(pdf.position, 0);
    } else {
      EXPECT_NEAR(pdf.position, s.pdf.position, 2e-6f * s.pdf.position);
    }
    if (isDistant()) {
      EXPECT_EQ(s.pdf.direction, 1);
      EXPECT_EQ(pdf.direction, 0);
    } else if (std::abs(pdf.direction - s.pdf.direction) > 1e-4f * s.pdf.direction) {
      ++atBorder;  // rounding carries a direction over the border of a texel
    }
  }
  EXPECT_LE(atBorder, 3);
}

TEST_P(Emission, SamplesHaveTheRadianceThatIsSeen) {
  Rng rng(2);
  for (int i = 0; i < 1000; ++i) {
    const LeSample s = sampleLe(rng);
    Rgb seen;
    if (isAtPoint()) {
      EXPECT_EQ(s.ray.o, *light().deltaPosition());
      seen = light().sample(s.ray.o + s.ray.d, test::kMiddle).radiance;  // at a distance of 1
    } else if (isDistant()) {
      seen = light().sample({}, test::kMiddle).radiance;
    } else if (light().isInfinite()) {
      seen = light().background(-s.ray.d);
    } else {  // as light samples find it
      const auto& area = static_cast<const AreaLight&>(light());
      seen = area.emitted(light().isSplit() ? -s.normal : s.normal, s.ray.d);
    }
    EXPECT_NEAR(s.radiance.r, seen.r, 2e-3f * seen.r + 1e-3f) << s.ray.d;
    EXPECT_NEAR(s.radiance.g, seen.g, 2e-3f * seen.g + 1e-3f) << s.ray.d;
  }
}

TEST_P(Emission, DirectionalDensityIntegratesToOne) {
  if (isDistant()) return;  // one direction: nothing to integrate
  Rng start(3);
  const LeSample somewhere = sampleLe(start);
  const auto pdf = [&](Rng& rng) {
    const Ray ray{.o = somewhere.ray.o, .d = sampleUniformSphere({rng.uniform(), rng.uniform()})};
    return light().pdfLe(ray, somewhere.normal).direction * 4 * kPi;
  };
  const test::ZTest z = test::runZTest(pdf, 1, 4, 400000);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
}

TEST_P(Emission, PositionalDensityIntegratesToOne) {
  if (isAtPoint()) return;  // one position
  Rng start(5);
  const LeSample somewhere = sampleLe(start);
  if (GetParam().shape) {  // the mean of 1 / density is the area
    const auto inverse = [&](Rng& rng) { return 1.0 / sampleLe(rng).pdf.position; };
    const test::ZTest z = test::runZTest(inverse, GetParam().shape->area(0), 6, 20000);
    EXPECT_TRUE(std::abs(z.z()) < kMaxAbsZ || std::abs(z.mean / z.truth - 1) < 2e-5) << z;
    return;
  }
  // Lines of one direction through a square around the disc.
  const Frame frame = Frame::fromZ(somewhere.ray.d);
  constexpr float kHalf = 4;
  const auto pdf = [&](Rng& rng) {
    const Vector3f local{(2 * rng.uniform() - 1) * kHalf, (2 * rng.uniform() - 1) * kHalf, -7};
    const Ray ray{.o = frame.toWorld(local), .d = somewhere.ray.d};
    return light().pdfLe(ray, somewhere.normal).position * 4 * kHalf * kHalf;
  };
  const test::ZTest z = test::runZTest(pdf, 1, 7, 200000);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
}

/// Directions of samples in cells of equal solid angle against the integral of pdfLe over the cell.
test::ChiSquareTest directionTest(const Light& light, double pdfFactorOnUpperHalf = 1) {
  constexpr int kZ = 24, kPhi = 32, kCount = 100000, kPerSide = 16, kPerSideAtEdges = 256;
  std::vector<double> observed(kZ * kPhi), expected(kZ * kPhi);
  Rng rng(99);
  LeSample s;
  for (int i = 0; i < kCount; ++i) {
    s = light.sampleLe({0.3f, 0.6f}, {rng.uniform(), rng.uniform()}, 0);
    const Vector3f w = s.ray.d;
    const int z = std::clamp(static_cast<int>((w.z + 1) / 2 * kZ), 0, kZ - 1);
    const double phi = std::atan2(w.y, w.x) + (w.y < 0 ? 2 * std::numbers::pi : 0);
    const int p = std::min(static_cast<int>(phi / (2 * std::numbers::pi) * kPhi), kPhi - 1);
    ++observed[static_cast<std::size_t>(z * kPhi + p)];
  }
  const auto meanPdf = [&](int z, int p, int perSide) {
    double sum = 0;
    for (int i = 0; i < perSide * perSide; ++i) {
      const double cosine = 2 * (z + (i / perSide + 0.5) / perSide) / kZ - 1;
      const double phi = 2 * std::numbers::pi * (p + (i % perSide + 0.5) / perSide) / kPhi;
      const double sine = std::sqrt(1 - cosine * cosine);
      const Vector3f w(Vec3d{sine * std::cos(phi), sine * std::sin(phi), cosine});
      sum += light.pdfLe({.o = s.ray.o, .d = w}, s.normal).direction;
    }
    return sum / (perSide * perSide);
  };
  double total = 0;
  for (int z = 0; z < kZ; ++z) {
    for (int p = 0; p < kPhi; ++p) {
      const auto cell = static_cast<std::size_t>(z * kPhi + p);
      double mean = meanPdf(z, p, kPerSide);
      if (mean == 0 && observed[cell] > 0) mean = meanPdf(z, p, kPerSideAtEdges);
      double& e = expected[cell];
      e = kCount * mean * 4 * std::numbers::pi / (kZ * kPhi);
      if (z >= kZ / 2) e *= pdfFactorOnUpperHalf;
      total += e;
    }
  }
  for (double& e : expected) e *= kCount / total;
  return test::chiSquareTest(observed, expected);
}

TEST_P(Emission, SamplesDirectionsByTheirDensity) {
  if (isDistant()) return;
  const test::ChiSquareTest c = directionTest(light());
  EXPECT_GT(c.pValue(), test::kMinPValue) << c;
}

TEST(EmissionTests, SeeADirectionalDensityThatIsAFifthOff) {
  const test::ChiSquareTest c = directionTest(PointLight(Transform(), {}), 1.2);
  EXPECT_LT(c.pValue(), test::kMinPValue) << c;
}

TEST_P(Emission, SendsOutThePowerOfTheLight) {
  RunningStats sent;
  Rng rng(8);
  for (int i = 0; i < 100000; ++i) sent.add(powerOf(sampleLe(rng)));
  RunningStats truth;  // over all directions, knowing nothing of how the light samples them
  if (isAtPoint() || light().isInfinite()) {
    Rng directions(9);
    for (int i = 0; i < 400000; ++i) {
      const Vector3f d = sampleUniformSphere({directions.uniform(), directions.uniform()});
      truth.add(4 * std::numbers::pi *
                (isAtPoint() ? double{light().sample(*light().deltaPosition() + d, test::kMiddle).radiance.r}
                             : kSceneDisc * double{light().background(d).r}));
    }
    const test::ZTest z = zTest(sent, truth);
    EXPECT_TRUE(std::abs(z.z()) < kMaxAbsZ || std::abs(z.mean / z.truth - 1) < 2e-6) << z;
  }
  if (GetParam().power) {
    const test::ZTest z = zTest(sent, *GetParam().power);
    EXPECT_TRUE(std::abs(z.z()) < kMaxAbsZ || std::abs(z.mean / z.truth - 1) < 2e-5) << z;
  }
}

TEST_P(Emission, SendsOutWhatPowerSaysWhereThatIsExact) {
  const std::string_view type = light().typeName();
  if (type != "point" && type != "distant" && type != "diffuse") return;
  EXPECT_NEAR(light().power().r, *GetParam().power, 1e-5 * *GetParam().power);
}

/// Power through the receiver by rays from the light.
RunningStats fluxByEmission(const Light& light, const Receiver& r, std::uint64_t seed, int count) {
  Rng rng(seed);
  RunningStats flux;
  for (int i = 0; i < count; ++i) {
    const Point2f position{rng.uniform(), rng.uniform()}, direction{rng.uniform(), rng.uniform()};
    const LeSample s = light.sampleLe(position, direction, 0);
    const float facing = -dot(s.ray.d, r.n), t = dot(s.ray.o - r.centre, r.n) / facing;
    const bool isHit =
        s.pdf.direction > 0 && facing > 0 && t > 0 && distance(s.ray.at(t), r.centre) < r.radius;
    const double weight = double{absDot(s.normal, s.ray.d)} / (double{s.pdf.position} * s.pdf.direction);
    flux.add(isHit ? double{s.radiance.r} * weight : 0.0);
  }
  return flux;
}

/// The same by light samples at points of the receiver.
RunningStats fluxByLightSamples(const Light& light, const Receiver& r, std::uint64_t seed, int count) {
  Rng rng(seed);
  const Frame frame = Frame::fromZ(r.n);
  RunningStats flux;
  for (int i = 0; i < count; ++i) {
    const Point2f disc = sampleConcentricDisk({rng.uniform(), rng.uniform()});
    const Point3f p = r.centre + r.radius * (disc.x * frame.s + disc.y * frame.t);
    const LightSample s = light.sample(p, {rng.uniform(), rng.uniform()});
    const double area = std::numbers::pi * sqr(double{r.radius});
    flux.add(s.pdf > 0 ? area * double{s.radiance.r} * std::max(0.0f, dot(r.n, s.wi)) / s.pdf : 0.0);
  }
  return flux;
}

TEST_P(Emission, LightsAReceiverAsLightSamplesDo) {
  const RunningStats sent = fluxByEmission(light(), GetParam().receiver, 10, 500000);
  const RunningStats looked = fluxByLightSamples(light(), GetParam().receiver, 11, 100000);
  EXPECT_GT(looked.mean(), 0);
  EXPECT_LT(sent.standardError(), 0.015 * sent.mean()) << "too few rays meet the receiver";
  const test::ZTest z = zTest(sent, looked);
  EXPECT_LT(std::abs(z.z()), kMaxAbsZ) << z;
}

TEST(EmissionTests, SeeAReceiverThatIsATwentiethTooBright) {
  const EmissionCase disk = [] {
    for (const EmissionCase& c : emissionCases()) {
      if (c.name == "Disk") return c;
    }
    throw std::logic_error("no such case");
  }();
  const RunningStats looked = fluxByLightSamples(*disk.light, disk.receiver, 11, 100000);
  const test::ZTest z = zTest(fluxByEmission(*disk.light, disk.receiver, 10, 300000), 1.05 * looked.mean());
  EXPECT_GT(std::abs(z.z()), kMaxAbsZ) << z;
}

TEST(BoundingSphere, IsEnteredByEveryLineThatMeetsTheScene) {
  const BoundingSphere sphere(kSceneBounds);
  EXPECT_NEAR(sphere.radius(), std::sqrt(12.0), 1e-12);
  Rng rng(12);
  for (int i = 0; i < 1000; ++i) {
    const Vector3f d = sampleUniformSphere({rng.uniform(), rng.uniform()});
    const Point3f inside{4 * rng.uniform() - 2, 4 * rng.uniform() - 2, 4 * rng.uniform() - 2};
    EXPECT_GT(sphere.pdfEntering({.o = inside, .d = d}), 0);
    const Ray ray = sphere.entering(d, {rng.uniform(), rng.uniform()}, 0);
    EXPECT_GE(length(ray.o), std::sqrt(12.0f) * (1 - 1e-6f)) << "outside";
    EXPECT_NEAR(dot(ray.o, d), -std::sqrt(12.0f), 2e-6f) << "on the disc before the scene";
  }
}

TEST(BoundingSphere, OfAnEmptySceneIsNotEntered) {
  for (const Bounds3f& box : {Bounds3f{}, Bounds3f{{1, 2, 3}, {1, 2, 3}}}) {
    DistantLight distant(Transform(), {});
    distant.preprocess(box);
    EXPECT_EQ(distant.sampleLe(test::kMiddle, test::kMiddle, 0).pdf.direction, 0);
    InfiniteLight infinite(Transform(), {});
    infinite.preprocess(box);
    EXPECT_EQ(infinite.sampleLe(test::kMiddle, test::kMiddle, 0).pdf.direction, 0);
  }
}

TEST(SpotLight, SendsNothingOutOfAClosedCone) {
  const SpotLight light(Transform(), {.coneAngle = 0, .coneDeltaAngle = 0});
  EXPECT_EQ(light.sampleLe({}, test::kMiddle, 0).pdf.direction, 0);
}

}  // namespace
}  // namespace pbrtmedia
