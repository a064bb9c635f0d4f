// SPDX-License-Identifier: BSD-2-Clause
#include "construct/world_builder.h"

#include <algorithm>

#include "base/interruption.h"
#include "base/memory.h"
#include "construct/light_messages.h"
#include "construct/plugins.h"

namespace pbrtmedia {
namespace {

/// Objects within objects are placed one by one, about a kilobyte each. So many placements are always
/// allowed, and so many for each ObjectInstance of the scene: memory follows what is written in the file.
constexpr std::uint64_t kFreePlacements = std::uint64_t{1} << 20, kPlacementsPerInstance = 64;
constexpr std::uint64_t kCountless = std::uint64_t{1} << 60;  ///< counts saturate here

/// Descriptions of so many strands or more take memory that is worth giving back, over a kilobyte each.
constexpr std::size_t kManyStrands = 100000;

constexpr std::uint32_t kMaxObjectDepth = 1000;  // objects within objects

std::string contextOf(const ShapeDescription& shape) { return "Shape \"" + shape.type + "\""; }

}  // namespace

WorldBuilder::WorldBuilder(SceneDescription& scene, Textures& textures, Materials& materials,
                           Diagnostics& diagnostics)
    : scene_(scene), textures_(textures), materials_(materials), diagnostics_(diagnostics) {}

void WorldBuilder::read(bool quick) {
  markUsedObjects();
  dropMediaOfCurves();
  markUsedMedia();
  warnOfMediaThatStay();
  for (std::size_t i = 0; i < scene_.media.size(); ++i) {
    Diagnostics messages;
    messages.strict = diagnostics_.strict;
    mediumPlans_.push_back(readMedium(scene_.media[i], mediumUsed_[i], messages, diagnostics_));
    handOver(messages, mediumUsed_[i], "medium");
  }
  for (LightDescription& light : scene_.lights) lights_.push_back(readLight(light, quick, diagnostics_));
  for (Entity& light : scene_.areaLights) areaLights_.push_back(readAreaLight(light, quick, diagnostics_));
  media_.resize(scene_.media.size());
  readShapes();
}

/// What nothing uses is not built, so that what is wrong with it changes no image: its errors are tolerated.
void WorldBuilder::handOver(const Diagnostics& messages, bool isUsed, std::string_view what) {
  for (const Diagnostic& d : messages.all()) {
    if (isUsed || d.severity != Severity::Error || d.message.ends_with("[--strict]")) {
      diagnostics_.add(d.severity, d.location, d.message);
    } else {
      diagnostics_.tolerated(d.location,
                             d.message + "; nothing uses this " + std::string(what) + ", so it is left out");
    }
  }
}

void WorldBuilder::readShapes() {
  for (ShapeDescription& shape : scene_.shapes) {
    leaveIfStopped();
    if (isUsed(shape)) {
      shapes_.push_back(readShape(shape, diagnostics_));
      joinStrands(shapes_.size() - 1);
      continue;
    }
    Diagnostics messages;
    messages.strict = diagnostics_.strict;
    shapes_.push_back(readShape(shape, messages));
    handOver(messages, false, "object");
  }
  if (joinedStrands_ >= kManyStrands) returnFreedMemory();
}

void WorldBuilder::joinStrands(std::size_t index) {
  ShapeRead& read = shapes_[index];
  if (!read.plan || !read.plan->strands || read.material.own) return;
  ShapeDescription& shape = scene_.shapes[index];
  const Curves::Params& strands = *read.plan->strands;
  const auto [first, isFirst] = firstStrands_.try_emplace(
      StrandKey{shape.ctm.get(), shape.media.get(), read.material.material, read.material.isNone,
                shape.object, shape.reverseOrientation, strands.type, strands.splitDepth},
      index);
  if (isFirst) return;
  shapes_[first->second].plan->strands->append(strands);
  read.plan.reset();
  shape.params = {};
  ++joinedStrands_;
}

WorldBuilder::ShapeRead WorldBuilder::readShape(ShapeDescription& shape, Diagnostics& diagnostics) {
  ParamReader in(shape, diagnostics, contextOf(shape));
  ShapeRead read;
  std::optional<ShapePlan> plan = pbrtmedia::readShape(shape, in, diagnostics);
  read.material = materials_.readForShape(shape, in, diagnostics);
  if (plan) in.reportUnused();
  if (plan && plan->make) read.plan = std::move(plan);
  if (!read.plan || !isUsed(shape)) return read;
  if (shape.areaLight != kNone && read.plan->strands) {
    diagnostics.tolerated(shape.location, contextOf(shape) +
                                              ": curves are no area lights: it does not emit; PBRT-v3 ends "
                                              "here. Thin cylinders can emit");
    shape.areaLight = kNone;
  }
  if (shape.areaLight != kNone && shape.ctm->isAnimated()) {
    diagnostics.warning(shape.location,
                        contextOf(shape) + ": area lights on moving shapes are ignored, as in PBRT-v3");
  } else if (shape.areaLight != kNone && shape.object != kNone) {
    diagnostics.warning(
        shape.location,
        contextOf(shape) + ": an area light in an object is seen but lights nothing, as in PBRT-v3");
  }
  return read;
}

/// How much of a curve rays meet from a side is not what a surface with its normals there would have: a
/// ribbon narrows with its inclination to the ray besides the cosine of its normal. The adjoint of hair knows
/// what turns to rays.
void WorldBuilder::warnOfCurves(const SourceLocation& at, const std::string& context) const {
  for (std::size_t i = 0; i < shapes_.size(); ++i) {
    const std::optional<ShapePlan>& plan = shapes_[i].plan;
    const ShapeDescription& shape = scene_.shapes[i];
    if (!plan || !plan->strands || !isUsed(shape) || shapes_[i].material.isNone) continue;
    const bool isHair =
        shape.material != kNone && scene_.materials[static_cast<std::size_t>(shape.material)].type == "hair";
    if (isHair && turnsToRays(plan->strands->type)) continue;
    diagnostics_.warning(
        at,
        context + ": curves have no thickness and face the rays that meet them, as at " +
            shape.location.toString() +
            ", so paths from lights find other surfaces there than paths from the camera: light that curves "
            "scatter may be some percent too bright or too dark, as in PBRT-v3; \"volpath\" renders them");
    return;
  }
}

void WorldBuilder::markUsedMedia() {
  mediumUsed_.assign(scene_.media.size(), false);
  const auto use = [&](const MediumUse& m) {
    if (m.index != kNone) mediumUsed_[static_cast<std::size_t>(m.index)] = true;
  };
  for (const ShapeDescription& shape : scene_.shapes) {
    if (!isUsed(shape)) continue;
    use(shape.media->inside);
    use(shape.media->outside);
  }
  use(scene_.cameraMedium);
}

void WorldBuilder::markUsedObjects() {
  objectUsed_.assign(scene_.objects.size(), false);
  std::vector<std::uint32_t> pending;
  for (const InstanceDescription& instance : scene_.instances) {
    if (instance.parent == kNone) pending.push_back(instance.object);
  }
  while (!pending.empty()) {
    const std::uint32_t object = pending.back();
    pending.pop_back();
    if (objectUsed_[object]) continue;
    objectUsed_[object] = true;
    for (const std::uint32_t inner : scene_.objects[object].instances)
      pending.push_back(scene_.instances[inner].object);
  }
  limitPlacements();
}

void WorldBuilder::limitPlacements() {
  for (const InstanceDescription& instance : scene_.instances) {
    const ObjectDescription& object = scene_.objects[instance.object];
    if (instance.parent != kNone || object.depth <= kMaxObjectDepth) continue;
    diagnostics_.error(instance.location, "ObjectInstance: \"" + object.name + "\" nests objects " +
                                              std::to_string(object.depth) + " deep, expected at most " +
                                              std::to_string(kMaxObjectDepth));
    return;
  }
  const std::uint64_t most = kFreePlacements + kPlacementsPerInstance * scene_.instances.size();
  // An object is complete before it is placed, so those within come first.
  std::vector<std::uint64_t> placed(scene_.objects.size(), 0);
  for (std::size_t i = 0; i < placed.size(); ++i) {
    if (scene_.objects[i].placedShapes == 0) continue;
    placed[i] = 1;
    for (const std::uint32_t shape : scene_.objects[i].shapes) {
      placed[i] += scene_.shapes[shape].ctm->isAnimated() ? 1 : 0;  // each an instance of its own
    }
    for (const std::uint32_t inner : scene_.objects[i].instances) {
      placed[i] = std::min(placed[i] + placed[scene_.instances[inner].object], kCountless);
    }
  }
  std::uint64_t placements = 0;
  for (const InstanceDescription& instance : scene_.instances) {
    if (instance.parent != kNone) continue;
    placements += placed[instance.object];
    if (placements <= most) continue;
    diagnostics_.error(instance.location, "ObjectInstance \"" + scene_.objects[instance.object].name +
                                              "\": nested objects multiply to " + std::to_string(placements) +
                                              (placements >= kCountless ? " or more" : "") +
                                              " placed objects, expected at most " + std::to_string(most) +
                                              " (" + std::to_string(kFreePlacements) + " and " +
                                              std::to_string(kPlacementsPerInstance) +
                                              " for each ObjectInstance of the scene)");
    return;
  }
}

void WorldBuilder::buildMedia(SceneBuilder& builder) {
  for (std::size_t i = 0; i < mediumUsed_.size(); ++i) {
    if (!mediumUsed_[i]) {
      report_.push_back("medium \"" + scene_.media[i].name + "\": not used, left out");
      continue;
    }
    if (!mediumPlans_[i]) continue;  // an unknown type: vacuum, as in PBRT-v3
    usesMedia_ = true;
    if (!withMedia_) continue;
    media_[i] = builder.addMedium((*mediumPlans_[i])(textures_));
    report_.push_back("medium \"" + scene_.media[i].name + "\": " + media_[i]->describe());
  }
}

void WorldBuilder::addAreaLights(const ShapeDescription& shape, Primitive& primitive, SceneBuilder& builder) {
  if (shape.areaLight == kNone || shape.ctm->isAnimated()) return;
  const auto& params = areaLights_[static_cast<std::size_t>(shape.areaLight)];
  if (!params || params->radiance.isBlack()) return;
  if (shape.object == kNone) reportAreaLight(shape, *primitive.shape, *params, diagnostics_);
  const std::uint32_t count = primitive.shape->primitiveCount();
  primitive.areaLights.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    primitive.areaLights.push_back(
        builder.own(std::make_unique<DiffuseAreaLight>(*primitive.shape, i, *params)));
  }
}

