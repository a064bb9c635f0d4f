// SPDX-License-Identifier: BSD-2-Clause
#include "scene/description_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace pbrtmedia {
namespace {

constexpr std::size_t kMaxOpenBlocks = 1u << 16;  // nesting of real scenes stays below a hundred

template <class Map>
std::vector<std::string> keysOf(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& entry : map) keys.push_back(entry.first);
  std::sort(keys.begin(), keys.end());
  return keys;
}

bool isFinite(const Matrix4& m) {
  return std::all_of(m.m.begin(), m.m.end(), [](const auto& row) {
    return std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); });
  });
}

/// PBRT-v3 writes matrices column by column.
Matrix4 columnMajor(const std::array<double, 16>& n) {
  Matrix4 m;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) m.m[row][column] = n[4 * column + row];
  }
  return m;
}

std::uint64_t saturatingAdd(std::uint64_t a, std::uint64_t b) {
  return a > std::numeric_limits<std::uint64_t>::max() - b ? std::numeric_limits<std::uint64_t>::max()
                                                           : a + b;
}

std::string_view endOf(Directive opener) {
  return opener == Directive::AttributeBegin
             ? "AttributeEnd"
             : (opener == Directive::TransformBegin ? "TransformEnd" : "ObjectEnd");
}
std::string_view beginOf(Directive opener) {
  return opener == Directive::AttributeBegin
             ? "AttributeBegin"
             : (opener == Directive::TransformBegin ? "TransformBegin" : "ObjectBegin");
}

}  // namespace

void DescriptionBuilder::apply(Statement s) {
  if (s.info->block == Block::World && !inWorld_) {
    return diagnostics_.tolerated(
        s.at,
        std::string(s.info->name) + " belongs between WorldBegin and WorldEnd; PBRT-v3 ignores it here");
  }
  if (s.info->block == Block::Options && inWorld_) {
    return diagnostics_.tolerated(
        s.at, std::string(s.info->name) + " belongs before WorldBegin; PBRT-v3 ignores it here");
  }
  switch (s.info->id) {
    case Directive::PixelFilter:
    case Directive::Film:
    case Directive::Sampler:
    case Directive::Accelerator:
    case Directive::Integrator:
    case Directive::Camera:
    case Directive::TransformTimes:
      return applyOption(s);
    case Directive::Identity:
    case Directive::Translate:
    case Directive::Scale:
    case Directive::Rotate:
    case Directive::LookAt:
    case Directive::Transform:
    case Directive::ConcatTransform:
    case Directive::CoordinateSystem:
    case Directive::CoordSysTransform:
    case Directive::ActiveTransform:
      return applyTransform(s);
    case Directive::AttributeBegin:
    case Directive::AttributeEnd:
    case Directive::TransformBegin:
    case Directive::TransformEnd:
    case Directive::ObjectBegin:
    case Directive::ObjectEnd:
    case Directive::ObjectInstance:
    case Directive::WorldBegin:
    case Directive::WorldEnd:
      return applyBlock(s);
    case Directive::Include:
      return;
    default:
      return applyDefinition(s);
  }
}

void DescriptionBuilder::applyOption(Statement& s) {
  switch (s.info->id) {
    case Directive::PixelFilter:
      return s.moveInto(scene_.filter);
    case Directive::Film:
      return s.moveInto(scene_.film);
    case Directive::Sampler:
      return s.moveInto(scene_.sampler);
    case Directive::Accelerator:
      return s.moveInto(scene_.accelerator);
    case Directive::Integrator:
      return s.moveInto(scene_.integrator);
    case Directive::Camera:
      return camera(s);
    default:
      if (s.numbers[1] < s.numbers[0])
        throw SceneError(s.at, "TransformTimes: the end lies before the start");
      scene_.transformStartTime = s.numbers[0];
      scene_.transformEndTime = s.numbers[1];
  }
}

