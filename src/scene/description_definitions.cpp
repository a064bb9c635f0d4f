// SPDX-License-Identifier: BSD-2-Clause
// The part of DescriptionBuilder that makes media, textures, materials, lights, shapes and the camera.
#include <algorithm>
#include <array>
#include <utility>

#include "scene/description_builder.h"

namespace pbrtmedia {

void DescriptionBuilder::applyDefinition(Statement& s) {
  switch (s.info->id) {
    case Directive::MakeNamedMedium:
      return makeMedium(s);
    case Directive::MediumInterface:
      return mediumInterface(s);
    case Directive::Texture:
      return texture(s);
    case Directive::Material:
      return material(s, false);
    case Directive::MakeNamedMaterial:
      return material(s, true);
    case Directive::NamedMaterial:
      return namedMaterial(s);
    case Directive::LightSource:
      return light(s);
    case Directive::AreaLightSource:
      return areaLight(s);
    case Directive::ReverseOrientation:
      state_.reverseOrientation = !state_.reverseOrientation;
      return;
    default:
      return shape(s);
  }
}

void DescriptionBuilder::camera(Statement& s) {
  const TransformPair toWorld{state_.ctm->start.inverse(), state_.ctm->end.inverse()};
  s.moveInto(scene_.camera);
  scene_.camera.worldFromCamera = std::make_shared<const TransformPair>(toWorld);
  coordinateSystems_["camera"] = scene_.camera.worldFromCamera;
}

void DescriptionBuilder::warnIfAnimated(const Statement& s) {
  if (!state_.ctm->isAnimated()) return;
  diagnostics_.warning(s.at,
                       std::string(s.info->name) + " does not move; the transformation at the start is used");
}

/// MakeNamedX: the type is a parameter.
bool DescriptionBuilder::typeFromParameter(Statement& s, Entity& entity) {
  const std::string name = s.strings[0].text;
  s.moveInto(entity);
  const Param* const type = std::as_const(entity.params).find(ParamKind::String, "type");
  if (!type || type->size() != 1) {
    const std::vector<Param>& all = entity.params.all();
    const auto other = std::find_if(all.begin(), all.end(), [](const Param& p) { return p.name == "type"; });
    const SourceLocation& at = other != all.end() ? other->valuesAt : s.strings[0].at;
    const std::string effect = s.info->id == Directive::MakeNamedMedium
                                   ? "; it is left out, as in PBRT-v3: vacuum takes its place"
                                   : "; as in PBRT-v3 it is the material \"none\": what has it is not seen";
    diagnostics_.tolerated(
        at, std::string(s.info->name) + ' ' + quotedName(name) + ": expected one \"string type\"" + effect);
    return false;
  }
  type->used = true;
  entity.type = std::get<std::vector<std::string>>(type->values)[0];
  entity.typeLocation = type->valuesAt;
  return true;
}

void DescriptionBuilder::makeMedium(Statement& s) {
  MediumDescription medium;
  medium.name = s.strings[0].text;
  const SourceLocation nameAt = s.strings[0].at;
  if (medium.name.empty()) {
    return diagnostics_.tolerated(
        nameAt, "MakeNamedMedium: the name \"\" means vacuum; it is left out, as in PBRT-v3");
  }
  if (!typeFromParameter(s, medium)) {
    leftOutMedia_.insert(medium.name);
    return;
  }
  medium.ctm = state_.ctm;
  medium.object = object_;
  if (medium.ctm->start.isSingular()) {
    if (medium.type != "homogeneous") {
      leftOutMedia_.insert(medium.name);
      return;
    }
    medium.ctm = std::make_shared<const TransformPair>();  // has no effect on it
  }
  medium.scope = state_.scope;
  const auto index = static_cast<std::uint32_t>(scene_.media.size());
  if (const auto [it, isNew] = mediaByName_.try_emplace(medium.name, index); !isNew) {
    diagnostics_.warning(nameAt, "medium " + quotedName(medium.name) + " was defined before at " +
                                     scene_.media[it->second].location.toString() +
                                     "; later uses take this definition");
    it->second = index;
  }
  scene_.media.push_back(std::move(medium));
}

void DescriptionBuilder::mediumInterface(const Statement& s) {
  MediumPair pair;
  const Statement::Text& inside = s.strings.front();
  const Statement::Text& outside = s.strings.back();  // one name stands for both sides
  pair.inside = {inside.text, inside.at, kNone};
  pair.outside = {outside.text, outside.at, kNone};
  state_.media = std::make_shared<const MediumPair>(std::move(pair));
  state_.mediaSeen = 0;
}

/// The media in force for something built now: names are looked up at their use, not at MediumInterface.
const SharedMedia& DescriptionBuilder::mediaHere(const SourceLocation& user) {
  if (state_.mediaSeen == scene_.media.size() + 1) return state_.media;
  MediumPair pair = *state_.media;
  lookUp(pair.inside, user);
  lookUp(pair.outside, user);
  if (pair.inside.index != state_.media->inside.index || pair.outside.index != state_.media->outside.index) {
    state_.media = std::make_shared<const MediumPair>(std::move(pair));
  }
  state_.mediaSeen = scene_.media.size() + 1;
  return state_.media;
}

void DescriptionBuilder::lookUp(MediumUse& use, const SourceLocation& user) {
  use.index = kNone;
  if (use.name.empty()) return;
  if (const auto it = mediaByName_.find(use.name); it != mediaByName_.end()) {
    use.index = static_cast<std::int32_t>(it->second);
  } else if (leftOutMedia_.count(use.name) == 0) {
    missingMedia_.try_emplace(use.name, Missing{use.location, user});
  }
}

void DescriptionBuilder::reportMissingMedia() {
  const auto names = [&] {
    std::vector<std::string> all;
    for (const auto& medium : scene_.media) all.push_back(medium.name);
    return all;
  };
  for (const auto& [name, missing] : missingMedia_) {
    const auto later = mediaByName_.find(name);
    if (later == mediaByName_.end()) {
      diagnostics_.tolerated(missing.named, "undefined medium " + quotedName(name) +
                                                ": vacuum is rendered in its place, as in PBRT-v3" +
                                                suggestFrom(name, names));
    } else {
      diagnostics_.tolerated(missing.named, "medium " + quotedName(name) + " is used at " +
                                                missing.user.toString() + " but defined only at " +
                                                scene_.media[later->second].location.toString() +
                                                "; as in PBRT-v3 it is vacuum until then");
    }
  }
}

void DescriptionBuilder::texture(Statement& s) {
  TextureDescription texture;
  texture.name = s.strings[0].text;
  const SourceLocation nameAt = s.strings[0].at;
  const std::string& flavour = s.strings[1].text;
  if (flavour != "float" && flavour != "color" && flavour != "spectrum") {
    const std::array<std::string_view, 3> known{"float", "spectrum", "color"};
    return diagnostics_.tolerated(
        s.strings[1].at, "Texture " + quotedName(texture.name) + ": unknown flavour " + quotedName(flavour) +
                             ", left out as in PBRT-v3" + suggestion(flavour, known));
  }
  texture.flavour = flavour == "float" ? TextureFlavour::Float : TextureFlavour::Spectrum;
  s.moveInto(texture, 2);
  warnIfAnimated(s);
  texture.ctm = state_.ctm;
  texture.scope = state_.scope;
  const auto kind = texture.flavour == TextureFlavour::Float ? NameScope::Kind::FloatTextures
                                                             : NameScope::Kind::SpectrumTextures;
  if (const auto earlier = NameScope::find(state_.scope, kind, texture.name)) {
    diagnostics_.warning(nameAt, "texture " + quotedName(texture.name) + " was defined before at " +
                                     scene_.textures[*earlier].location.toString() +
                                     "; later uses take this definition");
  }
  state_.scope =
      NameScope::with(state_.scope, kind, texture.name, static_cast<std::uint32_t>(scene_.textures.size()));
  scene_.textures.push_back(std::move(texture));
}

void DescriptionBuilder::material(Statement& s, bool isNamed) {
  MaterialDescription material;
  material.scope = state_.scope;
  const auto index = static_cast<std::uint32_t>(scene_.materials.size());
  if (!isNamed) {
    s.moveInto(material);
    state_.material = static_cast<std::int32_t>(index);
    scene_.materials.push_back(std::move(material));
    return;
  }
  material.name = s.strings[0].text;
  const SourceLocation nameAt = s.strings[0].at;
  // Without a type the name is still bound, so that its uses are no further errors.
  if (!typeFromParameter(s, material)) material.type.clear();
  if (const auto earlier = NameScope::find(state_.scope, NameScope::Kind::Materials, material.name)) {
    diagnostics_.warning(nameAt, "material " + quotedName(material.name) + " was defined before at " +
                                     scene_.materials[*earlier].location.toString() +
                                     "; later uses take this definition");
  }
  state_.scope = NameScope::with(state_.scope, NameScope::Kind::Materials, material.name, index);
  scene_.materials.push_back(std::move(material));
}

void DescriptionBuilder::namedMaterial(const Statement& s) {
  const std::string& name = s.strings[0].text;
  const auto index = NameScope::find(state_.scope, NameScope::Kind::Materials, name);
  if (!index) {
    return diagnostics_.tolerated(
        s.strings[0].at,
        "unknown material " + quotedName(name) + ": the material in force stays, as in PBRT-v3" +
            suggestFrom(name, [&] { return NameScope::names(state_.scope, NameScope::Kind::Materials); }));
  }
  state_.material = static_cast<std::int32_t>(*index);
}

void DescriptionBuilder::light(Statement& s) {
  LightDescription light;
  s.moveInto(light);
  warnIfAnimated(s);
  light.ctm = state_.ctm;
  if (light.ctm->start.isSingular()) {
    // What shines from a point needs the place alone.
    const Matrix4& m = light.ctm->start.matrix();
    if (light.type != "point" || m.m[3] != std::array<double, 4>{0, 0, 0, 1}) return;
    const Transform place = Transform::translate({m.m[0][3], m.m[1][3], m.m[2][3]});
    light.ctm = std::make_shared<const TransformPair>(TransformPair{place, place});
  }
  light.media = mediaHere(s.at);
  scene_.lights.push_back(std::move(light));
}

void DescriptionBuilder::areaLight(Statement& s) {
  if (s.strings[0].text.empty()) {
    state_.areaLight = kNone;
    return;
  }
  state_.areaLight = static_cast<std::int32_t>(scene_.areaLights.size());
  s.moveInto(scene_.areaLights.emplace_back());
}

/// Whether the statement is a mesh that the CTM maps into a plane, where PBRT-v3 shows it.
bool DescriptionBuilder::isPressedFlat(const Statement& s) const {
  constexpr std::array<std::string_view, 5> kMeshes{"trianglemesh", "plymesh", "loopsubdiv", "heightfield",
                                                    "nurbs"};
  if (state_.ctm->isAnimated() ||
      std::find(kMeshes.begin(), kMeshes.end(), s.strings[0].text) == kMeshes.end())
    return false;
  const auto& m = state_.ctm->start.matrix().m;
  if (m[3] != std::array<double, 4>{0, 0, 0, 1}) return false;
  const auto column = [&](std::size_t i) { return Vec3d{m[0][i], m[1][i], m[2][i]}; };
  constexpr double kParallel = 1e-9;  // sine of two columns that still span a plane
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3d a = column(i), b = column((i + 1) % 3);
    if (length(cross(a, b)) > kParallel * length(a) * length(b)) return true;
  }
  return false;
}

void DescriptionBuilder::shape(Statement& s) {
  if (isOutOfSight() && !isPressedFlat(s)) return;
  ShapeDescription shape;
  s.moveInto(shape);
  shape.ctm = state_.ctm;
  shape.media = mediaHere(s.at);
  shape.scope = state_.scope;
  shape.material = state_.material;
  shape.areaLight = state_.areaLight;
  shape.object = object_;
  shape.reverseOrientation = state_.reverseOrientation;
  if (object_ != kNone) {
    ObjectDescription& object = scene_.objects[static_cast<std::size_t>(object_)];
    object.shapes.push_back(static_cast<std::uint32_t>(scene_.shapes.size()));
    if (object.placedShapes != UINT64_MAX) ++object.placedShapes;
  }
  scene_.shapes.push_back(std::move(shape));
}

}  // namespace pbrtmedia
