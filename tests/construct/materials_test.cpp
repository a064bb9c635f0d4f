// SPDX-License-Identifier: BSD-2-Clause
#include "construct/materials.h"

#include <cmath>

#include "construct/probe.h"
#include "support/source_dir.h"

namespace pbrtmedia::test {
namespace {

const std::string kShape = " Shape \"sphere\"";
const std::string kTextures =
    "Texture \"bumps\" \"float\" \"checkerboard\" \"float uscale\" 20 \"float vscale\" 20 "
    "Texture \"f\" \"float\" \"constant\" \"float value\" 0.3 "
    "Texture \"s\" \"spectrum\" \"constant\" \"rgb value\" [ 0.3 0.4 0.5 ] ";

Attempt with(const std::string& world) { return attemptWorld(world); }
Numbers values(const Attempt& a) { return materials(a); }
/// The material in line 2, column 1, on a sphere.
Attempt onSphere(const std::string& material) { return with(material + "\n" + kShape); }
std::string material(const std::string& type, const std::string& parameters = "") {
  return "Material \"" + type + "\" " + parameters;
}

struct Parameters {
  std::string type;
  std::vector<std::pair<std::string, std::string>> base;  ///< given throughout, but for the one in question
  std::vector<std::string> spectra, floats;
  bool remaps = false, bumps = true;