std::optional<Primitive> WorldBuilder::buildPrimitive(std::size_t index, SceneBuilder& builder) {
  leaveIfStopped();
  const ShapeDescription& shape = scene_.shapes[index];
  const ShapeRead& read = shapes_[index];
  Primitive primitive;
  std::unique_ptr<Shape> made =
      builtAt(shape.location, contextOf(shape), [&] { return read.plan->make(diagnostics_); });
  if (made == nullptr) return std::nullopt;
  primitive.shape = builder.own(std::move(made));
  primitive.material =
      builtAt(shape.location, contextOf(shape), [&] { return materials_.build(read.material); });
  primitive.media = {mediumOf(shape.media->inside), mediumOf(shape.media->outside),
                     movesWith(shape, shape.media->inside), movesWith(shape, shape.media->outside)};
  primitive.location = shape.location;
  primitive.alpha = textures_.floatTexture(read.plan->alpha);
  primitive.shadowAlpha = textures_.floatTexture(read.plan->shadowAlpha);
  addAreaLights(shape, primitive, builder);
  return primitive;
}

void WorldBuilder::placeShapes(SceneBuilder& builder) {
  for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeDescription& shape = scene_.shapes[i];
    if (shape.object != kNone || !shapes_[i].plan) continue;
    std::optional<Primitive> primitive = buildPrimitive(i, builder);
    if (!primitive || primitive->isInvisible()) continue;
    if (shape.ctm->isAnimated()) {
      builtAt(shape.location, contextOf(shape), [&] {
        place(builder, addMoving(builder, *shape.ctm, *std::move(primitive)), TransformPair{});
      });
    } else {
      builtAt(shape.location, contextOf(shape), [&] { builder.addPrimitive(*std::move(primitive)); });
    }
  }
}

