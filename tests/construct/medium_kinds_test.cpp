// SPDX-License-Identifier: BSD-2-Clause
// Media whose density is a function, or stands in a file.
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>

#include "construct/probe.h"
#include "construct/raw_grid.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

const std::string kSigma = "\"rgb sigma_s\" [ 30 30 30 ] \"rgb sigma_a\" [ 20 20 20 ] ";
/// Few super-voxels: bounds of noise are dear.
const std::string kPerlin = "\"string type\" \"perlin\" \"integer supervoxels\" 4 " + kSigma;
const std::string kAnalytic = "\"string type\" \"analytic\" " + kSigma;
const std::string kTexture = "\"string type\" \"texture\" " + kSigma;

Attempt withTexture(const std::string& texture, const std::string& parameters,
                    const std::filesystem::path& folder = ".") {
  return attemptWorld(texture + " MakeNamedMedium \"m\" " + parameters +
                          "\nMediumInterface \"m\" \"\" Material \"\" Shape \"sphere\"",
                      {.folder = folder});
}
Attempt with(const std::string& parameters) { return withTexture("", parameters); }
Attempt withFbm(const std::string& parameters) {
  return withTexture(
      "Texture \"t\" \"float\" \"fbm\" Texture \"s\" \"spectrum\" \"fbm\" Texture \"u\" \"float\" "
      "\"scale\" \"texture tex1\" \"t\" \"float tex2\" 2",
      parameters);
}

TEST(ConstructPerlin, EveryParameterHasItsEffect) {
  std::vector<Effect> effects;
  const std::string base = kPerlin + "\"float threshold\" 0.3 \"float frequency\" 3 ";
  for (const std::string p :
       {"\"integer octaves\" 12", "\"float lacunarity\" 3", "\"float gain\" 0.8", "\"integer seed\" 7",
        "\"point p0\" [ -1 0 0 ]", "\"point p1\" [ 1 1 2 ]", "\"float scale\" 2"}) {
    effects.push_back({base, base + p});
  }
  effects.push_back({kPerlin + "\"float threshold\" 0.3", kPerlin + "\"float threshold\" 0.4"});
  effects.push_back({kPerlin + "\"float threshold\" 0.3 \"float frequency\" 2",
                     kPerlin + "\"float threshold\" 0.3 \"float frequency\" 2.5"});
  expectEffects(effects, with, media);
  expectSame(
      {{kPerlin, kPerlin + "\"integer octaves\" 6 \"float lacunarity\" 2 \"float gain\" 0.5 \"float "
                           "frequency\" 1 \"integer seed\" 0 \"float threshold\" 0.5 \"point p0\" [ 0 0 0 "
                           "] \"point p1\" [ 1 1 1 ] \"string bounds\" \"exact\""}},
      with, media);
}

TEST(ConstructPerlin, SaysWhatIsWrong) {
  expectMistakes({{kPerlin + "\"integer octaves\" 0", "found 0, expected in [1, 32]", ""},
                  {kPerlin + "\"float lacunarity\" 0.5", "found 0.5, expected in [1, 16]", ""},
                  {kPerlin + "\"float gain\" 0", "found 0, expected in (0, 1]", ""},
                  {kPerlin + "\"float frequency\" 0", "found 0, expected in (0, ", ""},
                  {kPerlin + "\"float threshold\" 1", "found 1, expected in [0, 1)", ""},
                  {kPerlin + "\"point p1\" [ 0 1 1 ]", "the box is flat: p0 and p1 agree in x", ""},
                  {kPerlin + "\"float density\" 1", "unknown parameter \"density\"", "", kTolerated}},
                 with);
}

TEST(ConstructAnalytic, EveryFunctionCanBeNamedAndEveryParameterHasItsEffect) {
  const auto named = [](const std::string& f) { return kAnalytic + "\"string function\" \"" + f + "\" "; };
  std::vector<Effect> effects;
  for (const std::string p : {"\"point center\" [ 0 0 .3 ]", "\"float radius\" 0.7", "\"float edge\" 0.3"})
    effects.push_back({named("sphere"), named("sphere") + p});
  for (const std::string f : {"slab", "ramp"}) {
    for (const std::string p : {"\"float from\" 0.3", "\"float to\" 0.6"})
      effects.push_back({named(f), named(f) + p});
  }
  for (const std::string p :
       {"\"float floor\" 1", "\"float height\" 4000", "\"float position\" 0.102", "\"float width\" 0.1"})
    effects.push_back({named("needle"), named("needle") + p});
  effects.push_back(
      {named("sinesphere"), named("sinesphere") + "\"point p0\" [ 0 0 0 ] \"point p1\" [ 1 1 1 ]"});
  expectEffects(effects, with, media);
  const Bounds3f box =
      mediumOf(with(named("sphere") + "\"float radius\" 2 \"point center\" [ 1 0 0 ]"))->bounds();
  EXPECT_NEAR(box.min.x, -1, 1e-5) << "the box of a sphere is its own";
  EXPECT_NEAR(box.max.x, 3, 1e-5);
}

