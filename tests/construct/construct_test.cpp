// SPDX-License-Identifier: BSD-2-Clause
#include "construct/construct.h"

#include "construct/probe.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

TEST(Construct, AnEmptyWorldHasTheDefaultsOfTheLanguage) {
  const Attempt a = attempt("WorldBegin WorldEnd");
  ASSERT_TRUE(a.made) << a.messages();
  EXPECT_TRUE(a.warns("the scene has no lights: the image will be black"));
  EXPECT_EQ(a.made->integrator->typeName(), "path");
  EXPECT_EQ(a.made->sampler->typeName(), "halton");
  EXPECT_EQ(a.made->sampler->samplesPerPixel(), 16);
  EXPECT_FALSE(a.made->pixelBounds.has_value());
}

TEST(Construct, WarnsOnlyWhenNothingShines) {
  EXPECT_TRUE(attempt(kSmall + "WorldBegin LightSource \"infinite\" WorldEnd").isSilent());
  EXPECT_TRUE(attempt(kSmall + "WorldBegin AreaLightSource \"diffuse\" Shape \"disk\" WorldEnd").isSilent());
  const Attempt object = attempt(kSmall +
                                 "WorldBegin ObjectBegin \"o\" AreaLightSource \"diffuse\" Shape \"disk\" "
                                 "ObjectEnd ObjectInstance \"o\" WorldEnd");
  EXPECT_EQ(object.find(Severity::Warning, "no lights"), nullptr) << object.messages();
}

TEST(Construct, ShowsAllProblemsTogether) {
  const StrictAttempts strict;
  const Attempt a = attempt(
      "Film \"image\" \"integer xresolution\" 0\nSampler \"nil\"\nCamera \"perspective\" \"float fov\" 500\n"
      "Integrator \"path\" \"integer maxdepth\" -1\nPixelFilter \"box\" \"float xwidth\" 0\nWorldBegin\n"
      "LightSource \"nil\"\nMaterial \"nil\"\nTexture \"t\" \"float\" \"nil\"\nShape \"nil\"\n"
      "MakeNamedMedium \"m\" \"string type\" \"nil\"\nAreaLightSource \"nil\"\nWorldEnd");
  EXPECT_FALSE(a.made.has_value());
  for (int line = 1; line <= 12; ++line) {
    if (line == 6) continue;
    const bool found =
        std::any_of(a.diagnostics.all().begin(), a.diagnostics.all().end(), [&](const Diagnostic& d) {
          return d.severity == Severity::Error && d.location.line == static_cast<std::uint32_t>(line);
        });
    EXPECT_TRUE(found) << "line " << line << '\n' << a.messages();
  }
}

TEST(Construct, ChecksBeforeItBuilds) {
  const StrictAttempts strict;
  const TemporaryFolder folder;
  folder.write("corrupt.png", "no picture");
  const Attempt a = attemptWorld(
      "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"corrupt.png\" "
      "Material \"matte\" \"texture Kd\" \"t\" Shape \"sphere\" Shape \"nil\"",
      {.folder = folder.path()});
  EXPECT_EQ(a.diagnostics.errorCount(), 1u) << "the picture is not read once something is wrong\n"
                                            << a.messages();
}

TEST(Construct, TheSameTextGivesTheSameImage) {
  const std::string text =
      kSmall + "WorldBegin LightSource \"infinite\" Shape \"sphere\" \"float radius\" 0.5 WorldEnd";
  const Attempt a = attempt(text), b = attempt(text), c = attempt(text, {.build = {.seed = 3}});
  EXPECT_EQ(rendered(a), rendered(b));
  EXPECT_NE(samples(a), samples(c));
}

// ---- The medium of the camera (reference 17.5 and our extension)

const std::string kFog =
    "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 9 9 9 ] \"rgb sigma_s\" [ 0 0 "
    "0 ] ";
const std::string kOnly =
    "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 Integrator \"volpath\" "
    "Sampler \"halton\" \"integer pixelsamples\" 1 ";
