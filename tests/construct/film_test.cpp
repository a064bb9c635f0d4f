// SPDX-License-Identifier: BSD-2-Clause
// Film, PixelFilter and the output file.
#include "construct/film.h"

#include "construct/probe.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

/// Options in line 1; the world is empty but for a light.
Attempt withOptions(const std::string& options) {
  return attempt(options + "\nWorldBegin " + kLight + "WorldEnd");
}
Attempt withFilter(const std::string& filter) {
  return withOptions(filter + " Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8");
}
std::string film(const std::string& parameters) {
  return "Film \"image\" \"integer xresolution\" [ 10 ] \"integer yresolution\" [ 20 ] " + parameters;
}

TEST(ConstructFilm, HasTheDefaultsOfTheLanguage) {
  const Attempt a = withOptions("");
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_EQ(a.made->film->settings().resolution, Point2i(1280, 720));
  EXPECT_EQ(a.made->outfile, "pbrt.exr");
  EXPECT_EQ(a.made->film->sampleBounds(), a.made->film->pixelBounds()) << "the default filter is the box";
  EXPECT_EQ(a.made->film->settings().scale, 1);
  EXPECT_EQ(a.made->film->settings().maxSampleLuminance, kInfinity);
}

TEST(ConstructFilm, EveryParameterHasItsEffect) {
  expectEffects({{film(""), film("\"float cropwindow\" [ 0.5 1 0 0.5 ]")},
                 {film(""), film("\"float scale\" 2")},
                 {film(""), film("\"float maxsampleluminance\" 3")},
                 {film(""), "Film \"image\" \"integer xresolution\" 11 \"integer yresolution\" 20"},
                 {film(""), "Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 21"}},
                withOptions, filmResponse);
  EXPECT_TRUE(withOptions(film("\"float diagonal\" 35")).isSilent());
  EXPECT_EQ(withOptions(film("\"string filename\" \"x.png\"")).made->outfile, "x.png");
}

TEST(ConstructFilm, SortsAndClampsTheCropWindow) {
  const Attempt a = withOptions(film("\"float cropwindow\" [ 1.5 0.5 0.25 -1 ]"));
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_EQ(a.made->film->pixelBounds(), (Bounds2i{{5, 0}, {10, 5}}));
}

TEST(ConstructFilm, PrefersItsOwnCropWindowToThatOfTheCommandLine) {
  ConstructOptions options;
  options.cropWindow = {0, 0.1f, 0, 0.1f};
  const std::string world = "\nWorldBegin " + kLight + "WorldEnd";
  const Attempt given = attempt(film("\"float cropwindow\" [ 0.5 1 0 1 ]") + world, {.build = options});
  EXPECT_EQ(given.made->film->pixelBounds(), (Bounds2i{{5, 0}, {10, 20}}));
  const Attempt without = attempt(film("") + world, {.build = options});
  EXPECT_EQ(without.made->film->pixelBounds(), (Bounds2i{{0, 0}, {1, 2}}));
}

TEST(ConstructFilm, TakesTheCommandLinesFileAndQuickness) {
  ConstructOptions options;
  options.outfile = "o.pfm";
  options.quick = true;
  const Attempt a = attempt(
      film("\"string filename\" \"x.nonsense\"") + "\nWorldBegin " + kLight + "WorldEnd", {.build = options});
  ASSERT_TRUE(a.isSilent()) << a.messages();
  EXPECT_EQ(a.made->outfile, "o.pfm");
  EXPECT_EQ(a.made->film->settings().resolution, Point2i(2, 5));
}

TEST(ConstructFilm, SaysWhatIsWrongAndWhere) {
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  expectMistakes(
      {{"Film \"imag\"", "Film: unknown type \"imag\"; did you mean \"image\"?", "t.pbrt:1:6"},
       {"Film \"image\" \"integer xresolution\" 0",
        "parameter \"xresolution\": found 0, expected in [1, 1048576]", "t.pbrt:1:36"},
       {"Film \"image\" \"float yresolution\" 5", "\"yresolution\": found type float, expected integer",
        "t.pbrt:1:14", kTolerated},
       {"Film \"image\" \"integer xresolutoin\" 5",
        "unknown parameter \"xresolutoin\"; did you mean \"xresolution\"?", "t.pbrt:1:14", kTolerated},
       {"Film \"image\" \"float cropwindow\" [ 0 1 0 ]", "found 3 numbers, expected 4: x0 x1 y0 y1",
        "t.pbrt:1:35"},
       {"Film \"image\" \"float cropwindow\" [ 0.5 0.5 0 1 ]", "Film \"image\": ", "t.pbrt:1:1"},
       {"Film \"image\" \"float maxsampleluminance\" 0", "\"maxsampleluminance\": found 0, expected > 0", "",
        kTolerated},
       {"Film \"image\" \"string filename\" \"a.jpg\"",
        "unknown image format \".jpg\"; known: .exr, .png, .pfm, .tga", "t.pbrt:1:32"},
       {"Film \"image\" \"string filename\" \"no/such/a.exr\"", "folder \"no/such\" does not exist", ""},
       {"Film \"image\" \"string filename\" [ \"a.exr\" \"b.exr\" ]", "found 2 values, expected 1", "",
        kTolerated}},
      withOptions);
  ConstructOptions options;
  std::filesystem::create_directory(folder.path() / "d.exr");
  options.outfile = folder.path() / "d.exr";
  EXPECT_TRUE(attempt("WorldBegin " + kLight + "WorldEnd", {.build = options}).failsWith("is a folder"));
}

