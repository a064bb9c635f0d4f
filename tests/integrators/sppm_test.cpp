// SPDX-License-Identifier: BSD-2-Clause
#include "integrators/sppm/sppm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/hash.h"
#include "integrators/sppm/photon_gather.h"
#include "integrators/sppm/photon_tracer.h"
#include "integrators/sppm/pixel_radii.h"
#include "lighting/light_strategy.h"
#include "lights/distant.h"
#include "materials/mirror.h"
#include "media/phase/phase_function.h"
#include "render/render_state.h"
#include "samplers/halton.h"
#include "support/direct_photons.h"
#include "support/fake_render.h"
#include "support/function_line.h"
#include "support/scene_kit.h"

namespace pbrtmedia {
namespace {

using namespace test;

/// Radiance by photons of a matte floor, at the first hit of a ray.
Rgb gathered(const PhotonMaps& maps, const Scene& scene, const Ray& ray, const PhotonGather::Kernels& kernels,
             int vertices = 9) {
  std::uint64_t queries = 0;
  const auto hit = scene.closest(ray, 0, {}, queries);
  SurfaceInteraction si = scene.surface(*hit, ray);
  PhotonGather gather(maps, vertices);
  gather.begin(kernels);
  return gather.scatteredOnSurface(si, hit->primitive->material->bsdf(si, TransportMode::Radiance, true), 1);
}
Rgb gathered(const PhotonMaps& maps, const Scene& scene, const Ray& ray, float radius, int vertices = 9) {
  return gathered(maps, scene, ray, {{KernelShape::Uniform, radius}, {KernelShape::Uniform, 0}}, vertices);
}

/// Power 10 over the lower hemisphere, one above a plane: 10 / (2 pi) at its foot. The mean over a disc of
/// radius r around it is that times 2 (1 - (1 + r²)^(-1/2)) / r².
TEST(SppmPhotons, OfAPointLightOnAPlaneHaveTheMeanOverTheDisc) {
  constexpr double kIrradiance = 10 / (2 * std::numbers::pi);
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 50), .material = kit.matte(1)});
  kit.pointLight({0, 0, 1}, static_cast<float>(kIrradiance));
  const auto scene = kit.finish();
  DirectPhotons photons(*scene);
  for (const double r : {.125, .5}) {
    const double blur = 2 * (1 - 1 / std::sqrt(1 + r * r)) / (r * r);
    RunningStats exact;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
      exact.add(std::numbers::pi *
                static_cast<double>(gathered(photons.trace(seed, 40000), *scene,
                                             rayOf({0, 0, .5f}, {0, 0, -1}), static_cast<float>(r))
                                        .g));
    }
    const ZTest test = zTest(exact, kIrradiance * blur, 1), unblurred = zTest(exact, kIrradiance, 1);
    EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
    EXPECT_TRUE(test.sees(.01)) << test;
    if (r > .3) {
      EXPECT_GT(std::abs(unblurred.z()), kMaxAbsZ) << "the bias is seen " << unblurred;
    }
  }
}

