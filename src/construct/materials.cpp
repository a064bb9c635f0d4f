// SPDX-License-Identifier: BSD-2-Clause
#include "construct/materials.h"

#include <algorithm>
#include <array>

#include "base/files.h"
#include "construct/material_kinds.h"
#include "construct/plugins.h"
#include "construct/tolerance.h"
#include "materials/fourier_table.h"
#include "materials/glass.h"
#include "materials/matte.h"
#include "materials/metal.h"
#include "materials/mirror.h"
#include "materials/mix.h"
#include "materials/plastic.h"
#include "materials/substrate.h"
#include "materials/subsurface_table.h"
#include "materials/translucent.h"
#include "materials/uber.h"

namespace pbrtmedia {
namespace {

using Make = Materials::Make;
using ReadMaterial = Make (*)(Texturable&);

constexpr int kMaxNesting = 256;  // mixes within mixes; more than the number of lobes allows

/// A dielectric's index: "eta", else "index".
TextureUse<float> readEta(Texturable& in, float fallback) {
  const auto eta = in.optionalFloat("eta", Range::nonNegative());
  const auto index = in.optionalFloat("index", Range::nonNegative());
  TextureUse<float> use =
      eta ? *eta : index.value_or(TextureUse<float>{TextureUse<float>::kConstant, fallback});
  if (!use.isConstant()) use.constant = fallback;
  return use;
}

Make readMatte(Texturable& in) {
  const auto kd = in.findRgb("Kd", Rgb(0.5f));
  const auto sigma = in.findFloat("sigma", 0);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<MatteMaterial>(
        MatteParams{.kd = t.rgbTexture(kd), .sigma = t.floatTexture(sigma), .bumpMap = t.floatTexture(bump)});
  };
}

Make readPlastic(Texturable& in) {
  const auto kd = in.findRgb("Kd", Rgb(0.25f)), ks = in.findRgb("Ks", Rgb(0.25f));
  const auto roughness = in.findFloat("roughness", 0.1f);
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<PlasticMaterial>(PlasticParams{.kd = t.rgbTexture(kd),
                                                           .ks = t.rgbTexture(ks),
                                                           .roughness = t.floatTexture(roughness),
                                                           .remapRoughness = remap,
                                                           .bumpMap = t.floatTexture(bump)});
  };
}

Make readGlass(Texturable& in) {
  const auto kr = in.findRgb("Kr", Rgb(1)), kt = in.findRgb("Kt", Rgb(1));
  const auto eta = readEta(in, 1.5f);
  const auto u = in.findFloat("uroughness", 0), v = in.findFloat("vroughness", 0);
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<GlassMaterial>(GlassParams{.kr = t.rgbTexture(kr),
                                                       .kt = t.rgbTexture(kt),
                                                       .eta = t.floatTexture(eta),
                                                       .uRoughness = t.floatTexture(u),
                                                       .vRoughness = t.floatTexture(v),
                                                       .remapRoughness = remap,
                                                       .bumpMap = t.floatTexture(bump)});
  };
}

Make readMirror(Texturable& in) {
  const auto kr = in.findRgb("Kr", Rgb(0.9f));
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<MirrorMaterial>(
        MirrorParams{.kr = t.rgbTexture(kr), .bumpMap = t.floatTexture(bump)});
  };
}

Make readMetal(Texturable& in) {
  const auto eta = in.findRgb("eta", kCopperEta), k = in.findRgb("k", kCopperK);
  const auto roughness = in.findFloat("roughness", 0.01f);
  const auto u = in.optionalFloat("uroughness"), v = in.optionalFloat("vroughness");
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<MetalMaterial>(MetalParams{.eta = t.rgbTexture(eta),
                                                       .k = t.rgbTexture(k),
                                                       .roughness = t.floatTexture(roughness),
                                                       .uRoughness = t.floatTexture(u),
                                                       .vRoughness = t.floatTexture(v),
                                                       .remapRoughness = remap,
                                                       .bumpMap = t.floatTexture(bump)});
  };
}

Make readSubstrate(Texturable& in) {
  const auto kd = in.findRgb("Kd", Rgb(0.5f)), ks = in.findRgb("Ks", Rgb(0.5f));
  const auto u = in.findFloat("uroughness", 0.1f), v = in.findFloat("vroughness", 0.1f);
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<SubstrateMaterial>(SubstrateParams{.kd = t.rgbTexture(kd),
                                                               .ks = t.rgbTexture(ks),
                                                               .uRoughness = t.floatTexture(u),
                                                               .vRoughness = t.floatTexture(v),
                                                               .remapRoughness = remap,
                                                               .bumpMap = t.floatTexture(bump)});
  };
}

