// SPDX-License-Identifier: BSD-2-Clause
#include "construct/integrators.h"

#include "construct/probe.h"

namespace pbrtmedia::test {
namespace {

/// Two mirrors and two walls that face each other, under three lights.
const std::string kRest =
    "\nFilm \"image\" \"integer xresolution\" 6 \"integer yresolution\" 6 "
    "Sampler \"random\" \"integer pixelsamples\" 4 Translate 0 0 1.5 Camera \"perspective\" WorldBegin "
    "LightSource \"point\" \"point from\" [ 0 0.5 0 ] LightSource \"infinite\" "
    "LightSource \"point\" \"point from\" [ 0.9 0 0 ] \"rgb I\" [ 9 3 1 ] "
    "Material \"matte\" \"rgb Kd\" [ 0.9 0.9 0.9 ] "
    "Shape \"cylinder\" \"float zmin\" -3 \"float zmax\" 3 "
    "AttributeBegin Material \"mirror\" Shape \"disk\" \"float height\" 2 "
    "Shape \"disk\" \"float height\" -2 AttributeEnd WorldEnd";
Attempt with(const std::string& integrator) { return attempt(integrator + kRest); }

TEST(ConstructIntegrator, EveryParameterHasItsEffect) {
  std::vector<Effect> effects{
      {"Integrator \"directlighting\"", "Integrator \"directlighting\" \"string strategy\" \"one\""},
      {"Integrator \"path\"", "Integrator \"whitted\""}};
  for (const std::string type : {"path", "volpath", "directlighting", "whitted", "bdpt"}) {
    const std::string integrator = "Integrator \"" + type + '"';
    effects.push_back({integrator, integrator + " \"integer maxdepth\" 1"});
    effects.push_back({integrator, integrator + " \"integer pixelbounds\" [ 1 3 1 4 ]"});
  }
  for (const std::string type : {"path", "volpath"}) {
    const std::string deep = "Integrator \"" + type + "\" \"integer maxdepth\" 12";
    effects.push_back({deep, deep + " \"float rrthreshold\" 0"});
    effects.push_back({deep, deep + " \"string lightsamplestrategy\" \"uniform\""});
    effects.push_back({deep, deep + " \"string lightsamplestrategy\" \"power\""});
    effects.push_back({deep, deep + " \"string lightsamplestrategy\" \"spatial\""});
  }
  for (const char* strategy : {"uniform", "spatial", "tree"}) {
    effects.push_back(
        {"Integrator \"bdpt\"",
         std::string("Integrator \"bdpt\" \"string lightsamplestrategy\" \"") + strategy + '"'});
  }
  expectEffects(effects, with, rendered);
  expectSame({{"",
               "Integrator \"path\" \"integer maxdepth\" 5 \"float rrthreshold\" 1 "
               "\"string lightsamplestrategy\" \"tree\""},
              {"Integrator \"directlighting\"",
               "Integrator \"directlighting\" \"string strategy\" \"all\" \"integer maxdepth\" 5"}},
             with, rendered);
}

TEST(ConstructIntegrator, SppmHasItsParameters) {
  const std::string sppm = "Integrator \"sppm\" \"integer iterations\" 4 \"float radius\" 0.2";
  expectEffects({{"Integrator \"path\"", sppm},
                 {sppm, "Integrator \"sppm\" \"integer iterations\" 5 \"float radius\" 0.2"},
                 {sppm, "Integrator \"sppm\" \"integer iterations\" 4 \"float radius\" 0.3"},
                 {sppm, sppm + " \"integer maxdepth\" 3"},
                 {sppm, sppm + " \"integer photonsperiteration\" 500"},
                 {sppm, sppm + " \"integer pixelbounds\" [ 1 3 1 4 ]"}},
                with, rendered);
  expectSame({{sppm, "Integrator \"sppm\" \"integer numiterations\" 4 \"float radius\" 0.2"},
              {sppm, sppm + " \"integer numiterations\" 9"},
              {sppm, sppm + " \"integer maxdepth\" 5 \"integer photonsperiteration\" 36"},
              {sppm, sppm + " \"integer photonsperiteration\" -7"},
              {"Integrator \"sppm\"", "Integrator \"sppm\" \"integer iterations\" 64 \"float radius\" 1"}},
             with, rendered);
  EXPECT_EQ(with(sppm).made->sampler->samplesPerPixel(), 4);
  const auto iterations = [](const ConstructOptions& options) {
    return attempt("Integrator \"sppm\"" + kRest, {.build = options}).made->sampler->samplesPerPixel();
  };
  EXPECT_EQ(iterations({.quick = true}), 4);
  EXPECT_EQ(iterations({.samplesPerPixel = 7}), 7);
  EXPECT_TRUE(with(sppm + " \"integer imagewritefrequency\" 8").warns("written once"));
}

TEST(ConstructIntegrator, MltHasItsParameters) {
  const std::string few = " \"integer bootstrapsamples\" 200 \"integer mutationsperpixel\" 4",
                    mlt = "Integrator \"mlt\"" + few;
  expectEffects({{"Integrator \"path\"", mlt},
                 {mlt, "Integrator \"mlt\" \"integer bootstrapsamples\" 200 \"integer mutationsperpixel\" 5"},
                 {mlt, "Integrator \"mlt\" \"integer bootstrapsamples\" 201 \"integer mutationsperpixel\" 4"},
                 {mlt, mlt + " \"integer maxdepth\" 3"},
                 {mlt, mlt + " \"integer chains\" 9"},
                 {mlt, mlt + " \"integer chains\" 9 \"float largestepprobability\" 1"},
                 {mlt, mlt + " \"integer chains\" 9 \"float sigma\" .2"},
                 {mlt, mlt + " \"integer pixelbounds\" [ 1 3 1 4 ]"}},
                with, rendered);
  expectSame({{mlt, mlt + " \"integer maxdepth\" 5 \"integer chains\" 1000 \"float largestepprobability\" .3 "
                          "\"float sigma\" .01"}},
             with, rendered);
  const auto mutations = [](const ConstructOptions& options) {
    return attempt("Integrator \"mlt\"" + kRest, {.build = options}).made->sampler->samplesPerPixel();
  };
  EXPECT_EQ(mutations({}), 100);
  EXPECT_EQ(mutations({.quick = true}), 6);
  EXPECT_EQ(mutations({.samplesPerPixel = 7}), 7);
  EXPECT_TRUE(with(mlt).isSilent()) << with(mlt).messages();
}

TEST(ConstructIntegrator, SppmIsDebiasedInSeveralWays) {
  const std::string sppm = "Integrator \"sppm\" \"integer iterations\" 4 \"float radius\" 0.4";
  const auto debias = [&](const char* kind) { return sppm + " \"string debias\" \"" + kind + '"'; };
  const std::string single = debias("single"), progressive = debias("progressive"),
                    both = debias("progressive-unbiased");
  expectEffects({{sppm, single},
                 {sppm, progressive},
                 {single, progressive},
                 {single, both},
                 {progressive, both},
                 {single, single + " \"float alpha\" 0.5"},
                 {single, single + " \"float c\" 0.499"},
                 {progressive, progressive + " \"float alpha\" 0.5"},
                 {sppm, sppm + " \"string kernel\" \"cone\""},
                 {single, single + " \"string kernel\" \"uniform\""},
                 {single, single + " \"string kernel\" \"quadratic\""},
                 {single, single + " \"string kernel\" \"quartic\""}},
                with, rendered);
  expectSame({{sppm, debias("none")},
              {sppm, sppm + " \"string kernel\" \"uniform\""},
              {single, single + " \"string kernel\" \"cone\" \"float alpha\" 0.66666667 \"float c\" 1.001"}},
             with, rendered);
  EXPECT_TRUE(with(single).made->film->keepsNegatives());
  EXPECT_TRUE(with(both).made->film->keepsNegatives());
  EXPECT_FALSE(with(progressive).made->film->keepsNegatives());
  EXPECT_FALSE(with(sppm).made->film->keepsNegatives());
  expectMistakes({{debias("singel"), "unknown debias \"singel\"; did you mean \"single\"?", ""},
                  {sppm + " \"string kernel\" \"gauss\"", "unknown kernel \"gauss\"", ""},
                  {single + " \"float alpha\" 1", "\"alpha\"", ""},
                  {single + " \"float c\" 0", "\"c\"", ""},
                  {sppm + " \"integer photonsperiteration\" 2000000000", "held in memory", "", kTolerated}},
                 with);
  EXPECT_TRUE(with(sppm + " \"float alpha\" 0.5").warns("\"alpha\" has no effect with \"debias\" \"none\""));
  EXPECT_TRUE(with(progressive + " \"float c\" 0.5").warns("\"c\" has no effect"));
  EXPECT_TRUE(with(single).isSilent()) << with(single).messages();
}

TEST(ConstructIntegrator, SppmSaysWhatPhotonsCannotTell) {
  const auto with = [](const std::string& medium) {
    return attempt("Integrator \"sppm\"" +
                   std::string(" WorldBegin LightSource \"point\" MakeNamedMedium \"m\" ") + medium +
                   " Material \"none\" MediumInterface \"m\" \"\" Shape \"sphere\" WorldEnd");
  };
  const std::string grid = "\"string type\" \"heterogeneous\" \"float density\" 1 ";
  EXPECT_TRUE(with(grid).isSilent()) << with(grid).messages();
  const std::string glow = "\"string type\" \"homogeneous\" \"rgb Le\" [ 1 1 1 ] ";
  EXPECT_TRUE(with(grid + "\"rgb Le\" [ 1 1 1 ]").isSilent());
  EXPECT_TRUE(with(glow).isSilent()) << with(glow).messages();
  const Attempt endless = attempt(
      "Integrator \"sppm\" MakeNamedMedium \"m\" " + glow +
      "MediumInterface \"\" \"m\" Camera \"perspective\" WorldBegin LightSource \"point\" Shape \"sphere\" "
      "WorldEnd");
  EXPECT_TRUE(endless.warns("medium \"m\" emits, and as nothing encloses it")) << endless.messages();
  const std::string linear = "\"string law\" \"linear\"";
  EXPECT_TRUE(with(grid + linear).isSilent()) << with(grid + linear).messages();
}

TEST(ConstructIntegrator, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{"Integrator \"volpaht\"", "Integrator: unknown type \"volpaht\"; did you mean \"volpath\"?",
        "t.pbrt:1:12"},
       {"Integrator \"bdtp\"", "unknown type \"bdtp\"", "t.pbrt:1:12"},
       {"Integrator \"path\" \"integer maxdepth\" -1", "\"maxdepth\": found -1, expected in [0, ", "",
        kTolerated},
       {"Integrator \"path\" \"float maxdepth\" 5", "found type float, expected integer", "t.pbrt:1:19",
        kTolerated},
       {"Integrator \"path\" \"float rrthreshold\" -1", "expected >= 0", "", kTolerated},
       {"Integrator \"path\" \"string lightsamplestrategy\" \"pwoer\"",
        "unknown lightsamplestrategy \"pwoer\"; did you mean \"power\"?", "t.pbrt:1:48", kTolerated},
       {"Integrator \"directlighting\" \"string strategy\" \"each\"",
        "unknown strategy \"each\"; known: ", "", kTolerated},
       {"Integrator \"whitted\" \"float rrthreshold\" 1", "unknown parameter \"rrthreshold\"", "",
        kTolerated},
       {"Integrator \"ambientocclusion\" \"integer nsamples\" 0", "\"nsamples\": found 0, expected in [1, ",
        "", kTolerated},
       {"Integrator \"sppm\" \"integer iterations\" 0", "\"iterations\": found 0, expected >= 1", "",
        kTolerated},
       {"Integrator \"sppm\" \"float radius\" 0", "\"radius\"", ""},
       {"Integrator \"mlt\" \"integer chains\" 0", "\"chains\": found 0, expected in [1, ", "", kTolerated},
       {"Integrator \"mlt\" \"float largestepprobability\" 2", "found 2, expected in [0, 1]", "", kTolerated},
       {"Integrator \"mlt\" \"float sigma\" -1", "expected >= 0", "", kTolerated},
       {"Integrator \"sppm\" \"float rrthreshold\" 1", "unknown parameter \"rrthreshold\"", "", kTolerated},
       {"Integrator \"ambientocclusion\" \"integer maxdepth\" 5", "unknown parameter \"maxdepth\"", "",
        kTolerated},
       {"Integrator \"path\" \"integer pixelbounds\" [ 0 1 ]", "found 2 numbers, expected 4: x0 x1 y0 y1", "",
        kTolerated},
       {"Integrator \"path\" \"integer pixelbounds\" [ 2 1 0 4 ]", "the rectangle holds no pixel", ""},
       {"Integrator \"path\" \"integer pixelbounds\" [ 100 200 0 4 ]", "lies outside the rendered image",
        "t.pbrt:1:1"}},
      with);
  EXPECT_TRUE(attempt("Integrator \"x\"" + kRest).failsWith("unknown type"));
  EXPECT_TRUE(attempt("Integrator \"path\" \"string lightsamplestrategy\" \"x\"" + kRest)
                  .warns("unknown lightsamplestrategy"));
}

