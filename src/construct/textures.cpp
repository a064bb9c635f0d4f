// SPDX-License-Identifier: BSD-2-Clause
#include "construct/textures.h"

#include <array>
#include <type_traits>
#include <utility>

#include "base/built_parts.h"
#include "construct/enum_parameter.h"
#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "image/image.h"
#include "textures/bilerp.h"
#include "textures/checkerboard.h"
#include "textures/dots.h"
#include "textures/fbm.h"
#include "textures/marble.h"
#include "textures/mix.h"
#include "textures/scale.h"
#include "textures/uv.h"
#include "textures/windy.h"
#include "textures/wrinkled.h"

namespace pbrtmedia {
namespace {

using Plan = Textures::Plan;
using ReadTexture = Plan (*)(Texturable&, const TextureDescription&);

constexpr std::string_view kGreyInstead = "a grey picture (0.5) takes its place, as in PBRT-v3";
constexpr int kMaxTextureNesting = 256;           // textures within textures; real scenes have a handful
constexpr std::size_t kMaxEvaluations = 1 << 16;  // a look-up of some milliseconds
constexpr int kMaxOctaves = 64;  // beyond, 1.99^octaves leaves every footprint and most float ranges

template <class T, class Make>
Plan planOf(Make make) {
  if constexpr (std::is_same_v<T, float>) {
    return {std::move(make), nullptr, false};
  } else {
    return {nullptr, std::move(make), false};
  }
}

template <class T>
TextureUse<T> findUse(Texturable& in, std::string_view name, float fallback) {
  if constexpr (std::is_same_v<T, float>) {
    return in.findFloat(name, fallback);
  } else {
    return in.findRgb(name, Rgb(fallback));
  }
}

template <class T>
const Texture<T>& resolve(Textures& textures, const TextureUse<T>& use) {
  if constexpr (std::is_same_v<T, float>) {
    return *textures.floatTexture(use);
  } else {
    return *textures.rgbTexture(use);
  }
}

template <class T>
T findConstant(ParamReader& in, std::string_view name, float fallback) {
  if constexpr (std::is_same_v<T, float>) {
    return in.findFloat(name, fallback);
  } else {
    return in.findSpectrum(name, Rgb(fallback));
  }
}

Mapping2d readMapping2d(ParamReader& in, const Transform& ctm) {
  constexpr std::array<std::string_view, 4> kMappings = {"uv", "spherical", "cylindrical", "planar"};
  const std::size_t mapping = in.findChoice("mapping", kMappings, 0);
  if (mapping == 1) return SphericalMapping(ctm);
  if (mapping == 2) return CylindricalMapping(ctm);
  if (mapping == 3) {
    return PlanarMapping{.v1 = in.findVector3("v1", {1, 0, 0}),
                         .v2 = in.findVector3("v2", {0, 1, 0}),
                         .uDelta = in.findFloat("udelta", 0),
                         .vDelta = in.findFloat("vdelta", 0)};
  }
  const UvMapping uv{.uScale = in.findFloat("uscale", 1),
                     .vScale = in.findFloat("vscale", 1),
                     .uDelta = in.findFloat("udelta", 0),
                     .vDelta = in.findFloat("vdelta", 0)};
  // For a word that it does not know PBRT-v3 takes (u, v) as they are, whatever the other parameters say.
  const std::span<const std::string> words = in.strings("mapping");
  const bool isUnknown = words.size() == 1 && words.front() != kMappings[0];
  return isUnknown ? UvMapping{} : uv;
}

FractalParams readFractal(ParamReader& in) {
  return {.octaves = findIntWithin(in, "octaves", 8, Range::closed(0, kMaxOctaves)),
          .roughness = in.findFloat("roughness", 0.5f)};
}

template <class T>
Plan readConstant(Texturable& in, const TextureDescription&) {
  const T value = findConstant<T>(in.own(), "value", 1);
  return planOf<T>([=](Textures&) { return std::make_unique<ConstantTexture<T>>(value); });
}

template <class T>
Plan readScale(Texturable& in, const TextureDescription&) {
  const auto tex1 = findUse<T>(in, "tex1", 1), tex2 = findUse<T>(in, "tex2", 1);
  return planOf<T>(
      [=](Textures& t) { return std::make_unique<ScaleTexture<T>>(resolve(t, tex1), resolve(t, tex2)); });
}

template <class T>
Plan readMix(Texturable& in, const TextureDescription&) {
  const auto tex1 = findUse<T>(in, "tex1", 0), tex2 = findUse<T>(in, "tex2", 1);
  const auto amount = in.findFloat("amount", 0.5f);
  return planOf<T>([=](Textures& t) {
    return std::make_unique<MixTexture<T>>(resolve(t, tex1), resolve(t, tex2), resolve(t, amount));
  });
}

template <class T>
Plan readBilerp(Texturable& in, const TextureDescription& d) {
  const BilerpParams<T> p{.v00 = findConstant<T>(in.own(), "v00", 0),
                          .v01 = findConstant<T>(in.own(), "v01", 1),
                          .v10 = findConstant<T>(in.own(), "v10", 0),
                          .v11 = findConstant<T>(in.own(), "v11", 1)};
  const Mapping2d mapping = readMapping2d(in.own(), d.ctm->start);
  return planOf<T>([=](Textures&) { return std::make_unique<BilerpTexture<T>>(mapping, p); });
}

Plan readUv(Texturable& in, const TextureDescription& d) {
  const Mapping2d mapping = readMapping2d(in.own(), d.ctm->start);
  return planOf<Rgb>([=](Textures&) { return std::make_unique<UvTexture>(mapping); });
}

template <class T>
Plan readCheckerboard(Texturable& in, const TextureDescription& d) {
  const auto tex1 = findUse<T>(in, "tex1", 1), tex2 = findUse<T>(in, "tex2", 0);
  const int dimension = in.own().findInt("dimension", 2);
  if (dimension != 2 && dimension != 3) {
    tolerate(in.own(), ParamKind::Integer, "dimension",
             "found " + std::to_string(dimension) +
                 ", expected 2 or 3; the texture is not defined, and its users "
                 "take their defaults, as in PBRT-v3");
    readMapping2d(in.own(), d.ctm->start);
    in.own().findString("aamode", "");
    Plan undefined;
    undefined.isUnusable = true;
    return undefined;
  }
  if (dimension == 3) {
    const Mapping3d mapping(d.ctm->start);
    return planOf<T>([=](Textures& t) {
      return std::make_unique<Checkerboard3dTexture<T>>(mapping, resolve(t, tex1), resolve(t, tex2));
    });
  }
  constexpr std::array<std::string_view, 2> kModes = {"closedform", "none"};
  const auto filter = findEnum(in.own(), "aamode", kModes, CheckerboardFilter::ClosedForm);
  const Mapping2d mapping = readMapping2d(in.own(), d.ctm->start);
  return planOf<T>([=](Textures& t) {
    return std::make_unique<Checkerboard2dTexture<T>>(mapping, resolve(t, tex1), resolve(t, tex2), filter);
  });
}

template <class T>
Plan readDots(Texturable& in, const TextureDescription& d) {
  const auto inside = findUse<T>(in, "inside", 1), outside = findUse<T>(in, "outside", 0);
  const Mapping2d mapping = readMapping2d(in.own(), d.ctm->start);
  return planOf<T>([=](Textures& t) {
    return std::make_unique<DotsTexture<T>>(mapping, resolve(t, inside), resolve(t, outside));
  });
}

template <class T>
Plan readFbm(Texturable& in, const TextureDescription& d) {
  const FractalParams p = readFractal(in.own());
  const Mapping3d mapping(d.ctm->start);
  return planOf<T>([=](Textures&) { return std::make_unique<FbmTexture<T>>(mapping, p); });
}

template <class T>
Plan readWrinkled(Texturable& in, const TextureDescription& d) {
  const FractalParams p = readFractal(in.own());
  const Mapping3d mapping(d.ctm->start);
  return planOf<T>([=](Textures&) { return std::make_unique<WrinkledTexture<T>>(mapping, p); });
}

template <class T>
Plan readWindy(Texturable&, const TextureDescription& d) {
  const Mapping3d mapping(d.ctm->start);
  return planOf<T>([=](Textures&) { return std::make_unique<WindyTexture<T>>(mapping); });
}

Plan readMarble(Texturable& in, const TextureDescription& d) {
  const MarbleParams p{.fractal = readFractal(in.own()),
                       .scale = in.own().findFloat("scale", 1),
                       .variation = in.own().findFloat("variation", 0.2f)};
  const Mapping3d mapping(d.ctm->start);
  return planOf<Rgb>([=](Textures&) { return std::make_unique<MarbleTexture>(mapping, p); });
}

template <class T>
Plan readImagemap(Texturable& in, const TextureDescription& d) {
  ParamReader& own = in.own();
  const std::string name = own.findString("filename", "");
  const std::optional<std::filesystem::path> file = own.findInputFile("filename", kGreyInstead);
  if (name.empty()) {
    tolerate(own, (own.has(ParamKind::String, "filename") ? "parameter \"filename\" is empty; "
                                                          : "parameter \"filename\" is missing; ") +
                      std::string(kGreyInstead));
  }
  constexpr std::array<std::string_view, 3> kWraps = {"repeat", "black", "clamp"};
  ImageTexelParams texels;
  texels.gamma = own.findBool("gamma", defaultGamma(name));
  texels.scale = own.findFloat("scale", texels.scale);
  texels.wrap = findEnum(own, "wrap", kWraps, WrapMode::Repeat);
  ImageFilterParams filter;
  filter.trilinear = own.findBool("trilinear", filter.trilinear);
  filter.maxAnisotropy = findFloatWithin(own, "maxanisotropy", filter.maxAnisotropy, Range::closed(1, 1024));
  const Mapping2d mapping = readMapping2d(own, d.ctm->start);
  const Textures::Picture picture{.file = file.value_or(""),
                                  .named = own.locationOf(ParamKind::String, "filename"),
                                  .context = own.context()};
  Plan plan = planOf<T>([=](Textures& t) {
    return std::make_unique<ImageTexture<T>>(mapping, t.pyramid<T>(picture, texels), filter);
  });
  plan.isUnusable = !file;
  return plan;
}

/// Of a texture that needs a library which no build has.
template <class T>
Plan readPtex(Texturable& in, const TextureDescription&) {
  ParamReader& own = in.own();
  own.findString("filename", "");
  own.findFloat("gamma", 2.2f);
  tolerate(own,
           "needs the Ptex library, which this program is built without; a constant grey (0.5) takes its "
           "place; an \"imagemap\" of a baked picture shows it");
  Plan plan = planOf<T>([](Textures&) { return std::make_unique<ConstantTexture<T>>(T(0.5f)); });
  plan.isUnusable = true;
  return plan;
}

constexpr std::array<Plugin<ReadTexture>, 11> kFloatTextures = {{{"constant", readConstant<float>},
                                                                 {"scale", readScale<float>},
                                                                 {"mix", readMix<float>},
                                                                 {"bilerp", readBilerp<float>},
                                                                 {"checkerboard", readCheckerboard<float>},
                                                                 {"dots", readDots<float>},
                                                                 {"imagemap", readImagemap<float>},
                                                                 {"fbm", readFbm<float>},
                                                                 {"wrinkled", readWrinkled<float>},
                                                                 {"windy", readWindy<float>},
                                                                 {"ptex", readPtex<float>}}};

constexpr std::array<Plugin<ReadTexture>, 13> kRgbTextures = {{{"constant", readConstant<Rgb>},
                                                               {"scale", readScale<Rgb>},
                                                               {"mix", readMix<Rgb>},
                                                               {"bilerp", readBilerp<Rgb>},
                                                               {"uv", readUv},
                                                               {"checkerboard", readCheckerboard<Rgb>},
                                                               {"dots", readDots<Rgb>},
                                                               {"imagemap", readImagemap<Rgb>},
                                                               {"fbm", readFbm<Rgb>},
                                                               {"wrinkled", readWrinkled<Rgb>},
                                                               {"windy", readWindy<Rgb>},
                                                               {"marble", readMarble},
                                                               {"ptex", readPtex<Rgb>}}};

}  // namespace

Textures::Textures(SceneDescription& scene, Diagnostics& diagnostics)
    : scene_(scene),
      diagnostics_(diagnostics),
      plans_(scene.textures.size()),
      builtFloats_(scene.textures.size()),
      builtRgbs_(scene.textures.size()),
      evaluations_(scene.textures.size()) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    TextureDescription& d = scene.textures[i];
    const bool isFloat = d.flavour == TextureFlavour::Float;
    const std::string kind = std::string(isFloat ? "float" : "spectrum") + " texture \"" + d.name + "\"";
    constexpr std::string_view kUndefined =
        "it is not defined, and its users take their defaults, as in PBRT-v3";
    const auto* plugin = isFloat ? findPlugin<ReadTexture>(kFloatTextures, d, kind, kUndefined, diagnostics)
                                 : findPlugin<ReadTexture>(kRgbTextures, d, kind, kUndefined, diagnostics);
    if (plugin == nullptr) {
      plans_[i].isUnusable = true;
      continue;
    }
    if (d.ctm->isAnimated()) {
      diagnostics.warning(d.location,
                          kind + ": textures do not move; the transformation of the start time is used");
    }
    ParamReader in(d, diagnostics, kind);
    Texturable texturable(in, d.scope);
    plans_[i] = plugin->read(texturable, d);
    in.reportUnused();
  }
}

