// SPDX-License-Identifier: BSD-2-Clause
#include "construct/shapes.h"

#include "construct/probe.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

Attempt with(const std::string& shape) { return attemptWorld(shape); }

/// A bent strand; of a ribbon two normals.
const std::string kPoints = "\"point P\" [ -1 -1 0 -.4 .5 .3 .5 -.3 0 1 1 .2 ] ";
const std::string kCurve = "Shape \"curve\" \"float width\" .6 " + kPoints;
const std::string kNormals = "\"normal N\" [ 0 0 1 .6 0 .8 ] ";

/// Two triangles in the plane z = 0.
const std::string kMesh =
    "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] \"point P\" [ -1 -1 0 1 -1 0 1 1 0 -1 1 0 ] ";
/// A tetrahedron.
const std::string kCage =
    "Shape \"loopsubdiv\" \"integer indices\" [ 0 2 1 0 1 3 1 2 3 2 0 3 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 0 "
    "0 1 ] ";
const std::string kField =
    "Shape \"heightfield\" \"integer nu\" 2 \"integer nv\" 3 \"float Pz\" [ 0 .1 .2 .3 0 .1 ] ";
const std::string kPatch =
    "Shape \"nurbs\" \"integer nu\" 3 \"integer nv\" 2 \"integer uorder\" 3 \"integer vorder\" 2 "
    "\"float uknots\" [ 0 0 0 1 1 1 ] \"float vknots\" [ 0 0 1 1 ] ";
const std::string kPatchPoints = "\"point P\" [ -1 -1 0 0 -1 1 1 -1 0 -1 1 0 0 1 1 1 1 0 ] ";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n-1 -1 0\n1 -1 0\n0 1 0\n3 0 1 2\n";

TEST(ConstructShape, EveryParameterOfQuadricsHasItsEffect) {
  std::vector<Effect> effects;
  const auto add = [&](const std::string& type, const std::vector<std::string>& parameters) {
    const std::string shape = "Shape \"" + type + '"';
    for (const std::string& p : parameters) effects.push_back({shape, shape + ' ' + p});
    effects.push_back({shape, "Translate 0.1 0 0 " + shape});
    effects.push_back({shape, "ReverseOrientation " + shape});
  };
  const std::string radius = "\"float radius\" 0.5", zmin = "\"float zmin\" -0.3",
                    zmax = "\"float zmax\" 0.4", phimax = "\"float phimax\" 200";
  add("sphere", {radius, zmin, zmax, phimax});
  add("cylinder", {radius, zmin, zmax, phimax});
  add("disk", {radius, "\"float height\" 0.3", "\"float innerradius\" 0.2", phimax});
  add("cone", {radius, "\"float height\" 0.3", phimax});
  add("paraboloid", {radius, "\"float zmin\" 0.3", zmax, phimax});
  add("hyperboloid", {"\"point p1\" [ 1 -1 -1 ]", "\"point p2\" [ 0.9 0.3 0.7 ]", phimax});
  expectEffects(effects, with, surfaces);
  expectSame(
      {{"Shape \"sphere\"",
        "Shape \"sphere\" \"float radius\" 1 \"float zmin\" -1 \"float zmax\" 1 \"float phimax\" 360"},
       {"Shape \"cylinder\"", "Shape \"cylinder\" \"float radius\" 1 \"float zmin\" -1 \"float zmax\" 1"},
       {"Shape \"disk\"", "Shape \"disk\" \"float height\" 0 \"float radius\" 1 \"float innerradius\" 0"},
       {"Shape \"cone\"", "Shape \"cone\" \"float radius\" 1 \"float height\" 1"},
       {"Shape \"paraboloid\"", "Shape \"paraboloid\" \"float radius\" 1 \"float zmin\" 0 \"float zmax\" 1"},
       {"Shape \"hyperboloid\"", "Shape \"hyperboloid\" \"point p1\" [ 0 0 0 ] \"point p2\" [ 1 1 1 ]"}},
      with, surfaces);
}

