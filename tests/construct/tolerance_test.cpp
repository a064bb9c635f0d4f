// SPDX-License-Identifier: BSD-2-Clause
#include "construct/tolerance.h"

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include "construct/probe.h"
#include "image/image.h"
#include "spectrum/spectrum.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

const std::string kBall = "Shape \"sphere\" ";

Attempt with(const std::string& world) { return attemptWorld(world); }

/// A medium of the name "m" in a sphere.
std::string inSphere(const std::string& medium) {
  return "MakeNamedMedium \"m\" " + medium + "\nMediumInterface \"m\" \"\" Material \"none\" " + kBall;
}

// ---- Empty names

TEST(Tolerance, AnEmptyFileNameOfALightIsNoPicture) {
  for (const std::string light : {"infinite", "goniometric", "projection"}) {
    expectSame({{"LightSource \"" + light + "\" " + kBall,
                 "LightSource \"" + light + "\" \"string mapname\" \"\" " + kBall}},
               with, lights);
  }
}

TEST(Tolerance, AnEmptyTextureNameIsNoTexture) {
  const std::string kd = "Material \"matte\" \"rgb Kd\" [ .1 .2 .3 ] ";
  expectSame({{kd + kBall, kd + "\"texture Kd\" \"\" \"texture bumpmap\" \"\" " + kBall},
              {kd + kBall, kd + kBall + "\"texture Kd\" [ \"\" ]"}},
             with, [](const Attempt& a) { return materials(a); });
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ -1 -1 0 1 -1 0 0 1 0 ] ";
  expectSame({{mesh, mesh + "\"texture alpha\" \"\" \"texture shadowalpha\" \"\""}}, with, surfaces);
}

TEST(Tolerance, AnEmptyFileNameWhereOneIsNeededIsSaidWithWhatHappens) {
  expectMistakes(
      {{"Shape \"plymesh\" \"string filename\" \"\"", "is missing or empty; the shape is left out",
        "t.pbrt:2:1", kTolerated},
       {"Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"\" Material \"matte\" \"texture Kd\" "
        "\"t\" " +
            kBall,
        "\"filename\" is empty; a grey picture (0.5) takes its place", "t.pbrt:2:1", kTolerated},
       {"Material \"metal\" \"spectrum eta\" \"\" " + kBall, "black is taken, as in PBRT-v3", "", kTolerated},
       {inSphere("\"string type\" \"nanovdb\" \"string filename\" \"\""),
        "the name is empty, expected a file", "t.pbrt:2:63"}},
      with);
  EXPECT_TRUE(with(inSphere("\"string type\" \"heterogeneous\" \"float density\" 1 \"string filename\" \"\""))
                  .isSilent());
}

// ---- Files that are missing or cannot be read

class ToleranceOfFiles : public testing::Test {
 protected:
  ToleranceOfFiles() {
    folder_.write("broken.png", "this is no picture");
    folder_.write("lfs.exr", kPointer);
    folder_.write("lfs.ply", kPointer);
    folder_.write("lfs.spd", kPointer);
    folder_.write("lfs.raw", kPointer);
    folder_.write("lfs.nvdb", kPointer);
    folder_.write("smoke.vdb", std::string(" BDV\0\0\0\0\xe0\0\0\0", 12));
    folder_.write("smoke.raw", std::string(" BDV\0\0\0\0\xe0\0\0\0", 12));
  }
  auto maker() const {
    return [this](const std::string& world) { return attemptWorld(world, {.folder = folder_.path()}); };
  }
  static constexpr const char* kPointer =
      "version https://git-lfs.github.com/spec/v1\noid sha256:"
      "4d7a214614ab2935c943f9e0ff69d22eadbb8f32b1258daaa5e2ca24d17e2393\nsize 12345\n";
  TemporaryFolder folder_;
};

