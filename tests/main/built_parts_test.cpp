// SPDX-License-Identifier: BSD-2-Clause
// What a scene does not need is not built: exactly what was built, by scenes that differ in one thing.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "base/built_parts.h"
#include "support/process.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

using Parts = std::map<std::string, std::uint64_t>;

/// Of a scene; what is empty here is not in it.
struct Words {
  std::string integrator = "\"volpath\"";
  std::string beforeCamera = "";
  std::string light = "LightSource \"point\" \"point from\" [ 0 3 -3 ]\n";
  std::string world = "Material \"matte\"\nShape \"sphere\"\n";
};

const std::string kBall = "Shape \"sphere\"\n";
const std::string kHollowBall = "Material \"none\"\n" + kBall;

std::string homogeneous(const std::string& sigmaA) {
  return "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ " + sigmaA +
         " ] \"rgb sigma_s\" [ .1 .1 .1 ]\n";
}

std::string perlin(const std::string& more) {
  return "MakeNamedMedium \"m\" \"string type\" \"perlin\" \"rgb sigma_a\" [ .1 .1 .1 ] \"rgb sigma_s\" [ .1 "
         ".1 .1 ]\n"
         "\"point p0\" [ -1 -1 -1 ] \"point p1\" [ 1 1 1 ] \"integer octaves\" 2 " +
         more + "\n";
}

const std::string kFilled = "MediumInterface \"m\" \"\"\n" + kHollowBall;

class Built : public testing::Test {
 protected:
  /// What the render built, without what it built none of.
  Parts by(const Words& words, const std::string& options = "") const {
    folder_.write("a.pbrt",
                  "Film \"image\" \"integer xresolution\" 6 \"integer yresolution\" 6 \"string filename\" "
                  "\"a.exr\"\nSampler \"random\" \"integer pixelsamples\" 2\nIntegrator " +
                      words.integrator + "\nLookAt 0 0 -4  0 0 1  0 1 0\n" + words.beforeCamera +
                      "Camera \"perspective\" \"float fov\" 40\nWorldBegin\n" + words.light + words.world +
                      "WorldEnd\n");
    const ProcessResult r =
        run("cd '" + folder_.path().string() +
            "' && timeout -s KILL 120 '" PBRT_PROGRAM "' --quiet --stats s.json " + options + " a.pbrt");
    EXPECT_EQ(r.status, 0) << r.output;
    if (r.status != 0) return {};
    const auto built = nlohmann::json::parse(folder_.read("s.json")).at("renders").at(0).at("built");
    EXPECT_EQ(built.size(), kPartCount);
    Parts parts;
    for (const auto& [name, count] : built.items()) {
      if (count.get<std::uint64_t>() > 0) parts[name] = count;
    }
    return parts;
  }
  TemporaryFolder folder_;
};

TEST_F(Built, NothingButATreeForASurface) { EXPECT_EQ(by({}), (Parts{{"rayTrees", 1}})); }

TEST_F(Built, NoTreeWithoutSurfaces) {
  const Words fog{.beforeCamera = homogeneous(".1 .1 .1") + "MediumInterface \"\" \"m\"\n", .world = ""};
  EXPECT_EQ(by(fog), (Parts{{"media", 1}}));
}

TEST_F(Built, ATreeForEachObjectThatIsPlaced) {
  const std::string object = "ObjectBegin \"o\"\nMaterial \"matte\"\n" + kBall + "ObjectEnd\n";
  EXPECT_EQ(by({.world = object + "ObjectInstance \"o\"\nTranslate 3 0 0\nObjectInstance \"o\"\n"}),
            (Parts{{"rayTrees", 2}}));
  EXPECT_EQ(by({.world = object + "Material \"matte\"\n" + kBall}), (Parts{{"rayTrees", 1}}));
}

TEST_F(Built, MediaThatSomethingUses) {
  EXPECT_EQ(by({.world = homogeneous(".1 .1 .1") + kFilled}), (Parts{{"media", 1}, {"rayTrees", 1}}));
  EXPECT_EQ(by({.world = homogeneous(".1 .1 .1") + kBall}), (Parts{{"rayTrees", 1}}));
  EXPECT_EQ(by({.world = perlin("\"string bounds\" \"progressive\"") + kBall}), (Parts{{"rayTrees", 1}}));
}

TEST_F(Built, ThreeChannelsWhereExtinctionDiffers) {
  EXPECT_EQ(by({.world = homogeneous(".1 .2 .3") + kFilled}),
            (Parts{{"media", 1}, {"chromaticMedia", 1}, {"rayTrees", 1}}));
}