TEST(ConstructFilm, KeepsTheLayersThatAreAskedFor) {
  const std::string world = "\nWorldBegin " + kLight + "WorldEnd";
  EXPECT_TRUE(withOptions(film("")).made->film->layers().isEmpty());
  const std::string two = film("\"string layers\" [ \"normal\" \"alpha\" \"alpha\" ]");
  EXPECT_EQ(withOptions(two).made->film->layers().text(), "alpha,normal");
  ConstructOptions options;
  options.layers = {"depth"};
  EXPECT_EQ(attempt(two + world, {.build = options}).made->film->layers().text(), "depth");
  // All that the integrator can tell.
  const std::string all = film("\"string layers\" \"all\"");
  EXPECT_EQ(withOptions("Integrator \"volpath\" " + all).made->film->layers().layers().size(), kLayerCount);
  EXPECT_EQ(withOptions("Integrator \"whitted\" " + all).made->film->layers().layers().size(),
            kLayerCount - 3);
  EXPECT_EQ(withOptions("Integrator \"volpath\" \"integer maxdepth\" 0 " + all).made->film->layers().text(),
            "variance,samples,seconds,lookups,emission,direct,indirect,surface,medium");
}

TEST(ConstructFilm, RefusesLayersThatNobodyCanTell) {
  expectMistakes(
      {{"Film \"image\" \"string layers\" [ \"albedo\" \"depht\" ]",
        "Film \"image\": parameter \"layers\": unknown layer \"depht\"; did you mean \"depth\"?",
        "t.pbrt:1:32"},
       {"Film \"image\" \"integer layers\" 3", "found type integer, expected string", "t.pbrt:1:14"},
       {"Film \"image\" \"string layers\" \"alpha\" \"string filename\" \"a.png\"",
        "layers are channels of an OpenEXR file, and the image is \"a.png\"; expected a name that ends in "
        ".exr",
        "t.pbrt:1:30"},
       {"Integrator \"whitted\" Film \"image\" \"string layers\" [ \"alpha\" \"medium\" \"mediumdepth\" ]",
        "Integrator \"whitted\" cannot fill mediumdepth, medium; it fills variance, samples, seconds, "
        "lookups, "
        "alpha, depth, normal, albedo, position, emission, direct, indirect, surface",
        "t.pbrt:1:53"}},
      withOptions);
  ConstructOptions options;
  options.layers = {"alhpa"};
  const std::string world = "WorldBegin " + kLight + "WorldEnd";
  EXPECT_TRUE(attempt(world, {.build = options}).failsWith("--layers: unknown layer \"alhpa\""));
  options.layers = {"alpha"};
  options.outfile = "a.pfm";
  EXPECT_TRUE(
      attempt(world, {.build = options}).failsWith("--layers: layers are channels of an OpenEXR file"));
}

TEST(ConstructFilm, IsNeeded) {
  const std::string world = "\nWorldBegin " + kLight + "WorldEnd";
  EXPECT_TRUE(attempt("Film \"imag\"" + world).failsWith("unknown type"));
  EXPECT_TRUE(attempt("PixelFilter \"bxo\"" + world).failsWith("unknown type"));
}

TEST(ConstructPixelFilter, EveryParameterHasItsEffect) {
  std::vector<Effect> effects{{"", "PixelFilter \"triangle\""},
                              {"", "PixelFilter \"gaussian\""},
                              {"", "PixelFilter \"mitchell\""},
                              {"", "PixelFilter \"sinc\""},
                              {"PixelFilter \"gaussian\"", "PixelFilter \"gaussian\" \"float alpha\" 1"},
                              {"PixelFilter \"mitchell\"", "PixelFilter \"mitchell\" \"float B\" 0.5"},
                              {"PixelFilter \"mitchell\"", "PixelFilter \"mitchell\" \"float C\" 0.5"},
                              {"PixelFilter \"sinc\"", "PixelFilter \"sinc\" \"float tau\" 2"}};
  for (const std::string type : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    const std::string filter = "PixelFilter \"" + type + '"';
    effects.push_back({filter, filter + " \"float xwidth\" 1.25"});
    effects.push_back({filter, filter + " \"float ywidth\" 1.25"});
  }
  expectEffects(effects, withFilter, filmResponse);
  expectSame({{"", "PixelFilter \"box\""},
              {"PixelFilter \"gaussian\"",
               "PixelFilter \"gaussian\" \"float xwidth\" 2 \"float ywidth\" 2 \"float alpha\" 2"},
              {"PixelFilter \"triangle\"", "PixelFilter \"triangle\" \"float xwidth\" 2 \"float ywidth\" 2"},
              {"PixelFilter \"sinc\"",
               "PixelFilter \"sinc\" \"float xwidth\" 4 \"float ywidth\" 4 \"float tau\" 3"}},
             withFilter, filmResponse);
}

TEST(ConstructPixelFilter, SaysWhatIsWrongAndWhere) {
  expectMistakes(
      {{"PixelFilter \"bxo\"", "PixelFilter: unknown type \"bxo\"; did you mean \"box\"?", "t.pbrt:1:13"},
       {"PixelFilter \"box\" \"float xwidth\" 0", "\"xwidth\": found 0, expected > 0", "t.pbrt:1:34"},
       {"PixelFilter \"box\" \"float ywidth\" 5000", "expected a radius in (0, 1000] pixels", "t.pbrt:1:1"},
       {"PixelFilter \"gaussian\" \"float alpha\" -1", "expected > 0", ""},
       {"PixelFilter \"sinc\" \"float tau\" 0", "expected > 0", ""},
       {"PixelFilter \"mitchell\" \"integer B\" 1", "found type integer, expected float", "", kTolerated},
       {"PixelFilter \"box\" \"float B\" 1", "unknown parameter \"B\"", "t.pbrt:1:19", kTolerated}},
      withFilter);
}

}  // namespace
}  // namespace pbrtmedia::test
