// SPDX-License-Identifier: BSD-2-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "construct/texturable.h"
#include "scene/description.h"
#include "textures/image_texture.h"
#include "textures/texture.h"

namespace pbrtmedia {

/// All textures of a scene: read and checked at once, built when first used, each once. Pictures that several
/// textures take with the same decoding share one pyramid. Hands its textures over with `takeBuilt`.
class Textures {
 public:
  /// Reads every texture; problems go to `diagnostics`. `scene` must outlive this object.
  Textures(SceneDescription& scene, Diagnostics& diagnostics);

  /// The texture, built now if need be. Throws SceneError when its picture cannot be read.
  const FloatTexture* floatTexture(const TextureUse<float>& use);
  const RgbTexture* rgbTexture(const TextureUse<Rgb>& use);
  /// Null for nothing, and for a texture that could not be read (--lenient).
  const FloatTexture* floatTexture(const std::optional<TextureUse<float>>& use) {
    return use && !isMissing(*use) ? floatTexture(*use) : nullptr;
  }
  const RgbTexture* rgbTexture(const std::optional<TextureUse<Rgb>>& use) {
    return use && !isMissing(*use) ? rgbTexture(*use) : nullptr;
  }

  std::size_t definedCount() const { return plans_.size(); }
  std::size_t builtCount() const { return builtCount_; }

  /// Keeps everything built alive: to be owned by the scene.
  struct Built {
    std::vector<std::unique_ptr<FloatTexture>> floats;
    std::vector<std::unique_ptr<RgbTexture>> rgbs;
  };
  Built takeBuilt() { return std::move(built_); }

  /// How a texture is made once its inputs exist. One of the two is set; none for an unknown class.
  struct Plan {
    std::function<std::unique_ptr<FloatTexture>(Textures&)> makeFloat;
    std::function<std::unique_ptr<RgbTexture>(Textures&)> makeRgb;
  };
  /// A picture decoded to texels; cached.
  template <class T>
  std::shared_ptr<const MipMap<T>> pyramid(const std::filesystem::path& file, const ImageTexelParams& params);

 private:
  template <class T>
  using PyramidCache =
      std::map<std::tuple<std::filesystem::path, bool, float, WrapMode>, std::shared_ptr<const MipMap<T>>>;

  template <class T>
  bool isMissing(const TextureUse<T>& use) const {
    return !use.isConstant() && !plans_[use.texture].makeFloat && !plans_[use.texture].makeRgb;
  }
  template <class T, class Make>
  std::unique_ptr<Texture<T>> build(std::uint32_t texture, const Make& make);

  SceneDescription& scene_;
  std::vector<Plan> plans_;
  std::vector<const FloatTexture*> builtFloats_;
  std::vector<const RgbTexture*> builtRgbs_;
  std::size_t builtCount_ = 0;
  std::vector<std::size_t> evaluations_;  ///< of each built texture: look-ups of textures for one value
  std::size_t evaluationsOfInputs_ = 0;   ///< of the texture that is being built
  int nesting_ = 0;                       ///< textures that are being built, each for the next
  std::map<float, const FloatTexture*> floatConstants_;
  std::map<std::tuple<float, float, float>, const RgbTexture*> rgbConstants_;
  PyramidCache<float> floatPyramids_;
  PyramidCache<Rgb> rgbPyramids_;
  Built built_;
};

}  // namespace pbrtmedia