  std::string with(const std::string& name, const std::string& parameter) const {
    std::string text;
    for (const auto& [given, value] : base) {
      if (given != name) text += value + ' ';
    }
    return kTextures + material(type, text + parameter);
  }
};
const std::vector<Parameters> kAll = {
    {"matte", {}, {"Kd"}, {"sigma"}, false},
    {"plastic", {}, {"Kd", "Ks"}, {"roughness"}, true},
    {"glass",
     {{"uroughness", "\"float uroughness\" 0.15"}, {"vroughness", "\"float vroughness\" 0.15"}},
     {"Kr", "Kt"},
     {"eta", "index", "uroughness", "vroughness"},
     true},
    {"mirror", {}, {"Kr"}, {}, false},
    {"metal", {}, {"eta", "k"}, {"roughness", "uroughness", "vroughness"}, true},
    {"substrate", {}, {"Kd", "Ks"}, {"uroughness", "vroughness"}, true},
    {"translucent", {}, {"Kd", "Ks", "reflect", "transmit"}, {"roughness"}, true},
    {"uber",
     {{"Kr", "\"rgb Kr\" [ .2 .2 .2 ]"}, {"Kt", "\"rgb Kt\" [ .1 .1 .1 ]"}},
     {"Kd", "Ks", "Kr", "Kt", "opacity"},
     {"roughness", "uroughness", "vroughness", "eta", "index"},
     true},
    {"disney",
     {{"spectrans", "\"float spectrans\" 0.2"},
      {"metallic", "\"float metallic\" 0.2"},
      {"sheen", "\"float sheen\" 0.2"},
      {"clearcoat", "\"float clearcoat\" 0.2"},
      {"color", "\"rgb color\" [ .6 .4 .2 ]"}},
     {"color", "scatterdistance"},
     {"metallic", "eta", "roughness", "speculartint", "anisotropic", "sheen", "sheentint", "clearcoat",
      "clearcoatgloss", "spectrans"},
     false},
    {"disney",
     {{"thin", "\"bool thin\" \"true\""}, {"spectrans", "\"float spectrans\" 0.2"}},
     {"color"},
     {"flatness", "difftrans", "roughness", "eta"},
     false},
    {"subsurface",
     {{"uroughness", "\"float uroughness\" 0.15"}, {"vroughness", "\"float vroughness\" 0.15"}},
     {"sigma_a", "sigma_s", "Kr", "Kt"},
     {"uroughness", "vroughness"},
     true},
    {"kdsubsurface",
     {{"uroughness", "\"float uroughness\" 0.15"}, {"vroughness", "\"float vroughness\" 0.15"}},
     {"Kd", "mfp", "Kr", "Kt"},
     {"uroughness", "vroughness"},
     true},
    {"hair", {}, {"sigma_a", "color"}, {"eumelanin", "pheomelanin", "eta"}, false, false},
    {"hair",
     {{"beta_m", "\"float beta_m\" 0.5"}, {"beta_n", "\"float beta_n\" 0.5"}},
     {},
     {"beta_m", "beta_n", "alpha"},
     false,
     false}};

/// What can be no texture.
TEST(ConstructMaterial, SubsurfaceNumbersHaveTheirEffect) {
  for (const std::string type : {"subsurface", "kdsubsurface"}) {
    for (const std::string name : {"scale", "g", "eta"}) {
      const std::string base = "Material \"" + type + "\" ", given = "\"float " + name + "\" 0.7 ";
      expectEffects({{base + kShape, base + given + kShape}, {base + kShape, base + kShape + ' ' + given}},
                    with, values);
    }
  }
  const std::string named = "Material \"subsurface\" \"string name\" \"Ketchup\" ";
  expectSame({{named + kShape,
               "Material \"subsurface\" \"rgb sigma_a\" [ .061 .97 1.45 ] \"rgb sigma_s\" [ .18 "
               ".07 .03 ]" +
                   kShape},
              {named + "\"float g\" 0.5" + kShape, named + kShape}},
             with, values);
}

TEST(ConstructMaterial, HairTakesOneSourceOfItsColour) {
  expectSame({{"Material \"hair\"" + kShape, "Material \"hair\" \"float eumelanin\" 1.3" + kShape}}, with,
             values);
  const Attempt a = with("Material \"hair\" \"rgb color\" [ .3 .2 .1 ] \"float eumelanin\" 1" + kShape);
  EXPECT_TRUE(a.warns("parameter \"eumelanin\" has no effect beside \"color\"")) << a.messages();
  EXPECT_EQ(values(a), values(with("Material \"hair\" \"rgb color\" [ .3 .2 .1 ]" + kShape)));
}

TEST(ConstructMaterial, AFourierMaterialWithoutItsTableIsBlack) {
  const Numbers black = values(with("Material \"matte\" \"rgb Kd\" [ 0 0 0 ]" + kShape));
  const Attempt none = with("Material \"fourier\"" + kShape);
  EXPECT_TRUE(none.warns("parameter \"bsdffile\" is missing; the surface is black")) << none.messages();
  EXPECT_EQ(values(none), black);
  const Attempt missing = with("Material \"fourier\" \"string bsdffile\" \"none.bsdf\"" + kShape);
  EXPECT_TRUE(missing.warns("the surface is black, as in PBRT-v3")) << missing.messages();
  EXPECT_EQ(values(missing), black);
}

TEST(ConstructMaterial, ABrokenTableIsToldWhereItsNameStands) {
  const std::filesystem::path file = sourceDir() / "LICENSE";
  const Attempt broken =
      with("Material \"fourier\"\nShape \"sphere\" \"string bsdffile\" \"" + file.string() + "\"");
  const Diagnostic* const told = broken.find(Severity::Warning, "not a tabulated BSDF");
  ASSERT_NE(told, nullptr) << broken.messages();
  EXPECT_EQ(told->location.line, 3) << broken.messages();
  EXPECT_NE(told->message.find("Shape \"sphere\""), std::string::npos) << told->message;
}

TEST(ConstructMaterial, SaysThatLightBelowTheSurfaceIsNotKnownForAnyIndex) {
  const std::string below = "where light goes below the surface";
  for (const std::string type : {"subsurface", "kdsubsurface"}) {
    for (const char* eta : {".3", "3"}) {
      const Attempt a = with("Material \"" + type + "\" \"float eta\" " + eta + kShape);
      EXPECT_TRUE(a.warns(below)) << a.messages();
      for (const double v : values(a)) EXPECT_TRUE(std::isfinite(v));
    }
    EXPECT_TRUE(with("Material \"" + type + "\" \"float eta\" 2.8" + kShape).isSilent());
    EXPECT_TRUE(with("Material \"" + type + "\" \"float eta\" .36" + kShape).isSilent());
    const Attempt onShape = with("Material \"" + type + "\"\n" + kShape + " \"float eta\" 3");
    const Diagnostic* const told = onShape.find(Severity::Warning, below);
    ASSERT_NE(told, nullptr) << onShape.messages();
    EXPECT_EQ(told->location.line, 3);
  }
  const std::string disney = "Material \"disney\" \"float eta\" 4 ";
  EXPECT_FALSE(with(disney + kShape).warns(below));
  EXPECT_TRUE(with(disney + "\"rgb scatterdistance\" [ 1 1 1 ]" + kShape).warns(below));
  EXPECT_FALSE(
      with(disney + "\"rgb scatterdistance\" [ 1 1 1 ] \"bool thin\" \"true\"" + kShape).warns(below));
}

TEST(ConstructMaterial, SaysWhatScatteringBelowSurfacesNeeds) {
  const std::string subsurface = "Material \"subsurface\" ";
  const Attempt a = attemptWorld(subsurface + kShape);
  EXPECT_FALSE(a.warns("scattering below surfaces")) << a.messages();
  const std::string mix =
      "MakeNamedMaterial \"a\" \"string type\" \"matte\" MakeNamedMaterial \"b\" \"string type\" "
      "\"subsurface\" Material \"mix\" ";
  EXPECT_TRUE(attemptWorld(mix + "\"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"" + kShape)
                  .warns("nothing scatters below the surface of \"namedmaterial2\""));
  EXPECT_FALSE(attemptWorld(mix + "\"string namedmaterial1\" \"b\" \"string namedmaterial2\" \"a\"" + kShape)
                   .warns("nothing scatters"));
}

TEST(ConstructMaterial, EveryParameterHasItsEffectAsConstantTextureAndOnTheShape) {
  for (const Parameters& m : kAll) {
    std::vector<Effect> effects;
    const std::string base = m.with("", "");
    const auto both = [&](const std::string& name, const std::string& parameter) {
      effects.push_back({base + kShape, m.with(name, parameter) + kShape});
      effects.push_back({base + kShape, base + kShape + ' ' + parameter});
    };
    for (const std::string& name : m.spectra) {
      both(name, "\"rgb " + name + "\" [ 0.3 0.4 0.5 ]");
      both(name, "\"texture " + name + "\" \"s\"");
    }
    for (const std::string& name : m.floats) {
      both(name, "\"float " + name + "\" 0.3");
      both(name, "\"texture " + name + "\" \"f\"");
    }
    if (m.remaps) both("remaproughness", "\"bool remaproughness\" \"false\"");
    if (m.bumps) both("bumpmap", "\"texture bumpmap\" \"bumps\"");
    expectEffects(effects, with, values);
  }
}

TEST(ConstructMaterial, HasTheDefaultsOfTheLanguage) {
  expectSame(
      {{kShape, "Material \"matte\"" + kShape},
       {kShape, "Material \"matte\" \"rgb Kd\" [ 0.5 0.5 0.5 ] \"float sigma\" 0" + kShape},
       {"Material \"plastic\"" + kShape,
        "Material \"plastic\" \"rgb Kd\" [ .25 .25 .25 ] \"rgb Ks\" [ .25 .25 .25 ] \"float roughness\" 0.1" +
            kShape},
       {"Material \"glass\"" + kShape, "Material \"glass\" \"float index\" 3 \"float eta\" 1.5" + kShape},
       {"Material \"mirror\"" + kShape, "Material \"mirror\" \"rgb Kr\" [ .9 .9 .9 ]" + kShape},
       {"Material \"metal\"" + kShape, "Material \"metal\" \"float roughness\" 0.01" + kShape},
       {"Material \"metal\" \"float roughness\" 0.2" + kShape,
        "Material \"metal\" \"float uroughness\" 0.2 \"float vroughness\" 0.2" + kShape},
       {"Material \"uber\" \"float uroughness\" 0.2" + kShape,
        "Material \"uber\" \"float uroughness\" 0.2 \"float vroughness\" 0.2" + kShape},
       {"Material \"substrate\"" + kShape,
        "Material \"substrate\" \"rgb Kd\" [ .5 .5 .5 ] \"float uroughness\" 0.1 \"bool remaproughness\" "
        "\"true\"" +
            kShape},
       {"Material \"translucent\"" + kShape,
        "Material \"translucent\" \"rgb reflect\" [ .5 .5 .5 ]" + kShape}},
      with, values);
}

TEST(ConstructMaterial, SaysWhatIsWrongAndWhere) {
  const std::string named = "MakeNamedMaterial \"a\" \"string type\" \"matte\" ";
  expectMistakes(
      {{"Material \"mate\"", "Material: unknown type \"mate\"; did you mean \"matte\"?", "t.pbrt:2:10",
        kTolerated},
       {"Material \"velvet\"", "unknown type \"velvet\"", "t.pbrt:2:10", kTolerated},
       {"MakeNamedMaterial \"n\" \"string type\" \"mate\"", "material \"n\": unknown type \"mate\"",
        "t.pbrt:2:37", kTolerated},
       {"Material \"matte\" \"float Kd\" 0.5", "parameter \"Kd\": found type float, expected ", "t.pbrt:2:18",
        kTolerated},
       {"Material \"matte\" \"rgb kd\" [ 1 1 1 ]", "unknown parameter \"kd\"; did you mean \"Kd\"?",
        "t.pbrt:2:18", kTolerated},
       {"Material \"glass\" \"float roughness\" 0.1", "unknown parameter \"roughness\"", "", kTolerated},
       {"Material \"glass\" \"float eta\" -1", "parameter \"eta\": found -1, expected >= 0", "t.pbrt:2:30",
        kTolerated},
       {"Material \"matte\" \"float sigma\" [ 1 2 ]", "found 2 values, expected 1", "", kTolerated},
       {"Material \"matte\" \"rgb Kd\" [ ]", "found an empty list, expected a value or a texture", "",
        kTolerated},
       {"Material \"matte\" \"texture Kd\" \"nil\"", "unknown spectrum texture \"nil\"; none is defined here",
        "t.pbrt:2:31", kTolerated},
       {kTextures + "Material \"matte\" \"texture Kd\" \"f\"",
        "texture \"f\" is a float texture, expected a spectrum texture", "", kTolerated},
       {kTextures + "Material \"matte\" \"texture sigma\" \"bumsp\"",
        "unknown float texture \"bumsp\"; did you mean \"bumps\"?", "", kTolerated},
       {named + "Material \"mix\" \"string namedmaterial1\" \"a\"", "parameter \"namedmaterial2\" is missing",
        "", kTolerated},
       {named + "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"",
        "unknown material \"b\"; known: a", "", kTolerated},
       {"MakeNamedMaterial \"a\" \"string type\" \"\" Material \"mix\" \"string namedmaterial1\" \"a\" "
        "\"string namedmaterial2\" \"a\"",
        "cannot mix with a material of type \"none\"", ""}},
      onSphere);
  expectMistakes({{"Shape \"sphere\" \"rgb kd\" [ 1 1 1 ]", "unknown parameter \"kd\"; did you mean \"Kd\"?",
                   "t.pbrt:2:16", kTolerated},
                  {"Material \"none\" Shape \"sphere\" \"rgb Kd\" [ 1 1 1 ]", "unknown parameter \"Kd\"", "",
                   kTolerated},
                  {"Material \"none\" \"rgb Kd\" [ 1 1 1 ] Shape \"sphere\"", "unknown parameter \"Kd\"", "",
                   kTolerated}},
                 with);
}

TEST(ConstructMaterial, AnUnknownTypeIsTheOnlyComplaint) {
  const Attempt a = onSphere("Material \"mate\" \"rgb Kd\" [ 1 1 1 ] \"float eta\" 2 ");
  EXPECT_EQ(a.diagnostics.all().size(), 1u) << a.messages();
  const Attempt shape = with("Material \"mate\" Shape \"sphere\" \"float eta\" 2");
  EXPECT_EQ(shape.diagnostics.all().size(), 1u) << shape.messages();
}

TEST(ConstructMaterial, MakesAMatteOfAnUnknownType) {
  const Attempt a =
      attemptWorld("Material \"velvet\" \"rgb Kd\" [ .1 .2 .3 ] \"rgb color\" [ 1 1 1 ]" + kShape);
  ASSERT_TRUE(a.warns("unknown type \"velvet\"")) << a.messages();
  EXPECT_FALSE(a.warns("color")) << "nobody can tell what is right";
  EXPECT_EQ(values(a), values(with("Material \"matte\" \"rgb Kd\" [ .1 .2 .3 ]" + kShape)));
}

TEST(ConstructMaterial, TakesTheDefaultForATextureOfAnUnknownClass) {
  const std::string unknown =
      "Texture \"f\" \"float\" \"pctx\" \"string filename\" \"x\" Texture \"s\" \"spectrum\" \"pctx\" ";
  const auto tolerated = [&](const std::string& world) {
    const Attempt a = attemptWorld(unknown + world);
    EXPECT_TRUE(a.warns("unknown type \"pctx\"")) << a.messages();
    return values(a);
  };
  EXPECT_EQ(tolerated("Material \"matte\" \"texture Kd\" \"s\" \"texture bumpmap\" \"f\"" + kShape),
            values(with(kShape)));
  EXPECT_EQ(tolerated("Material \"glass\" \"texture eta\" \"f\"" + kShape),
            values(with("Material \"glass\"" + kShape)));
  EXPECT_EQ(tolerated("Material \"metal\" \"texture uroughness\" \"f\"" + kShape),
            values(with("Material \"metal\"" + kShape)));
}

// ---- Which value counts (reference 3.3, 3.4)

TEST(ConstructTexturable, ATextureWinsOverAConstantAndTheShapeOverTheMaterial) {
  const std::string s2 = "Texture \"s2\" \"spectrum\" \"constant\" \"rgb value\" [ 0.7 0.7 0.7 ] ";
  const std::string constant = "\"rgb Kd\" [ .1 .1 .1 ] ", texture = "\"texture Kd\" \"s\" ",
                    other = "\"texture Kd\" \"s2\" ";
  const auto is = [&](const std::string& value) { return "Material \"matte\" \"rgb Kd\" " + value + kShape; };
  const std::string start = kTextures + s2;
  expectSame(
      {{start + material("matte", texture + constant) + kShape, is("[ .3 .4 .5 ]")},
       {start + material("matte", constant + texture) + kShape, is("[ .3 .4 .5 ]")},
       {start + material("matte", texture) + kShape + constant, is("[ .1 .1 .1 ]")},
       {start + material("matte", texture) + kShape + other, is("[ .7 .7 .7 ]")},
       {start + material("matte", texture) + kShape + other + constant, is("[ .7 .7 .7 ]")},
       {start + "MakeNamedMaterial \"m\" \"string type\" \"matte\" NamedMaterial \"m\" " + kShape + other,
        is("[ .7 .7 .7 ]")},
       {start + kShape + other, is("[ .7 .7 .7 ]")}},
      with, values);
}

TEST(ConstructTexturable, AShapeThatOverridesLeavesTheOthersAlone) {
  const std::string world = "Material \"matte\" \"rgb Kd\" [ .1 .1 .1 ] ";
  const Attempt alone = with(world + kShape);
  const Attempt first = with(world + kShape + " Translate 50 0 0 Shape \"sphere\" \"rgb Kd\" [ 1 1 1 ]");
  EXPECT_EQ(values(alone), values(first));
}

TEST(ConstructTexturable, NamesMeanWhatTheyMeanWhereTheyStand) {
  const std::string red = "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [ 1 0 0 ] ";
  const std::string blue = "Texture \"c\" \"spectrum\" \"constant\" \"rgb value\" [ 0 0 1 ] ";
  const auto measured = [](const std::string& world) {  // redefinition warns, as in PBRT-v3
    const Attempt a = attemptWorld(world);
    EXPECT_TRUE(a.made.has_value()) << a.messages();
    return a.made ? values(a) : Numbers{};
  };
  const std::string matte = "Material \"matte\" \"texture Kd\" \"c\" ";
  const auto plain = [&](const std::string& parameters) {
    return measured("Material \"matte\" " + parameters + kShape);
  };
  // A built material keeps the older meaning.
  EXPECT_EQ(measured(red + matte + blue + kShape), plain("\"rgb Kd\" [ 1 0 0 ]"));
  // A shape that overrides anything gives all names the meaning they have at the Shape.
  EXPECT_EQ(measured(red + matte + blue + kShape + " \"float sigma\" 20"),
            plain("\"rgb Kd\" [ 0 0 1 ] \"float sigma\" 20"));
  // Definitions in an attribute block end with it.
  EXPECT_EQ(measured(red + "AttributeBegin " + blue + "AttributeEnd " + matte + kShape),
            plain("\"rgb Kd\" [ 1 0 0 ]"));
  EXPECT_TRUE(with("AttributeBegin " + red + "AttributeEnd " + matte + kShape)
                  .warns("unknown spectrum texture \"c\""));
}

TEST(ConstructMix, AmountOneShowsTheFirstMaterial) {
  const std::string parts =
      "MakeNamedMaterial \"a\" \"string type\" \"matte\" \"rgb Kd\" [ 1 0 0 ] "
      "MakeNamedMaterial \"b\" \"string type\" \"mirror\" ";
  const std::string mix =
      parts + "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" ";
  expectSame({{mix + "\"rgb amount\" [ 1 1 1 ]" + kShape, "Material \"matte\" \"rgb Kd\" [ 1 0 0 ]" + kShape},
              {mix + kShape, mix + "\"rgb amount\" [ .5 .5 .5 ]" + kShape}},
             with, bsdfValues);  // a mix of two has both lobes whatever their weights
  expectEffects({{mix + kShape, mix + "\"rgb amount\" [ .2 .5 .5 ]" + kShape},
                 {mix + kShape, mix + kShape + "\"rgb amount\" [ .2 .5 .5 ]"},
                 {kTextures + mix + kShape, kTextures + mix + "\"texture amount\" \"s\"" + kShape},
                 {mix + kShape, mix + kShape + "\"string namedmaterial2\" \"a\""}},
                with, values);
}

TEST(ConstructMix, TheNamesOfAnOverridingShapeAreThoseAtTheShape) {
  const auto named = [](const std::string& name, const std::string& kd) {
    return "MakeNamedMaterial \"" + name + "\" \"string type\" \"matte\" \"rgb Kd\" " + kd + ' ';
  };
  const std::string mix = "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"a\" ";
  const Attempt kept = attemptWorld(named("a", "[ 1 0 0 ]") + mix + named("a", "[ 0 0 1 ]") + kShape);
  const Attempt renewed = attemptWorld(named("a", "[ 1 0 0 ]") + mix + named("a", "[ 0 0 1 ]") + kShape +
                                       " \"rgb amount\" [ .5 .5 .5 ]");
  ASSERT_TRUE(kept.made && renewed.made) << kept.messages() << renewed.messages();
  EXPECT_EQ(values(kept), values(with(named("a", "[ 1 0 0 ]") + mix + kShape)));
  EXPECT_EQ(values(renewed), values(with(named("a", "[ 0 0 1 ]") + mix + kShape)));
}

TEST(ConstructMix, RefusesTooManyLobesAndEndlessNesting) {
  std::string world = "MakeNamedMaterial \"m0\" \"string type\" \"matte\" ";
  for (int i = 1; i <= 400; ++i) {
    const std::string inner = "\"m" + std::to_string(i - 1) + "\" ";
    world += "MakeNamedMaterial \"m" + std::to_string(i) +
             "\" \"string type\" \"mix\" \"string namedmaterial1\" " + inner + "\"string namedmaterial2\" " +
             inner;
  }
  EXPECT_TRUE(with(world + "NamedMaterial \"m4\"" + kShape).failsWith("lobes"));
  EXPECT_TRUE(
      with(world + "NamedMaterial \"m400\"" + kShape).failsWith("is nested more than 256 materials deep"));
}

}  // namespace
}  // namespace pbrtmedia::test
