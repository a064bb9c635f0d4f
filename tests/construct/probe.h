// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <vector>

#include "construct/attempt.h"
#include "lights/light.h"
#include "materials/bssrdf.h"
#include "materials/material.h"
#include "media/medium.h"
#include "media/phase/phase_function.h"
#include "render/sample_taker.h"

// What constructed objects do, as lists of numbers: two scenes that differ in one parameter must differ here.
namespace pbrtmedia::test {

using Numbers = std::vector<double>;

inline void append(Numbers& n, Rgb c) { n.insert(n.end(), {c.r, c.g, c.b}); }
inline void append(Numbers& n, const Vec3<float>& v) { n.insert(n.end(), {v.x, v.y, v.z}); }

inline std::vector<Ray> probingRays() {
  std::vector<Ray> rays;
  for (int i = -4; i <= 4; ++i) {
    for (int j = -4; j <= 4; ++j) {
      const Point3f target(0.23f * static_cast<float>(i) + 0.013f, 0.23f * static_cast<float>(j) + 0.017f,
                           0.1f);
      for (const Vector3f from : {Vector3f(0, 0, 1), normalize(Vector3f(0.7f, 0.4f, 0.2f)),
                                  normalize(Vector3f(-0.2f, -0.5f, -1))}) {
        rays.push_back({.o = target + 6.0f * from, .d = -from, .tMax = kInfinity, .time = 0.25f});
      }
    }
  }
  return rays;
}

/// Hits, normals, (u, v), emission, and whether shadow rays are blocked.
inline Numbers surfaces(const Attempt& a) {
  const Scene& scene = *a.made->scene;
  Numbers n;
  std::uint64_t queries = 0;
  for (const Ray& ray : probingRays()) {
    n.push_back(scene.occluded(ray, 0, Exclusions{}, queries) ? 1 : 0);
    const auto hit = scene.closest(ray, 0, Exclusions{}, queries);
    n.push_back(hit ? hit->t() : -1);
    if (!hit) continue;
    const SurfaceInteraction si = scene.surface(*hit, ray);
    append(n, si.n);
    append(n, si.shading.n);
    append(n, si.dpdu);
    append(n, si.shading.dpdu);
    n.insert(n.end(), {si.uv.x, si.uv.y, static_cast<double>(si.faceIndex)});
    if (hit->isEmitter()) append(n, hit->areaLight().emitted(si.n, si.wo));
  }
  return n;
}

/// Values of the BSDFs that the rays meet, for one direction: what does not depend on how lobes are sampled.
inline Numbers bsdfValues(const Attempt& a) {
  const Scene& scene = *a.made->scene;
  Numbers n;
  std::uint64_t queries = 0;
  for (const Ray& ray : probingRays()) {
    const auto hit = scene.closest(ray, 0, Exclusions{}, queries);
    if (!hit) continue;
    SurfaceInteraction si = scene.surface(*hit, ray);
    append(n, hit->primitive->material->bsdf(si, TransportMode::Radiance, true)
                  .f(si.wo, Vector3f(0.36f, 0.48f, 0.8f)));
  }
  return n;
}

/// Values and samples of the BSDFs that the rays meet. Footprints are left out except for `footprint`.
inline Numbers materials(const Attempt& a, float footprint = 0) {
  const Scene& scene = *a.made->scene;
  Numbers n;
  std::uint64_t queries = 0;
  for (const Ray& ray : probingRays()) {
    const auto hit = scene.closest(ray, 0, Exclusions{}, queries);
    if (!hit || hit->primitive->material == nullptr) continue;
    SurfaceInteraction si = scene.surface(*hit, ray);
    si.dudx = si.dvdy = footprint;
    si.dvdx = -footprint / 3;
    si.dpdx = footprint * si.dpdu;
    si.dpdy = footprint * si.dpdv;
    const Bsdf bsdf = hit->primitive->material->bsdf(si, TransportMode::Radiance, true);
    n.push_back(static_cast<double>(bsdf.lobeCount()));
    n.push_back(bsdf.eta());
    append(n, bsdf.shadingNormal());
    for (const Vector3f wi :
         {Vector3f(0.36f, 0.48f, 0.8f), Vector3f(-0.6f, 0, 0.8f), Vector3f(0, 0.6f, -0.8f)})
      append(n, bsdf.f(si.wo, wi));
    for (const Point2f u : {Point2f(0.1f, 0.3f), Point2f(0.7f, 0.6f), Point2f(0.95f, 0.2f)}) {
      const BsdfSample s = bsdf.sample(si.wo, u);
      append(n, s.f);
      append(n, s.wi);
      n.push_back(s.pdf);
    }
    if (const auto bssrdf = hit->primitive->material->bssrdf(si)) {
      n.push_back(bssrdf->eta());
      append(n, bssrdf->radial(0.3f));
      append(n, bssrdf->radial(0.02f));
    }
  }
  return n;
}

inline Numbers lights(const Attempt& a) {
  const Scene& scene = *a.made->scene;
  Numbers n;
  for (const Light* light : scene.lights()) {
    n.insert(n.end(), {light->isDelta() ? 1.0 : 0.0, static_cast<double>(light->sampleCount())});
    append(n, light->power());
    for (const Point3f p :
         {Point3f(0, 0, 0.5f), Point3f(0.2f, 0.3f, 2), Point3f(1, -1, -2), Point3f(0, 3, 1)}) {
      for (const Point2f u : {Point2f(0.2f, 0.4f), Point2f(0.9f, 0.7f)}) {
        const LightSample s = light->sample(p, u);
        append(n, s.radiance);
        append(n, s.wi);
        n.push_back(s.pdf);
      }
      append(n, light->background(normalize(Vector3f(p))));
    }
  }
  return n;
}

/// The medium inside the first surface that is met.
inline const Medium* mediumOf(const Attempt& a) {
  std::uint64_t queries = 0;
  for (const Ray& ray : probingRays()) {
    if (const auto hit = a.made->scene->closest(ray, 0, Exclusions{}, queries))
      return hit->primitive->media.inside;
  }
  return nullptr;
}

inline Numbers media(const Attempt& a) {
  const Medium* medium = mediumOf(a);
  if (medium == nullptr) return {};
  Numbers n;
  for (const float z : {0.1f, 0.5f, 0.9f}) {
    Rng rng(7);
    RenderCounters counters;
    const Segment s{Point3f(-3, 0.3f, z), Vector3f(1, 0.05f, 0), 0, 6};
    append(n, medium->transmittance(s, rng, counters));
    const FreeFlight flight = medium->sampleFreeFlight(s, Rgb(1), rng, counters);
    n.push_back(flight.collided ? flight.t : -1);
    append(n, flight.weight);
  }
  n.push_back(medium->phase().evaluate(Vector3f(0, 0, 1), Vector3f(0.6f, 0, 0.8f)));
  n.push_back(static_cast<double>(medium->overlap().mode));
  n.push_back(medium->overlap().priority);
  append(n, medium->bounds().min);
  append(n, medium->bounds().max);
  return n;
}

inline Numbers cameraRays(const Attempt& a) {
  Numbers n;
  for (const Point2f film : {Point2f(0, 0), Point2f(4, 4), Point2f(7, 1)}) {
    for (const float time : {0.0f, 0.3f, 0.9f}) {
      const auto w = a.made->camera->generateRay(film, {0.8f, 0.3f}, time);
      append(n, w.ray.o);
      append(n, w.ray.d);
      n.insert(n.end(), {w.ray.time, w.weight});
    }
  }
  return n;
}

inline Numbers samples(const Attempt& a) {
  Sampler& sampler = *a.made->sampler;
  Numbers n{static_cast<double>(sampler.samplesPerPixel())};
  for (std::int64_t i = 0; i < sampler.samplesPerPixel(); ++i) {
    sampler.start({1, 2}, i);
    const CameraSample camera = sampler.cameraSample({1, 2});
    n.insert(n.end(), {camera.film.x, camera.film.y, camera.lens.x, camera.time});
    for (int d = 0; d < 6; ++d) {
      const Point2f p = sampler.get2D();
      n.insert(n.end(), {p.x, p.y, sampler.get1D()});
    }
  }
  return n;
}

/// Bounds of the film and the image that one lit sample makes among dark ones.
inline Numbers filmResponse(const Attempt& a) {
  Film& film = *a.made->film;
  const Bounds2i pixels = film.pixelBounds(), sampled = film.sampleBounds();
  Numbers n;
  for (const Bounds2i b : {pixels, sampled}) {
    n.insert(n.end(), {static_cast<double>(b.min.x), static_cast<double>(b.min.y),
                       static_cast<double>(b.max.x), static_cast<double>(b.max.y)});
  }
  SamplePass pass(sampled, 1);
  for (int y = sampled.min.y; y < sampled.max.y; ++y) {
    for (int x = sampled.min.x; x < sampled.max.x; ++x) pass.at({x, y}, 0) = {{0.5f, 0.5f}, Rgb(0), true};
  }
  Rgb light(7, 8, 9);
  RenderCounters counters;
  film.admit(light, counters);
  pass.at({pixels.min.x + 1, pixels.min.y + 1}, 0) = {{0.3f, 0.4f}, light, true};
  film.accumulate(pass);
  const Image image = film.develop();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) append(n, image.rgb(x, y));
  }
  return n;
}