TEST(ConstructShape, SaysWhenAHyperboloidIsNotWhatItsSegmentSweeps) {
  const std::string elsewhere = "Shape \"hyperboloid\" \"point p1\" [ -2 .5 .4 ] \"point p2\" [ -.7 -.3 -1 ]",
                    empty = "Shape \"hyperboloid\" \"point p1\" [ 1 0 -1 ] \"point p2\" [ 0 0 1 ]";
  EXPECT_TRUE(attemptWorld(elsewhere).warns("with radius 0.6366 at p1 instead of 2.062"));
  EXPECT_TRUE(
      attemptWorld(elsewhere, {.strict = true}).failsWith("with radius 0.6366 at p1 instead of 2.062"));
  EXPECT_TRUE(attemptWorld(empty).warns("nothing is rendered"));
  EXPECT_TRUE(attemptWorld("Shape \"hyperboloid\"").isSilent()) << "PBRT-v3 never ends; here it is a cone";
}

TEST(ConstructShape, EveryParameterOfMeshesHasItsEffect) {
  expectEffects({{kMesh, kMesh + "\"normal N\" [ 0 0 1 0 .6 .8 0 0 1 0 0 1 ]"},
                 {kMesh, kMesh + "\"vector S\" [ 0 1 0 0 1 0 0 1 0 0 1 0 ]"},
                 {kMesh, kMesh + "\"point2 uv\" [ 0 0 1 0 1 1 0 1 ]"},
                 {kMesh, kMesh + "\"float alpha\" 0"},
                 {kMesh, kMesh + "\"float shadowalpha\" 0"},
                 {kMesh, kMesh + "\"integer faceIndices\" [ 5 6 ]"},
                 {kMesh + "\"float alpha\" 0", kMesh + "\"float shadowalpha\" 0"},
                 {kCage, kCage + "\"integer levels\" 1"},
                 {kCage, kCage + "\"integer nlevels\" 1"},
                 {kField, "Scale 2 1 1 " + kField},
                 {kPatch + kPatchPoints, kPatch + kPatchPoints + "\"float u0\" 0.2"},
                 {kPatch + kPatchPoints, kPatch + kPatchPoints + "\"float u1\" 0.7"},
                 {kPatch + kPatchPoints, kPatch + kPatchPoints + "\"float v0\" 0.2"},
                 {kPatch + kPatchPoints, kPatch + kPatchPoints + "\"float v1\" 0.7"},
                 {kPatch + kPatchPoints,
                  kPatch + "\"float Pw\" [ -1 -1 0 1  0 -2 2 2  1 -1 0 1  -1 1 0 1  0 1 1 1  1 1 0 1 ]"}},
                with, surfaces);
  expectSame({{kMesh + "\"point2 uv\" [ 0 0 1 0 1 1 0 1 ]", kMesh + "\"float uv\" [ 0 0 1 0 1 1 0 1 ]"},
              {kMesh + "\"point2 uv\" [ 0 0 1 0 1 1 0 1 ]", kMesh + "\"point2 st\" [ 0 0 1 0 1 1 0 1 ]"},
              {kMesh + "\"point2 uv\" [ 0 0 1 0 1 1 0 1 ]", kMesh + "\"float st\" [ 0 0 1 0 1 1 0 1 ]"},
              {kMesh + "\"point2 uv\" [ 0 0 1 0 1 1 0 1 ]",
               kMesh + "\"point2 st\" [ 3 0 1 0 1 1 0 1 ] \"point2 uv\" [ 0 0 1 0 1 1 0 1 ]"},
              {kMesh, kMesh + "\"float alpha\" 0.5 \"float shadowalpha\" 0.001"},
              {kCage, kCage + "\"integer levels\" 3 \"string scheme\" \"loop\""},
              {kPatch + kPatchPoints,
               kPatch + kPatchPoints + "\"float u0\" 0 \"float u1\" 1 \"float v0\" 0 \"float v1\" 1"}},
             with, surfaces);
}

