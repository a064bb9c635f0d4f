// SPDX-License-Identifier: BSD-2-Clause
#include "scene/description_builder.h"

#include <utility>

namespace pbrtmedia {

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
    case Directive::Define:
    case Directive::Include:
      return;  // of the tokens
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