inline Numbers rendered(const Attempt& a) {
  RenderOptions loop;
  loop.pixelBounds = a.made->pixelBounds;
  const RenderResult result =
      a.made->integrator->render(*a.made->camera, *a.made->sampler, *a.made->film, loop);
  Numbers n{static_cast<double>(result.samplesTaken)};
  const Image image = a.made->film->develop();
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) append(n, image.rgb(x, y));
  }
  return n;
}

/// One parameter of a plugin: the scene without and with it.
struct Effect {
  std::string without, with;
};

/// Both scenes are built without a word, and do not do the same.
template <class Try, class Measure>
void expectEffects(const std::vector<Effect>& effects, const Try& make, const Measure& measure) {
  for (const Effect& e : effects) {
    const Attempt without = make(e.without), with = make(e.with);
    ASSERT_TRUE(without.isSilent()) << e.without << '\n' << without.messages();
    ASSERT_TRUE(with.isSilent()) << e.with << '\n' << with.messages();
    EXPECT_NE(measure(without), measure(with)) << e.without << "\n  against\n" << e.with;
  }
}
/// Both scenes are built without a word, and do the same.
template <class Try, class Measure>
void expectSame(const std::vector<Effect>& pairs, const Try& make, const Measure& measure) {
  for (const Effect& e : pairs) {
    const Attempt first = make(e.without), second = make(e.with);
    ASSERT_TRUE(first.isSilent()) << e.without << '\n' << first.messages();
    ASSERT_TRUE(second.isSilent()) << e.with << '\n' << second.messages();
    EXPECT_EQ(measure(first), measure(second)) << e.without << "\n  against\n" << e.with;
  }
}