TEST_F(ToleranceOfFiles, APictureThatIsNotThereIsGreyAndALightShinesWithout) {
  const auto textured = [](const std::string& file) {
    return "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"" + file +
           "\" Material \"matte\" \"texture Kd\" \"t\" " + kBall;
  };
  const auto seen = [&](const std::string& world) {
    const Attempt a = maker()(world);
    EXPECT_TRUE(a.made.has_value()) << a.messages();
    return a.made ? materials(a) : Numbers{};
  };
  const auto matte = [&](float kd) {
    return seen("Material \"matte\" \"rgb Kd\" [ " + std::to_string(kd) + ' ' + std::to_string(kd) + ' ' +
                std::to_string(kd) + " ] " + kBall);
  };
  const auto expectNear = [](const Numbers& found, const Numbers& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_NEAR(found[i], expected[i], 1e-5);
  };
  expectNear(seen(textured("nil.exr")), matte(0.5f));
  expectNear(seen(textured("lfs.exr")), matte(0.5f));
  // The curve of sRGB, which a name that ends so has, turns grey as well.
  expectNear(seen(textured("broken.png")), matte(0.21404114f));
  for (const std::string type : {"infinite", "goniometric", "projection"}) {
    for (const std::string file : {"nil.exr", "broken.png", "lfs.exr", "picture.jpg"}) {
      const Attempt a = maker()("LightSource \"" + type + "\" \"string mapname\" \"" + file + "\" " + kBall);
      ASSERT_TRUE(a.warns("\"mapname\": ")) << file << a.messages();
      EXPECT_EQ(lights(a), lights(with("LightSource \"" + type + "\" " + kBall))) << type << file;
    }
  }
}

TEST_F(ToleranceOfFiles, EveryPointerOfGitLfsIsNamed) {
  const std::string pull = "run \"git lfs pull\"";
  expectMistakes(
      {{"LightSource \"infinite\" \"string mapname\" \"lfs.exr\" " + kBall, pull, "t.pbrt:2:41", kTolerated},
       {"Shape \"plymesh\" \"string filename\" \"lfs.ply\"", pull, "t.pbrt:2:35", kTolerated},
       {"Material \"metal\" \"spectrum k\" \"lfs.spd\" " + kBall, pull, "t.pbrt:2:31", kTolerated},
       {inSphere("\"string type\" \"heterogeneous\" \"string filename\" \"lfs.raw\""), pull, ""},
       {inSphere("\"string type\" \"nanovdb\" \"string filename\" \"lfs.nvdb\""), pull, ""}},
      maker());
}

TEST_F(ToleranceOfFiles, AnOpenVdbFileIsSentToVdb2pbrt) {
  for (const std::string file : {"smoke.vdb", "smoke.raw"}) {
    for (const std::string type : {"heterogeneous", "nanovdb"}) {
      const Attempt a =
          maker()(inSphere("\"string type\" \"" + type + "\" \"string filename\" \"" + file + '"'));
      EXPECT_TRUE(a.failsWith("\"vdb2pbrt " + file + "\" makes an .nvdb file of it")) << a.messages();
      EXPECT_EQ(a.diagnostics.all().size(), 1u) << a.messages();
    }
  }
}

TEST_F(ToleranceOfFiles, VolumesAreNoScenes) {
  folder_.write("scene.vdb", std::string(" BDV\0\0\0\0\xe0\0\0\0", 12));
  folder_.write("scene.nvdb", std::string("NanoVDB1\0\0\0\0", 12));
  folder_.write("scene.pbrt", kPointer);
  const auto said = [&](const char* name) {
    Diagnostics diagnostics;
    parseFiles(std::array{folder_.path() / name}, diagnostics);
    EXPECT_TRUE(diagnostics.hasErrors());
    return diagnostics.format();
  };
  EXPECT_NE(said("scene.vdb").find("run vdb2pbrt on it"), std::string::npos) << said("scene.vdb");
  EXPECT_NE(said("scene.nvdb").find("\"string type\" \"nanovdb\""), std::string::npos) << said("scene.nvdb");
  EXPECT_NE(said("scene.pbrt").find("git lfs pull"), std::string::npos) << said("scene.pbrt");
}

// ---- What nothing uses