TEST(ConstructAnalytic, SaysWhatIsWrong) {
  expectMistakes(
      {{kAnalytic, "parameter \"string function\" is missing; known: ", ""},
       {kAnalytic + "\"string function\" \"slap\"", "unknown function \"slap\"; did you mean \"slab\"?", ""},
       {kAnalytic + "\"string function\" \"slab\" \"float from\" 2", "\"from\" must be below \"to\"", ""},
       {kAnalytic + "\"string function\" \"sphere\" \"float radius\" -1",
        "\"radius\" must be a number above 0", ""},
       {kAnalytic + "\"string function\" \"slab\" \"float radius\" 1", "unknown parameter \"radius\"", "",
        kTolerated}},
      with);
}

TEST(ConstructTextureMedium, IsAMediumOfAnyFloatTexture) {
  const Attempt a = withFbm(kTexture + "\"texture density\" \"t\"");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_NE(a.made->scene->media()[0]->learnedBounds(), nullptr)
      << "progressive unless the scene says otherwise";
  const std::string given = "\"string bounds\" \"constant\" \"float majorant\" 20 ";
  EXPECT_NE(media(withFbm(kTexture + given + "\"texture density\" \"t\"")),
            media(withFbm(kTexture + given + "\"texture density\" \"u\"")));
  EXPECT_NE(media(withFbm(kTexture + given + "\"texture density\" \"t\"")),
            media(withTexture("Scale 2 2 2 Texture \"t\" \"float\" \"fbm\" Identity",
                              kTexture + given + "\"texture density\" \"t\"")))
      << "the 3-D mapping of the texture counts";
  // A number is a texture too.
  EXPECT_TRUE(with(kTexture + "\"float density\" 0.7").isSilent());
}

TEST(ConstructTextureMedium, SaysWhatIsWrong) {
  expectMistakes({{kTexture, "parameter \"texture density\": expected the name of a float texture", ""},
                  {kTexture + "\"texture density\" \"v\"", "expected the name of a float texture", ""},
                  {kTexture + "\"texture density\" \"s\"", "expected the name of a float texture", ""},
                  {kTexture + "\"float density\" -1", "expected the name of a float texture", ""},
                  {kTexture + "\"texture density\" \"t\" \"string bounds\" \"exact\"",
                   "a texture knows no bounds of its own: expected \"progressive\"", ""}},
                 withFbm);
}

TEST(ConstructTextureMedium, ComplainsOfValuesThatAreNoDensity) {
  const std::string medium =
      kTexture + "\"texture density\" \"n\" \"string bounds\" \"constant\" \"float majorant\" 99 ";
  const auto complaint = [&](const std::string& texture) {
    const Attempt a = withTexture(texture, medium);
    EXPECT_TRUE(a.isSilent()) << a.messages();
    for (const double x : media(a)) EXPECT_TRUE(std::isfinite(x));
    return a.made->scene->media()[0]->complaint();
  };
  EXPECT_EQ(complaint("Texture \"n\" \"float\" \"constant\" \"float value\" 2"), "");
  EXPECT_EQ(complaint("Texture \"n\" \"float\" \"constant\" \"float value\" -2"),
            "texture \"n\" has negative values in the medium; they count as density 0");
}

TEST(ConstructGrid, ComplainsOfWeightsOfEitherSignWherePathsScatterOften) {
  const auto complaint = [](const std::string& scale, const std::string& flights) {
    const Attempt a = with(
        "\"string type\" \"heterogeneous\" \"float density\" 1 \"rgb sigma_s\" [ 1 1 1 ] "
        "\"rgb sigma_a\" [ 0 0 0 ] \"float scale\" " +
        scale + " \"string freeflight\" \"" + flights + "\"");
    EXPECT_TRUE(a.isSilent()) << a.messages();
    return a.made->scene->media()[0]->complaint();
  };
  EXPECT_TRUE(
      complaint("100", "debiased-ray-marching").starts_with("paths may scatter often in it, as 173.2"))
      << complaint("100", "debiased-ray-marching");
  EXPECT_EQ(complaint("2", "debiased-ray-marching"), "");
  EXPECT_EQ(complaint("100", "weighted-delta"), "");
}

/// Writes numbers as a raw file, little-endian.
template <class Word>
void writeRaw(const std::filesystem::path& file, const std::vector<Word>& words) {
  std::ofstream out(file, std::ios::binary);
  for (const Word word : words) {
    for (std::size_t i = 0; i < sizeof(Word); ++i) out.put(static_cast<char>(word >> (8 * i) & 0xff));
  }
}

const std::string kSize = "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer nz\" 3 " + kSigma;