TEST(ConstructIntegrator, SaysThatOnlyVolpathRendersMedia) {
  const std::string world =
      "\nFilm \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin LightSource "
      "\"infinite\" "
      "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" MediumInterface \"m\" \"\" Shape \"sphere\" "
      "WorldEnd";
  for (const std::string type : {"path", "directlighting", "whitted", "ambientocclusion"}) {
    const Attempt a = attempt("Integrator \"" + type + '"' + world);
    EXPECT_TRUE(a.warns("does not render participating media")) << a.messages();
    EXPECT_EQ(placeOf(a.find(Severity::Warning, "media")), "t.pbrt:1:1");
  }
  EXPECT_TRUE(attempt("Integrator \"volpath\"" + world).isSilent());
}

/// A ball on a floor, without lights.
Attempt openWith(const std::string& integrator, const ConstructOptions& options = {}) {
  return attempt(
      integrator +
          " Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 24 Sampler \"random\" "
          "LookAt 0 -4 1  0 0 0  0 0 1 Camera \"perspective\" WorldBegin Shape \"sphere\" "
          "Translate 0 0 -1 Shape \"disk\" \"float radius\" 9 WorldEnd",
      {.build = options});
}

TEST(ConstructIntegrator, AmbientOcclusionHasItsParametersAndNeedsNoLights) {
  const std::string occlusion = "Integrator \"ambientocclusion\"";
  const auto with = [](const std::string& integrator) { return openWith(integrator); };
  EXPECT_TRUE(openWith(occlusion).isSilent()) << openWith(occlusion).messages();
  EXPECT_TRUE(openWith("Integrator \"path\"").warns("no lights"));
  expectEffects({{occlusion, occlusion + " \"integer nsamples\" 3"},
                 {occlusion, occlusion + " \"bool cossample\" \"false\""},
                 {occlusion, occlusion + " \"integer pixelbounds\" [ 1 3 1 4 ]"}},
                with, rendered);
  expectSame({{occlusion, occlusion + " \"integer nsamples\" 64 \"bool cossample\" \"true\""}}, with,
             rendered);
  EXPECT_EQ(rendered(openWith(occlusion, {.quick = true})),
            rendered(openWith(occlusion + " \"integer nsamples\" 1", {.quick = true})));
}

TEST(ConstructAccelerator, ChecksWhatHasNoEffect) {
  for (const std::string good :
       {"Accelerator \"bvh\" \"string splitmethod\" \"hlbvh\" \"integer maxnodeprims\" 8",
        "Accelerator \"kdtree\" \"integer intersectcost\" 8 \"integer traversalcost\" 2 \"float emptybonus\" "
        "0.1 "
        "\"integer maxprims\" 3 \"integer maxdepth\" 9"}) {
    EXPECT_TRUE(with(good).isSilent()) << with(good).messages();
  }
  expectMistakes(
      {{"Accelerator \"bhv\"", "Accelerator: unknown type \"bhv\"; did you mean \"bvh\"?", "t.pbrt:1:13",
        kTolerated},
       {"Accelerator \"bvh\" \"string splitmethod\" \"x\"", "unknown splitmethod \"x\"", "", kTolerated},
       {"Accelerator \"kdtree\" \"integer maxnodeprims\" 1", "unknown parameter", "", kTolerated}},
      with);
}

}  // namespace
}  // namespace pbrtmedia::test
