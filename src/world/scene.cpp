// SPDX-License-Identifier: BSD-2-Clause
#include "world/scene.h"

#include <algorithm>

#include "shapes/shape.h"
#include "world/scene_parts.h"

namespace pbrtmedia {

Placement::Placement(std::uint32_t object, const AnimatedTransform& worldFromObject,
                     const Transform& mediaFromObject)
    : object_(object), worldFromObject_(worldFromObject) {
  if (mediaFromObject.isIdentity()) return;
  mediaSpace_ = std::make_unique<const MediaSpace>(
      MediaSpace{mediaFromObject, mediaFromObject * worldFromObject.start().inverse()});
}

Bounds3f Placement::worldBounds(const Bounds3f& object) const {
  return object.isEmpty() ? object : worldFromObject_.motionBounds(object);
}

Transform Placement::mediaFromWorld(double time) const {
  if (mediaSpace_ && !isAnimated()) return mediaSpace_->fromWorld;
  const Transform objectFromWorld = worldFromObject_.at(time).inverse();
  return mediaSpace_ ? mediaSpace_->fromObject * objectFromWorld : objectFromWorld;
}

Segment Placement::toObject(const Segment& s, float time) const {
  if (isAnimated()) {
    const Transform m = mediaFromWorld(double{time});
    return {m.point(s.o), m.vector(s.d), s.tMin, s.tMax};
  }
  if (mediaSpace_) {
    const Transform& m = mediaSpace_->fromWorld;
    return {m.point(s.o), m.vector(s.d), s.tMin, s.tMax};
  }
  const Transform& worldFromObject = worldFromObject_.start();
  return {Point3f(worldFromObject.inversePoint(Vec3d(s.o))),
          Vector3f(worldFromObject.inverseVector(Vec3d(s.d))), s.tMin, s.tMax};
}

Scene::Scene(std::unique_ptr<Parts> parts)
    : parts_(std::move(parts)),
      lights_(parts_->lights.begin(), parts_->lights.end()),
      lightTargets_(parts_->lightTargets),
      bounds_(parts_->top.accelerator.bounds()),
      largestCoordinate_(std::max(maxComponent(abs(bounds_.min)), maxComponent(abs(bounds_.max)))),
      boundaries_(primitiveGroups()),
      vicinity_(primitiveGroups(), parts_->placements) {
  for (std::uint32_t i = 0; i < lights_.size(); ++i) {
    if (lights_[i]->isInfinite()) infiniteLights_.push_back(i);
  }
  for (std::size_t i = 0; i < lightTargets_.size(); ++i) {
    const PrimitiveId target = lightTargets_[i];
    if (!target.isValid() || parts_->entries[target.geometry].primitive->primitive.material) continue;
    hiders_.resize(i + 1, PrimitiveId::kNone);
    hiders_[i] = target.geometry;
  }
  illuminants_.assign(lights_.begin(), lights_.end());
  for (std::size_t i = 0; i < parts_->mediumLights.size(); ++i) {
    illuminants_.push_back(&parts_->mediumLights[i]);
  }
  hasVisibleEmitters_ = !infiniteLights_.empty();
  const auto emits = [](const Medium* medium) { return medium && medium->isEmissive(); };
  for (const auto& group : primitiveGroups()) {
    for (const Primitive* p : group) {
      hasMediumBoundaries_ |= !p->media.same();
      hasEmissiveMedia_ |= emits(p->media.inside) || emits(p->media.outside);
      hasShadowAlpha_ |= p->shadowAlpha != nullptr;
      hasVisibleEmitters_ |= !p->areaLights.empty();
    }
  }
}

Scene::~Scene() = default;

void Scene::prepareEmission() {
  for (Light* light : parts_->lights) light->prepareEmission();
}

std::optional<std::size_t> Scene::lightOf(const PlacedMedium& medium) const {
  const std::optional<std::size_t> number = parts_->mediumLights.find(medium);
  if (!number) return std::nullopt;
  return lights_.size() + *number;
}

const MediumLight* Scene::mediumLight(std::size_t light) const {
  return light < lights_.size() ? nullptr : &parts_->mediumLights[light - lights_.size()];
}

const std::vector<Medium*>& Scene::media() const { return parts_->media; }

std::vector<Medium*> Scene::learners() const {
  std::vector<Medium*> learners;
  for (Medium* medium : parts_->media) {
    if (medium->learnedBounds() != nullptr) learners.push_back(medium);
  }
  return learners;
}

const std::deque<Placement>& Scene::placements() const { return parts_->placements; }

SceneHit Scene::resolve(const RayHit& hit) const {
  SceneHit result{.hit = hit};
  const Parts::PlacedPrimitive* placed = nullptr;
  if (hit.id.instance == PrimitiveId::kNone) {
    placed = parts_->entries[hit.id.geometry].primitive;
  } else {
    result.placement = parts_->entries[hit.id.instance].placement;
    placed = &parts_->objects[result.placement->object()].primitives[hit.id.geometry];
    const MediumInterface& media = placed->primitive.media;
    if (media.insideMoves) result.insidePlacement = result.placement;
    if (media.outsideMoves && !placed->outsideIsAmbient) result.outsidePlacement = result.placement;
  }
  result.primitive = &placed->primitive;
  if (placed->firstLight != SceneHit::kNoLight) result.light = placed->firstLight + hit.id.primitive;
  return result;
}

std::optional<SceneHit> Scene::closest(const Ray& ray, float tMin, const Exclusions& exclusions,
                                       std::uint64_t& queries) const {
  ++queries;
  const std::optional<RayHit> hit = parts_->top.accelerator.intersect(ray, tMin, exclusions);
  if (!hit) return std::nullopt;
  return resolve(*hit);
}

bool Scene::occluded(const Ray& ray, float tMin, const Exclusions& exclusions, std::uint64_t& queries,
                     std::uint32_t hider) const {
  ++queries;
  return parts_->top.accelerator.occluded(ray, tMin, exclusions, hider);
}

SurfaceInteraction Scene::surface(const SceneHit& hit, const Ray& ray) const {
  if (!hit.placement) {
    SurfaceInteraction si = hit.primitive->shape->interaction(hit.hit, ray);
    si.primitive = hit.hit.id;
    return si;
  }
  const Transform worldFromObject = hit.placement->worldFromObject(ray.time);
  const Ray rayObject = worldFromObject.inverse().ray(ray);
  SurfaceInteraction si =
      transformInteraction(worldFromObject, hit.primitive->shape->interaction(hit.hit, rayObject));
  si.primitive = hit.hit.id;
  return si;
}

std::vector<std::vector<const Primitive*>> Scene::primitiveGroups() const {
  std::vector<std::vector<const Primitive*>> groups;
  const auto add = [&](const Parts::Group& group) {
    auto& list = groups.emplace_back();
    for (const Parts::PlacedPrimitive& p : group.primitives) list.push_back(&p.primitive);
  };
  add(parts_->top);
  for (const Parts::Group& object : parts_->objects) add(object);
  return groups;
}

}  // namespace pbrtmedia