/// Fluence of a point light in fog at a distance, which falls with exp(-sigma_t d) / d²: the mean over a
/// ball.
TEST(SppmPhotons, OfAPointLightInFogHaveTheMeanOverTheBall) {
  constexpr double kSigmaA = .3, kSigmaS = .9, kAway = .8, kRadius = .6, kIntensity = 2;
  SceneKit kit;
  const Medium* const fog = kit.fog("fog", Rgb(kSigmaA), Rgb(kSigmaS));
  kit.builder.addPrimitive({.shape = kit.box({-9, -9, -9}, {9, 9, 9}), .media = {fog, nullptr}});
  kit.pointLight({0, 0, 0}, kIntensity);
  const auto scene = kit.finish();
  // Over shells around the light: a sphere of radius d meets the ball in a cap of this share.
  const auto share = [](double d) {
    return std::clamp(.5 * (1 - (d * d + kAway * kAway - kRadius * kRadius) / (2 * d * kAway)), 0., 1.);
  };
  const double ball = 4 * std::numbers::pi / 3 * std::pow(kRadius, 3);
  const double fluence =
      simpson(
          [&](double d) {
            return 4 * std::numbers::pi * kIntensity * std::exp(-(kSigmaA + kSigmaS) * d) * share(d);
          },
          kAway - kRadius, kAway + kRadius, 1000) /
      ball;
  const double truth = fluence / (4 * std::numbers::pi);  // scattered evenly
  DirectPhotons photons(*scene);
  RunningStats means;
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    const PhotonMaps maps = photons.trace(seed, 40000);
    PhotonGather gather(maps, 9);
    gather.begin({{KernelShape::Uniform, 0}, {KernelShape::Uniform, static_cast<float>(kRadius)}});
    means.add(static_cast<double>(
        gather.scatteredInMedium({kAway, 0, 0}, {0, 0, 1}, fog->phase(), Rgb(kSigmaS), 1).b));
    EXPECT_GT(gather.found().inMedia, 0u);
  }
  const ZTest test = zTest(means, truth, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees(.01)) << test;
  const ZTest other = zTest(means, truth * 1.02, 1);
  EXPECT_GT(std::abs(other.z()), kMaxAbsZ) << other;
}

/// Where normals are smooth, photons on one facet count on the next by the cosine of the facet they are on:
/// their density goes by that.
TEST(SppmPhotons, OnTheNextFacetCountByItsCosine) {
  constexpr double kIntensity = 2, kAlbedo = .5, kRadius = .3, kSlope = 1;  ///< radians, of the second facet
  const Point3f lamp{.4f, .1f, 1.2f};
  const Vector3f along(static_cast<float>(std::cos(kSlope)), 0, static_cast<float>(-std::sin(kSlope)));
  SceneKit kit;
  TriangleMesh::Params mesh;
  mesh.P = {{-5, -5, 0},
            {0, -5, 0},
            {0, 5, 0},
            {-5, 5, 0},
            Point3f(5 * along.x, -5, 5 * along.z),
            Point3f(5 * along.x, 5, 5 * along.z)};
  mesh.indices = {0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2};
  const Vector3f smooth = normalize(Vector3f(std::sin(.5f), 0, std::cos(.5f)));
  mesh.N.assign(mesh.P.size(), Normal3f(smooth));
  kit.builder.addPrimitive(
      {.shape = kit.builder.own(std::make_unique<TriangleMesh>(std::move(mesh), ShapePlacement{})),
       .material = kit.matte(kAlbedo)});
  kit.pointLight(lamp, kIntensity);
  const auto scene = kit.finish();
  const Point3f at{-.05f, 0, 0};
  // Over the disc of both facets.
  double flux = 0, ofThisFacet = 0;
  constexpr int kSteps = 1000;
  for (const bool second : {false, true}) {
    for (int i = 0; i < kSteps * kSteps; ++i) {
      const int column = i % kSteps, row = i / kSteps;
      const double s = kRadius * 1.5 * (column + .5) / kSteps, y = kRadius * (2 * (row + .5) / kSteps - 1);
      const Vec3d p = second ? Vec3d(s * double{along.x}, y, s * double{along.z}) : Vec3d(-s, y, 0);
      if (lengthSquared(p - Vec3d(at)) > kRadius * kRadius) continue;
      const Vec3d d = Vec3d(lamp) - p;
      const double area = kRadius * 1.5 * 2 * kRadius / (kSteps * kSteps);
      flux += area * kIntensity * absDot(d, Vec3d(smooth)) / std::pow(lengthSquared(d), 1.5);
    }
    if (!second) ofThisFacet = flux;
  }
  const double scale = kAlbedo / std::numbers::pi / (std::numbers::pi * kRadius * kRadius);
  DirectPhotons photons(*scene);
  RunningStats found;
  for (std::uint64_t seed = 1; seed <= 64; ++seed) {
    found.add(
        static_cast<double>(gathered(photons.trace(seed, 40000), *scene,
                                     rayOf(at + Vector3f(0, 0, .5f), {0, 0, -1}), static_cast<float>(kRadius))
                                .g));
  }
  const ZTest test = zTest(found, scale * flux, 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees(.02)) << test;
  EXPECT_GT(flux, 1.3 * ofThisFacet) << "the next facet has a part in it";
}

