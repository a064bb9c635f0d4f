// SPDX-License-Identifier: BSD-2-Clause
// How media with a density are tracked, as scenes choose it: free flights, patterns, super-voxels, bounds.
#include <set>

#include "construct/probe.h"
#include "freeflight/flight_list.h"
#include "transmittance/estimator_list.h"

namespace pbrtmedia::test {
namespace {

const std::string kGrid =
    "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer nz\" 3 \"rgb sigma_s\" [ 10 10 10 ] "
    "\"rgb sigma_a\" [ 20 20 20 ] \"float density\" [ 0.1 0.2 0.3 0.4 0.5 0.6 ] ";
const std::string kPerlin =
    "\"string type\" \"perlin\" \"integer octaves\" 2 \"float threshold\" 0.2 \"rgb sigma_s\" [ 30 30 30 ] "
    "\"rgb sigma_a\" [ 20 20 20 ] ";

Attempt with(const std::string& parameters) {
  return attemptWorld("MakeNamedMedium \"m\" " + parameters +
                      "\nMediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"");
}

std::string quoted(const ParameterDescription& d) {
  const std::string value = d.type == "string" || d.type == "bool" ? '"' + d.value + '"' : d.value;
  return " \"" + d.type + " " + d.name + "\" " + value;
}

TEST(ConstructFreeFlight, EverySamplerOfTheListCanBeNamedWithItsParameters) {
  for (const std::string_view name : flightNames()) {
    const std::string named = kGrid + "\"string freeflight\" \"" + std::string(name) + "\"";
    const AnyFlight sampler = *findFlight(name);
    std::string all = named;
    for (const ParameterDescription& d : parametersOf(sampler)) all += quoted(d);
    const Attempt bare = with(named), spelled = with(all);
    ASSERT_TRUE(bare.made) << name << ": " << bare.messages();
    ASSERT_TRUE(spelled.made) << name << ": " << spelled.messages();
    EXPECT_EQ(media(bare), media(spelled)) << name;
    EXPECT_NE(mediumOf(bare)->describe().find("free flights " + std::string(name)), std::string::npos)
        << mediumOf(bare)->describe();
    const FlightTraits traits = traitsOf(sampler);
    if (traits.bias == EstimatorTraits::Bias::Unbiased) {
      EXPECT_TRUE(bare.isSilent()) << bare.messages();
    } else {
      EXPECT_TRUE(bare.warns("\" is " + std::string(nameOf(traits.bias)))) << bare.messages();
    }
  }
}

TEST(ConstructFreeFlight, NoParameterMeansTwoThings) {
  for (const std::string_view samplerName : flightNames()) {
    for (const std::string_view estimatorName : estimatorNames()) {
      std::set<std::string> names;
      for (const ParameterDescription& d : parametersOf(*findFlight(samplerName))) names.insert(d.name);
      for (const ParameterDescription& d : parametersOf(*findEstimator(estimatorName)))
        EXPECT_EQ(names.count(d.name), 0u) << samplerName << " and " << estimatorName << " have " << d.name;
    }
  }
}

TEST(ConstructFreeFlight, ParametersHaveTheirEffectAndMistakesAreTold) {
  const std::string single = kGrid + "\"string freeflight\" \"single-particle\" ",
                    marched = kGrid + "\"string freeflight\" \"ray-marching\" ";
  EXPECT_NE(media(with(single)), media(with(single + "\"float boundscale\" 0.5")));
  EXPECT_NE(media(with(marched)), media(with(marched + "\"integer flightsteps\" 3")));
  EXPECT_NE(media(with(kGrid)), media(with(kGrid + "\"string freeflight\" \"regular\"")));
  EXPECT_EQ(media(with(kGrid)), media(with(kGrid + "\"string freeflight\" \"auto\"")));
  // The default serves the laws that are mixtures; for others the first that is unbiased.
  const std::string pink = kGrid + "\"string law\" \"pinknoise\" ",
                    linear = kGrid + "\"string law\" \"linear\" ";
  const std::string unproven = "\"string bounds\" \"progressive\" ",
                    debiased = "\"string freeflight\" \"debiased-ray-marching\" ";
  EXPECT_EQ(media(with(pink)), media(with(pink + "\"string freeflight\" \"weighted-delta\"")));
  EXPECT_EQ(media(with(linear)), media(with(linear + "\"string freeflight\" \"regular\"")));
  // Bounds that cut across voxels, and densities without.
  EXPECT_EQ(media(with(linear + unproven)), media(with(linear + unproven + debiased)));
  EXPECT_TRUE(with(linear + unproven).isSilent());
  EXPECT_TRUE(with(kPerlin + "\"string law\" \"davis\"").isSilent());
  EXPECT_EQ(media(with(kPerlin + "\"string law\" \"linear\"")),
            media(with(kPerlin + "\"string law\" \"linear\"" + debiased)));
  expectMistakes(
      {{kGrid + "\"string freeflight\" \"detla\"",
        "unknown free-flight sampler \"detla\"; did you mean \"delta\"?", ""},
       {kGrid + "\"string freeflight\" \"auot\"", "did you mean \"auto\"?", ""},
       {kGrid + "\"string freeflight\" \"delta\" \"string law\" \"linear\"",
        "the free flights of \"delta\" follow exponential, pinknoise, davis, mixture; for a medium that "
        "scatters, the law \"linear\" is served by debiased-ray-marching, ray-marching, regular",
        ""},
       {kPerlin + "\"string law\" \"linear\" \"string freeflight\" \"delta\"",
        "is served by debiased-ray-marching, ray-marching", ""},
       {single + "\"string model\" \"adaptiv\"", "\"model\": found \"adaptiv\", expected one of", ""},
       {kGrid + "\"string freeflight\" \"delta\" \"float boundscale\" 2", "unknown parameter \"boundscale\"",
        "", kTolerated}},
      with);
}

TEST(ConstructPattern, ChangesTheImageOfItsPixelsOnly) {
  const auto make = [&](const std::string& pattern) {
    return attempt(
        "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 \"string filename\" \"t.exr\" "
        "Sampler \"random\" \"integer pixelsamples\" 4 Integrator \"volpath\" LookAt .5 .5 -3  .5 .5 0  0 1 "
        "0 "
        "Camera \"perspective\" \"float fov\" 20 WorldBegin LightSource \"infinite\" MakeNamedMedium \"m\" " +
        kGrid + "\"string transmittance\" \"ratio\" " + pattern +
        " MediumInterface \"m\" \"\" Material \"\" Shape \"sphere\" \"float radius\" 2 WorldEnd");
  };
  const Numbers plain = rendered(make(""));
  EXPECT_EQ(plain, rendered(make("\"string pattern\" \"independent\"")));
  for (const std::string name : {"latinhypercube", "hammersley", "halton", "scrambledhalton"}) {
    const Attempt a = make("\"string pattern\" \"" + name + "\"");
    ASSERT_TRUE(a.isSilent()) << a.messages();
    const Numbers n = rendered(a);
    EXPECT_NE(plain, n) << name;
    EXPECT_EQ(n, rendered(make("\"string pattern\" \"" + name + "\""))) << name;
  }
  expectMistakes({{"\"string pattern\" \"hamersley\"", "did you mean \"hammersley\"?", ""}},
                 [&](const std::string& p) { return make(p); });
}

TEST(ConstructSuperVoxels, AreAsManyAsAsked) {
  const auto described = [](const std::string& p) { return mediumOf(with(p))->describe(); };
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(described(kPerlin + "\"integer supervoxels\" 5"), "super-voxels 5 x 5 x 5"));
  EXPECT_TRUE(has(described(kPerlin + "\"integer supervoxels\" [ 5 1 40 ]"), "super-voxels 5 x 1 x 40"));
  EXPECT_TRUE(has(described(kPerlin + "\"integer supervoxels\" 0"), "super-voxels 1 x 1 x 1"));
  // A grid of 2 x 1 x 3 samples has 3 x 2 x 4 gaps, borders included; cells hold whole ones.
  EXPECT_TRUE(has(described(kGrid + "\"integer supervoxels\" [ 9 1 2 ]"), "super-voxels 3 x 1 x 2"))
      << described(kGrid + "\"integer supervoxels\" [ 9 1 2 ]");
  EXPECT_TRUE(has(described(kGrid + "\"integer supervoxels\" 0"), "super-voxels 1 x 1 x 1"));
  expectMistakes({{kGrid + "\"integer supervoxels\" [ 1 2 ]", "found 2 numbers, expected one, or three", ""},
                  {kGrid + "\"integer supervoxels\" -1", "found -1, expected 0 (one for all) to 1024", ""},
                  {kGrid + "\"integer supervoxels\" 1025", "found 1025, expected 0", ""},
                  {kGrid + "\"integer supervoxels\" 1024",
                   "found 1073741824 super-voxels in all, expected at most", ""}},
                 with);
}

TEST(ConstructBounds, EveryKindServesEveryField) {
  for (const std::string& field : {kGrid, kPerlin}) {
    const Numbers exact = media(with(field));
    EXPECT_EQ(exact, media(with(field + "\"string bounds\" \"exact\"")));
    const Attempt constant = with(field + "\"string bounds\" \"constant\" \"float majorant\" 5");
    const Attempt progressive = with(field + "\"string bounds\" \"progressive\"");
    for (const Attempt* a : {&constant, &progressive}) ASSERT_TRUE(a->isSilent()) << a->messages();
    EXPECT_NE(exact, media(constant));
    EXPECT_NE(exact, media(progressive));
    ASSERT_EQ(progressive.made->scene->media().size(), 1u);
    EXPECT_EQ(constant.made->scene->media()[0]->learnedBounds(), nullptr);
    ASSERT_NE(progressive.made->scene->media()[0]->learnedBounds(), nullptr);
    EXPECT_NE(mediumOf(progressive)->describe().find("bounds learned"), std::string::npos);
    EXPECT_NE(mediumOf(constant)->describe().find("bounds given"), std::string::npos);
  }
}

TEST(ConstructBounds, NumbersAreExtinctionsOfTheLargestChannel) {
  // sigma_t is (2, 4, 8): an extinction of 2 is a density of a quarter.
  const Attempt a = with(
      "\"string type\" \"perlin\" \"integer octaves\" 1 \"rgb sigma_a\" [ 1 2 4 ] \"rgb sigma_s\" [ 1 2 4 ] "
      "\"string bounds\" "
      "\"progressive\" \"float initialextinction\" 2 \"float epsilon\" 0.8 \"float boundslack\" 0.5");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  const LearnedBounds& bounds = *a.made->scene->media()[0]->learnedBounds();
  EXPECT_EQ(bounds.inForce().maximum(), .25f);
  EXPECT_EQ(bounds.params().epsilon, .1f);
  EXPECT_EQ(bounds.params().slack, .5f);
  EXPECT_EQ(bounds.params().warmUpPasses, 4);
  EXPECT_EQ(with(kGrid + "\"string bounds\" \"progressive\" \"integer warmup\" 7")
                .made->scene->media()[0]
                ->learnedBounds()
                ->params()
                .warmUpPasses,
            7);
  EXPECT_EQ(with(kGrid + "\"string bounds\" \"progressive\"")
                .made->scene->media()[0]
                ->learnedBounds()
                ->params()
                .initial,
            .01f / 30);
}

TEST(ConstructBounds, SaysWhatIsWrong) {
  const std::string constant = "\"string bounds\" \"constant\" ",
                    progressive = "\"string bounds\" \"progressive\" ";
  expectMistakes({{kGrid + "\"string bounds\" \"progresive\"", "did you mean \"progressive\"?", ""},
                  {kGrid + constant, "\"constant\" needs a \"float majorant\"", ""},
                  {kGrid + constant + "\"float majorant\" 0", "\"majorant\": found 0, expected > 0", ""},
                  {kGrid + constant + "\"float scale\" 1e-30 \"float majorant\" 1e30",
                   "\"majorant\": divided by the largest sigma_t it is no finite density", ""},
                  {kGrid + "\"float majorant\" 1", "\"majorant\": needs \"string bounds\" \"constant\"", ""},
                  {kGrid + constant + "\"float majorant\" 1 \"float epsilon\" 1",
                   "\"epsilon\": needs \"string bounds\" \"progressive\"", ""},
                  {kGrid + "\"float initialextinction\" 1", "needs \"string bounds\" \"progressive\"", ""},
                  {kGrid + "\"float boundslack\" 1", "needs \"string bounds\" \"progressive\"", ""},
                  {kGrid + progressive + "\"float initialextinction\" 0", "found 0, expected > 0", ""},
                  {kGrid + progressive + "\"float epsilon\" 0", "found 0, expected > 0", ""},
                  {kGrid + progressive + "\"float boundslack\" -1", "found -1, expected >= 0", ""},
                  {kGrid + "\"integer warmup\" 2", "\"warmup\": needs \"string bounds\" \"progressive\"", ""},
                  {kGrid + progressive + "\"integer warmup\" -1", "found -1, expected", ""},
                  {kGrid + "\"integer warmuplookups\" 2", "\"warmuplookups\": needs \"string bounds\"", ""},
                  {kGrid + progressive + "\"integer warmuplookups\" -1", "found -1, expected", ""},
                  {kGrid + "\"float densityslack\" 1", "unknown parameter \"densityslack\"", "", kTolerated}},
                 with);
}

TEST(ConstructBounds, WhatGoesFromVoxelToVoxelNeedsThem) {
  const std::string estimator = "\"string transmittance\" \"regular\" ",
                    sampler = "\"string freeflight\" \"regular\" ",
                    gamma =
                        "\"string transmittance\" \"gamma\" \"string base\" \"regular\" \"rgb sigma_s\" 0 ";
  EXPECT_TRUE(with(kGrid + estimator + sampler).isSilent());
  expectMistakes(
      {{kPerlin + estimator,
        "\"transmittance\": \"regular\" goes from voxel to voxel, but this density has none; these "
        "work here: ratio, ",
        ""},
       {kPerlin + sampler,
        "\"freeflight\": \"regular\" goes from voxel to voxel, but this density has none; these work "
        "here: weighted-delta, delta, ",
        ""},
       {kGrid + estimator + "\"string bounds\" \"progressive\"",
        "bounds that are not \"exact\" cut across them", ""}},
      with);
  const Attempt a = with(kPerlin + estimator);
  EXPECT_EQ(a.messages().find("ratio, regular"), std::string::npos) << a.messages();
}

}  // namespace
}  // namespace pbrtmedia::test
