// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

#include "accelerators/accelerator.h"
#include "base/animated_transform.h"
#include "base/segment.h"
#include "shapes/surface_interaction.h"
#include "world/boundary_closure.h"
#include "world/boundary_vicinity.h"
#include "world/primitive.h"

namespace pbrtmedia {

class Illuminant;
class Light;
class Medium;
class MediumLight;
struct PlacedMedium;

/// An object placed in the world. A medium seen through a placement moves along with it.
class Placement {
 public:
  /// `mediaFromObject`: the space in which the object's media were defined, as seen from the object's.
  Placement(std::uint32_t object, const AnimatedTransform& worldFromObject,
            const Transform& mediaFromObject = Transform());
  std::uint32_t object() const { return object_; }
  bool isAnimated() const { return worldFromObject_.isAnimated(); }
  Transform worldFromObject(double time) const { return worldFromObject_.at(time); }
  /// World bounds, over all times, of a box of the object.
  Bounds3f worldBounds(const Bounds3f& object) const;
  Transform mediaFromObject() const { return mediaSpace_ ? mediaSpace_->fromObject : Transform(); }
  Transform mediaFromWorld(double time) const;
  /// The same line in the space in which the object's media were defined; t keeps its meaning as a world
  /// length.
  Segment toObject(const Segment& segmentWorld, float time) const;

 private:
  struct MediaSpace {
    Transform fromObject;
    Transform fromWorld;  ///< at the start time
  };
  std::uint32_t object_;
  AnimatedTransform worldFromObject_;
  std::unique_ptr<const MediaSpace> mediaSpace_;  ///< null: that of the object
};

/// A hit with the things it refers to. The surface point itself is computed on demand (Scene::surface).
struct SceneHit {
  static constexpr std::uint32_t kNoLight = 0xffffffffu;
  RayHit hit;
  const Primitive* primitive = nullptr;
  const Placement* placement = nullptr;  ///< null: placed directly
  /// Through which the medium inside is seen: null if it stays where it was defined.
  const Placement* insidePlacement = nullptr;
  /// The same for the medium outside; also null if the object itself encloses that medium nowhere, as it is
  /// then the medium around the object.
  const Placement* outsidePlacement = nullptr;
  /// Index into Scene::lights() of the light on the primitive that was hit; kNoLight: none, or one that is
  /// visible only (lights inside objects, scene-language reference 5.4).
  std::uint32_t light = kNoLight;

  float t() const { return hit.t; }
  bool isEmitter() const { return !primitive->areaLights.empty(); }
  /// Whether it is the primitive that Scene::hiderOf names.
  bool isHider(std::uint32_t geometry) const { return hit.id.geometry == geometry && !placement; }
  /// Only when isEmitter().
  const AreaLight& areaLight() const { return *primitive->areaLights[hit.id.primitive]; }
};

/// Everything that is rendered: owns it and answers ray queries. Made by SceneBuilder; immutable,
/// thread-safe.
class Scene {
 public:
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;
  ~Scene();

  /// Closest hit with tMin <= t < ray.tMax of what is not excluded. `queries`: a counter, incremented.
  std::optional<SceneHit> closest(const Ray& ray, float tMin, const Exclusions& exclusions,
                                  std::uint64_t& queries) const;
  /// Whether a surface with a material lies in [tMin, ray.tMax); shadowalpha applies. Surfaces without
  /// material do not block. Media are not considered. `queries`: a counter, incremented.
  /// `hider`: hiderOf the light that is looked for.
  bool occluded(const Ray& ray, float tMin, const Exclusions& exclusions, std::uint64_t& queries,
                std::uint32_t hider = PrimitiveId::kNone) const;
  /// World-space surface point of a hit of `ray`, without footprint.
  SurfaceInteraction surface(const SceneHit& hit, const Ray& ray) const;

  /// The lights that illuminate, in order of addition.
  const std::vector<const Light*>& lights() const { return lights_; }
  /// Light::prepareEmission of them all; for who makes an integrator that traces from lights.
  void prepareEmission();
  /// The primitive a light is on, to be left out when its visibility is tested; invalid for other lights.
  PrimitiveId lightTarget(std::size_t light) const {
    return light < lightTargets_.size() ? lightTargets_[light] : PrimitiveId{};
  }
  /// PrimitiveId::geometry of the surface without material that a light is on; kNone for other lights. It
  /// hides what of this light is behind it, and nothing else.
  std::uint32_t hiderOf(std::size_t light) const {
    return light < hiders_.size() ? hiders_[light] : PrimitiveId::kNone;
  }
  /// What light selectors choose from: lights(), followed by the emissive media, which only integrators that
  /// render media take.
  const std::vector<const Illuminant*>& illuminants() const { return illuminants_; }
  /// Number in illuminants() of a medium; nothing when light sampling does not look for it.
  std::optional<std::size_t> lightOf(const PlacedMedium& medium) const;
  /// Number `light` of illuminants(), null when that is no medium.
  const MediumLight* mediumLight(std::size_t light) const;
  /// Some primitive names a medium that emits.
  bool hasEmissiveMedia() const { return hasEmissiveMedia_; }
  /// Those of lights() that answer rays leaving the scene: index into lights().
  const std::vector<std::uint32_t>& infiniteLights() const { return infiniteLights_; }
  /// The media of the scene that SceneBuilder::addMedium was told of. Not const, as bounds may be learned;
  /// nothing else changes.
  const std::vector<Medium*>& media() const;
  /// Those of them whose bounds are learned.
  std::vector<Medium*> learners() const;
  /// Bounds of all surfaces (over all times). Empty for a scene without surfaces.
  const Bounds3f& bounds() const { return bounds_; }
  /// The largest absolute value in `bounds`.
  float largestCoordinate() const { return largestCoordinate_; }
  /// Which boundaries of media close.
  const BoundaryClosure& boundaries() const { return boundaries_; }
  /// Whether a boundary other than the one that was hit may pass through a point (world).
  bool mayTouchBoundary(Point3f p, const SceneHit& own = {}) const {
    return vicinity_.mayHold(p, own.primitive, own.placement);
  }
  /// Some primitive names a medium.
  bool hasMediumBoundaries() const { return hasMediumBoundaries_; }
  bool hasShadowAlpha() const { return hasShadowAlpha_; }
  /// Something can be seen that emits: an area light (also in an object) or an infinite light.
  bool hasVisibleEmitters() const { return hasVisibleEmitters_; }
  /// Primitives in groups: those placed directly, then those of every object.
  std::vector<std::vector<const Primitive*>> primitiveGroups() const;
  /// All placements of objects.
  const std::deque<Placement>& placements() const;

 private:
  friend class SceneBuilder;
  struct Parts;
  explicit Scene(std::unique_ptr<Parts> parts);
  SceneHit resolve(const RayHit& hit) const;

  std::unique_ptr<Parts> parts_;
  std::vector<const Light*> lights_;
  std::vector<const Illuminant*> illuminants_;
  std::vector<PrimitiveId> lightTargets_;
  std::vector<std::uint32_t> hiders_;  ///< up to the last light that has one
  std::vector<std::uint32_t> infiniteLights_;
  Bounds3f bounds_;
  float largestCoordinate_;
  BoundaryClosure boundaries_;
  BoundaryVicinity vicinity_;
  bool hasMediumBoundaries_ = false, hasShadowAlpha_ = false, hasVisibleEmitters_ = false,
       hasEmissiveMedia_ = false;
};

}  // namespace pbrtmedia