void WorldBuilder::placeObjects(SceneBuilder& builder) {
  objectNumber_.resize(scene_.objects.size());
  movingShapes_.resize(scene_.objects.size());
  std::size_t left = 0;
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    if (!objectUsed_[i]) {
      ++left;
      continue;
    }
    std::vector<Primitive> primitives;
    for (const std::uint32_t shape : scene_.objects[i].shapes) {
      if (!shapes_[shape].plan) continue;
      std::optional<Primitive> primitive = buildPrimitive(shape, builder);
      if (!primitive || primitive->isInvisible()) continue;
      const TransformPair& ctm = *scene_.shapes[shape].ctm;
      if (ctm.isAnimated()) {
        movingShapes_[i].push_back(builtAt(scene_.shapes[shape].location, contextOf(scene_.shapes[shape]),
                                           [&] { return addMoving(builder, ctm, *std::move(primitive)); }));
      } else {
        primitives.push_back(*std::move(primitive));
      }
    }
    objectNumber_[i] = builtAt(scene_.objects[i].location, "ObjectBegin \"" + scene_.objects[i].name + '"',
                               [&] { return builder.addObject(std::move(primitives)); });
  }
  if (left > 0) report_.push_back(std::to_string(left) + " objects are never placed: left out");
  for (InstanceDescription& instance : scene_.instances) {
    if (instance.parent != kNone) continue;
    placeInstance(builder, instance, TransformPair{});
    instance.ctm.reset();  // there may be many, and each is placed once
  }
}

