// SPDX-License-Identifier: BSD-2-Clause
#include "construct/cameras.h"

#include "construct/probe.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

/// The camera, in line 1 at column 1.
Attempt with(const std::string& camera) {
  return attempt(camera + "\n" + kSmall + "WorldBegin " + kLight + "WorldEnd");
}

TEST(ConstructCamera, EveryParameterHasItsEffect) {
  std::vector<Effect> effects{{"", "Camera \"orthographic\""},
                              {"", "Camera \"environment\""},
                              {"", "Translate 0 0 1 Camera \"perspective\""},
                              {"", "Camera \"perspective\" \"float fov\" 45"},
                              {"", "Camera \"perspective\" \"float halffov\" 30"}};
  for (const std::string type : {"perspective", "orthographic", "environment"}) {
    const std::string camera = "Camera \"" + type + '"';
    effects.push_back({camera, camera + " \"float shutteropen\" 0.5"});
    effects.push_back({camera, camera + " \"float shutterclose\" 2"});
    effects.push_back({camera, "ActiveTransform EndTime Translate 1 0 0 ActiveTransform All " + camera});
    if (type == "environment") continue;
    effects.push_back({camera, camera + " \"float frameaspectratio\" 2"});
    effects.push_back({camera, camera + " \"float screenwindow\" [ -2 2 -1 1 ]"});
    effects.push_back({camera, camera + " \"float lensradius\" 0.1"});
    effects.push_back({camera + " \"float lensradius\" 0.1",
                       camera + " \"float lensradius\" 0.1 \"float focaldistance\" 3"});
  }
  expectEffects(effects, with, cameraRays);
  expectSame(
      {{"", "Camera \"perspective\" \"float fov\" 90 \"float lensradius\" 0 \"float focaldistance\" 1e6"},
       {"Camera \"environment\"",
        "Camera \"environment\" \"float lensradius\" 1 \"float focaldistance\" 2 \"float frameaspectratio\" "
        "3 "
        "\"float screenwindow\" [ 0 1 0 1 ]"},
       {"Camera \"perspective\" \"float halffov\" 30", "Camera \"perspective\" \"float fov\" 60"}},
      with, cameraRays);
}

TEST(ConstructCamera, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{"Camera \"perspectiv\"",
        "Camera: unknown type \"perspectiv\"; did you mean \"perspective\"? known: ", "t.pbrt:1:8"},
       {"Camera \"perspective\" \"float fov\" 180", "\"fov\": found 180, expected in (0, 180)",
        "t.pbrt:1:34"},
       {"Camera \"perspective\" \"float halffov\" 90", "expected above 0 and below 90", ""},
       {"Camera \"perspective\" \"float fov\" -40", "the picture is turned by 180 degrees", "t.pbrt:1:34",
        kTolerated},
       {"Camera \"perspective\" \"integer fov\" 30", "\"fov\": found type integer, expected float",
        "t.pbrt:1:22", kTolerated},
       {"Camera \"perspective\" \"float fvo\" 30", "unknown parameter \"fvo\"; did you mean \"fov\"?", "",
        kTolerated},
       {"Camera \"perspective\" \"float lensradius\" -1", "expected >= 0", "", kTolerated},
       {"Camera \"orthographic\" \"float lensradius\" .1 \"float focaldistance\" 0",
        "expected > 0; the lens is left out", "", kTolerated},
       {"Camera \"orthographic\" \"float frameaspectratio\" 0", "expected > 0", ""},
       {"Camera \"orthographic\" \"float fov\" 30", "unknown parameter \"fov\"", "", kTolerated},
       {"Camera \"perspective\" \"float screenwindow\" [ 0 1 ]",
        "found 2 numbers, expected 4: xmin xmax ymin ymax", "", kTolerated},
       {"Camera \"perspective\" \"float screenwindow\" [ 1 1 0 1 ]",
        "screen window must be finite and not empty", ""},
       {"Camera \"perspective\" \"float fov\" [ 40 50 ]", "\"fov\": found 2 values, expected 1", "",
        kTolerated}},
      with);
}

const std::string kLenses = "# a lens and its stop\n50 20 1.6 30\n-80 4 1 30\n0 50 0 6";

