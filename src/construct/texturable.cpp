// SPDX-License-Identifier: BSD-2-Clause
#include "construct/texturable.h"

#include <sstream>
#include <type_traits>
#include <vector>

#include "construct/tolerance.h"

namespace pbrtmedia {

template <class T>
std::optional<TextureUse<T>> Texturable::findTexture(ParamReader& in, std::string_view name,
                                                     const std::string& texture) {
  constexpr bool kIsFloat = std::is_same_v<T, float>;
  constexpr auto kFlavour = kIsFloat ? NameScope::Kind::FloatTextures : NameScope::Kind::SpectrumTextures;
  constexpr auto kOther = kIsFloat ? NameScope::Kind::SpectrumTextures : NameScope::Kind::FloatTextures;
  if (const auto index = NameScope::find(scope(), kFlavour, texture)) return TextureUse<T>{*index, T{}};
  const std::string what = kIsFloat ? "float" : "spectrum";
  std::string message;
  if (NameScope::find(scope(), kOther, texture)) {
    message = "texture \"" + texture + "\" is a " + (kIsFloat ? "spectrum" : "float") +
              " texture, expected a " + what + " texture";
  } else {
    const std::vector<std::string> owned = NameScope::names(scope(), kFlavour);
    const std::vector<std::string_view> known(owned.begin(), owned.end());
    message = "unknown " + what + " texture \"" + texture + "\"";
    message += known.empty() ? "; none is defined here" : suggestion(texture, known);
  }
  tolerate(in, ParamKind::Texture, name, message + "; the default is used, as in PBRT-v3");
  return std::nullopt;
}

template <class T>
Texturable::Found<T> Texturable::findIn(ParamReader& in, std::string_view name, Range range) {
  constexpr ParamKind kKind = std::is_same_v<T, float> ? ParamKind::Float : ParamKind::Spectrum;
  if (in.has(ParamKind::Texture, name)) {
    in.has(kKind, name);  // a constant of the same name loses, but it is known
    const std::optional<std::string> texture = in.findTextureName(name);
    if (texture && !texture->empty()) return {true, findTexture<T>(in, name, *texture)};
  }
  const Param* param = in.find(kKind, name);
  if (param == nullptr) return {};
  if (param->size() == 0) {
    tolerate(in, kKind, name, "found an empty list, expected a value or a texture; the default is used");
    return {true, std::nullopt};
  }
  if (param->size() > 1) {
    tolerate(
        in, kKind, name,
        "found " + std::to_string(param->size()) + " values, expected 1; the first counts, as in PBRT-v3");
  }
  const T value = std::get<std::vector<T>>(param->values).front();
  if constexpr (std::is_same_v<T, float>) {
    if (!range.contains(static_cast<double>(value))) {
      std::ostringstream found;
      found << "found " << value << ", expected " << range.toString() << "; the default is used";
      tolerate(in, kKind, name, found.str());
      return {true, std::nullopt};
    }
  }
  return {true, TextureUse<T>{TextureUse<T>::kConstant, value}};
}

template <class T>
std::optional<TextureUse<T>> Texturable::find(std::string_view name, Range range) {
  if (shape_ != nullptr) {
    if (Found<T> found = findIn<T>(*shape_, name, range); found.isGiven) {
      shapeOverrides_ = true;
      return found.use;
    }
  }
  return findIn<T>(own_, name, range).use;
}

std::optional<TextureUse<float>> Texturable::optionalFloat(std::string_view name, Range range) {
  return find<float>(name, range);
}

std::optional<TextureUse<Rgb>> Texturable::optionalRgb(std::string_view name) { return find<Rgb>(name, {}); }

template <class T>
TextureUse<T> Texturable::findOr(std::string_view name, T fallback, Range range) {
  auto use = find<T>(name, range).value_or(TextureUse<T>{TextureUse<T>::kConstant, fallback});
  if (!use.isConstant()) use.constant = fallback;
  return use;
}

TextureUse<float> Texturable::findFloat(std::string_view name, float fallback, Range range) {
  return findOr<float>(name, fallback, range);
}

TextureUse<Rgb> Texturable::findRgb(std::string_view name, Rgb fallback) {
  return findOr<Rgb>(name, fallback, {});
}

bool Texturable::findBool(std::string_view name, bool fallback) {
  if (shape_ != nullptr) {
    if (const std::optional<bool> value = shape_->optionalBool(name)) {
      shapeOverrides_ = true;
      return *value;
    }
  }
  return own_.findBool(name, fallback);
}

std::optional<std::string> Texturable::optionalString(std::string_view name) {
  if (shape_ != nullptr) {
    if (std::optional<std::string> value = shape_->optionalString(name)) {
      shapeOverrides_ = true;
      return value;
    }
  }
  return own_.optionalString(name);
}

std::optional<std::filesystem::path> Texturable::findInputFile(std::string_view name,
                                                               std::string_view consequence) {
  if (shape_ != nullptr && shape_->has(ParamKind::String, name)) {
    shapeOverrides_ = true;
    return shape_->findInputFile(name, consequence);
  }
  return own_.findInputFile(name, consequence);
}

}  // namespace pbrtmedia
