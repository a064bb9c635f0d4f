// SPDX-License-Identifier: BSD-2-Clause
// What WorldBuilder has to say of media: whether they move, and whether anybody sees them.
#include <algorithm>
#include <array>

#include "construct/world_builder.h"
#include "media/homogeneous.h"

namespace pbrtmedia {
namespace {

/// How the shapes of a scene name a medium.
struct Mentions {
  bool byAny = false;         ///< also on both sides, or in objects that are never placed
  bool byBoundary = false;    ///< some placed shape has it on one side only
  bool isOpen = false;        ///< of those one that can be looked into, or that has it outside
  bool byUnplaced = false;    ///< some shape of an object that is never placed
  SourceLocation boundary{};  ///< of the last opaque shape with it inside
};

std::string interfaceOf(const std::string& medium) { return "MediumInterface \"" + medium + "\" \"\""; }

}  // namespace

/// Media stay where they were defined, as in PBRT-v3, but for those defined in the object that the shape is
/// of; and a shape that moves by itself takes its medium along. One that is the same everywhere and emits
/// goes with the placement: it makes no difference to what it is, and tells where light samples are to look
/// for it.
bool WorldBuilder::movesWith(const ShapeDescription& shape, const MediumUse& use) const {
  const Medium* const medium = mediumOf(use);
  if (!medium || shape.object == kNone) return true;
  if (scene_.media[static_cast<std::size_t>(use.index)].object == shape.object) return true;
  return medium->typeName() == HomogeneousMedium::kTypeName && medium->isEmissive();
}

/// A medium under a moving transformation goes along with shapes that move, and with nothing else.
void WorldBuilder::warnOfMediaThatStay() {
  std::vector<bool> told(scene_.media.size(), false);
  for (const ShapeDescription& shape : scene_.shapes) {
    if (!isUsed(shape) || shape.media->inside.index == shape.media->outside.index) continue;
    for (const MediumUse* use : {&shape.media->inside, &shape.media->outside}) {
      if (use->index == kNone) continue;
      const auto index = static_cast<std::size_t>(use->index);
      const MediumDescription& medium = scene_.media[index];
      const bool isTaken =
          shape.ctm->isAnimated() && (shape.object == kNone || shape.object == medium.object);
      if (told[index] || isTaken || !medium.ctm->isAnimated() || medium.type == HomogeneousMedium::kTypeName)
        continue;
      told[index] = true;
      diagnostics_.warning(medium.location,
                           "medium \"" + medium.name +
                               "\": media do not move by themselves; the transformation of the "
                               "start time is used, as the shape at " +
                               shape.location.toString() + " does not take it along");
    }
  }
}

void WorldBuilder::dropMediaOfCurves() {
  const ShapeDescription* first = nullptr;
  std::size_t count = 0;
  const auto none = std::make_shared<const MediumPair>();
  for (ShapeDescription& shape : scene_.shapes) {
    if (shape.type != "curve" || shape.media->inside.index == shape.media->outside.index) continue;
    if (isUsed(shape) && ++count == 1) first = &shape;
    shape.media = none;
  }
  if (first == nullptr) return;
  diagnostics_.tolerated(
      first->location,
      "Shape \"curve\": curves have no inside, so they bound no media: MediumInterface is left out for " +
          std::to_string(count) + (count == 1 ? " curve" : " curves") +
          "; PBRT-v3 changes media at each hit. The same name twice says what is around them");
}

/// Whether nobody looks through the shape, whatever its textures are.
bool WorldBuilder::isOpaque(const ShapeDescription& shape) const {
  if (shape.material == kNone) return true;  // the default matte
  constexpr std::array<std::string_view, 5> kOpaque = {"matte", "mirror", "metal", "plastic", "substrate"};
  const std::string& type = scene_.materials[static_cast<std::size_t>(shape.material)].type;
  return std::find(kOpaque.begin(), kOpaque.end(), type) != kOpaque.end();
}

void WorldBuilder::warnOfUnseenMedia(const CameraMedium& camera, const std::vector<const Medium*>& unreached,
                                     Diagnostics& diagnostics) const {
  std::vector<Mentions> mentions(scene_.media.size());
  for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
    const ShapeDescription& shape = scene_.shapes[i];
    for (const MediumUse* use : {&shape.media->inside, &shape.media->outside}) {
      if (use->index == kNone) continue;
      Mentions& m = mentions[static_cast<std::size_t>(use->index)];
      m.byAny = true;
      if (!isUsed(shape)) m.byUnplaced = true;
      if (!isUsed(shape) || shape.media->inside.index == shape.media->outside.index) continue;
      m.byBoundary = true;
      const bool hasHoles = shapes_[i].plan && shapes_[i].plan->alpha;
      if (use == &shape.media->outside || hasHoles || !isOpaque(shape)) {
        m.isOpen = true;
      } else {
        m.boundary = shape.location;
      }
    }
  }
  const auto isCamera = [&](std::size_t index) {
    for (std::size_t i = 0; i < camera.state().activeCount(); ++i) {
      if (camera.state().active(i).medium == media_[index]) return true;
    }
    return scene_.cameraMedium.index == static_cast<std::int32_t>(index);
  };
  for (std::size_t i = 0; i < mentions.size(); ++i) {
    const Mentions& m = mentions[i];
    if (m.byUnplaced || isCamera(i)) continue;
    const std::string& name = scene_.media[i].name;
    const std::string medium = "medium \"" + name + "\": ";
    const SourceLocation& at = scene_.media[i].location;
    if (!m.byAny) {
      diagnostics.warning(at, medium + "no shape has it, so it is not seen; " + interfaceOf(name) +
                                  " before a shape of Material \"none\" puts it there");
    } else if (!m.byBoundary) {
      diagnostics.warning(
          at, medium +
                  "every shape that names it has it on both sides, which changes nothing, so it is "
                  "not seen; " +
                  interfaceOf(name) + " has it inside only");
    } else if (!m.isOpen) {
      diagnostics.warning(m.boundary,
                          medium +
                              "it is inside of surfaces that let no light through, so it is not seen; "
                              "Material \"none\" lets all light through");
    } else if (std::find(unreached.begin(), unreached.end(), media_[i]) != unreached.end()) {
      diagnostics.warning(
          at, medium +
                  "its densities lie outside of all shapes that have it inside, so it is not seen; a "
                  "medium stays where MakeNamedMedium stands, but one between ObjectBegin and "
                  "ObjectEnd moves with the object");
    }
  }
}

}  // namespace pbrtmedia
