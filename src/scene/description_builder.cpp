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

constexpr Matrix4 kNowhere{{{{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}}}};

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
      transformTimes(s);
  }
}

void DescriptionBuilder::transformTimes(const Statement& s) {
  const double start = s.numbers[0];
  double end = s.numbers[1];
  if (!std::isfinite(start) || !std::isfinite(end))
    throw SceneError(s.at, "TransformTimes: found a time that is not finite");
  if (end < start) {
    diagnostics_.tolerated(
        s.at,
        "TransformTimes: the end lies before the start; as in PBRT-v3 everything jumps from "
        "its start to its end behind the start time");
    end = start;
  }
  scene_.transformStartTime = start;
  scene_.transformEndTime = end;
}

void DescriptionBuilder::applyTransform(const Statement& s) {
  const auto& n = s.numbers;
  const auto given = n.begin() + s.info->numbers;
  if (!std::all_of(n.begin(), given, [](double x) { return std::isfinite(x); }))
    return transformBy(s, Transform(kNowhere));
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
      if (largest > 0) return transformBy(s, Transform::rotate(n[0], Vec3d(n[1], n[2], n[3]) / largest));
      return diagnostics_.tolerated(s.at,
                                    "Rotate: the axis has length 0; nothing is turned, while PBRT-v3 shows "
                                    "nothing of what follows; leave it out, or give an axis");
    }
    case Directive::LookAt:
      return lookAt(s);
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

void DescriptionBuilder::lookAt(const Statement& s) {
  const auto& n = s.numbers;
  const Vec3d eye{n[0], n[1], n[2]}, look{n[3], n[4], n[5]}, up{n[6], n[7], n[8]};
  if (const auto view = Transform::lookAt(eye, look, up)) return transformBy(s, *view);
  if (eye == look || up == Vec3d{}) {
    return diagnostics_.tolerated(
        s.at, std::string("LookAt: ") +
                  (eye == look ? "eye and target coincide" : "the up vector has length 0") +
                  "; it is ignored, while PBRT-v3 shows nothing of what follows");
  }
  diagnostics_.tolerated(s.at, "LookAt: the up vector is parallel to the view; it is ignored, as in PBRT-v3");
}

/// A CTM without inverse is kept, as in PBRT-v3, and what stands under it is not seen. One that is not finite
/// becomes one that maps everything to nowhere.
void DescriptionBuilder::setCtm(const Statement& s, TransformPair next) {
  const char* problem = nullptr;
  for (Transform* t : {&next.start, &next.end}) {
    const bool finite = isFinite(t->matrix()) && isFinite(t->inverseMatrix());
    if (!finite) *t = Transform(kNowhere);
    if (problem == nullptr && t->isSingular()) problem = "the matrix has no inverse";
    if (!finite) problem = "the transformation exceeds the range of numbers";
  }
  const auto given = s.numbers.begin() + s.info->numbers;
  if (!std::all_of(s.numbers.begin(), given, [](double x) { return std::isfinite(x); }))
    problem = "found a number that is not finite";
  const bool wasOutOfSight = isOutOfSight();
  state_.ctm = std::make_shared<const TransformPair>(next);
  if (problem == nullptr || wasOutOfSight) return;
  diagnostics_.tolerated(s.at,
                         std::string(s.info->name) + ": " + problem +
                             "; what stands under it is not seen, as in PBRT-v3 (meshes that it presses "
                             "flat are)");
}

bool DescriptionBuilder::isOutOfSight() const {
  return state_.ctm->start.isSingular() || state_.ctm->end.isSingular();
}