TEST_F(ToleranceOfFiles, WhatIsBrokenAndNotUsedIsAWarningAndNotOpened) {
  folder_.write("short.raw", "1234");
  const std::string file = "\"string type\" \"heterogeneous\" \"integer nx\" 2 \"string filename\" ";
  expectMistakes(
      {{"MakeNamedMedium \"m\" \"string type\" \"nanovdb\" \"string filename\" \"nil.nvdb\" " + kBall,
        "nothing uses this medium, so it is left out", "t.pbrt:2:63", kTolerated},
       {"MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"float g\" "
        "1 " +
            kBall,
        "nothing uses this medium", "", kTolerated},
       {"Material \"glass\" \"texture Kr\" \"nil\" Material \"matte\" " + kBall, "unknown spectrum texture",
        "", kTolerated},
       {"ObjectBegin \"o\" Shape \"heightfield\" ObjectEnd " + kBall, "nothing uses this object",
        "t.pbrt:2:17", kTolerated},
       {"ObjectBegin \"o\" MakeNamedMedium \"m\" " + file + "\"nil.raw\" MediumInterface \"m\" \"\" " +
            kBall + "ObjectEnd " + kBall,
        "nothing uses this medium", "", kTolerated}},
      maker());
  const Attempt notRead = maker()("MakeNamedMedium \"m\" " + file + "\"short.raw\" " + kBall);
  EXPECT_TRUE(notRead.warns("no shape has it")) << notRead.messages();
  EXPECT_EQ(notRead.messages().find("4 bytes"), std::string::npos) << "its size is not asked for";
  EXPECT_TRUE(maker()(inSphere(file + "\"short.raw\"")).failsWith("holds 4 bytes, expected 8"));
}

// ---- Values that PBRT-v3 moves into their range or ignores

TEST(Tolerance, NumbersBeyondTheirRangeAreMovedAsInPbrt) {
  const std::string matte = "Texture \"t\" \"color\" \"fbm\" \"integer octaves\" ";
  const std::string use = " Material \"matte\" \"texture Kd\" \"t\" " + kBall;
  const auto same = [](const std::string& tolerated, const std::string& said, const std::string& plain,
                       auto measure) {
    const Attempt a = with(tolerated), b = with(plain);
    ASSERT_TRUE(a.warns(said)) << tolerated << a.messages();
    ASSERT_TRUE(b.isSilent()) << plain << b.messages();
    EXPECT_EQ(measure(a), measure(b)) << tolerated;
  };
  same(matte + "-3" + use, "found -3, expected in [0, 64]; taken as 0", matte + "0" + use,
       [](const Attempt& a) { return materials(a); });
  same("LightSource \"infinite\" \"integer samples\" -2 " + kBall, "taken as 1",
       "LightSource \"infinite\" \"integer samples\" 1 " + kBall, lights);
  same("Shape \"sphere\" \"float radius\" -2", "taken without its sign",
       "Shape \"sphere\" \"float radius\" 2", surfaces);
  same("Shape \"disk\" \"float phimax\" -20 " + kBall, "the shape is left out", kBall, surfaces);
  same("LightSource \"distant\" \"point to\" [ 0 0 0 ] " + kBall, "the light is left out", kBall, lights);
}

TEST(Tolerance, ImagesOfStrategiesAreOfShortPathsAsInPbrtV3) {
  const std::string world = "LightSource \"infinite\" " + kBall;
  for (const std::string name : {"visualizestrategies", "visualizeweights"}) {
    const auto with = [&](const std::string& value, const std::string& depth) {
      return attemptWorld(
          world, {},
          "Integrator \"bdpt\" \"integer maxdepth\" " + depth + " \"bool " + name + "\" \"" + value + '"');
    };
    EXPECT_TRUE(with("false", "9").isSilent());
    EXPECT_TRUE(with("true", "5").isSilent());
    const Attempt asked = with("true", "6");
    EXPECT_TRUE(asked.made && asked.warns("\"" + name + "\" limits \"maxdepth\" to 5")) << asked.messages();
    EXPECT_TRUE(asked.made && asked.warns("found 6")) << asked.messages();
  }
}

TEST(Tolerance, ALensThatCannotBeIsNone) {
  const auto rays = [](const std::string& lens, const std::string& said) {
    const Attempt a = attemptWorld(kBall, {}, "Camera \"perspective\" " + lens);
    EXPECT_TRUE(said.empty() ? a.isSilent() : a.warns(said)) << a.messages();
    return cameraRays(a);
  };
  const Numbers pinhole = rays("", "");
  EXPECT_EQ(rays("\"float focaldistance\" 0 \"float lensradius\" 0", ""), pinhole) << "exporters write it";
  EXPECT_EQ(rays("\"float lensradius\" -1", "taken as 0"), pinhole);
  EXPECT_EQ(rays("\"float lensradius\" 1 \"float focaldistance\" -3", "all is sharp"), pinhole);
  EXPECT_EQ(rays("\"float screenwindow\" [ 0 1 ]", "left out"), pinhole);
  // A negative angle turns the picture: the ray of a corner is that of the opposite one.
  const Attempt turned = attemptWorld(kBall, {}, "Camera \"perspective\" \"float fov\" -50"),
                plain = attemptWorld(kBall, {}, "Camera \"perspective\" \"float fov\" 50");
  ASSERT_TRUE(turned.made && plain.made);
  const Vector3f a = turned.made->camera->generateRay({1, 2}, {0.5f, 0.5f}, 0).ray.d,
                 b = plain.made->camera->generateRay({7, 6}, {0.5f, 0.5f}, 0).ray.d;
  EXPECT_NEAR(a.x, b.x, 1e-6);
  EXPECT_NEAR(a.y, b.y, 1e-6);
  EXPECT_NEAR(a.z, b.z, 1e-6);
}