TEST(SppmPhotons, OfLongPathsAreNotJoinedToDeepVertices) {
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.sphere({0, 0, 0}, 1), .material = kit.matte(.9f)});
  kit.pointLight({0, 0, .2f}, 1);
  const auto scene = kit.finish();
  DirectPhotons photons(*scene);
  const PhotonMaps maps = photons.trace(1, 2000, 4);
  double last = 0;
  for (int vertices = 1; vertices <= 5; ++vertices) {
    const double now{gathered(maps, *scene, rayOf({0, 0, 0}, {1, 0, 0}), .7f, vertices).r};
    EXPECT_GT(now, last) << "photons of one more scattering";
    last = now;
  }
  EXPECT_EQ(gathered(maps, *scene, rayOf({0, 0, 0}, {1, 0, 0}), .7f, 9).r, static_cast<float>(last));
}

TEST(SppmRadii, ShrinkAsPhotonsAreFound) {
  std::vector<double> numbers(2 * PixelRadii::kNumbers);
  PixelRadii radii(numbers);
  radii.start(.5);
  EXPECT_EQ(radii.of(1).onSurfaces, .5f);
  EXPECT_EQ(radii.of(1).inMedia, .5f);
  double area = .25, volume = .125;
  for (int k = 0; k < 20; ++k) {  // gamma (k + 1) of gamma k + 1 are kept
    radii.shrink(1, {.onSurfaces = 30, .inMedia = 7});
    area *= (2.0 / 3 * (k + 1)) / (2.0 / 3 * k + 1);
    volume *= (2.0 / 3 * (k + 1)) / (2.0 / 3 * k + 1);
    EXPECT_NEAR(radii.of(1).onSurfaces, std::sqrt(area), 1e-6);
    EXPECT_NEAR(radii.of(1).inMedia, std::cbrt(volume), 1e-6);
  }
  radii.shrink(1, {});
  EXPECT_NEAR(radii.of(1).onSurfaces, std::sqrt(area), 1e-6) << "nothing was found";
  radii.shrink(1, {.onSurfaces = 1});
  EXPECT_LT(radii.of(1).onSurfaces, static_cast<float>(std::sqrt(area)));
  EXPECT_NEAR(radii.of(1).inMedia, std::cbrt(volume), 1e-6) << "each by its own";
  EXPECT_EQ(radii.of(0).onSurfaces, .5f) << "of another pixel";
}

// ---- Debiased kernels

/// Estimates by the photons of iterations of debiased photon mapping, with and without the correction. Only
/// differences of the first levels are taken, up to the kernel of a quarter of the size, so that the variance
/// is finite: the mean is what that kernel finds. That all levels together make up for the rest is no
/// question of chance (PhotonKernel.CorrectionsTelescope).
struct Debiased {
  RunningStats corrected, biased;
};
constexpr double kLastSize = .25;
/// `gather(maps, kernels)`: at one point. `paths`: of the first level.
template <class Gather>
Debiased debiased(DirectPhotons& photons, float radius, int iterations, int paths, const Gather& gather) {
  const KernelSchedule schedule({.debias = Debias::Single, .c = .499});
  Debiased found;
  Rng rng(5);
  for (int i = 0; i < iterations; ++i) {
    KernelSchedule::Step step = schedule.of(i, (i + rng.uniformDouble()) / iterations);
    if (step.sizes.correction->size < 1.001 * kLastSize) step = {.sizes = {.base = step.sizes.base}};
    const PhotonMaps maps =
        photons.trace(static_cast<std::uint64_t>(i) + 1, static_cast<int>(paths * step.photons));
    const auto with = [&](const KernelSizes& sizes) {
      return static_cast<double>(
          gather(maps, {{KernelShape::Cone, radius, sizes}, {KernelShape::Cone, radius, sizes}}).g);
    };
    found.corrected.add(with(step.sizes));
    found.biased.add(with({.base = step.sizes.base}));
  }
  return found;
}