TEST_F(Built, SuperVoxelsForFieldsAndLearnedOnesWhereTheyRise) {
  EXPECT_EQ(by({.world = perlin("\"integer supervoxels\" 4") + kFilled}),
            (Parts{{"media", 1}, {"superVoxelGrids", 1}, {"rayTrees", 1}}));
  EXPECT_EQ(by({.world = perlin("\"integer supervoxels\" 4 \"string bounds\" \"progressive\"") + kFilled}),
            (Parts{{"media", 1}, {"superVoxelGrids", 1}, {"learnedBounds", 1}, {"rayTrees", 1}}));
}

TEST_F(Built, TexturesThatMaterialsUseAndThenDifferentials) {
  const std::string
      checks = "Texture \"t\" \"spectrum\" \"checkerboard\"\n",
      constant = "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [ .1 .2 .3 ]\n",
      half = "Texture \"h\" \"spectrum\" \"scale\" \"texture tex1\" \"t\" \"rgb tex2\" [ .5 .5 .5 ]\n",
      matte = "Material \"matte\" \"texture Kd\" \"t\"\n" + kBall,
      halfMatte = "Material \"matte\" \"texture Kd\" \"h\"\n" + kBall;
  EXPECT_EQ(by({.world = checks + matte}),
            (Parts{{"textures", 1}, {"rayDifferentials", 1}, {"rayTrees", 1}}));
  EXPECT_EQ(by({.world = checks + half + halfMatte}),
            (Parts{{"textures", 2}, {"rayDifferentials", 1}, {"rayTrees", 1}}));
  EXPECT_EQ(by({.world = constant + matte}), (Parts{{"rayTrees", 1}}));
  EXPECT_EQ(by({.world = constant + half + halfMatte}), (Parts{{"textures", 1}, {"rayTrees", 1}}));
  EXPECT_EQ(by({.world = checks + "Material \"matte\"\n" + kBall}), (Parts{{"rayTrees", 1}}));
}

TEST_F(Built, TablesOfLightsWhereThereIsAChoice) {
  const std::string point = Words{}.light, two = point + "LightSource \"point\" \"point from\" [ 3 0 -3 ]\n";
  const Parts tree = {{"rayTrees", 1}}, table = {{"lightDistributions", 1}, {"rayTrees", 1}};
  for (const std::string strategy : {"uniform", "power", "spatial", "tree", "learned"}) {
    const std::string integrator = "\"volpath\" \"string lightsamplestrategy\" \"" + strategy + "\"";
    EXPECT_EQ(by({.integrator = integrator}), tree) << strategy;
    EXPECT_EQ(by({.integrator = integrator, .light = two}), strategy == "uniform" ? tree : table) << strategy;
  }
  EXPECT_EQ(by({.light = "LightSource \"infinite\" \"rgb L\" [ .5 .5 .5 ]\n"}), tree)
      << "the same everywhere";
}

TEST_F(Built, TablesOfScatteringBelowSurfaces) {
  EXPECT_EQ(by({.world = "Material \"subsurface\"\n" + kBall}),
            (Parts{{"subsurfaceTables", 1}, {"rayTrees", 1}}));
}

TEST_F(Built, PhotonMapsBySppm) {
  const std::string floor =
      "Material \"matte\"\nTranslate 0 -1 0\nRotate 90 1 0 0\nShape \"disk\" \"float radius\" 5\n";
  EXPECT_EQ(by({.integrator = "\"sppm\" \"integer iterations\" 3 \"integer photonsperiteration\" 1000",
                .world = Words{}.world + floor}),
            (Parts{{"photonMaps", 3}, {"rayTrees", 1}}));
}

TEST_F(Built, PlanesOfTheFilmThatWereAskedFor) {
  EXPECT_EQ(by({}, "--layers depth,samples"), (Parts{{"layers", 3}, {"rayTrees", 1}}));
  EXPECT_EQ(by({}, "--convergence c.csv"), (Parts{{"filmHalves", 1}, {"rayTrees", 1}}));
  EXPECT_EQ(by({.integrator = "\"bdpt\""}), (Parts{{"splatBuffers", 1}, {"rayTrees", 1}}));
}

TEST_F(Built, NoMediaForIntegratorsWithoutThemNorTheirBoundaries) {
  EXPECT_EQ(by({.integrator = "\"path\"", .world = perlin("") + kFilled}), (Parts{}));
}

}  // namespace
}  // namespace pbrtmedia::test