TEST(ConstructRawGrid, IsTheGridThatStandsInTheScene) {
  const TemporaryFolder folder;
  std::vector<std::uint32_t> floats;
  for (const float v : {.1f, .2f, .3f, .4f, .5f, .6f}) floats.push_back(std::bit_cast<std::uint32_t>(v));
  writeRaw(folder.path() / "f.raw", floats);
  writeRaw<std::uint16_t>(folder.path() / "h.raw", {0x3800, 0x3400, 0x3c00, 0, 0x0001, 0x3a00});
  const auto make = [&](const std::string& p) { return withTexture("", kSize + p, folder.path()); };
  expectSame(
      {{"\"float density\" [ .1 .2 .3 .4 .5 .6 ]", "\"string filename\" \"f.raw\""},
       {"\"float density\" [ .5 .25 1 0 5.9604645e-8 .75 ]",
        "\"string filename\" \"h.raw\" \"string format\" \"half\""},
       {"\"string filename\" \"f.raw\"",
        "\"string filename\" \"f.raw\" \"string format\" \"float\" \"string precision\" \"float\" \"string "
        "layout\" \"automatic\""},
       {"\"string filename\" \"f.raw\"", "\"string filename\" \"f.raw\" \"string layout\" \"bricked\""}},
      make, media);
  expectEffects(
      {{"\"string filename\" \"f.raw\"", "\"string filename\" \"f.raw\" \"string precision\" \"half\""}},
      make, media);
  EXPECT_NE(mediumOf(make("\"string filename\" \"f.raw\" \"string layout\" \"bricked\""))
                ->describe()
                .find("bricked"),
            std::string::npos);
}

TEST(ConstructRawGrid, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  writeRaw<std::uint32_t>(folder.path() / "short.raw", {0, 0, 0, 0, 0});
  writeRaw<std::uint32_t>(folder.path() / "long.raw", {0, 0, 0, 0, 0, 0, 0});
  writeRaw<std::uint32_t>(folder.path() / "nan.raw", {0, 0, 0, 0x7fc00000, 0, 0});
  writeRaw<std::uint32_t>(folder.path() / "negative.raw", {0, 0, 0, 0, 0, 0xbf800000});
  const auto make = [&](const std::string& p) { return withTexture("", p, folder.path()); };
  const std::string file = kSize + "\"string filename\" ";
  expectMistakes(
      {{file + "\"none.raw\"", "there is no file", ""},
       {file + "\"short.raw\"", "holds 20 bytes, expected 24: 4 for each of nx*ny*nz = 2*1*3 = 6 numbers",
        ""},
       {file + "\"long.raw\"", "holds 28 bytes, expected 24", ""},
       {file + "\"long.raw\" \"string format\" \"half\"", "expected 12: 2 for each", ""},
       {file + "\"nan.raw\"", "found nan at voxel (1, 0, 1)", ""},
       {file + "\"negative.raw\"", "the file holds 1 negative value at voxel (1, 0, 2): -1", "", kTolerated},
       {file + "\"long.raw\" \"float density\" [ 1 1 1 1 1 1 ]",
        "\"float density\" is given too: one of them", ""},
       {file + "\"long.raw\" \"string format\" \"double\"", "unknown format \"double\"", ""},
       {"\"string type\" \"heterogeneous\" \"integer nx\" 1000000 \"integer ny\" 1000000 \"integer nz\" "
        "1000000 "
        "\"string filename\" \"short.raw\"",
        "expected 4000000000000000000", ""},
       {kSize + "\"float density\" [ 0 0 0 0 0 0 ] \"string precision\" \"double\"", "unknown precision", ""},
       {kSize + "\"float density\" [ 0 0 0 0 0 0 ] \"string layout\" \"brick\"", "did you mean \"bricked\"?",
        ""}},
      make);
}

TEST(RawGrid, ReadsEveryHalf) {
  EXPECT_EQ(floatOfHalf(0x3c00), 1.0f);
  EXPECT_EQ(floatOfHalf(0xc000), -2.0f);
  EXPECT_EQ(floatOfHalf(0x0001), 0x1p-24f);
  EXPECT_EQ(floatOfHalf(0x03ff), 0x1.ff8p-15f);
  EXPECT_EQ(floatOfHalf(0x0400), 0x1p-14f);
  EXPECT_EQ(floatOfHalf(0x7bff), 65504.0f);
  EXPECT_EQ(floatOfHalf(0x7c00), std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(floatOfHalf(0x7e00)));
  EXPECT_TRUE(std::signbit(floatOfHalf(0x8000)));
  // Between neighbours of one sign values rise.
  for (std::uint32_t bits = 0; bits < 0x7c00; ++bits) {
    ASSERT_LT(floatOfHalf(static_cast<std::uint16_t>(bits)),
              floatOfHalf(static_cast<std::uint16_t>(bits + 1)));
  }
}

}  // namespace
}  // namespace pbrtmedia::test