/// Builds one texture. What refers to others can multiply: each doubling of a few lines of text would double
/// the time of every look-up, and a long chain would exhaust the stack.
template <class T, class Make>
std::unique_ptr<Texture<T>> Textures::build(std::uint32_t texture, const Make& make) {
  const TextureDescription& d = scene_.textures[texture];
  const std::string context = "texture \"" + d.name + "\"";
  if (nesting_ >= kMaxTextureNesting) {
    throw SceneError(d.location, context + ": is nested more than " + std::to_string(kMaxTextureNesting) +
                                     " textures deep");
  }
  const std::size_t outer = std::exchange(evaluationsOfInputs_, 1);
  ++nesting_;
  std::unique_ptr<Texture<T>> made = builtAt(d.location, context, [&] { return make(*this); });
  --nesting_;
  evaluations_[texture] = std::exchange(evaluationsOfInputs_, outer);
  if (evaluations_[texture] > kMaxEvaluations) {
    throw SceneError(d.location, context + ": one value takes more than " + std::to_string(kMaxEvaluations) +
                                     " look-ups of the textures it refers to");
  }
  ++builtCount_;
  if (d.type == "constant") return made;
  countBuilt(Part::Textures);
  wantFootprints_ = wantFootprints_ || (d.type != "scale" && d.type != "mix");  // these have inputs that do
  return made;
}