TEST(ConstructCamera, ReadsLensFiles) {
  const TemporaryFolder folder;
  folder.write("a.dat", kLenses);
  folder.write("other.dat", "60 20 1.6 30 -80 4 1 30 0 50 0 6");
  folder.write("odd.dat", "50 20 1.6\n");
  folder.write("text.dat", "fifty 20 1.6 30\n");
  folder.write("flat.dat", "0 20 1 30\n");
  folder.write("glass.dat", "50 20 -1.6 30\n");
  const auto inFolder = [&](const std::string& camera, const std::string& film = "") {
    return attempt(camera + "\n" + kSmall + film + " WorldBegin " + kLight + "WorldEnd",
                   {.folder = folder.path()});
  };
  const auto alone = [&](const std::string& camera) { return inFolder(camera); };
  const std::string realistic = "Camera \"realistic\" ", a = realistic + "\"string lensfile\" \"a.dat\" ";
  const std::string open = a + "\"float aperturediameter\" 5 ";
  expectEffects({{a, realistic + "\"string lensfile\" \"other.dat\""},
                 {a, open},
                 {a, a + "\"float focusdistance\" 0.5"},
                 {a, a + "\"float shutteropen\" 0.5"},
                 {a, a + "\"float shutterclose\" 2"},
                 {a, a + "\"bool simpleweighting\" \"false\""},
                 {a, "Translate 0 0 1 " + a}},
                alone, cameraRays);
  expectSame(
      {{a, a + "\"float aperturediameter\" 1 \"float focusdistance\" 10 \"bool simpleweighting\" \"true\""}},
      alone, cameraRays);
  const Attempt wide = inFolder(a,
                                "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 "
                                "\"string filename\" \"unused.exr\" \"float diagonal\" 20");
  ASSERT_TRUE(wide.made) << wide.messages();
  EXPECT_NE(cameraRays(wide), cameraRays(alone(a)));

  expectMistakes({{realistic, "parameter \"string lensfile\" is missing", "t.pbrt:1:1"},
                  {realistic + "\"string lensfile\" \"nil.dat\"", "there is no file", ""},
                  {realistic + "\"string lensfile\" \"odd.dat\"", "needs rows of 4 numbers", ""},
                  {realistic + "\"string lensfile\" \"text.dat\"", "found 3 numbers", ""},
                  {realistic + "\"string lensfile\" \"flat.dat\"", "cannot be focused", ""},
                  {realistic + "\"string lensfile\" \"glass.dat\"",
                   "lens 1: index of refraction: expected a finite number > 0", ""},
                  {a + "\"float focusdistance\" 0.05", "focusdistance: the lens, of focal length ", ""},
                  {a + "\"float aperturediameter\" 0", "expected > 0", ""},
                  {a + "\"float aperturediameter\" 7",
                   "found 7 mm, expected at most the 6 mm of the lens; that is taken", "", kTolerated},
                  {a + "\"float fov\" 30", "unknown parameter \"fov\"", "", kTolerated}},
                 alone);
  EXPECT_TRUE(
      alone(a + "\"bool simpleweighting\" \"false\" \"float shutterclose\" 0").warns("the image is black"));
  EXPECT_TRUE(
      inFolder(a, "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"float diagonal\" 0")
          .failsWith("\"diagonal\" must be > 0"));
}

TEST(ConstructCamera, WarnsOfScaleAndExchangedShutterTimes) {
  const std::string scaled = "Scale 2 2 2 Camera \"perspective\"";
  EXPECT_TRUE(with(scaled + " \"float lensradius\" .1").warns("the transformation scales"));
  EXPECT_FALSE(with(scaled).warns("the transformation scales"));
  const Attempt a = with("Camera \"perspective\" \"float shutteropen\" 1 \"float shutterclose\" 0.5");
  ASSERT_TRUE(a.warns("the two times are exchanged")) << a.messages();
  EXPECT_EQ(a.made->camera->generateRay({1, 1}, {0.5f, 0.5f}, 0).ray.time, 0.5f);
}

TEST(ConstructCamera, TakesTheDefaultOfAScalarWithTwoValues) {
  const std::string world = kSmall + "WorldBegin " + kLight + "WorldEnd";
  const Attempt a = attempt("Camera \"perspective\" \"float fov\" [ 40 50 ] \"float fvo\" 1 " + world);
  ASSERT_TRUE(a.warns("expected 1")) << a.messages();
  EXPECT_TRUE(a.warns("unknown parameter \"fvo\""));
  EXPECT_EQ(cameraRays(a), cameraRays(with("")));
  EXPECT_TRUE(attempt("Camera \"nil\" " + world).failsWith("unknown type"));
}

}  // namespace
}  // namespace pbrtmedia::test