TEST(ConstructShape, EveryParameterOfCurvesHasItsEffect) {
  const std::string five = "\"point P\" [ -1 -1 0 -.4 .5 .3 .5 -.3 0 1 1 .2 .2 1 .1 ] ";
  const std::string wide = "Shape \"curve\" \"float width\" .6 ";
  const std::string ribbon = kCurve + "\"string type\" \"ribbon\" " + kNormals;
  expectEffects({{kCurve, "Shape \"curve\" \"float width\" .4 " + kPoints},
                 {kCurve, kCurve + "\"float width0\" .3"},
                 {kCurve, kCurve + "\"float width1\" .3"},
                 {kCurve, kCurve + "\"string basis\" \"bspline\""},
                 {kCurve, kCurve + "\"string type\" \"cylinder\""},
                 {kCurve, ribbon},
                 {ribbon, kCurve + "\"string type\" \"ribbon\" \"normal N\" [ 0 0 1 0 .6 .8 ]"},
                 {wide + five + "\"string basis\" \"bspline\"",
                  wide + five + "\"string basis\" \"bspline\" \"integer degree\" 2"},
                 {kCurve, "Translate .2 0 0 " + kCurve},
                 {kCurve, "ReverseOrientation " + kCurve},
                 {kCurve, "Scale -1 1 1 " + kCurve}},
                with, surfaces);
  expectSame({{kCurve, kCurve + "\"string type\" \"flat\" \"string basis\" \"bezier\" \"integer degree\" 3"},
              {kCurve, kCurve + "\"float width0\" .6 \"float width1\" .6"},
              {kCurve, kCurve + "\"integer splitdepth\" 3"},
              {kCurve + "\"integer splitdepth\" 1", kCurve + "\"float splitdepth\" 1"},
              {"Shape \"curve\" " + kPoints, "Shape \"curve\" \"float width\" 1 " + kPoints}},
             with, surfaces);
  EXPECT_TRUE(with(kCurve + "\"integer splitdepth\" 2000000000").isSilent());
  EXPECT_TRUE(with(kCurve + "\"integer splitdepth\" -5").isSilent());
}

TEST(ConstructShape, TexturesCutWhereTheyAreZero) {
  const std::string texture =
      "Texture \"a\" \"float\" \"checkerboard\" \"float uscale\" 2 \"float vscale\" 2 ";
  expectEffects({{texture + kMesh, texture + kMesh + "\"texture alpha\" \"a\""},
                 {texture + kMesh, texture + kMesh + "\"texture shadowalpha\" \"a\""}},
                with, surfaces);
}