void expectCorrected(const Debiased& found, double first, double last) {
  const ZTest corrected = zTest(found.corrected, last, 5), biased = zTest(found.biased, first, 5),
              control = zTest(found.biased, last, 5);
  std::printf("%.5f +- %.5f of %.5f, without correction %.5f of %.5f\n", corrected.mean,
              corrected.standardError, last, biased.mean, first);
  EXPECT_LT(std::abs(corrected.z()), kMaxAbsZ) << corrected;
  EXPECT_LT(kMaxAbsZ * corrected.standardError, std::abs(first - last)) << "the correction must be seen";
  EXPECT_LT(std::abs(biased.z()), kMaxAbsZ) << biased;
  EXPECT_GT(std::abs(control.z()), kMaxAbsZ) << "negative control " << control;
}

/// The plane of the published experiment, with a wider kernel, whose bias is larger: 10 / (2 pi (1 +
/// d²)^1.5).
TEST(SppmDebiased, SeesAPointLightOnAPlaneAsTheLastKernelDoes) {
  constexpr double kIrradiance = 10 / (2 * std::numbers::pi), kRadius = .8;
  SceneKit kit;
  kit.builder.addPrimitive({.shape = kit.square(0, 50), .material = kit.matte(1)});
  kit.pointLight({0, 0, 1}, static_cast<float>(kIrradiance));
  const auto scene = kit.finish();
  DirectPhotons photons(*scene);
  const auto meanWithin = [](double radius) {  // the cone on a disc is 6 (1 - x) x
    return simpson(
        [&](double x) {
          return 6 * (1 - x) * x * kIrradiance / (std::numbers::pi * std::pow(1 + sqr(radius * x), 1.5));
        },
        0, 1);
  };
  expectCorrected(debiased(photons, static_cast<float>(kRadius), 4000, 500,
                           [&](const PhotonMaps& maps, const PhotonGather::Kernels& kernels) {
                             return gathered(maps, *scene, rayOf({0, 0, .5f}, {0, 0, -1}), kernels);
                           }),
                  meanWithin(kRadius), meanWithin(kRadius * std::sqrt(kLastSize)));
}

/// Fog under parallel light, exp(-sigma_t z) deep in it.
TEST(SppmDebiased, SeesABeamInAMediumAsTheLastKernelDoes) {
  constexpr double kSigmaA = .8, kSigmaS = 3.2, kRadius = .9;
  SceneKit kit;
  const Medium* const fog = kit.fog("fog", Rgb(kSigmaA), Rgb(kSigmaS));
  kit.builder.addPrimitive({.shape = kit.box({-1, -1, -1}, {1, 1, 1}), .media = {fog, nullptr}});
  kit.builder.addLight(std::make_unique<DistantLight>(
      Transform(), DistantLight::Params{.radiance = Rgb(2), .from = {0, 0, 1}, .to = {0, 0, 0}}));
  const auto scene = kit.finish();
  DirectPhotons photons(*scene);
  // Over shells, in each of which it has the mean sinh(s) / s: the cone in a ball is 12 (1 - x) x².
  const auto meanWithin = [](double radius) {
    constexpr double kSigmaT = kSigmaA + kSigmaS;
    return 2 * std::exp(-kSigmaT) / (4 * std::numbers::pi) *
           simpson(
               [&](double x) {
                 const double s = kSigmaT * radius * x;
                 return 12 * (1 - x) * x * x * (s > 0 ? std::sinh(s) / s : 1);
               },
               0, 1);
  };
  expectCorrected(debiased(photons, static_cast<float>(kRadius), 2000, 1000,
                           [&](const PhotonMaps& maps, const PhotonGather::Kernels& kernels) {
                             PhotonGather gather(maps, 9);
                             gather.begin(kernels);
                             return gather.scatteredInMedium({0, 0, 0}, {0, 0, 1}, fog->phase(),
                                                             Rgb(static_cast<float>(kSigmaS)), 1);
                           }),
                  meanWithin(kRadius), meanWithin(kRadius * std::cbrt(kLastSize)));
}