Make readTranslucent(Texturable& in) {
  const auto kd = in.findRgb("Kd", Rgb(0.25f)), ks = in.findRgb("Ks", Rgb(0.25f));
  const auto reflect = in.findRgb("reflect", Rgb(0.5f)), transmit = in.findRgb("transmit", Rgb(0.5f));
  const auto roughness = in.findFloat("roughness", 0.1f);
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<TranslucentMaterial>(TranslucentParams{.kd = t.rgbTexture(kd),
                                                                   .ks = t.rgbTexture(ks),
                                                                   .reflect = t.rgbTexture(reflect),
                                                                   .transmit = t.rgbTexture(transmit),
                                                                   .roughness = t.floatTexture(roughness),
                                                                   .remapRoughness = remap,
                                                                   .bumpMap = t.floatTexture(bump)});
  };
}

Make readUber(Texturable& in) {
  const auto kd = in.findRgb("Kd", Rgb(0.25f)), ks = in.findRgb("Ks", Rgb(0.25f));
  const auto kr = in.findRgb("Kr", Rgb(0)), kt = in.findRgb("Kt", Rgb(0));
  const auto opacity = in.findRgb("opacity", Rgb(1));
  const auto roughness = in.findFloat("roughness", 0.1f);
  const auto u = in.optionalFloat("uroughness"), v = in.optionalFloat("vroughness");
  const auto eta = readEta(in, 1.5f);
  const bool remap = in.findBool("remaproughness", true);
  const auto bump = in.optionalFloat("bumpmap");
  return [=](Materials& m) {
    Textures& t = m.textures();
    return std::make_unique<UberMaterial>(UberParams{.kd = t.rgbTexture(kd),
                                                     .ks = t.rgbTexture(ks),
                                                     .kr = t.rgbTexture(kr),
                                                     .kt = t.rgbTexture(kt),
                                                     .opacity = t.rgbTexture(opacity),
                                                     .roughness = t.floatTexture(roughness),
                                                     .uRoughness = t.floatTexture(u),
                                                     .vRoughness = t.floatTexture(v),
                                                     .eta = t.floatTexture(eta),
                                                     .remapRoughness = remap,
                                                     .bumpMap = t.floatTexture(bump)});
  };
}

/// One of the two materials of a mix: one with a name, or what PBRT-v3 makes where that is unknown, a matte
/// of the parameters of the mix.
struct MixPart {
  std::int32_t named = kNone;
  Make matte;
  const Material* build(Materials& m) const { return matte ? m.keep(matte(m)) : m.buildShared(named); }
};

MixPart readMixPart(Texturable& in, std::string_view parameter) {
  constexpr std::string_view kMatte = "; a matte takes its place, as in PBRT-v3";
  const std::optional<std::string> name = in.optionalString(parameter);
  if (name) {
    if (const auto index = NameScope::find(in.scope(), NameScope::Kind::Materials, *name)) {
      return {static_cast<std::int32_t>(*index), {}};
    }
    const std::vector<std::string> owned = NameScope::names(in.scope(), NameScope::Kind::Materials);
    const std::vector<std::string_view> known(owned.begin(), owned.end());
    tolerate(in.own(), ParamKind::String, parameter,
             "unknown material \"" + *name + "\"" + suggestion(*name, known) + std::string(kMatte));
  } else {
    tolerate(in.own(), "parameter \"" + std::string(parameter) + "\" is missing" + std::string(kMatte));
  }
  return {kNone, readMatte(in)};
}

Make readMix(Texturable& in) {
  const auto amount = in.findRgb("amount", Rgb(0.5f));
  const MixPart a = readMixPart(in, "namedmaterial1"), b = readMixPart(in, "namedmaterial2");
  const SourceLocation at = in.own().entity().location;
  const std::string context = in.own().context();
  return [=](Materials& m) -> std::unique_ptr<Material> {
    const Material* first = a.build(m);
    const Material* second = b.build(m);
    if (first == nullptr || second == nullptr)
      throw std::invalid_argument("cannot mix with a material of type \"none\"");
    if (second->hasBssrdf() && !first->hasBssrdf()) {
      m.diagnostics().warning(at, context +
                                      ": nothing scatters below the surface of \"namedmaterial2\", which is "
                                      "like clear glass, as in PBRT-v3; as \"namedmaterial1\", it does");
    }
    return std::make_unique<MixMaterial>(*first, *second, *m.textures().rgbTexture(amount));
  };
}

constexpr std::array<Plugin<ReadMaterial>, 14> kMaterials = {{{"matte", readMatte},
                                                              {"plastic", readPlastic},
                                                              {"glass", readGlass},
                                                              {"mirror", readMirror},
                                                              {"metal", readMetal},
                                                              {"uber", readUber},
                                                              {"substrate", readSubstrate},
                                                              {"translucent", readTranslucent},
                                                              {"mix", readMix},
                                                              {"disney", readDisney},
                                                              {"subsurface", readSubsurface},
                                                              {"kdsubsurface", readKdSubsurface},
                                                              {"hair", readHair},
                                                              {"fourier", readFourier}}};

