// SPDX-License-Identifier: BSD-2-Clause
#include "construct/cameras.h"

#include "construct/probe.h"

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
       {"Camera \"realistic\"", "unknown type \"realistic\"", "t.pbrt:1:8"},
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

TEST(ConstructCamera, WarnsOfScaleAndExchangedShutterTimes) {
  EXPECT_TRUE(with("Scale 2 2 2 Camera \"perspective\"").warns("the transformation scales"));
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