// ---- Whole renders

std::unique_ptr<SppmIntegrator> makeSppm(Scene& scene, const SppmParams& params,
                                         std::optional<const Medium*> around = nullptr) {
  scene.prepareEmission();
  std::unique_ptr<const LightSelector> photons;
  if (!scene.lights().empty()) {
    const std::span<const Illuminant* const> all = scene.illuminants();
    photons = makeLightSelector(LightStrategy::Power, all.first(scene.lights().size()), scene.bounds());
  }
  return std::make_unique<SppmIntegrator>(scene, params, uniformSelectorWithMedia(scene), std::move(photons),
                                          CameraMedium(scene, kFarAway, 0, around));
}

/// A floor under a lamp, and a mirror above both: the lamp's image lights the floor from 2 H - h. The floor's
/// own light, mirrored, would be the next part, which `maxDepth` leaves out.
struct MirrorRoom {
  static constexpr float kLamp = 1, kMirror = 2, kIntensity = 3, kAlbedo = .5f;
  explicit MirrorRoom(float kr = .8f) {
    kit.builder.addPrimitive({.shape = kit.square(0, 1000), .material = kit.matte(kAlbedo)});
    const RgbTexture* texture = kit.builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(kr)));
    const Material* mirror = kit.builder.own(std::make_unique<MirrorMaterial>(MirrorParams{.kr = texture}));
    kit.builder.addPrimitive({.shape = kit.square(kMirror, 1000), .material = mirror});
    kit.pointLight({20, 15, kLamp}, kIntensity);
    scene = kit.finish();
  }
  /// Radiance of the floor below the lamp by itself, and by its image.
  static double direct(double height) {
    return static_cast<double>(kAlbedo) / std::numbers::pi * static_cast<double>(kIntensity) /
           (height * height);
  }
  SceneKit kit;
  std::unique_ptr<Scene> scene;
};

/// Straight down through the film plane, whose pixels are a hundredth of a unit, around the foot of the lamp.
class CloseCamera final : public Camera {
 public:
  CloseCamera() : Camera(AnimatedTransform(), 0, 1) {}
  WeightedRay generateRay(Point2f film, Point2f, float time) const override {
    WeightedRay w;
    w.ray =
        RayDifferential(rayOf({20 + (film.x - 18.5f) / 1000, 15 + (film.y - 11.5f) / 1000, .5f}, {0, 0, -1}));
    w.ray.time = rayTime(time);
    return w;
  }
};

/// The first `passes` of so many iterations.
Outcome renderClose(const Integrator& integrator, RenderOptions options, unsigned threads,
                    std::int64_t iterations, int passes = 1 << 20) {
  if (!options.afterPass) {
    options.afterPass = [&](const PassEnd& end) { return end.result.completedSamplesPerPixel < passes; };
  }
  const ThreadLimit limit(threads);
  const HaltonSampler sampler({.pixelSamples = iterations, .seed = options.seed});
  Film film = smallFilm({9, 7});
  Outcome out;
  out.result = integrator.render(CloseCamera(), sampler, film, options);
  out.image = film.develop();
  return out;
}

double meanOf(const Image& image) {
  double sum = 0;
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) sum += static_cast<double>(image.at(x, y, 0));
  }
  return sum / (image.width() * image.height());
}

TEST(Sppm, FindsTheImageOfALampInAMirror) {
  MirrorRoom room;
  const auto sppm = makeSppm(*room.scene, {.maxDepth = 2, .photonsPerIteration = 20000, .radius = .2f});
  RunningStats means;
  for (std::uint64_t seed = 1; seed <= 12; ++seed)
    means.add(meanOf(renderClose(*sppm, {.seed = seed}, 2, 8).image));
  const double truth = MirrorRoom::direct(1) + .8 * MirrorRoom::direct(3);
  const ZTest test = zTest(means, truth, 1), direct = zTest(means, MirrorRoom::direct(1), 1);
  EXPECT_LT(std::abs(test.z()), kMaxAbsZ) << test;
  EXPECT_TRUE(test.sees(.01)) << test;
  EXPECT_GT(std::abs(direct.z()), kMaxAbsZ) << "without photons" << direct;
}

