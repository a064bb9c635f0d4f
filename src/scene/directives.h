// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace pbrtmedia {

enum class Directive : std::uint8_t {
  Accelerator,
  ActiveTransform,
  AreaLightSource,
  AttributeBegin,
  AttributeEnd,
  Camera,
  ConcatTransform,
  CoordinateSystem,
  CoordSysTransform,
  Define,
  Film,
  Identity,
  Include,
  Integrator,
  LightSource,
  LookAt,
  MakeNamedMaterial,
  MakeNamedMedium,
  Material,
  MediumInterface,
  NamedMaterial,
  ObjectBegin,
  ObjectEnd,
  ObjectInstance,
  PixelFilter,
  ReverseOrientation,
  Rotate,
  Sampler,
  Scale,
  Shape,
  Texture,
  Transform,
  TransformBegin,
  TransformEnd,
  TransformTimes,
  Translate,
  WorldBegin,
  WorldEnd
};

/// Where a directive may stand: before WorldBegin, between WorldBegin and WorldEnd, or both.
enum class Block : std::uint8_t { Options, World, Any };

/// The arguments follow in this order: a bare word, numbers, quoted strings, parameters.
struct DirectiveInfo {
  std::string_view name;
  Directive id;
  Block block;
  std::uint8_t numbers = 0;  ///< 16: in brackets; otherwise without
  std::uint8_t minStrings = 0, maxStrings = 0;
  bool parameters = false;
  bool word = false;
  std::string_view strings{};  ///< what the strings are, for messages: "name, flavour, class"
  bool value = false;          ///< behind the strings: a number, a string, or several of them in brackets
};

std::span<const DirectiveInfo> directives();
/// Null: no directive has this name.
const DirectiveInfo* findDirective(std::string_view name);
/// What to say about a word that is no directive: the nearest names, or which other program knows it.
std::string explainUnknownDirective(std::string_view word);

}  // namespace pbrtmedia