TEST(Tolerance, ArraysOfMeshesThatDoNotFitAreDroppedAndMeshesWithoutFacesLeftOut) {
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ -1 -1 0 1 -1 0 0 1 0 ] ";
  for (const std::string array : {"\"normal N\" [ 0 1 0 ]", "\"vector S\" [ 1 0 0 ]",
                                  "\"float uv\" [ 0 0 1 1 ]", "\"integer faceIndices\" [ 1 2 3 ]"}) {
    const Attempt a = with(mesh + array);
    ASSERT_TRUE(a.warns("the array is left out, as in PBRT-v3")) << array << a.messages();
    EXPECT_EQ(surfaces(a), surfaces(with(mesh))) << array;
  }
  for (const std::string empty :
       {"Shape \"trianglemesh\" \"point P\" [ ] \"normal N\" [ ] \"float st\" [ ] \"integer indices\" [ ] ",
        "Shape \"trianglemesh\" \"point P\" [ 0 0 0 ] ",
        "Shape \"loopsubdiv\" \"integer indices\" [ ] \"point P\" [ ] ",
        "Shape \"trianglemesh\" \"integer indices\" [ 0 1 9 ] \"point P\" [ -1 -1 0 1 -1 0 0 1 0 ] ",
        "Shape \"nurbs\" \"integer nu\" 4 "}) {
    const Attempt a = with("AreaLightSource \"diffuse\" " + empty + "AreaLightSource \"\" " + kBall);
    ASSERT_TRUE(a.warns("the shape is left out, as in PBRT-v3")) << empty << a.messages();
    EXPECT_EQ(surfaces(a), surfaces(with(kBall))) << empty;
  }
}

TEST(Tolerance, AMixOfUnknownMaterialsIsAMatteOfItsParameters) {
  const std::string kd = "\"rgb Kd\" [ .1 .2 .3 ] ";
  const Attempt mixed = with("Material \"mix\" \"string namedmaterial1\" \"a\" " + kd + kBall),
                matte = with("Material \"matte\" " + kd + kBall);
  ASSERT_TRUE(mixed.warns("unknown material \"a\"")) << mixed.messages();
  EXPECT_TRUE(mixed.warns("\"namedmaterial2\" is missing; a matte takes its place"));
  EXPECT_EQ(bsdfValues(mixed), bsdfValues(matte));
}

TEST(Tolerance, AnUnknownTextureOfTheShapeGivesTheDefaultNotTheMaterialsValue) {
  const Attempt a = with("Material \"matte\" \"rgb Kd\" [ .1 .2 .3 ] " + kBall + "\"texture Kd\" \"nil\"");
  ASSERT_TRUE(a.warns("the default is used, as in PBRT-v3")) << a.messages();
  EXPECT_EQ(materials(a), materials(with(kBall)));
}

// ---- Values of this renderer's own parameters are never guessed

TEST(Tolerance, UnknownWordsOfOwnParametersStayErrors) {
  const std::string grid = "\"string type\" \"heterogeneous\" \"float density\" 1 ";
  for (const std::string p : {"transmittance", "freeflight", "bounds", "overlap", "border", "precision",
                              "layout", "pattern", "law", "phase"}) {
    const Attempt a = with(inSphere(grid + "\"string " + p + "\" \"nonsense\""));
    EXPECT_TRUE(a.failsWith("nonsense")) << p << a.messages();
  }
  for (const std::string p : {"mediumlightsampling", "channelsampling", "mistransmittance"}) {
    EXPECT_TRUE(attemptWorld(kBall, {}, "Integrator \"volpath\" \"string " + p + "\" \"nonsense\"")
                    .failsWith("nonsense"))
        << p;
  }
}

