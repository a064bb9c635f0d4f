// SPDX-License-Identifier: BSD-2-Clause
#include "world/scene_builder.h"

#include <glog/logging.h>

#include <algorithm>
#include <unordered_set>

#include "shapes/shape.h"
#include "world/scene_parts.h"

namespace pbrtmedia {

std::uint32_t Scene::Parts::Group::add(Primitive primitive) {
  CHECK(primitive.shape != nullptr);
  CHECK(primitive.areaLights.empty() || primitive.areaLights.size() == primitive.shape->primitiveCount())
      << "one light for each primitive of the shape";
  PlacedPrimitive& placed = primitives.emplace_back(PlacedPrimitive{std::move(primitive)});
  const HitFilter* filter = nullptr;
  if (AlphaFilter::isNeeded(placed.primitive)) filter = &filters.emplace_back(placed.primitive);
  const Shape::Geometry geometry = placed.primitive.shape->geometry();
  if (const auto* triangles = std::get_if<TriangleBuffers>(&geometry)) {
    return accelerator.addTriangles(*triangles, filter);
  }
  return accelerator.addUser(*std::get<const UserGeometry*>(geometry), filter);
}

void Scene::Parts::Group::findAmbientMedia() {
  std::unordered_set<const Medium*> enclosed;
  for (const PlacedPrimitive& p : primitives) {
    if (!p.primitive.media.same()) enclosed.insert(p.primitive.media.inside);
  }
  for (PlacedPrimitive& p : primitives) p.outsideIsAmbient = enclosed.count(p.primitive.media.outside) == 0;
}

/// One light for each medium that stays where it was defined, whichever boundaries show it, and for the
/// others one for each placement.
void Scene::Parts::addMediumLights() {
  std::vector<MediumEmitter> inWorld = top.mediumEmitters(/*inObject=*/false);
  const auto show = [&](const MediumEmitter& emitter, const Bounds3f& boundary) {
    auto known = std::find_if(inWorld.begin(), inWorld.end(),
                              [&](const MediumEmitter& e) { return e.medium == emitter.medium; });
    if (known == inWorld.end()) known = inWorld.insert(known, MediumEmitter{emitter.medium, {}, false});
    known->boundary.expand(boundary);
  };
  std::vector<std::vector<MediumEmitter>> moving(objects.size()), staying(objects.size());
  for (std::size_t i = 0; i < objects.size(); ++i) {
    for (const MediumEmitter& e : objects[i].mediumEmitters(/*inObject=*/true)) {
      (e.moves ? moving : staying)[i].push_back(e);
    }
  }
  for (const Placement& p : placements) {
    for (const MediumEmitter& e : staying[p.object()]) show(e, p.worldBounds(e.boundary));
  }
  mediumLights.add(inWorld, nullptr);
  for (const Placement& p : placements) mediumLights.add(moving[p.object()], &p);
}

std::vector<MediumEmitter> Scene::Parts::Group::mediumEmitters(bool inObject) const {
  std::vector<const Primitive*> placed;
  for (const PlacedPrimitive& p : primitives) placed.push_back(&p.primitive);
  return mediumEmittersOf(placed, inObject);
}

SceneBuilder::SceneBuilder() : parts_(std::make_unique<Scene::Parts>()) {}
SceneBuilder::~SceneBuilder() = default;

void SceneBuilder::keep(Owned object) { parts_->owned.push_back(std::move(object)); }

Medium* SceneBuilder::addMedium(std::unique_ptr<Medium> medium) {
  parts_->media.push_back(own(std::move(medium)));
  return parts_->media.back();
}

void SceneBuilder::addPrimitive(Primitive primitive) {
  const std::uint32_t geometry = parts_->top.add(std::move(primitive));
  CHECK_EQ(geometry, parts_->entries.size());
  Scene::Parts::PlacedPrimitive& placed = parts_->top.primitives.back();
  parts_->entries.push_back({&placed, nullptr});
  if (placed.primitive.areaLights.empty()) return;
  placed.firstLight = static_cast<std::uint32_t>(parts_->lights.size());
  for (std::size_t i = 0; i < placed.primitive.areaLights.size(); ++i) {
    parts_->lights.push_back(placed.primitive.areaLights[i]);
    parts_->lightTargets.push_back({PrimitiveId::kNone, geometry, static_cast<std::uint32_t>(i)});
  }
}

std::uint32_t SceneBuilder::addObject(std::vector<Primitive> primitives) {
  Scene::Parts::Group& object = parts_->objects.emplace_back();
  for (Primitive& p : primitives) object.add(std::move(p));
  object.findAmbientMedia();
  object.accelerator.build();
  return static_cast<std::uint32_t>(parts_->objects.size() - 1);
}

void SceneBuilder::addInstance(std::uint32_t object, const AnimatedTransform& worldFromObject,
                               const Transform& mediaFromObject) {
  CHECK_LT(object, parts_->objects.size());
  const Scene::Parts::Group& group = parts_->objects[object];
  if (group.primitives.empty()) return;
  const std::uint32_t number = parts_->top.accelerator.addInstance(group.accelerator, worldFromObject);
  CHECK_EQ(number, parts_->entries.size());
  parts_->placements.emplace_back(object, worldFromObject, mediaFromObject);
  parts_->entries.push_back({nullptr, &parts_->placements.back()});
}

void SceneBuilder::addLight(std::unique_ptr<Light> light) {
  parts_->lights.push_back(light.get());
  parts_->lightTargets.emplace_back();
  parts_->freeLights.push_back(std::move(light));
}

std::unique_ptr<Scene> SceneBuilder::finish() {
  CHECK(parts_ != nullptr) << "finish() was called before";
  parts_->top.accelerator.build();
  const Bounds3f bounds = parts_->top.accelerator.bounds();
  for (Light* light : parts_->lights) light->preprocess(bounds);
  parts_->addMediumLights();
  return std::unique_ptr<Scene>(new Scene(std::move(parts_)));
}

}  // namespace pbrtmedia