TEST(Sppm, LeavesOutWhatIsDeeperThanAsked) {
  MirrorRoom room;
  const auto sppm = makeSppm(*room.scene, {.maxDepth = 1, .photonsPerIteration = 20000, .radius = .2f});
  EXPECT_NEAR(meanOf(renderClose(*sppm, {}, 2, 2).image), MirrorRoom::direct(1),
              1e-3 * MirrorRoom::direct(1));
}

TEST(Sppm, IsTheSameBitsForAnyThreadsAndAnotherForAnotherSeed) {
  MirrorRoom room;
  const auto sppm = makeSppm(*room.scene, {.maxDepth = 4, .photonsPerIteration = 5000, .radius = .2f});
  const Outcome one = renderClose(*sppm, {.seed = 3}, 1, 3);
  for (const unsigned threads : {2u, 5u}) {
    const Outcome other = renderClose(*sppm, {.seed = 3}, threads, 3);
    EXPECT_EQ(one.image.data(), other.image.data()) << threads;
    EXPECT_EQ(one.result.carried, other.result.carried);
    EXPECT_EQ(one.result.counters.rays, other.result.counters.rays);
  }
  EXPECT_NE(one.image.data(), renderClose(*sppm, {.seed = 4}, 2, 3).image.data());
}

TEST(Sppm, CountsIterationsAsSamples) {
  MirrorRoom room;
  const auto sppm = makeSppm(*room.scene, {.maxDepth = 2, .photonsPerIteration = 500, .radius = .2f});
  const Outcome all = renderClose(*sppm, {}, 2, 5);
  EXPECT_EQ(all.result.completedSamplesPerPixel, 5);
  EXPECT_EQ(all.result.samplesTaken, all.result.samplesTotal);
  EXPECT_EQ(all.result.pixelsSampled, all.result.pixelsTotal);
  EXPECT_FALSE(all.result.interrupted);
  const Outcome stopped = renderClose(*sppm, {}, 2, 5, 2);
  EXPECT_EQ(stopped.result.completedSamplesPerPixel, 2);
  EXPECT_TRUE(stopped.result.interrupted);
  const std::atomic<bool> stop{true};
  EXPECT_EQ(renderClose(*sppm, {.stop = &stop}, 2, 5).result.samplesTaken, 0u);
}

/// Has the render stopped at one of its rays.
class StoppingCamera final : public Camera {
 public:
  StoppingCamera(int last, std::atomic<bool>& stop)
      : Camera(AnimatedTransform(), 0, 1), left_(last), stop_(stop) {}
  WeightedRay generateRay(Point2f film, Point2f lens, float time) const override {
    if (left_-- == 0) stop_ = true;
    return CloseCamera().generateRay(film, lens, time);
  }

 private:
  mutable std::atomic<int> left_;
  std::atomic<bool>& stop_;
};

TEST(Sppm, LeavesOutAnIterationThatIsCutOff) {
  MirrorRoom room;
  const auto sppm = makeSppm(*room.scene, {.maxDepth = 2, .photonsPerIteration = 2000, .radius = .2f});
  const Outcome two = renderClose(*sppm, {}, 1, 5, 2);
  const int rays = static_cast<int>(two.result.pixelsTotal) + 1;  // of an iteration, with one for the time
  for (const int more : {0, 5, rays - 2}) {                       // among photons, and among pixels
    std::atomic<bool> stop{false};
    Film film = smallFilm({9, 7});
    const HaltonSampler sampler({.pixelSamples = 5});
    int partial = 0;
    const ThreadLimit one(1);
    const RenderResult cut =
        sppm->render(StoppingCamera(2 * rays + more, stop), sampler, film,
                     {.stop = &stop, .beforePartialPass = [&](const PassEnd&) { ++partial; }});
    EXPECT_EQ(cut.completedSamplesPerPixel, 2);
    EXPECT_EQ(cut.samplesTaken, two.result.samplesTaken);
    EXPECT_TRUE(cut.interrupted);
    EXPECT_EQ(partial, 1);
    EXPECT_EQ(cut.carried, two.result.carried);
    EXPECT_EQ(film.develop().data(), two.image.data());
  }
}