TEST(Tolerance, OwnParametersThatDoNotFitTheirTypeStayErrors) {
  const std::string grid = "\"string type\" \"heterogeneous\" \"float density\" 1 ";
  const std::string perlin = "\"string type\" \"perlin\" ";
  const std::string analytic = "\"string type\" \"analytic\" \"string function\" \"sphere\" ";
  struct Case {
    std::string parameters, name, found;
  };
  const Case cases[] = {
      {grid + "\"float supervoxels\" 2", "supervoxels", "found type float, expected integer"},
      {grid + "\"integer supervoxels\" 2.5", "supervoxels", "found 2.5, expected a whole number"},
      {grid + "\"int supervoxels\" 2", "supervoxels", "unknown type \"int\""},
      {grid + "\"string roulettethreshold\" \".5\"", "roulettethreshold",
       "found type string, expected float"},
      {grid + "\"float roulettethreshold\" [ .5 .5 ]", "roulettethreshold", "found 2 values, expected 1"},
      {grid + "\"float roulettethreshold\" \".5\"", "roulettethreshold", "expected a number"},
      {grid + "\"float transmittance\" 1", "transmittance", "found type float, expected string"},
      {grid + "\"string transmittance\" 1", "transmittance", "found 1, expected a quoted string"},
      {grid + "\"string transmittance\" [ ]", "transmittance", "found no value"},
      {grid + "\"integer freeflight\" 1", "freeflight", "found type integer, expected string"},
      {grid + "\"bool bounds\" \"true\"", "bounds", "found type bool, expected string"},
      {grid + "\"integer majorant\" 1", "majorant", "found type integer, expected float"},
      {grid + "\"float border\" 1", "border", "found type float, expected string"},
      {grid + "\"float priority\" 1", "priority", "found type float, expected integer"},
      {grid + "\"float phase\" 1", "phase", "found type float, expected string"},
      {grid + "\"float Le\" 1", "Le", "found type float, expected rgb"},
      {grid + "\"rgb Le\" [ 1 1 1 1 ]", "Le", "found 4 numbers, expected a multiple of 3"},
      {grid + "\"rgb Lescale\" [ 1 1 1 ]", "Lescale", "found type rgb, expected float"},
      {grid + "\"rgb temperature\" [ 1 1 1 ]", "temperature", "found type rgb, expected float"},
      {perlin + "\"float octaves\" 2", "octaves", "found type float, expected integer"},
      {perlin + "\"integer gain\" 1", "gain", "found type integer, expected float"},
      {analytic + "\"vector center\" [ 0 0 0 ]", "center", "found type vector, expected point"},
      {analytic + "\"integer radius\" 1", "radius", "found type integer, expected float"}};
  for (const Case& c : cases) {
    const Attempt a = with(inSphere(c.parameters));
    EXPECT_TRUE(a.failsWith("parameter \"" + c.name + "\": ")) << c.parameters << a.messages();
    EXPECT_TRUE(a.failsWith(c.found)) << c.parameters << a.messages();
    EXPECT_EQ(a.diagnostics.errorCount(), 1u) << c.parameters << a.messages();
  }
  for (const std::string p : {"mediumlightsampling", "channelsampling", "mistransmittance"}) {
    const Attempt a = attemptWorld(kBall, {}, "Integrator \"volpath\" \"bool " + p + "\" \"true\"");
    EXPECT_TRUE(a.failsWith("parameter \"" + p + "\": found type bool, expected string")) << a.messages();
  }
}

TEST(Tolerance, WrongTypesOfPbrtsParametersAreItsDefaults) {
  const std::string grid = "\"string type\" \"heterogeneous\" \"float density\" 1 ";
  for (const char* p :
       {"\"float sigma_a\" 1", "\"integer scale\" 2", "\"float g\" [ .1 .2 ]", "\"float nx\" 1",
        "\"vector p0\" [ 0 0 0 ]", "\"float preset\" 1", "\"string scale\" 2"}) {
    const Attempt a = with(inSphere(grid + p));
    EXPECT_TRUE(a.made && a.diagnostics.all().size() == 1) << p << a.messages();
  }
  for (const char* p :
       {"\"float maxdepth\" 3", "\"integer rrthreshold\" 1", "\"bool pixelbounds\" \"true\""}) {
    const Attempt a = attemptWorld(kBall, {}, std::string("Integrator \"volpath\" ") + p);
    EXPECT_TRUE(a.warns("it is ignored, as in PBRT-v3")) << p << a.messages();
  }
}

