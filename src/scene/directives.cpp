// SPDX-License-Identifier: BSD-2-Clause
#include "scene/directives.h"

#include <algorithm>
#include <array>
#include <vector>

#include "base/diagnostics.h"

namespace pbrtmedia {
namespace {

constexpr DirectiveInfo plain(std::string_view name, Directive id, Block block) { return {name, id, block}; }
constexpr DirectiveInfo transform(std::string_view name, Directive id, std::uint8_t numbers) {
  return {name, id, Block::Any, numbers};
}
constexpr DirectiveInfo named(std::string_view name, Directive id, Block block,
                              std::string_view what = "name") {
  return {name, id, block, 0, 1, 1, false, false, what};
}
constexpr DirectiveInfo plugin(std::string_view name, Directive id, Block block,
                               std::string_view what = "type") {
  return {name, id, block, 0, 1, 1, true, false, what};
}

// Reference 5.3. Sorted by name.
constexpr std::array kDirectives{
    plugin("Accelerator", Directive::Accelerator, Block::Options),
    DirectiveInfo{"ActiveTransform", Directive::ActiveTransform, Block::Any, 0, 0, 0, false, true},
    plugin("AreaLightSource", Directive::AreaLightSource, Block::World),
    plain("AttributeBegin", Directive::AttributeBegin, Block::World),
    plain("AttributeEnd", Directive::AttributeEnd, Block::World),
    plugin("Camera", Directive::Camera, Block::Options),
    transform("ConcatTransform", Directive::ConcatTransform, 16),
    named("CoordSysTransform", Directive::CoordSysTransform, Block::Any),
    named("CoordinateSystem", Directive::CoordinateSystem, Block::Any),
    DirectiveInfo{"Define", Directive::Define, Block::Any, 0, 1, 1, false, false, "name of a variable", true},
    plugin("Film", Directive::Film, Block::Options),
    plain("Identity", Directive::Identity, Block::Any),
    named("Include", Directive::Include, Block::Any, "file name"),
    plugin("Integrator", Directive::Integrator, Block::Options),
    plugin("LightSource", Directive::LightSource, Block::World),
    transform("LookAt", Directive::LookAt, 9),
    plugin("MakeNamedMaterial", Directive::MakeNamedMaterial, Block::World, "name"),
    plugin("MakeNamedMedium", Directive::MakeNamedMedium, Block::Any, "name"),
    plugin("Material", Directive::Material, Block::World),
    DirectiveInfo{"MediumInterface", Directive::MediumInterface, Block::Any, 0, 1, 2, false, false,
                  "inside medium"},
    named("NamedMaterial", Directive::NamedMaterial, Block::World),
    named("ObjectBegin", Directive::ObjectBegin, Block::World),
    plain("ObjectEnd", Directive::ObjectEnd, Block::World),
    named("ObjectInstance", Directive::ObjectInstance, Block::World),
    plugin("PixelFilter", Directive::PixelFilter, Block::Options),
    plain("ReverseOrientation", Directive::ReverseOrientation, Block::World),
    transform("Rotate", Directive::Rotate, 4),
    plugin("Sampler", Directive::Sampler, Block::Options),
    transform("Scale", Directive::Scale, 3),
    plugin("Shape", Directive::Shape, Block::World),
    DirectiveInfo{"Texture", Directive::Texture, Block::World, 0, 3, 3, true, false,
                  "name, flavour and class"},
    transform("Transform", Directive::Transform, 16),
    plain("TransformBegin", Directive::TransformBegin, Block::World),
    plain("TransformEnd", Directive::TransformEnd, Block::World),
    DirectiveInfo{"TransformTimes", Directive::TransformTimes, Block::Options, 2},
    transform("Translate", Directive::Translate, 3),
    plain("WorldBegin", Directive::WorldBegin, Block::Options),
    plain("WorldEnd", Directive::WorldEnd, Block::World)};

bool byName(const DirectiveInfo& a, std::string_view b) { return a.name < b; }

}  // namespace

std::span<const DirectiveInfo> directives() { return kDirectives; }

const DirectiveInfo* findDirective(std::string_view name) {
  if (name.empty() || name[0] < 'A' || name[0] > 'Z') return nullptr;
  const auto it = std::lower_bound(kDirectives.begin(), kDirectives.end(), name, byName);
  return it != kDirectives.end() && it->name == name ? &*it : nullptr;
}

std::string explainUnknownDirective(std::string_view word) {
  constexpr std::array<std::string_view, 6> kVersion4{"Attribute",      "ColorSpace", "Import",
                                                      "MakeNamedLight", "Option",     "Preset"};
  constexpr std::array<std::string_view, 5> kVersion2{"Renderer", "Searchpath", "SurfaceIntegrator", "Volume",
                                                      "VolumeIntegrator"};
  if (std::find(kVersion4.begin(), kVersion4.end(), word) != kVersion4.end()) {
    return "; PBRT-v4 knows it, PBRT-v3 does not";
  }
  if (std::find(kVersion2.begin(), kVersion2.end(), word) != kVersion2.end()) {
    return "; PBRT-v2 knew it, PBRT-v3 does not";
  }
  std::vector<std::string_view> names;
  for (const DirectiveInfo& d : kDirectives) names.push_back(d.name);
  return suggestion(word, names);
}

}  // namespace pbrtmedia
