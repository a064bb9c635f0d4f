// SPDX-License-Identifier: BSD-2-Clause
#include "construct/texturable.h"

#include <sstream>
#include <type_traits>
#include <vector>

namespace pbrtmedia {

template <class T>
std::optional<TextureUse<T>> Texturable::findIn(ParamReader& in, std::string_view name, Range range) {
  constexpr bool kIsFloat = std::is_same_v<T, float>;
  constexpr ParamKind kKind = kIsFloat ? ParamKind::Float : ParamKind::Spectrum;
  constexpr auto kFlavour = kIsFloat ? NameScope::Kind::FloatTextures : NameScope::Kind::SpectrumTextures;
  if (in.has(ParamKind::Texture, name)) {
    in.has(kKind, name);  // a constant of the same name loses, but it is known
    const std::optional<std::string> texture = in.findTextureName(name);
    if (!texture) return std::nullopt;
    if (const auto index = NameScope::find(scope(), kFlavour, *texture)) return TextureUse<T>{*index, T{}};
    const std::vector<std::string> owned = NameScope::names(scope(), kFlavour);
    const std::vector<std::string_view> known(owned.begin(), owned.end());
    const bool otherFlavour =
        NameScope::find(
            scope(), kIsFloat ? NameScope::Kind::SpectrumTextures : NameScope::Kind::FloatTextures, *texture)
            .has_value();
    const std::string what = kIsFloat ? "float" : "spectrum";
    in.error(ParamKind::Texture, name,
             otherFlavour ? "texture \"" + *texture + "\" is a " + (kIsFloat ? "spectrum" : "float") +
                                " texture, expected a " + what + " texture"
             : known.empty()
                 ? "unknown " + what + " texture \"" + *texture + "\"; none is defined here"
                 : "unknown " + what + " texture \"" + *texture + "\"" + suggestion(*texture, known));
    return std::nullopt;
  }
  const Param* param = in.find(kKind, name);
  if (param == nullptr) return std::nullopt;
  if (param->size() == 0) {
    in.error(kKind, name, "found an empty list, expected a value or a texture");
    return std::nullopt;
  }
  if (param->size() > 1) {
    in.diagnostics().tolerated(in.locationOf(kKind, name),
                                  in.context() + ": parameter \"" + std::string(name) + "\": found " +
                                      std::to_string(param->size()) + " values, expected 1");
  }
  const T value = std::get<std::vector<T>>(param->values).front();
  if constexpr (kIsFloat) {
    if (!range.contains(value)) {
      std::ostringstream found;
      found << "found " << value << ", expected " << range.toString();
      in.error(kKind, name, found.str());
      return std::nullopt;
    }
  }
  return TextureUse<T>{TextureUse<T>::kConstant, value};
}

template <class T>
std::optional<TextureUse<T>> Texturable::find(std::string_view name, Range range) {
  if (shape_ != nullptr) {
    if (auto use = findIn<T>(*shape_, name, range)) {
      shapeOverrides_ = true;
      return use;
    }
  }
  return findIn<T>(own_, name, range);
}

std::optional<TextureUse<float>> Texturable::optionalFloat(std::string_view name, Range range) {
  return find<float>(name, range);
}

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

}  // namespace pbrtmedia
