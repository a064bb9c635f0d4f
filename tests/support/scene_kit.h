// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <array>
#include <memory>
#include <utility>
#include <vector>

#include "integrators/path/path.h"
#include "integrators/path/vol_path.h"
#include "lighting/light_strategy.h"
#include "lights/diffuse_area.h"
#include "lights/infinite.h"
#include "lights/point.h"
#include "materials/matte.h"
#include "media/homogeneous.h"
#include "render/sampling_integrator.h"
#include "samplers/random.h"
#include "shapes/sphere.h"
#include "shapes/triangle_mesh.h"
#include "support/statistics.h"
#include "world/media_topology.h"
#include "world/scene_builder.h"

// Small scenes from real parts.
namespace pbrtmedia::test {

/// Scatters nothing back.
class BlackMaterial final : public Material {
 public:
  Bsdf bsdf(SurfaceInteraction& si, TransportMode mode, bool) const override { return Bsdf(si, mode); }
  std::size_t maxLobes() const override { return 0; }
};

/// A SceneBuilder with a few words for common parts.
class SceneKit {
 public:
  SceneBuilder builder;

  const Medium* fog(std::string name, Rgb sigmaA, Rgb sigmaS, OverlapRule overlap = {}) {
    return builder.own(std::make_unique<HomogeneousMedium>(HomogeneousMedium::Params{.name = std::move(name),
                                                                                     .sigmaA = sigmaA,
                                                                                     .sigmaS = sigmaS,
                                                                                     .phase = {PhaseLobe{}},
                                                                                     .overlap = overlap}));
  }
  const Material* matte(float kd) {
    const RgbTexture* texture = builder.own(std::make_unique<ConstantTexture<Rgb>>(Rgb(kd)));
    const FloatTexture* sigma = builder.own(std::make_unique<ConstantTexture<float>>(0.0f));
    return builder.own(std::make_unique<MatteMaterial>(MatteParams{.kd = texture, .sigma = sigma}));
  }
  const Material* black() { return builder.own(std::make_unique<BlackMaterial>()); }

  /// Axis-parallel box with outward normals.
  const Shape* box(Point3f a, Point3f b, const Transform& place = {}) {
    TriangleMesh::Params mesh;
    for (int i = 0; i < 8; ++i) mesh.P.push_back(Bounds3f{a, b}.corner(i));
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return builder.own(std::make_unique<TriangleMesh>(std::move(mesh), ShapePlacement{place, false}));
  }
  const Shape* sphere(Point3f centre, float radius, bool reverse = false) {
    const Transform place = Transform::translate(Vec3d(centre));
    Sphere::Params params;
    params.radius = radius;
    return builder.own(std::make_unique<Sphere>(params, ShapePlacement{place, reverse}));
  }
  /// Corners in order; normal along (b - a) x (c - a).
  const Shape* quad(Point3f a, Point3f b, Point3f c, Point3f d) {
    TriangleMesh::Params mesh;
    mesh.P = {a, b, c, d};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return builder.own(std::make_unique<TriangleMesh>(std::move(mesh), ShapePlacement{}));
  }
  /// Square of half-width `r` at height z, facing +z.
  const Shape* square(float z, float r) { return quad({-r, -r, z}, {r, -r, z}, {r, r, z}, {-r, r, z}); }

  /// Diffuse lights for all primitives of a shape about to be placed.
  std::vector<AreaLight*> emitters(const Shape* shape, Rgb radiance, bool twoSided = false, int samples = 1) {
    std::vector<AreaLight*> lights;
    for (std::uint32_t i = 0; i < shape->primitiveCount(); ++i) {
      lights.push_back(builder.own(std::make_unique<DiffuseAreaLight>(
          *shape, i,
          DiffuseAreaLight::Params{.radiance = radiance, .twoSided = twoSided, .samples = samples})));
    }
    return lights;
  }
  void sky(float radiance) {
    InfiniteLight::Params params;
    params.radiance = Rgb(radiance);
    builder.addLight(std::make_unique<InfiniteLight>(Transform(), params));
  }
  void pointLight(Point3f at, float intensity) {
    builder.addLight(std::make_unique<PointLight>(
        Transform(), PointLight::Params{.intensity = Rgb(intensity), .from = at}));
  }
  std::unique_ptr<Scene> finish() { return builder.finish(); }
};

inline std::unique_ptr<const LightSelector> uniformSelector(const Scene& scene) {
  if (scene.lights().empty()) return nullptr;
  return makeLightSelector(LightStrategy::Uniform,
                           std::span(scene.illuminants()).first(scene.lights().size()), scene.bounds());
}

inline std::unique_ptr<const LightSelector> uniformSelectorWithMedia(const Scene& scene) {
  if (scene.illuminants().empty()) return nullptr;
  return makeLightSelector(LightStrategy::Uniform, scene.illuminants(), scene.bounds());
}

inline std::unique_ptr<SamplingIntegrator> makePath(const Scene& scene, PathParams params = {}) {
  return std::make_unique<PathIntegrator>(scene, params, uniformSelector(scene));
}
/// Outside of everything: where tests without a camera have theirs.
inline constexpr Point3f kFarAway{50, 60, 70};

inline std::unique_ptr<SamplingIntegrator> makeVolPath(const Scene& scene, PathParams params = {},
                                                       std::optional<const Medium*> camera = nullptr) {
  return std::make_unique<VolPathIntegrator>(scene, params, uniformSelectorWithMedia(scene),
                                             CameraMedium(scene, kFarAway, 0, camera));
}

inline Ray rayOf(Point3f o, Vector3f d) {
  Ray ray;
  ray.o = o;
  ray.d = normalize(d);
  return ray;
}

/// Radiance along one ray: n independent estimates.
struct Estimates {
  RunningStats red, green, blue;
  RenderCounters counters;
  std::vector<Rgb> values;  ///< the first few
};
inline Estimates estimate(const SamplingIntegrator& integrator, const Ray& ray, std::uint64_t n,
                          std::uint64_t seed = 1) {
  Estimates result;
  RandomSampler sampler({.pixelSamples = 1, .seed = seed});
  for (std::uint64_t i = 0; i < n; ++i) {
    sampler.start({0, 0}, static_cast<std::int64_t>(i));
    Rng rng(hashCombine(seed, i));
    SampleContext context{sampler, rng, result.counters};
    const Rgb value = integrator.radiance(RayDifferential(ray), context);
    result.red.add(value.r);
    result.green.add(value.g);
    result.blue.add(value.b);
    if (result.values.size() < 64) result.values.push_back(value);
  }
  return result;
}

}  // namespace pbrtmedia::test