WorldBuilder::MovingShape WorldBuilder::addMoving(SceneBuilder& builder, const TransformPair& ctm,
                                                  Primitive primitive) {
  std::vector<Primitive> alone;
  alone.push_back(std::move(primitive));
  return {builder.addObject(std::move(alone)), ctm};
}

void WorldBuilder::place(SceneBuilder& builder, const MovingShape& shape, const TransformPair& outer) {
  // Its media were defined in the world, where the shape is at the start.
  builder.addInstance(shape.object,
                      AnimatedTransform(outer.start * shape.ctm.start, scene_.transformStartTime,
                                        outer.end * shape.ctm.end, scene_.transformEndTime),
                      shape.ctm.start);
}

void WorldBuilder::placeInstance(SceneBuilder& builder, const InstanceDescription& instance,
                                 const TransformPair& outer) {
  if (scene_.objects[instance.object].placedShapes == 0) return;  // however often it is repeated inside
  const TransformPair place{outer.start * instance.ctm->start, outer.end * instance.ctm->end};
  if (place.start.isSingular() || place.end.isSingular()) {
    diagnostics_.tolerated(
        instance.location,
        "ObjectInstance: the transformation is singular (a scale of 0?), so the object is not "
        "seen, as in PBRT-v3");
    return;
  }
  leaveIfStopped();
  const AnimatedTransform worldFromObject(place.start, scene_.transformStartTime, place.end,
                                          scene_.transformEndTime);
  builtAt(instance.location, "ObjectInstance",
          [&] { builder.addInstance(objectNumber_[instance.object], worldFromObject); });
  builtAt(instance.location, "ObjectInstance", [&] {
    for (const MovingShape& shape : movingShapes_[instance.object]) this->place(builder, shape, place);
  });
  for (const std::uint32_t inner : scene_.objects[instance.object].instances) {
    placeInstance(builder, scene_.instances[inner], place);
  }
}

std::unique_ptr<Scene> WorldBuilder::build(bool withMedia) {
  withMedia_ = withMedia;
  SceneBuilder builder;
  buildMedia(builder);
  placeShapes(builder);
  placeObjects(builder);
  for (const std::optional<LightPlan>& light : lights_) {
    if (light) builder.addLight((*light)());
  }
  describe(textures_);

  Textures::Built built = textures_.takeBuilt();
  for (auto& texture : built.floats) builder.own(std::move(texture));
  for (auto& texture : built.rgbs) builder.own(std::move(texture));
  for (auto& material : materials_.takeBuilt()) builder.own(std::move(material));
  return builder.finish();
}

void WorldBuilder::describe(const Textures& textures) {
  const auto line = [&](const std::string& what, std::size_t built, std::size_t defined) {
    if (defined > 0)
      report_.push_back(what + ": " + std::to_string(built) + " built of " + std::to_string(defined) +
                        " defined");
  };
  line("textures", textures.builtCount(), textures.definedCount());
  line("materials", materials_.builtCount(), materials_.definedCount());
}

}  // namespace pbrtmedia