TEST(ConstructShape, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{kCage + "\"integer levels\" 12",
        "which gives 67108864 triangles; expected at most 16777216, so up to 11 levels", ""},
       {"Shape \"shpere\"", "Shape: unknown type \"shpere\"; did you mean \"sphere\"?", "t.pbrt:2:7",
        kTolerated},
       {"Shape \"cruve\"", "unknown type \"cruve\"; did you mean \"curve\"?", "t.pbrt:2:7", kTolerated},
       {"Shape \"curve\"", "parameter \"point P\" is missing; the shape is left out", "t.pbrt:2:1",
        kTolerated},
       {"Shape \"curve\" \"point P\" [ 0 0 0 1 0 0 2 0 0 ]",
        "P: expected 4 points and 3 for each further segment, found 3 points", "t.pbrt:2:1", kTolerated},
       {"Shape \"curve\" \"point P\" [ 0 0 0 1 0 0 2 0 0 ] \"string basis\" \"bspline\"",
        "P: expected 4 points or more, found 3 points", "", kTolerated},
       {kCurve + "\"integer degree\" 4", "degree: expected 2 or 3, found 4", "", kTolerated},
       {kCurve + "\"string basis\" \"hermite\"", "unknown basis \"hermite\"", "", kTolerated},
       {kCurve + "\"string type\" \"round\"",
        "unknown type \"round\"; known: flat, ribbon, cylinder; taken as "
        "cylinder",
        "", kTolerated},
       {kCurve + "\"string type\" \"ribbon\"", "N: expected 2 normals", "", kTolerated},
       {kCurve + "\"string type\" \"ribbon\" \"normal N\" [ 0 0 1 ]", "N: expected 2 normals", "",
        kTolerated},
       {kCurve + "\"string type\" \"ribbon\" \"normal N\" [ 0 0 1 0 0 0 ]",
        "N: expected normals of finite length above 0", "", kTolerated},
       {kCurve + "\"float width0\" -1", "\"width0\": found -1, expected >= 0; taken without its sign", "",
        kTolerated},
       {"Shape \"curve\" \"float width\" 0 " + kPoints,
        "the curve has no width or no length; the shape is left out", "", kTolerated},
       {"Shape \"curve\" \"point P\" [ 1 1 1 1 1 1 1 1 1 1 1 1 ]", "the curve has no width or no length", "",
        kTolerated},
       {kCurve + "\"float alpha\" 0", "unknown parameter \"alpha\"", "", kTolerated},
       {"AreaLightSource \"diffuse\" " + kCurve, "curves are no area lights: it does not emit", "",
        kTolerated},
       {"Shape \"sphere\" \"float radius\" 0", "radius: expected a finite number > 0, found 0", "t.pbrt:2:1",
        kTolerated},
       {"Shape \"sphere\" \"integer radius\" 1", "\"radius\": found type integer, expected float",
        "t.pbrt:2:16", kTolerated},
       {"Shape \"sphere\" \"float raduis\" 1", "unknown parameter \"raduis\"; did you mean \"radius\"?",
        "t.pbrt:2:16", kTolerated},
       {"Shape \"sphere\" \"float alpha\" 0", "unknown parameter \"alpha\"", "", kTolerated},
       {"Shape \"disk\" \"float phimax\" 0", "phimax: expected degrees > 0", "", kTolerated},
       {"Scale 1 0 1 Shape \"sphere\"", "Scale: the matrix has no inverse", "t.pbrt:2:1", kTolerated},
       {"Shape \"trianglemesh\"", "parameter \"integer indices\" is missing", "t.pbrt:2:1", kTolerated},
       {"Shape \"trianglemesh\"", "parameter \"point P\" is missing", "t.pbrt:2:1", kTolerated},
       {"Shape \"trianglemesh\" \"float indices\" [ 0 1 2 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ]",
        "\"indices\": found type float, expected integer", "t.pbrt:2:22", kTolerated},
       {"Shape \"trianglemesh\" \"integer indices\" [ 0 1 3 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ]",
        "\"indices\": ", "", kTolerated},
       {"Shape \"trianglemesh\" \"integer indices\" [ 0 1 -1 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ]",
        "\"indices\": ", "", kTolerated},
       {kMesh + "\"normal N\" [ 0 0 1 ]", "\"N\": ", "", kTolerated},
       {kMesh + "\"vector S\" [ 0 0 1 ]", "\"S\": ", "", kTolerated},
       {kMesh + "\"point2 uv\" [ 0 0 1 1 ]", "\"uv\": ", "", kTolerated},
       {kMesh + "\"float st\" [ 0 0 1 1 ]", "\"st\": ", "", kTolerated},
       {kMesh + "\"float uv\" [ 0 0 1 ]", "\"uv\": found 3 numbers, expected pairs", "", kTolerated},
       {kMesh + "\"integer faceIndices\" [ 1 ]", "\"faceIndices\": ", "", kTolerated},
       {kMesh + "\"texture alpha\" \"nil\"", "unknown float texture \"nil\"; none is defined here", "",
        kTolerated},
       {kCage + "\"integer levels\" -1", "found -1 levels, expected at least 0; taken as 0", "", kTolerated},
       {"Shape \"loopsubdiv\"", "parameter \"integer indices\" is missing", "", kTolerated},
       {"Shape \"plymesh\"", "parameter \"string filename\" is missing or empty", "t.pbrt:2:1", kTolerated},
       {"Shape \"plymesh\" \"string filename\" \"nil.ply\"", "there is no file \"", "t.pbrt:2:35",
        kTolerated},
       {"Shape \"heightfield\"", "parameter \"float Pz\" is missing", "t.pbrt:2:1"},
       {"Shape \"heightfield\" \"integer nu\" 1 \"integer nv\" 2 \"float Pz\" [ 1 2 ]",
        "nu: expected at least 2 samples", "", kTolerated},
       {"Shape \"heightfield\" \"integer nu\" 2 \"integer nv\" 2 \"float Pz\" [ 1 2 ]",
        "Pz: expected 4 numbers (nu * nv), found 2", "t.pbrt:2:1"},
       {"Shape \"nurbs\"", "parameter \"float uknots\" is missing", "", kTolerated},
       {kPatch, "parameter \"point P\" or \"float Pw\" is missing", "", kTolerated},
       {kPatch + "\"point P\" [ 0 0 0 ]", "Shape \"nurbs\": ", "", kTolerated},
       {kPatch + kPatchPoints + "\"float u0\" 5", "Shape \"nurbs\": ", "", kTolerated}},
      with);
}