// ---- Media

TEST(Tolerance, NegativeSamplesCountAsZeroAndAreCountedButNaNIsNot) {
  const std::string grid = "\"string type\" \"heterogeneous\" \"integer nx\" 3 ";
  const Attempt a = with(inSphere(grid + "\"float density\" [ 1 -.5 -2 ]"));
  ASSERT_TRUE(a.warns("holds 2 negative values, the first at voxel (1, 0, 0): -0.5; they count as 0"))
      << a.messages();
  EXPECT_EQ(media(a), media(with(inSphere(grid + "\"float density\" [ 1 0 0 ]"))));
  const StrictAttempts strict;
  EXPECT_TRUE(with(inSphere(grid + "\"float density\" [ 1 -.5 -2 ]")).failsWith("2 negative values"));
}

TEST(Tolerance, NegativeSamplesOfRawFilesCountAsZero) {
  const TemporaryFolder folder;
  const auto write = [&](const char* name, std::array<float, 3> values) {
    std::ofstream(folder.path() / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(values.data()), sizeof values);
  };
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  write("negative.raw", {1, -1, -3});
  write("nan.raw", {1, kNan, -3});
  write("inf.raw", {-kInf, 1, 1});
  folder.write("half.raw", std::string("\x00\x3c\x00\xbc\x00\xc0", 6));
  const auto raw = [&](const std::string& file) {
    return attemptWorld(
        inSphere("\"string type\" \"heterogeneous\" \"integer nx\" 3 \"string filename\" " + file),
        {.folder = folder.path()});
  };
  EXPECT_TRUE(
      raw("\"negative.raw\"").warns("the file holds 2 negative values, the first at voxel (1, 0, 0): -1"));
  EXPECT_TRUE(raw("\"half.raw\" \"string format\" \"half\"").warns("the file holds 2 negative values"))
      << raw("\"half.raw\" \"string format\" \"half\"").messages();
  EXPECT_TRUE(raw("\"nan.raw\"").failsWith("found nan at voxel (1, 0, 0)"));
  EXPECT_TRUE(raw("\"inf.raw\"").failsWith("found -inf at voxel (0, 0, 0)"));
}

TEST(Tolerance, ADensityThatDoesNotFitIsVacuum) {
  for (const std::string p :
       {"\"integer nx\" 2 \"float density\" [ 1 1 1 ]", "\"integer nx\" 0 \"float density\" [ ]",
        "\"integer ny\" -1 \"float density\" [ 1 ]", ""}) {
    const Attempt a = with(inSphere("\"string type\" \"heterogeneous\" " + p));
    ASSERT_TRUE(a.warns("the medium is vacuum, as in PBRT-v3")) << p << a.messages();
    EXPECT_EQ(mediumOf(a), nullptr);
  }
}

TEST(Tolerance, AFlatBoxIsTheOnlyComplaint) {
  const Attempt a =
      with(inSphere("\"string type\" \"heterogeneous\" \"float density\" [ 1 ] \"point p1\" [ 1 1 0 ]"));
  EXPECT_TRUE(a.failsWith("the box is flat: p0 and p1 agree in z"));
  EXPECT_EQ(a.diagnostics.all().size(), 1u) << a.messages();
  // The same for other media whose reading ends early.
  for (const std::string p : {"\"string type\" \"analytic\" \"string function\" \"sper\" \"float radius\" 2",
                              "\"string type\" \"perlin\" \"point p1\" [ 1 1 0 ] \"integer octaves\" 2",
                              "\"string type\" \"nanovdb\" \"string filename\" \"nil.nvdb\" \"string grid\" "
                              "\"x\" \"string Legrid\" \"y\" "
                              "\"rgb Le\" [ 1 1 1 ]",
                              "\"string type\" \"heterogeneous\" \"string filename\" \"nil.raw\" \"integer "
                              "nx\" 4 \"string format\" "
                              "\"half\""}) {
    EXPECT_EQ(with(inSphere(p)).diagnostics.all().size(), 1u) << with(inSphere(p)).messages();
  }
}

