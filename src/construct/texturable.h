// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "scene/name_scope.h"
#include "scene/param_reader.h"
#include "spectrum/rgb.h"

namespace pbrtmedia {

/// A parameter that may be a number or a texture: which texture of the scene, or which constant.
template <class T>
struct TextureUse {
  static constexpr std::uint32_t kConstant = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t texture = kConstant;  ///< into SceneDescription::textures
  T constant{};  ///< the value; of a texture: what stands in when it is of an unknown class
  bool isConstant() const { return texture == kConstant; }
};

/// Looks parameters up in a shape's list first, then in the material's own (scene-language reference 3.3):
/// texture in the shape's, constant in the shape's, texture in the own, constant in the own, default. Without
/// a shape only the own list counts. With a shape, names of both lists mean what they mean at the Shape
/// (reference 3.4). A name that is no texture of the kind, in either list, gives the default and is
/// tolerated; an empty name is none. Remembers whether the shape's list gave anything, and what textures were
/// found.
class Texturable {
 public:
  Texturable(ParamReader& own, NameScope::Ptr ownScope) : own_(own), ownScope_(std::move(ownScope)) {}
  Texturable(ParamReader& shape, NameScope::Ptr shapeScope, ParamReader& own, NameScope::Ptr ownScope)
      : own_(own), ownScope_(std::move(ownScope)), shape_(&shape), shapeScope_(std::move(shapeScope)) {}

  TextureUse<float> findFloat(std::string_view name, float fallback, Range range = {});
  TextureUse<Rgb> findRgb(std::string_view name, Rgb fallback);
  std::optional<TextureUse<float>> optionalFloat(std::string_view name, Range range = {});
  std::optional<TextureUse<Rgb>> optionalRgb(std::string_view name);
  bool findBool(std::string_view name, bool fallback);
  std::optional<std::string> optionalString(std::string_view name);
  /// ParamReader::findInputFile.
  std::optional<std::filesystem::path> findInputFile(std::string_view name, std::string_view consequence);

  /// Whose list tells this parameter: the shape's where it stands there.
  ParamReader& readerOf(ParamKind kind, std::string_view name) {
    return shape_ != nullptr && shape_->has(kind, name) ? *shape_ : own_;
  }

  /// A parameter of the shape was used: the material is of this shape alone.
  bool shapeOverrides() const { return shapeOverrides_; }
  ParamReader& own() { return own_; }
  /// Where a name is looked up: with a shape, what is in force at the Shape.
  const NameScope::Ptr& scope() const { return shape_ != nullptr ? shapeScope_ : ownScope_; }

 private:
  /// What one list says of a parameter.
  template <class T>
  struct Found {
    bool isGiven = false;              ///< false: nothing, the next list counts
    std::optional<TextureUse<T>> use;  ///< nothing: the default
  };
  template <class T>
  Found<T> findIn(ParamReader& in, std::string_view name, Range range);
  template <class T>
  std::optional<TextureUse<T>> findTexture(ParamReader& in, std::string_view name,
                                           const std::string& texture);
  template <class T>
  std::optional<TextureUse<T>> find(std::string_view name, Range range);
  template <class T>
  TextureUse<T> findOr(std::string_view name, T fallback, Range range);

  ParamReader& own_;
  NameScope::Ptr ownScope_;
  ParamReader* shape_ = nullptr;
  NameScope::Ptr shapeScope_;
  bool shapeOverrides_ = false;
};

}  // namespace pbrtmedia