const FloatTexture* Textures::floatTexture(const TextureUse<float>& use) {
  if (use.isConstant() || isMissing(use)) {
    const FloatTexture*& constant = floatConstants_[use.constant];
    if (constant == nullptr) {
      built_.floats.push_back(std::make_unique<ConstantTexture<float>>(use.constant));
      constant = built_.floats.back().get();
    }
    return constant;
  }
  const FloatTexture*& texture = builtFloats_[use.texture];
  if (texture == nullptr) {
    built_.floats.push_back(build<float>(use.texture, plans_[use.texture].makeFloat));
    texture = built_.floats.back().get();
  }
  evaluationsOfInputs_ += evaluations_[use.texture];
  return texture;
}

const RgbTexture* Textures::rgbTexture(const TextureUse<Rgb>& use) {
  if (use.isConstant() || isMissing(use)) {
    const RgbTexture*& constant = rgbConstants_[{use.constant.r, use.constant.g, use.constant.b}];
    if (constant == nullptr) {
      built_.rgbs.push_back(std::make_unique<ConstantTexture<Rgb>>(use.constant));
      constant = built_.rgbs.back().get();
    }
    return constant;
  }
  const RgbTexture*& texture = builtRgbs_[use.texture];
  if (texture == nullptr) {
    built_.rgbs.push_back(build<Rgb>(use.texture, plans_[use.texture].makeRgb));
    texture = built_.rgbs.back().get();
  }
  evaluationsOfInputs_ += evaluations_[use.texture];
  return texture;
}