std::string contextOf(const MaterialDescription& d) {
  return d.name.empty() ? "Material \"" + d.type + "\"" : "material \"" + d.name + "\"";
}

}  // namespace

Materials::Materials(SceneDescription& scene, Textures& textures, Diagnostics& diagnostics)
    : scene_(scene),
      textures_(textures),
      diagnostics_(diagnostics),
      plans_(scene.materials.size()),
      shared_(scene.materials.size()) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    MaterialDescription& d = scene.materials[i];
    const std::string context = contextOf(d);
    ParamReader in(d, diagnostics, context);
    if (d.isNone()) {
      in.reportUnused();
      continue;
    }
    Texturable texturable(in, d.scope);
    const auto* plugin = findPlugin<ReadMaterial>(
        kMaterials, d, d.name.empty() ? "Material" : context,
        "a matte of the same parameters takes its place, as in PBRT-v3", diagnostics);
    plans_[i] = plugin != nullptr ? plugin->read(texturable) : readMatte(texturable);
    if (plugin != nullptr) in.reportUnused();  // of an unknown one nobody can tell what is right
  }
}

Materials::Use Materials::readForShape(const ShapeDescription& shape, ParamReader& in,
                                       Diagnostics& diagnostics) {
  Use use;
  use.material = shape.material;
  if (shape.material == kNone) {
    // The default matte, which a shape can override too.
    Entity defaults;
    defaults.type = "matte";
    defaults.location = shape.location;
    ParamReader own(defaults, diagnostics, "Material \"matte\"");
    Texturable texturable(in, shape.scope, own, nullptr);
    Make make = readMatte(texturable);
    if (texturable.shapeOverrides()) use.own = std::move(make);
    return use;
  }
  MaterialDescription& d = scene_.materials[static_cast<std::size_t>(shape.material)];
  if (d.isNone()) {
    use.isNone = true;
    return use;
  }
  bool unread = false;
  for (const Param& param : shape.params.all()) unread = unread || !param.used;
  if (!unread) return use;
  const ReadMaterial* read = nullptr;
  for (const auto& plugin : kMaterials) {
    if (plugin.name == d.type) read = &plugin.read;
  }
  ParamReader own(d, diagnostics, contextOf(d));
  Texturable texturable(in, shape.scope, own, d.scope);
  const std::size_t before = diagnostics.errorCount();
  Make make = read != nullptr ? (*read)(texturable) : readMatte(texturable);
  if (read == nullptr) {
    for (const Param& param : shape.params.all())
      param.used = true;  // nobody can tell whether they are right
  }
  if (texturable.shapeOverrides() && diagnostics.errorCount() == before) use.own = std::move(make);
  return use;
}

const Material* Materials::keep(std::unique_ptr<Material> material) {
  hasBssrdfs_ = hasBssrdfs_ || material->hasBssrdf();
  built_.push_back(std::move(material));
  return built_.back().get();
}

const Material* Materials::buildShared(std::int32_t index) {
  if (index == kNone) {
    if (default_ == nullptr) {
      default_ = keep(std::make_unique<MatteMaterial>(MatteParams{
          .kd = textures_.rgbTexture(TextureUse<Rgb>{TextureUse<Rgb>::kConstant, Rgb(0.5f)}),
          .sigma = textures_.floatTexture(TextureUse<float>{TextureUse<float>::kConstant, 0.0f})}));
    }
    return default_;
  }
  const auto i = static_cast<std::size_t>(index);
  if (!plans_[i]) return nullptr;
  if (shared_[i] == nullptr) {
    const MaterialDescription& d = scene_.materials[i];
    if (nesting_ >= kMaxNesting) {
      throw SceneError(d.location, contextOf(d) + ": is nested more than " + std::to_string(kMaxNesting) +
                                       " materials deep");
    }
    ++nesting_;
    shared_[i] = keep(builtAt(d.location, contextOf(d), [&] { return plans_[i](*this); }));
    --nesting_;
  }
  return shared_[i];
}

std::shared_ptr<const SubsurfaceTable> Materials::subsurfaceTable(float g, float eta) {
  auto& table = subsurfaceTables_[{g, eta}];
  if (!table) table = std::make_shared<const SubsurfaceTable>(g, eta);
  return table;
}

std::shared_ptr<const FourierTable> Materials::fourierTable(const std::filesystem::path& file) {
  auto& table = fourierTables_[file];
  if (!table) {
    table = std::make_shared<const FourierTable>(
        FourierTable::parse(FileBytes::open(file).text(), file.string()));
  }
  return table;
}

std::size_t Materials::builtCount() const {
  return shared_.size() - static_cast<std::size_t>(std::count(shared_.begin(), shared_.end(), nullptr));
}

const Material* Materials::build(const Use& use) {
  if (use.isNone) return nullptr;
  return use.own ? keep(use.own(*this)) : buildShared(use.material);
}

}  // namespace pbrtmedia