TEST(ConstructShape, ReadsPlyFiles) {
  const TemporaryFolder folder;
  folder.write("a.ply", kPly);
  folder.write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n1\n");
  std::string wrongIndex = kPly;
  wrongIndex.replace(wrongIndex.rfind('2'), 1, "7");
  folder.write("index.ply", wrongIndex);
  const auto inFolder = [&](const std::string& shape) {
    return attemptWorld(shape, {.folder = folder.path()});
  };
  const std::string ply = "Shape \"plymesh\" \"string filename\" \"a.ply\"";
  expectSame(
      {{ply, "Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 ] \"point P\" [ -1 -1 0 1 -1 0 0 1 0 ]"}},
      inFolder, surfaces);
  expectEffects({{ply, ply + " \"float alpha\" 0"}, {ply, ply + " \"float shadowalpha\" 0"}}, inFolder,
                surfaces);
  expectMistakes({{"Shape \"plymesh\" \"string filename\" \"broken.ply\"", "", "", kTolerated},
                  {"Shape \"plymesh\" \"string filename\" \"index.ply\"", "indices", "", kTolerated}},
                 inFolder);
}

TEST(ConstructShape, WarnsOfWhatAMeshLeavesOut) {
  const Attempt a =
      with("Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 ] \"point P\" [ 0 0 0 1 0 0 0 1 0 ]");
  EXPECT_TRUE(a.warns("\"indices\"")) << a.messages();
  EXPECT_TRUE(with(kMesh + "\"float st\" [ 0 0 0 0 0 0 0 0 1 1 ]").warns("\"st\""));
}

TEST(ConstructShape, SaysThatNormalsAreForRibbons) {
  const Attempt a = with(kCurve + kNormals);
  EXPECT_TRUE(a.warns("\"N\" is for curves of type ribbon only")) << a.messages();
  EXPECT_EQ(surfaces(a), surfaces(with(kCurve)));
}

TEST(ConstructShape, LeavesUnknownShapesOut) {
  const Attempt a = attemptWorld("Shape \"blob\" \"float width\" 1 Shape \"sphere\" \"float raduis\" 2");
  ASSERT_TRUE(a.warns("unknown type \"blob\"")) << a.messages();
  EXPECT_TRUE(a.warns("unknown parameter \"raduis\""));
  EXPECT_EQ(surfaces(a), surfaces(with("Shape \"sphere\"")));
}

}  // namespace
}  // namespace pbrtmedia::test