/// Whether a mistake is an error always, or a warning that is one with --strict.
enum class Verdict { Error, Tolerated };
inline constexpr Verdict kTolerated = Verdict::Tolerated;

/// A text and what must be said of it; `place` "" is not looked at.
struct Mistake {
  std::string text, message, place;
  Verdict verdict = Verdict::Error;
};

template <class Try>
void expectMistakes(const std::vector<Mistake>& mistakes, const Try& make) {
  const auto expectSaid = [](const Mistake& m, const Attempt& a, Severity severity) {
    const Diagnostic* found = a.find(severity, m.message);
    EXPECT_EQ(a.made.has_value(), severity == Severity::Warning) << m.text << '\n' << a.messages();
    ASSERT_NE(found, nullptr) << m.text << "\nsays\n" << a.messages() << "\nbut not\n" << m.message;
    if (m.verdict == kTolerated) {
      EXPECT_NE(found->message.find("--strict"), std::string::npos) << found->message;
    }
    if (!m.place.empty()) {
      EXPECT_EQ(found->location.toString(), m.place) << m.text << '\n' << a.messages();
    }
  };
  for (const Mistake& m : mistakes) {
    const bool isTolerated = m.verdict == kTolerated;
    expectSaid(m, make(m.text), isTolerated ? Severity::Warning : Severity::Error);
    if (!isTolerated) continue;
    const StrictAttempts strict;
    expectSaid(m, make(m.text), Severity::Error);
  }
}

}  // namespace pbrtmedia::test