/// A black environment but for the emitter at distance 1 in front of the camera.
const std::string kEmitter =
    " AttributeBegin AreaLightSource \"diffuse\" \"bool twosided\" \"true\" Translate 0 0 1 "
    "Shape \"disk\" \"float radius\" 50 AttributeEnd ";

double brightness(const std::string& text) {
  const Attempt a = attempt(text);
  EXPECT_TRUE(a.made.has_value()) << a.messages();
  return a.made ? rendered(a).at(1) : -1;
}

// Through one unit of this fog one sample in 8000 passes.

TEST(ConstructCameraMedium, IsTheOutsideMediumInForceAtWorldEnd) {
  const auto lit = [](const std::string& outside, const std::string& atTheEnd) {
    return brightness(kOnly + kFog + "MediumInterface \"\" \"" + outside +
                      "\" WorldBegin AttributeBegin MediumInterface \"\"" + kEmitter + "AttributeEnd " +
                      atTheEnd + " WorldEnd");
  };
  EXPECT_EQ(lit("", ""), 1);
  EXPECT_LT(lit("fog", ""), 0.1);
  EXPECT_EQ(lit("fog", "MediumInterface \"\" \"\""), 1);
  EXPECT_EQ(lit("fog", "MediumInterface \"fog\" \"\""), 1) << "the inside is not the camera's";
  EXPECT_LT(lit("", "MediumInterface \"\" \"fog\""), 0.1);
}

TEST(ConstructCameraMedium, IsFoundByGeometryWhenNotGiven) {
  const auto lit = [](const std::string& place) {
    return brightness(kOnly + kFog + "WorldBegin AttributeBegin " + place +
                      " MediumInterface \"fog\" \"\" Material \"none\" " +
                      "Shape \"sphere\" \"float radius\" 0.8 AttributeEnd" + kEmitter + "WorldEnd");
  };
  EXPECT_LT(lit(""), 0.1);
  EXPECT_EQ(lit("Translate 0 0 -2"), 1);
}

TEST(ConstructCameraMedium, WarnsWhenTheSceneSaysOtherwise) {
  const std::string other = "MakeNamedMedium \"smoke\" \"string type\" \"homogeneous\" ";
  const Attempt a =
      attempt(kOnly + kFog + other +
              "MediumInterface \"\" \"smoke\" WorldBegin AttributeBegin "
              "MediumInterface \"fog\" \"smoke\" Material \"none\" Shape \"sphere\" AttributeEnd" +
              kEmitter + "WorldEnd");
  ASSERT_TRUE(a.made) << a.messages();
  const Diagnostic* warning = a.find(Severity::Warning, "fog");
  ASSERT_NE(warning, nullptr) << a.messages();
  EXPECT_NE(warning->message.find("smoke"), std::string::npos);
  EXPECT_EQ(warning->location.line, 1u);
}

// ---- Light from infinitely far in a medium without end

TEST(ConstructEndlessMedium, WarnsOfLightsAtInfinityAndNamesBoth) {
  const std::string lights =
      " LightSource \"infinite\" LightSource \"distant\" LightSource \"point\" \"point from\" [ 0 1 0 ] ";
  const Attempt fog =
      attempt(kOnly + kFog + "MediumInterface \"\" \"fog\" WorldBegin\n" + lights + "WorldEnd");
  for (const char* light : {"LightSource \"infinite\"", "LightSource \"distant\""}) {
    const Diagnostic* warning = fog.find(Severity::Warning, light);
    ASSERT_NE(warning, nullptr) << fog.messages();
    EXPECT_NE(warning->message.find("\"fog\", which has no end"), std::string::npos) << fog.messages();
    EXPECT_EQ(warning->location.line, 2u);
  }
  EXPECT_EQ(fog.diagnostics.all().size(), 2u) << fog.messages();
  // What the warning says is so: nothing but the point light is left.
  EXPECT_EQ(
      brightness(kOnly + kFog + "MediumInterface \"\" \"fog\" WorldBegin LightSource \"infinite\" WorldEnd"),
      0);
}