void DescriptionBuilder::applyTransform(const Statement& s) {
  const auto& n = s.numbers;
  switch (s.info->id) {
    case Directive::Identity: {
      TransformPair next = *state_.ctm;
      if (state_.startActive) next.start = {};
      if (state_.endActive) next.end = {};
      return setCtm(s, next);
    }
    case Directive::Translate:
      return transformBy(s, Transform::translate({n[0], n[1], n[2]}));
    case Directive::Scale:
      return transformBy(s, Transform::scale(n[0], n[1], n[2]));
    case Directive::Rotate: {
      const double largest = std::max({std::abs(n[1]), std::abs(n[2]), std::abs(n[3])});
      if (!(largest > 0)) throw SceneError(s.at, "Rotate: the axis has length 0");
      return transformBy(s, Transform::rotate(n[0], Vec3d(n[1], n[2], n[3]) / largest));
    }
    case Directive::LookAt: {
      const auto view = Transform::lookAt({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, {n[6], n[7], n[8]});
      if (!view) {
        throw SceneError(s.at, "LookAt: eye and target coincide, or the up vector is parallel to the view");
      }
      return transformBy(s, *view);
    }
    case Directive::ConcatTransform:
      return transformBy(s, Transform(columnMajor(n)));
    case Directive::Transform: {
      const Transform t(columnMajor(n));
      TransformPair next = *state_.ctm;
      if (state_.startActive) next.start = t;
      if (state_.endActive) next.end = t;
      return setCtm(s, next);
    }
    case Directive::CoordinateSystem:
      coordinateSystems_[s.strings[0].text] = state_.ctm;
      return;
    case Directive::CoordSysTransform:
      return coordSysTransform(s);
    default:
      return activeTransform(s);
  }
}

void DescriptionBuilder::transformBy(const Statement& s, const Transform& t) {
  TransformPair next = *state_.ctm;
  if (state_.startActive) next.start = next.start * t;
  if (state_.endActive) next.end = next.end * t;
  setCtm(s, next);
}

void DescriptionBuilder::setCtm(const Statement& s, TransformPair next) {
  for (const Transform* t : {&next.start, &next.end}) {
    if (t->isSingular()) throw SceneError(s.at, std::string(s.info->name) + ": the matrix has no inverse");
    if (!isFinite(t->matrix()) || !isFinite(t->inverseMatrix())) {
      throw SceneError(s.at, std::string(s.info->name) + ": the transformation exceeds the range of numbers");
    }
  }
  state_.ctm = std::make_shared<const TransformPair>(next);
}

void DescriptionBuilder::coordSysTransform(const Statement& s) {
  const auto it = coordinateSystems_.find(s.strings[0].text);
  if (it != coordinateSystems_.end()) {
    state_.ctm = it->second;
    return;
  }
  diagnostics_.tolerated(s.strings[0].at,
                            "unknown coordinate system " + quotedName(s.strings[0].text) +
                                suggestFrom(s.strings[0].text, [&] { return keysOf(coordinateSystems_); }));
}

void DescriptionBuilder::activeTransform(const Statement& s) {
  const bool all = s.word == "All";
  if (!all && s.word != "StartTime" && s.word != "EndTime") {
    const std::array<std::string_view, 3> known{"All", "StartTime", "EndTime"};
    throw SceneError(s.wordAt,
                     "ActiveTransform: unknown selection " + shown(s.word) + suggestion(s.word, known));
  }
  state_.startActive = all || s.word == "StartTime";
  state_.endActive = all || s.word == "EndTime";
}

void DescriptionBuilder::applyBlock(const Statement& s) {
  switch (s.info->id) {
    case Directive::AttributeBegin:
    case Directive::TransformBegin:
      return openBlock(s);
    case Directive::ObjectBegin:
      return beginObject(s);
    case Directive::AttributeEnd:
      return closeBlock(s, Directive::AttributeBegin);
    case Directive::TransformEnd:
      return closeBlock(s, Directive::TransformBegin);
    case Directive::ObjectEnd:
      return closeBlock(s, Directive::ObjectBegin);
    case Directive::ObjectInstance:
      return placeObject(s);
    case Directive::WorldBegin:
      return beginWorld(s);
    default:
      return endWorld(s);
  }
}

void DescriptionBuilder::openBlock(const Statement& s) {
  if (blocks_.size() >= kMaxOpenBlocks) {
    throw SceneError(s.at, "more than " + std::to_string(kMaxOpenBlocks) + " blocks are open");
  }
  blocks_.push_back({s.info->id, s.at, state_, object_});
}

void DescriptionBuilder::restore(const OpenBlock& block) {
  if (block.opener == Directive::TransformBegin) {
    state_.ctm = block.saved.ctm;
    state_.startActive = block.saved.startActive;
    state_.endActive = block.saved.endActive;
  } else {
    state_ = block.saved;
    object_ = block.object;
  }
}

void DescriptionBuilder::closeBlock(const Statement& s, Directive opener) {
  const auto match =
      std::find_if(blocks_.rbegin(), blocks_.rend(), [&](const auto& b) { return b.opener == opener; });
  if (match != blocks_.rbegin()) {  // also when no block is open: then rbegin() == rend() == match
    const OpenBlock& open = blocks_.back();
    diagnostics_.error(s.at, std::string(s.info->name) + ": the " + std::string(beginOf(open.opener)) +
                                 " at " + open.at.toString() + " is still open; expected " +
                                 std::string(endOf(open.opener)));
  } else if (blocks_.empty()) {
    throw SceneError(s.at, std::string(s.info->name) + " without " + std::string(beginOf(opener)));
  }
  if (match == blocks_.rend()) return;
  const std::size_t left = static_cast<std::size_t>(blocks_.rend() - match) - 1;
  while (blocks_.size() > left) {
    restore(blocks_.back());
    blocks_.pop_back();
  }
}

void DescriptionBuilder::beginObject(const Statement& s) {
  if (object_ != kNone) {
    const ObjectDescription& outer = scene_.objects[static_cast<std::size_t>(object_)];
    diagnostics_.error(s.at, "ObjectBegin inside the definition of object " + quotedName(outer.name) +
                                 " begun at " + outer.location.toString());
  }
  const std::string& name = s.strings[0].text;
  if (const auto it = objectsByName_.find(name); it != objectsByName_.end()) {
    diagnostics_.warning(s.strings[0].at, "object " + quotedName(name) + " was defined before at " +
                                              scene_.objects[it->second].location.toString() +
                                              "; later instances use this definition");
  }
  openBlock(s);
  const auto index = static_cast<std::uint32_t>(scene_.objects.size());
  objectsByName_[name] = index;
  object_ = static_cast<std::int32_t>(index);
  ObjectDescription object;
  object.name = name;
  object.location = s.at;
  scene_.objects.push_back(std::move(object));
}

void DescriptionBuilder::placeObject(const Statement& s) {
  const std::string& name = s.strings[0].text;
  const auto it = objectsByName_.find(name);
  if (it == objectsByName_.end()) {
    throw SceneError(s.strings[0].at, "unknown object " + quotedName(name) +
                                          suggestFrom(name, [&] { return keysOf(objectsByName_); }));
  }
  const auto index = static_cast<std::int32_t>(it->second);
  const bool isOpen =
      object_ == index || std::any_of(blocks_.begin(), blocks_.end(), [&](const OpenBlock& b) {
        return b.opener == Directive::ObjectBegin && b.object == index;
      });
  if (isOpen) throw SceneError(s.strings[0].at, "object " + quotedName(name) + " would contain itself");

  InstanceDescription instance;
  instance.object = it->second;
  instance.parent = object_;
  instance.ctm = state_.ctm;
  instance.location = s.at;
  if (object_ != kNone) {
    if (!std::exchange(notedNesting_, true)) {
      diagnostics_.note(s.at, "an instance inside an object is an extension; PBRT-v3 refuses it");
    }
    ObjectDescription& outer = scene_.objects[static_cast<std::size_t>(object_)];
    const ObjectDescription& inner = scene_.objects[it->second];
    outer.instances.push_back(static_cast<std::uint32_t>(scene_.instances.size()));
    outer.depth = std::max(outer.depth, inner.depth + 1);
    outer.placedShapes = saturatingAdd(outer.placedShapes, inner.placedShapes);
  }
  scene_.instances.push_back(std::move(instance));
}

void DescriptionBuilder::beginWorld(const Statement& s) {
  inWorld_ = true;
  ++worlds_;
  scene_.worldBegin = s.at;
  state_.ctm = std::make_shared<const TransformPair>();
  state_.startActive = state_.endActive = true;
  coordinateSystems_["world"] = state_.ctm;
}

void DescriptionBuilder::endWorld(const Statement& s) {
  for (const OpenBlock& block : blocks_) {
    diagnostics_.warning(block.at, std::string(beginOf(block.opener)) + " without " +
                                       std::string(endOf(block.opener)) + " at WorldEnd");
  }
  // Open blocks are dropped without restoring, so their medium is the camera's: as PBRT-v3 does.
  scene_.cameraMedium = mediaHere(s.at)->outside;
  reportMissingMedia();
  scene_.worldEnd = s.at;
  finished_.push_back(std::move(scene_));
  reset();
}

void DescriptionBuilder::reset() {
  scene_ = {};
  scene_.camera.worldFromCamera = std::make_shared<const TransformPair>();
  state_ = {};
  blocks_.clear();
  inWorld_ = false;
  object_ = kNone;
  mediaByName_.clear();
  objectsByName_.clear();
  coordinateSystems_.clear();
  missingMedia_.clear();
  notedNesting_ = false;
}

void DescriptionBuilder::finish() {
  if (inWorld_)
    diagnostics_.error(scene_.worldBegin, "the input ends without the WorldEnd of this WorldBegin");
  if (worlds_ == 0 && !diagnostics_.hasErrors()) {
    diagnostics_.error({}, "nothing to render: the input has no WorldBegin … WorldEnd");
  }
}

}  // namespace pbrtmedia