void DescriptionBuilder::coordSysTransform(const Statement& s) {
  const auto it = coordinateSystems_.find(s.strings[0].text);
  if (it != coordinateSystems_.end()) {
    state_.ctm = it->second;
    return;
  }
  diagnostics_.tolerated(s.strings[0].at,
                         "unknown coordinate system " + quotedName(s.strings[0].text) +
                             ": the transformation in force stays, as in PBRT-v3" +
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
  if (openTransforms_.size() >= kMaxOpenBlocks || openAttributes_.size() >= kMaxOpenBlocks) {
    throw SceneError(s.at, "more than " + std::to_string(kMaxOpenBlocks) + " blocks are open");
  }
  openTransforms_.push_back({s.info->id, s.at, state_.ctm, state_.startActive, state_.endActive});
  if (s.info->id != Directive::TransformBegin) openAttributes_.push_back({s.info->id, s.at, state_});
}

/// What is odd about an End of blocks that `opener` begins, given what is open; "" when it is in order.
std::string DescriptionBuilder::misnested(const Statement& s, Directive opener) const {
  const auto block = [](const auto& open) {
    return "the " + std::string(beginOf(open.opener)) + " at " + open.at.toString();
  };
  const std::string name = std::string(s.info->name) + ": ";
  const OpenTransform& transform = openTransforms_.back();
  if (opener == Directive::TransformBegin) {
    if (transform.opener == opener) return {};
    return name + block(transform) + " is still open; expected " + std::string(endOf(transform.opener)) +
           "; as in PBRT-v3 its transformation is restored and nothing else";
  }
  const OpenAttributes& attributes = openAttributes_.back();
  std::string text;
  if (attributes.opener != opener) {
    text = name + block(attributes) + " is still open; expected " + std::string(endOf(attributes.opener)) +
           "; as in PBRT-v3 it is closed by this";
  }
  const bool isSame = transform.opener == attributes.opener && transform.at.line == attributes.at.line &&
                      transform.at.column == attributes.at.column;
  if (!isSame) {
    text = name + block(transform) + " is still open; expected " + std::string(endOf(transform.opener)) +
           "; as in PBRT-v3 the attributes of " + block(attributes) +
           " are restored, but the transformation of this one";
  }
  return text;
}

/// The innermost block ends, whatever began it: PBRT-v3 compares no names.
void DescriptionBuilder::closeBlock(const Statement& s, Directive opener) {
  const bool hasAttributes = opener != Directive::TransformBegin;
  const std::string name(s.info->name);
  const bool noObject = opener == Directive::ObjectBegin && object_ == kNone;
  if (opener == Directive::ObjectBegin) object_ = kNone;
  if (hasAttributes ? openAttributes_.empty() : openTransforms_.empty()) {
    return diagnostics_.tolerated(
        s.at, name + " without " + std::string(beginOf(opener)) + "; it is ignored, as in PBRT-v3");
  }
  if (openTransforms_.empty()) {
    diagnostics_.error(
        s.at, name + ": the transformation of the " + std::string(beginOf(openAttributes_.back().opener)) +
                  " at " + openAttributes_.back().at.toString() +
                  " was restored by a TransformEnd before; what PBRT-v3 does then is not defined");
    openAttributes_.pop_back();
    return;
  }
  if (noObject) {
    diagnostics_.tolerated(s.at, name + " where no object is defined; as in PBRT-v3 it closes the " +
                                     std::string(beginOf(openAttributes_.back().opener)) + " at " +
                                     openAttributes_.back().at.toString());
  } else if (const std::string odd = misnested(s, opener); !odd.empty()) {
    diagnostics_.tolerated(s.at, odd);
  }
  if (hasAttributes) {
    state_ = std::move(openAttributes_.back().saved);
    openAttributes_.pop_back();
  }
  state_.ctm = std::move(openTransforms_.back().ctm);
  state_.startActive = openTransforms_.back().startActive;
  state_.endActive = openTransforms_.back().endActive;
  openTransforms_.pop_back();
}

void DescriptionBuilder::beginObject(const Statement& s) {
  if (object_ != kNone) {
    const ObjectDescription& outer = scene_.objects[static_cast<std::size_t>(object_)];
    diagnostics_.tolerated(s.at, "ObjectBegin inside the definition of object " + quotedName(outer.name) +
                                     " begun at " + outer.location.toString() +
                                     ", which ends here, as in PBRT-v3: nothing that follows belongs to it");
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
    return diagnostics_.tolerated(s.strings[0].at,
                                  "unknown object " + quotedName(name) + ": left out, as in PBRT-v3" +
                                      suggestFrom(name, [&] { return keysOf(objectsByName_); }));
  }
  if (object_ == static_cast<std::int32_t>(it->second)) {
    return diagnostics_.tolerated(
        s.strings[0].at, "object " + quotedName(name) + " would contain itself: left out, as in PBRT-v3");
  }
  if (isOutOfSight()) return;

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
  const auto withoutEnd = [&](const auto& open) {
    diagnostics_.tolerated(open.at, std::string(beginOf(open.opener)) + " without " +
                                        std::string(endOf(open.opener)) + " at WorldEnd");
  };
  std::for_each(openAttributes_.begin(), openAttributes_.end(), withoutEnd);
  for (const OpenTransform& open : openTransforms_) {
    if (open.opener == Directive::TransformBegin) withoutEnd(open);
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
  openAttributes_.clear();
  openTransforms_.clear();
  inWorld_ = false;
  object_ = kNone;
  mediaByName_.clear();
  objectsByName_.clear();
  coordinateSystems_.clear();
  missingMedia_.clear();
  leftOutMedia_.clear();
  notedNesting_ = false;
}

void DescriptionBuilder::finish() {
  const std::string unfinished = "the input ends without the WorldEnd of this WorldBegin";
  if (inWorld_ && finished_.empty()) diagnostics_.error(scene_.worldBegin, unfinished);
  if (inWorld_ && !finished_.empty())
    diagnostics_.tolerated(scene_.worldBegin, unfinished + "; as in PBRT-v3 this world is not rendered");
  if (worlds_ == 0 && !diagnostics_.hasErrors()) {
    diagnostics_.error({}, "nothing to render: the input has no WorldBegin … WorldEnd");
  }
}

}  // namespace pbrtmedia
