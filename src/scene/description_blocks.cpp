// SPDX-License-Identifier: BSD-2-Clause
// The part of DescriptionBuilder that opens and closes blocks: attributes, transformations, objects, worlds.
#include <algorithm>
#include <limits>
#include <utility>

#include "scene/description_builder.h"

namespace pbrtmedia {
namespace {

constexpr std::size_t kMaxOpenBlocks = 1u << 16;  // nesting of real scenes stays below a hundred

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

}  // namespace pbrtmedia