TEST(Sppm, GoesOnFromAStateToTheSameBits) {
  MirrorRoom room;
  const auto sppm = makeSppm(*room.scene, {.maxDepth = 3, .photonsPerIteration = 2000, .radius = .2f});
  const Outcome whole = renderClose(*sppm, {.seed = 3}, 2, 5);
  Film film = smallFilm({9, 7});
  RenderState state;
  const HaltonSampler sampler({.pixelSamples = 5, .seed = 3});
  sppm->render(CloseCamera(), sampler, film, {.seed = 3, .afterPass = [&](const PassEnd& end) {
                                                state = saveState(*room.scene, film, end.result);
                                                return end.result.completedSamplesPerPixel < 2;
                                              }});
  EXPECT_EQ(state.result.completedSamplesPerPixel, 2);
  Film rest = smallFilm({9, 7});
  ASSERT_TRUE(restoreState(state, *room.scene, rest));
  const RenderResult result = sppm->render(CloseCamera(), sampler, rest, {.seed = 3, .start = &state});
  EXPECT_EQ(rest.develop().data(), whole.image.data());
  EXPECT_EQ(result.carried, whole.result.carried);
  state.result.carried.clear();  // negative control: without the radii it is another image
  ASSERT_TRUE(restoreState(state, *room.scene, rest));
  sppm->render(CloseCamera(), sampler, rest, {.seed = 3, .start = &state});
  EXPECT_NE(rest.develop().data(), whole.image.data());
}

// ---- Whole renders without radii of their own

SppmParams debiasedParams(Debias debias) {
  return {.maxDepth = 3,
          .photonsPerIteration = 2000,
          .radius = .2f,
          .kernel = KernelShape::Cone,
          .schedule = {.debias = debias}};
}
constexpr Debias kDebiased[] = {Debias::Single, Debias::Progressive, Debias::ProgressiveUnbiased};

TEST(SppmDebiased, IsTheSameBitsForAnyThreads) {
  MirrorRoom room;
  std::vector<std::vector<float>> images;
  for (const Debias debias : kDebiased) {
    const auto sppm = makeSppm(*room.scene, debiasedParams(debias));
    const Outcome one = renderClose(*sppm, {.seed = 3}, 1, 5), other = renderClose(*sppm, {.seed = 3}, 5, 5);
    EXPECT_EQ(one.image.data(), other.image.data());
    EXPECT_TRUE(one.result.carried.empty());
    for (const auto& before : images) EXPECT_NE(before, one.image.data()) << "each kind has its own image";
    images.push_back(one.image.data());
  }
}

TEST(SppmDebiased, IterationsCanBeTakenApart) {
  MirrorRoom room;
  EXPECT_NE(makeSppm(*room.scene, {})->whyInOnePiece(), "");
  for (const Debias debias : kDebiased) {
    const auto sppm = makeSppm(*room.scene, debiasedParams(debias));
    EXPECT_EQ(sppm->whyInOnePiece(), "");
    const double whole = meanOf(renderClose(*sppm, {.seed = 3}, 2, 6).image),
                 first = meanOf(renderClose(*sppm, {.seed = 3, .endSample = 2}, 2, 6).image),
                 rest = meanOf(renderClose(*sppm, {.seed = 3, .firstSample = 2}, 2, 6).image);
    EXPECT_NEAR(whole, (2 * first + 4 * rest) / 6, 1e-3 * whole);
    EXPECT_NE(first, rest);
  }
}

}  // namespace
}  // namespace pbrtmedia
