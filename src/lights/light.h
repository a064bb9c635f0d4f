// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "base/bounds.h"
#include "base/ray.h"
#include "base/vec.h"
#include "lights/illuminant.h"
#include "shapes/surface_interaction.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A direction toward a light from a reference point.
struct LightSample {
  Rgb radiance;  ///< arriving along -wi, before visibility and transmittance
  Vector3f wi;   ///< unit, from the reference point to the light
  float distance =
      kInfinity;  ///< world length of the shadow segment; infinity for distant and infinite lights
  float pdf = 0;  ///< solid angle; 1 for delta lights; 0: no sample
  Normal3f n{};   ///< of hits on the light there, where it is a surface
};

/// Densities of a ray that a light sends out.
struct LePdf {
  float position = 0;   ///< 1/area, on the light or on the disc that faces a scene lit from infinity
  float direction = 0;  ///< 1/solid angle
};

/// A ray that a light sends out: the power it stands for is radiance |normal·d| / (pdf.position
/// pdf.direction).
struct LeSample {
  Ray ray;  ///< world space, unit direction; starts on the light, or outside the scene's bounding sphere
  Normal3f normal;  ///< where it starts: that of hits on a surface, otherwise the ray's direction
  Rgb radiance;  ///< along the ray; intensity (W/sr) of a light at one point, irradiance of a distant light
  LePdf pdf;     ///< 1 where there is no choice (delta lights); a direction of 0: no sample
};

/// A source of light, world space. Immutable after `preprocess`, thread-safe.
class Light : public Illuminant {
 public:
  virtual std::string_view typeName() const = 0;
  /// Position or direction is a single point: no BSDF sample can find it.
  virtual bool isDelta() const = 0;
  /// Answers rays that leave the scene.
  virtual bool isInfinite() const { return false; }
  /// Whether it shines from infinitely far, all around or along one direction.
  bool isAtInfinity() const { return isInfinite() || (isDelta() && !deltaPosition()); }
  /// The one point all its light comes from, if there is one; then radiance falls with 1/r².
  virtual std::optional<Point3f> deltaPosition() const { return std::nullopt; }
  /// Of a light with `deltaPosition`: narrows [tMin, tMax] (tMax may be infinite) to a part of the line
  /// o + t d, world space, beyond which no light of it falls on the line; empty: tMin > tMax.
  virtual void clipToLit(Vec3d o, Vec3d d, double& tMin, double& tMax) const {
    (void)o, (void)d, (void)tMin, (void)tMax;
  }
  /// Light samples find another side of it emitting than rays that hit it do (Shape::isSampledFromBehind).
  /// Then the weights of multiple importance sampling decide what it illuminates: they must be PBRT-v3's,
  /// which leave out the probability of choosing this light.
  virtual bool isSplit() const { return false; }
  /// "samples": how many of this light's samples `directlighting` takes.
  int sampleCount() const { return sampleCount_; }
  /// Called once with the scene's bounds before rendering.
  virtual void preprocess(const Bounds3f& sceneBounds) { (void)sceneBounds; }
  /// Makes the tables that only `sampleLe` and `pdfLe` need. Called once before them, by whoever traces from
  /// lights: other renders neither wait for them nor hold them.
  virtual void prepareEmission() {}

  virtual LightSample sample(Point3f reference, Point2f u) const = 0;
  double arrivingLuminance(Point3f reference, Point2f u) const final {
    const LightSample s = sample(reference, u);
    return s.pdf > 0 ? double{s.radiance.luminance()} / s.pdf : 0;
  }
  /// Solid-angle density of `sample(reference, .)` for unit `wi`. `hit`: the light's own surface point found
  /// along wi (area lights), null for lights at infinity. 0 for delta lights.
  virtual float pdf(Point3f reference, Vector3f wi, const SurfaceInteraction* hit) const = 0;
  /// After `prepareEmission`. A ray from the light into the scene. `uPosition`, `uDirection`: uniform in the
  /// unit square. Found by position and direction together, not toward a point: what `sample` sees of a light
  /// is sent out here, also of a light that is split.
  virtual LeSample sampleLe(Point2f uPosition, Point2f uDirection, float time) const {
    (void)uPosition, (void)uDirection, (void)time;
    return {};
  }
  /// Densities with which `sampleLe` finds a ray that starts at a point of the light where the normal (of
  /// hits) is `normal`, or anywhere outside the scene for lights at infinity. 0 for what is no choice.
  virtual LePdf pdfLe(const Ray& ray, Normal3f normal) const {
    (void)ray, (void)normal;
    return {};
  }
  /// Radiance of a ray that left the scene along unit `direction`; black except for infinite lights.
  virtual Rgb background(Vector3f direction) const {
    (void)direction;
    return {};
  }

 protected:
  explicit Light(int sampleCount = 1) : sampleCount_(sampleCount) {}

 private:
  int sampleCount_;
};

/// A light on a primitive of a shape.
class AreaLight : public Light {
 public:
  using Light::Light;
  /// Radiance leaving a surface point of this light along unit `wo`, as it is seen; the side is judged by
  /// `normal`.
  virtual Rgb emitted(Normal3f normal, Vector3f wo) const = 0;
};

}  // namespace pbrtmedia