TEST(Tolerance, ColoursBeyondRgbLoseTheirNegativeChannelsWithAWarning) {
  const std::string homogeneous = "\"string type\" \"homogeneous\" \"rgb sigma_s\" [ 0 0 0 ] ";
  // A narrow red line has a negative blue channel, as has a candle.
  const std::string line = "[ 600 0 620 1 640 0 ]";
  const Rgb red = sampledSpectrumToRgb({{600, 0}, {620, 1}, {640, 0}});
  ASSERT_LT(red.min(), 0);
  for (const std::string& p :
       {"\"spectrum sigma_a\" " + line, "\"spectrum sigma_s\" " + line,
        "\"rgb sigma_a\" [ 1 1 1 ] \"spectrum Le\" " + line, std::string("\"xyz sigma_a\" [ 1 0 0 ]"),
        std::string("\"rgb sigma_a\" [ 1 1 1 ] \"blackbody Le\" [ 1500 1 ]")}) {
    const Attempt a = with(inSphere(homogeneous + p));
    ASSERT_TRUE(a.warns("its negative channels count as 0")) << p << a.messages();
    const StrictAttempts strict;
    EXPECT_TRUE(with(inSphere(homogeneous + p)).made.has_value()) << p << ": no fault of the file";
  }
  const Rgb clamped = red.nonNegative();
  const auto number = [](float x) {
    std::ostringstream text;
    text.precision(9);
    text << x << ' ';
    return text.str();
  };
  EXPECT_EQ(media(with(inSphere(homogeneous + "\"spectrum sigma_a\" " + line))),
            media(with(inSphere(homogeneous + "\"rgb sigma_a\" [ " + number(clamped.r) + number(clamped.g) +
                                number(clamped.b) + "]"))));
  // What is written as a negative number is told of as a mistake.
  expectMistakes({{inSphere(homogeneous + "\"rgb sigma_a\" [ 1 -1 1 ]"), "its negative channels count as 0",
                   "", kTolerated}},
                 with);
}

TEST(Tolerance, ABlackBodyWithoutTemperatureIsBlack) {
  const Attempt a = with("LightSource \"point\" \"blackbody I\" [ 0 1 ] " + kBall);
  ASSERT_TRUE(a.warns("a black body without temperature is black")) << a.messages();
  EXPECT_EQ(lights(a), lights(with("LightSource \"point\" \"rgb I\" [ 0 0 0 ] " + kBall)));
}

// ---- Emission that would be dark in silence

TEST(Tolerance, EmissionThatCannotBeSeenIsTold) {
  const std::string fog = "\"string type\" \"homogeneous\" ",
                    grid =
                        "\"string type\" \"heterogeneous\" \"integer nz\" 2 "
                        "\"float density\" [ 1 1 ] ";
  const auto made = [](const std::string& medium) { return with(inSphere(medium)); };
  EXPECT_TRUE(
      made(fog + "\"float Lescale\" 5").failsWith("it multiplies the radiance \"Le\", which is not given"));
  EXPECT_TRUE(made(grid + "\"float Lescale\" 5").failsWith("which is not given"));
  EXPECT_TRUE(made(grid + "\"float Lescale\" [ 5 5 ]").failsWith("which is not given"));
  EXPECT_TRUE(made(grid + "\"float Lescale\" 5 \"float temperature\" [ 900 2000 ]").isSilent());
  EXPECT_TRUE(
      made(grid + "\"float temperature\" [ .75 .75 ]").warns("is a \"float temperaturescale\" missing?"));
  EXPECT_TRUE(made(grid + "\"float temperature\" [ .75 .75 ] \"float temperaturescale\" 3000").isSilent());
  EXPECT_TRUE(made(grid + "\"rgb Le\" [ 1 1 1 ] \"float Lescale\" [ 0 0 ]").warns("all its factors are 0"));
  EXPECT_TRUE(made(fog + "\"rgb Le\" [ 1 1 1 ] \"rgb sigma_a\" [ 0 0 0 ]").warns("sigma_a is 0"));
  EXPECT_TRUE(made(fog + "\"rgb Le\" [ 1 1 1 ]").isSilent());
  EXPECT_TRUE(
      made(grid + "\"rgb sigma_s\" [ 0 0 0 ] \"float temperature\" [ 900 2000 ] \"string law\" \"davis\"")
          .isSilent());
}

}  // namespace
}  // namespace pbrtmedia::test
