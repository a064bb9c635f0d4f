// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <utility>

#include "base/parallel.h"
#include "cameras/camera.h"
#include "film/film.h"
#include "filters/gaussian.h"
#include "render/render_options.h"
#include "render/render_result.h"
#include "render/sampling_integrator.h"
#include "samplers/random.h"
#include "support/scene_kit.h"
#include "world/scene_builder.h"

// Renders of functions instead of scenes.
namespace pbrtmedia::test {

/// Rays along -z through the film plane.
class FlatCamera final : public Camera {
 public:
  FlatCamera() : Camera(AnimatedTransform(), 0, 1) {}
  WeightedRay generateRay(Point2f film, Point2f, float time) const override {
    WeightedRay w;
    w.ray = RayDifferential(rayOf({film.x, film.y, 1}, {0, 0, -1}));
    w.ray.time = rayTime(time);
    return w;
  }
};

inline const Scene& emptyScene() {
  static const std::unique_ptr<const Scene> scene = SceneBuilder().finish();
  return *scene;
}

/// Any function of position and random numbers.
class FakeIntegrator final : public SamplingIntegrator {
 public:
  using Function = std::function<Rgb(const RayDifferential&, SampleContext&)>;
  explicit FakeIntegrator(Function f, bool makesSplats = false)
      : SamplingIntegrator(emptyScene()), f_(std::move(f)), makesSplats_(makesSplats) {}
  std::string_view typeName() const override { return "fake"; }
  Rgb radiance(const RayDifferential& ray, SampleContext& context) const override { return f_(ray, context); }
  bool makesSplats() const override { return makesSplats_; }

 private:
  Function f_;
  bool makesSplats_;
};

inline FakeIntegrator noise() {
  return FakeIntegrator([](const RayDifferential& ray, SampleContext& context) {
    return Rgb(ray.o.x * 0.1f, context.sampler.get1D(), context.rng.uniform());
  });
}

inline Film smallFilm(Point2i resolution = {37, 23}) {
  Film::Settings settings;
  settings.resolution = resolution;
  return {settings, GaussianFilter({})};
}

struct Outcome {
  Image image;
  RenderResult result;
};
inline Outcome renderFake(const Integrator& integrator, const RenderOptions& options, unsigned threads = 1,
                          std::int64_t spp = 7) {
  const ThreadLimit limit(threads);
  const RandomSampler sampler({.pixelSamples = spp, .seed = options.seed});
  Film film = smallFilm();
  Outcome out;
  out.result = integrator.render(FlatCamera(), sampler, film, options);
  out.image = film.develop();
  return out;
}

}  // namespace pbrtmedia::test
