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
  /// Reads every texture; problems go to `diagnostics`, as do those of building. Both references must outlive
  /// this object.
  Textures(SceneDescription& scene, Diagnostics& diagnostics);

  /// The texture, built now if need be. Throws SceneError when it cannot be made.
  const FloatTexture* floatTexture(const TextureUse<float>& use);
  const RgbTexture* rgbTexture(const TextureUse<Rgb>& use);
  /// Null for nothing, and for a texture of an unknown class.
  const FloatTexture* floatTexture(const std::optional<TextureUse<float>>& use) {
    return use && !isMissing(*use) ? floatTexture(*use) : nullptr;
  }
  const RgbTexture* rgbTexture(const std::optional<TextureUse<Rgb>>& use) {
    return use && !isMissing(*use) ? rgbTexture(*use) : nullptr;
  }

  std::size_t definedCount() const { return plans_.size(); }
  std::size_t builtCount() const { return builtCount_; }
  /// Whether some texture that was built, or a bump map of it, looks at the footprint of a pixel.
  bool wantFootprints() const { return wantFootprints_; }

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
    bool isUnusable = false;
  };
  /// Where a picture comes from.
  struct Picture {
    std::filesystem::path file;  ///< "": there is none
    SourceLocation named;        ///< the place that names it
    std::string context;         ///< starts messages
  };
  /// A picture decoded to texels; cached. Grey, as in PBRT-v3, and told of where there is none or it cannot
  /// be read.
  template <class T>
  std::shared_ptr<const MipMap<T>> pyramid(const Picture& picture, const ImageTexelParams& params);

  /// Whether a texture has no value of its own: it is of an unknown class, or its picture is not there.
  bool isUnusable(std::uint32_t texture) const { return plans_[texture].isUnusable; }

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
  Diagnostics& diagnostics_;
  std::vector<Plan> plans_;
  std::vector<const FloatTexture*> builtFloats_;
  std::vector<const RgbTexture*> builtRgbs_;
  std::size_t builtCount_ = 0;
  bool wantFootprints_ = false;
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
