// SPDX-License-Identifier: BSD-2-Clause
#include "construct/samplers.h"

#include "construct/probe.h"

namespace pbrtmedia::test {
namespace {

const std::string kRest =
    "\nFilm \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 WorldBegin " + kLight + "WorldEnd";
Attempt with(const std::string& sampler) { return attempt(sampler + kRest); }
std::int64_t samplesOf(const std::string& sampler, const ConstructOptions& options) {
  const Attempt a = attempt(sampler + kRest, {.build = options});
  EXPECT_TRUE(a.made.has_value()) << a.messages();
  return a.made ? a.made->sampler->samplesPerPixel() : -1;
}

TEST(ConstructSampler, EveryParameterHasItsEffect) {
  std::vector<Effect> effects{
      {"Sampler \"halton\"", "Sampler \"halton\" \"bool samplepixelcenter\" \"true\""},
      {"Sampler \"stratified\"", "Sampler \"stratified\" \"integer xsamples\" 3"},
      {"Sampler \"stratified\"", "Sampler \"stratified\" \"integer ysamples\" 3"},
      {"Sampler \"stratified\"", "Sampler \"stratified\" \"bool jitter\" \"false\""}};
  for (const std::string type : {"halton", "sobol", "02sequence", "lowdiscrepancy", "maxmindist", "random"}) {
    effects.push_back({"Sampler \"" + type + '"', "Sampler \"" + type + "\" \"integer pixelsamples\" 8"});
  }
  for (const std::string type : {"02sequence", "lowdiscrepancy", "maxmindist", "stratified"}) {
    effects.push_back({"Sampler \"" + type + '"', "Sampler \"" + type + "\" \"integer dimensions\" 2"});
  }
  expectEffects(effects, with, samples);
  expectSame(
      {{"", "Sampler \"halton\" \"integer pixelsamples\" 16 \"bool samplepixelcenter\" \"false\""},
       {"Sampler \"random\"", "Sampler \"random\" \"integer pixelsamples\" 4"},
       {"Sampler \"02sequence\"", "Sampler \"lowdiscrepancy\" \"integer dimensions\" 4"},
       {"Sampler \"stratified\"",
        "Sampler \"stratified\" \"integer xsamples\" 4 \"integer ysamples\" 4 \"bool jitter\" \"true\""}},
      with, samples);
}

TEST(ConstructSampler, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{"Sampler \"haltn\"", "Sampler: unknown type \"haltn\"; did you mean \"halton\"?", "t.pbrt:1:9"},
       {"Sampler \"halton\" \"float pixelsamples\" [ 64 ]",
        "parameter \"pixelsamples\": found type float, expected integer", "t.pbrt:1:18", kTolerated},
       {"Sampler \"halton\" \"integer pixelsamples\" 0", "found 0, expected >= 1", "t.pbrt:1:41", kTolerated},
       {"Sampler \"stratified\" \"integer xsamples\" 0", "expected in [1, ", "", kTolerated},
       {"Sampler \"stratified\" \"integer ysamples\" 0", "expected in [1, ", "", kTolerated},
       {"Sampler \"stratified\" \"integer pixelsamples\" 4", "unknown parameter \"pixelsamples\"", "",
        kTolerated},
       {"Sampler \"02sequence\" \"integer dimensions\" -1", "expected in [0, ", "", kTolerated},
       {"Sampler \"random\" \"integer pixelsamples\" [ 4 4 ]", "found 2 values, expected 1", "", kTolerated}},
      with);
  EXPECT_TRUE(attempt("Sampler \"x\"" + kRest).failsWith("unknown type"));
}

TEST(ConstructSampler, WarnsWhenCountsAreRounded) {
  for (const std::string type : {"sobol", "02sequence", "maxmindist"}) {
    const Attempt a = with("Sampler \"" + type + "\" \"integer pixelsamples\" 100");
    ASSERT_TRUE(a.warns("100 samples per pixel are rounded up to 128")) << type << a.messages();
    EXPECT_EQ(a.made->sampler->samplesPerPixel(), 128);
  }
  ConstructOptions options;
  options.samplesPerPixel = 100;
  EXPECT_TRUE(
      attempt("Sampler \"sobol\"" + kRest, {.build = options}).warns("100 samples per pixel are rounded up"));
  EXPECT_TRUE(
      attempt("Sampler \"sobol\" \"integer pixelsamples\" 3" + kRest, {.build = {.quick = true}}).isSilent());
}

TEST(ConstructSampler, QuickMeansOneSampleForAllButRandom) {
  const ConstructOptions quick{.quick = true};
  for (const std::string type : {"halton", "sobol", "02sequence", "maxmindist", "stratified"})
    EXPECT_EQ(samplesOf("Sampler \"" + type + '"', quick), 1) << type;
  EXPECT_EQ(samplesOf("Sampler \"random\" \"integer pixelsamples\" 9", quick), 9);
}

TEST(ConstructSampler, TheCommandLineDecidesTheNumberOfSamples) {
  ConstructOptions options{.quick = true};
  options.samplesPerPixel = 12;
  for (const std::string type : {"halton", "random", "stratified"})
    EXPECT_EQ(samplesOf("Sampler \"" + type + '"', options), 12) << type;
  options.samplesPerPixel = 13;
  EXPECT_EQ(samplesOf("Sampler \"stratified\"", options), 13) << "a prime is 1 x 13 strata";
  options.samplesPerPixel = 4294967311;  // a prime above 2^32
  EXPECT_TRUE(attempt("Sampler \"stratified\"" + kRest, {.build = options})
                  .failsWith("needs a grid of 1 x 4294967311"));
}

TEST(ConstructSampler, HasTheSeedOfTheCommandLine) {
  for (const std::string type : {"halton", "sobol", "02sequence", "maxmindist", "stratified", "random"}) {
    const std::string text = "Sampler \"" + type + '"' + kRest;
    EXPECT_NE(samples(attempt(text, {.build = {.seed = 1}})), samples(attempt(text, {.build = {.seed = 2}})))
        << type;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