TEST(ConstructEndlessMedium, IsFoundBehindBoundariesToo) {
  const Attempt clearing =
      attempt(kOnly + kFog +
              "WorldBegin LightSource \"infinite\" MediumInterface \"\" \"fog\" Material "
              "\"none\" Shape \"sphere\" \"float radius\" 2 MediumInterface \"\" \"\" "
              "WorldEnd");
  EXPECT_TRUE(clearing.warns("\"fog\", which has no end")) << clearing.messages();
}

TEST(ConstructEndlessMedium, IsNotWhatAFewDirectionsSee) {
  // Fog without end behind one side of a cube around the camera: light comes in by the others.
  for (const char* square : {"1 -1 -1  1 1 -1  1 1 1  1 -1 1", "-1 1 -1  1 1 -1  1 1 1  -1 1 1",
                             "-1 -1 1  1 -1 1  1 1 1  -1 1 1", "-1 -1 -1  -1 1 -1  -1 1 1  -1 -1 1",
                             "-1 -1 -1  1 -1 -1  1 -1 1  -1 -1 1", "-1 -1 -1  1 -1 -1  1 1 -1  -1 1 -1"}) {
    for (const char* media : {"\"fog\" \"\"", "\"\" \"fog\""}) {
      const Attempt a =
          attempt(kOnly + kFog + "WorldBegin LightSource \"infinite\" MediumInterface " + media +
                  " Material \"none\" Shape \"trianglemesh\" \"integer indices\" [ 0 1 2 0 2 3 ] "
                  "\"point P\" [ " +
                  square + " ] MediumInterface \"\" \"\" WorldEnd");
      EXPECT_FALSE(a.warns("which has no end")) << square << media << a.messages();
    }
  }
}

TEST(ConstructEndlessMedium, SaysNothingWhereLightGetsThrough) {
  const std::string light = "LightSource \"infinite\" ";
  const std::string shell =
      "AttributeBegin MediumInterface \"fog\" \"\" Material \"none\" Shape \"sphere\" \"float radius\" 2 "
      "AttributeEnd ";
  EXPECT_TRUE(attempt(kOnly + kFog + "WorldBegin " + light + shell + "WorldEnd").isSilent());
  EXPECT_TRUE(attempt(kOnly + kFog + "WorldBegin " + light + shell + "MediumInterface \"\" \"fog\" WorldEnd")
                  .isSilent())
      << "the fog that is given as the camera's ends at the sphere";
  const std::string clear =
      "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] \"rgb sigma_s\" [ 0 "
      "0 0 "
      "] ";
  EXPECT_TRUE(
      attempt(kOnly + clear + "MediumInterface \"\" \"fog\" WorldBegin " + light + "WorldEnd").isSilent());
  EXPECT_TRUE(attempt(kOnly + kFog + "MediumInterface \"\" \"fog\" WorldBegin LightSource \"point\" WorldEnd")
                  .isSilent());
}

// ---- Surfaces without material

TEST(ConstructNoMaterial, DoesNotBlockTheLight) {
  for (const std::string integrator : {"path", "volpath", "directlighting", "whitted"}) {
    const auto lit = [&](const std::string& between) {
      return brightness("Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 Integrator \"" +
                        integrator +
                        "\" LookAt 0 0 1  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 5 WorldBegin "
                        "LightSource \"distant\" "
                        "\"point from\" [ 0 0 9 ] \"point to\" [ 0 0 0 ] Shape \"disk\" AttributeBegin "
                        "MakeNamedMedium \"v\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [ 0 0 0 ] "
                        "\"rgb sigma_s\" [ 0 0 0 ] MediumInterface \"v\" \"\" Translate 0 0 4 " +
                        between + " AttributeEnd WorldEnd");
    };
    EXPECT_NEAR(lit("Material \"none\" Shape \"sphere\""), 0.5 / kPi, 1e-4) << integrator;
    EXPECT_NEAR(lit("Material \"\" Shape \"disk\""), 0.5 / kPi, 1e-4) << integrator;
    EXPECT_EQ(lit("Material \"matte\" Shape \"disk\""), 0) << integrator;
  }
}

}  // namespace
}  // namespace pbrtmedia::test