template <class T>
std::shared_ptr<const MipMap<T>> Textures::pyramid(const Picture& picture, const ImageTexelParams& params) {
  auto& cache = [this]() -> PyramidCache<T>& {
    if constexpr (std::is_same_v<T, float>) {
      return floatPyramids_;
    } else {
      return rgbPyramids_;
    }
  }();
  std::shared_ptr<const MipMap<T>>& entry = cache[{picture.file, params.gamma, params.scale, params.wrap}];
  if (entry != nullptr) return entry;
  if (!picture.file.empty()) {
    try {
      return entry = makeTexturePyramid<T>(readImage(picture.file), params);
    } catch (const SceneError& e) {
      diagnostics_.tolerated(picture.named, picture.context + ": parameter \"filename\": " + problemOf(e) +
                                                "; " + std::string(kGreyInstead));
    }
  }
  Image grey(1, 1, {"R", "G", "B"});
  grey.setRgb(0, 0, Rgb(0.5f));
  return entry = makeTexturePyramid<T>(grey, params);
}

template std::shared_ptr<const MipMap<float>> Textures::pyramid<float>(const Picture&,
                                                                       const ImageTexelParams&);
template std::shared_ptr<const MipMap<Rgb>> Textures::pyramid<Rgb>(const Picture&, const ImageTexelParams&);

}  // namespace pbrtmedia
