// SPDX-License-Identifier: BSD-2-Clause
// The program as a user meets it: options, exit codes, messages, files.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>
#include <functional>
#include <nlohmann/json.hpp>
#include <set>

#include "image/image.h"
#include "support/process.h"
#include "support/source_dir.h"
#include "support/temporary_folder.h"

namespace pbrtmedia::test {
namespace {

const std::string kScene =
    "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 8 \"string filename\" \"named.exr\"\n"
    "Sampler \"random\" \"integer pixelsamples\" 4\nIntegrator \"path\"\nWorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [ 0.5 0.25 1 ]\nWorldEnd\n";
/// Long enough that nothing but a stop ends it.
const std::string kEndless =
    "Film \"image\" \"integer xresolution\" 64 \"integer yresolution\" 64 \"string filename\" "
    "\"endless.exr\"\n"
    "Sampler \"random\" \"integer pixelsamples\" 100000000\nIntegrator \"path\"\nWorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [ 0.5 0.25 1 ]\nWorldEnd\n";

/// In front of a program that ends by itself: what does not is killed, and its status is none of ours.
constexpr const char* kAtMost = "timeout -s KILL 120";

/// The time that the processors spent in programs. It does not grow with what else the machine does, so it
/// may be compared with a `--time`.
double cpuSecondsOf(const std::function<void()>& runPrograms) {
  const auto spent = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
  };
  const double before = spent();
  runPrograms();
  return spent() - before;
}

class Pbrt : public testing::Test {
 protected:
  /// Runs pbrt in the temporary folder; `before` stands in front of the program ("timeout -s INT 2").
  ProcessResult pbrt(const std::string& arguments, const std::string& before = "") const {
    return run("cd '" + folder_.path().string() + "' && " + before + " '" PBRT_PROGRAM "' " + arguments);
  }
  Rgb pixelOf(const std::string& name, int x, int y) const {
    return readImage(folder_.path() / name).rgb(x, y);
  }
  Rgb firstPixel(const std::string& name) const { return readImage(folder_.path() / name).rgb(0, 0); }
  TemporaryFolder folder_;
};

TEST_F(Pbrt, WritesImagesOfStrategiesBesideTheImage) {
  folder_.write(
      "a.pbrt",
      "Film \"image\" \"integer xresolution\" 6 \"integer yresolution\" 4\nPixelFilter \"box\"\n"
      "Sampler \"random\" \"integer pixelsamples\" 4\nIntegrator \"bdpt\" \"integer maxdepth\" 2 \"bool "
      "visualizeweights\" \"true\"\nLookAt 0 -3 1 0 0 0 0 0 1\nCamera \"perspective\"\nWorldBegin\n"
      "LightSource \"point\" \"point from\" [ 0 0 1 ]\nShape \"disk\"\nWorldEnd\n");
  std::filesystem::create_directory(folder_.path() / "out");
  const ProcessResult result = pbrt("--quiet --outfile out/image.exr a.pbrt");
  ASSERT_EQ(result.status, 0) << result.output;
  Rgb sum;
  int found = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "out")) {
    const std::string name = entry.path().filename().string();
    if (name == "image.exr") continue;
    EXPECT_EQ(name.substr(0, 6), "bdpt_d") << name;
    sum += readImage(entry.path()).rgb(3, 2);
    ++found;
  }
  EXPECT_EQ(found, 8);
  const Rgb image = pixelOf("out/image.exr", 3, 2);
  EXPECT_GT(image.g, 0);
  EXPECT_NEAR(sum.g, image.g, 2e-2f * image.g) << "halves in the files";
  for (const std::string option : {"--checkpoint c.bin", "--frames 1:2"}) {
    const ProcessResult refused = pbrt("--quiet " + option + " --outfile b-####.exr a.pbrt");
    EXPECT_NE(refused.status, 0) << option;
    EXPECT_NE(refused.output.find("\"visualizeweights\""), std::string::npos) << refused.output;
  }
}

TEST_F(Pbrt, RendersTheFileThatTheSceneNames) {
  folder_.write("a.pbrt", kScene);
  const ProcessResult r = pbrt("a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  const Image image = readImage(folder_.path() / "named.exr");
  EXPECT_EQ(image.width(), 16);
  EXPECT_EQ(image.height(), 8);
  EXPECT_EQ(image.rgb(3, 3), Rgb(0.5f, 0.25f, 1));
  EXPECT_EQ(folder_.fileCount(), 2u) << "no temporary file may stay";
}

TEST_F(Pbrt, WritesItsProvenanceIntoTheImage) {
  folder_.write("a.pbrt", kScene);
  ASSERT_EQ(pbrt("--seed 7 --nthreads=1 a.pbrt").status, 0);
  const Image image = readImage(folder_.path() / "named.exr");
  EXPECT_NE(image.metadata.at("command").find("--seed 7 --nthreads=1 a.pbrt"), std::string::npos);
  EXPECT_EQ(image.metadata.at("seed"), "7");
  EXPECT_EQ(image.metadata.at("samples"), "4");
  EXPECT_FALSE(image.metadata.at("sceneHash").empty());
  EXPECT_FALSE(image.metadata.at("seconds").empty());
  const std::string version = image.metadata.at("version");
  EXPECT_EQ(pbrt("--version").output, version + '\n') << "one text everywhere";
  EXPECT_EQ(pbrt("-version").output, version + '\n');
  EXPECT_EQ(version.find("pbrt-media "), 0u) << version;
  EXPECT_NE(version.find(", commit "), std::string::npos) << version;
  ASSERT_EQ(pbrt("--stats s.json a.pbrt").status, 0);
  EXPECT_EQ(nlohmann::json::parse(folder_.read("s.json"))["version"], version);
}

TEST_F(Pbrt, HashesTheSceneWithItsIncludes) {
  const auto hashOf = [&](const std::string& light) {
    folder_.write("light.pbrt", light);
    folder_.write("a.pbrt",
                  "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2\nWorldBegin\n"
                  "Include \"light.pbrt\"\nWorldEnd\n");
    const ProcessResult r = pbrt("--outfile h.exr a.pbrt");
    EXPECT_EQ(r.status, 0) << r.output;
    return readImage(folder_.path() / "h.exr").metadata.at("sceneHash");
  };
  const std::string one = hashOf("LightSource \"infinite\"\n");
  EXPECT_EQ(one, hashOf("LightSource \"infinite\"\n"));
  EXPECT_NE(one, hashOf("LightSource \"infinite\" \"rgb L\" [ 2 2 2 ]\n"));
}

/// A scene with everything that a file can decide: a volume, a mesh, an image, a spectrum.
class SceneHash : public Pbrt {
 protected:
  static constexpr const char* kTriangle =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 9\n1 0 9\n0 1 9\n3 0 1 2\n";

  void SetUp() override {
    writeVolume(1);
    writeImage(folder_.path() / "map.pfm", Image(2, 2));
    folder_.write("mesh.ply", kTriangle);
    folder_.write("water.spd", "400 1\n700 2\n");
    folder_.write(
        "a.pbrt",
        "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 \"string filename\" "
        "\"h.exr\"\nSampler \"random\" \"integer pixelsamples\" 1\nIntegrator \"volpath\"\nWorldBegin\n"
        "MakeNamedMedium \"fog\" \"string type\" \"heterogeneous\" \"integer nx\" 2 \"integer ny\" 2 "
        "\"integer nz\" 2 \"string filename\" \"fog.raw\" \"spectrum sigma_a\" \"water.spd\"\n"
        "LightSource \"infinite\" \"string mapname\" \"map.pfm\"\n"
        "Shape \"plymesh\" \"string filename\" \"mesh.ply\"\n"
        "AttributeBegin\nMediumInterface \"fog\" \"\"\nMaterial \"none\"\nShape \"sphere\"\nAttributeEnd\n"
        "WorldEnd\n");
  }
  void writeVolume(float last) const {
    const float density[8] = {1, 1, 1, 1, 1, 1, 1, last};
    std::ofstream out(folder_.path() / "fog.raw", std::ios::binary);
    out.write(reinterpret_cast<const char*>(density), sizeof density);
  }
  std::string hash(const std::string& options = "") const {
    const ProcessResult r = pbrt("--quiet " + options + " a.pbrt");
    EXPECT_EQ(r.status, 0) << r.output;
    return readImage(folder_.path() / "h.exr").metadata.at("sceneHash");
  }
};

TEST_F(SceneHash, CoversMediumParametersOfTheCommandLine) {
  const std::string plain = hash();
  EXPECT_EQ(hash("--seed 3 --spp 2 --nthreads 1"), plain) << "what merging is for";
  const std::string other = hash("--mediumparams '\"float g\" 0.5'");
  EXPECT_NE(other, plain);
  EXPECT_NE(hash("--mediumparams '\"float g\" 0.6'"), other);
  EXPECT_EQ(hash("--mediumparams '\"float g\" 0.5'"), other);
}

TEST_F(SceneHash, CoversTheContentOfEveryFile) {
  std::set<std::string> hashes{hash()};
  writeVolume(2);
  EXPECT_TRUE(hashes.insert(hash()).second) << "a volume";
  Image map(2, 2);
  map.setRgb(1, 1, Rgb(1));
  writeImage(folder_.path() / "map.pfm", map);
  EXPECT_TRUE(hashes.insert(hash()).second) << "an image";
  std::string mesh = kTriangle;
  mesh.replace(mesh.find("0 1 9"), 5, "0 2 9");
  folder_.write("mesh.ply", mesh);
  EXPECT_TRUE(hashes.insert(hash()).second) << "a mesh";
  folder_.write("water.spd", "400 1\n700 3\n");
  EXPECT_TRUE(hashes.insert(hash()).second) << "a spectrum";
  writeVolume(2);
  EXPECT_FALSE(hashes.insert(hash()).second) << "the same bytes written again";
}

/// An output over an input is refused before anything is written.
TEST_F(SceneHash, FilesThatTheSceneReadsAreNotWrittenOver) {
  folder_.write("more.pbrt", "AttributeBegin\nAttributeEnd\n");
  std::string text = folder_.read("a.pbrt");
  text.insert(text.find("WorldEnd"), "Include \"more.pbrt\"\n");
  folder_.write("a.pbrt", text);
  std::filesystem::create_symlink("mesh.ply", folder_.path() / "link.json");
  for (const auto& [file, why] :
       std::vector<std::pair<std::string, std::string>>{{"more.pbrt", "an Include or a spectrum"},
                                                        {"water.spd", "an Include or a spectrum"},
                                                        {"fog.raw", "a parameter (a.pbrt:"},
                                                        {"map.pfm", "a parameter (a.pbrt:"},
                                                        {"link.json", "a parameter (a.pbrt:"}}) {
    const std::string before = folder_.read(file);
    for (const std::string option : {"--stats ", "--convergence ", "--checkpoint "}) {
      const ProcessResult r = pbrt(option + file + " a.pbrt");
      EXPECT_EQ(r.status, 1) << r.output;
      const bool isThere = option == "--checkpoint ";  // a file by that name is a render, which is said first
      EXPECT_NE(r.output.find(isThere ? "there is such a file" : why), std::string::npos) << r.output;
    }
    EXPECT_EQ(folder_.read(file), before);
  }
  const ProcessResult image = pbrt("--outfile map.pfm a.pbrt");
  EXPECT_EQ(image.status, 1);
  EXPECT_NE(image.output.find("the image \"map.pfm\" is the file of a parameter (a.pbrt:"), std::string::npos)
      << image.output;
  folder_.write("other.raw", folder_.read("fog.raw"));
  const ProcessResult params =
      pbrt("--stats other.raw --mediumparams '\"string filename\" \"other.raw\"' a.pbrt");
  EXPECT_NE(params.output.find("is the file of a parameter (--mediumparams:1:"), std::string::npos)
      << params.output;
  EXPECT_FALSE(folder_.has("h.exr")) << "nothing is written";
  EXPECT_EQ(pbrt("--stats new.json a.pbrt").status, 0);
}

TEST_F(SceneHash, LetsImgtoolRefuseWhatDoesNotBelongTogether) {
  const auto render = [&](const std::string& options, const std::string& file) {
    ASSERT_EQ(pbrt("--quiet --outfile " + file + ' ' + options + " a.pbrt").status, 0);
  };
  const auto merge = [&](const std::string& files) {
    const auto imgtool = std::filesystem::path(PBRT_PROGRAM).parent_path() / "imgtool";
    return run("cd '" + folder_.path().string() + "' && '" + imgtool.string() + "' merge " + files +
               " -o m.exr");
  };
  render("--seed 1", "one.exr");
  render("--seed 2", "two.exr");
  const ProcessResult good = merge("one.exr two.exr");
  EXPECT_EQ(good.status, 0) << good.output;
  render("--seed 3 --mediumparams '\"float g\" .5'", "other.exr");
  const ProcessResult params = merge("one.exr other.exr");
  EXPECT_EQ(params.status, 1);
  EXPECT_NE(params.output.find("--mediumparams (none and '\"float g\" 0.5') differs"), std::string::npos)
      << params.output;
  writeVolume(2);
  render("--seed 3", "volume.exr");
  const ProcessResult volume = merge("one.exr volume.exr");
  EXPECT_EQ(volume.status, 1);
  EXPECT_NE(volume.output.find("the content of fog.raw differs"), std::string::npos) << volume.output;
}

TEST_F(Pbrt, TakesOptionsInEverySpelling) {
  folder_.write("a.pbrt", kScene);
  EXPECT_EQ(pbrt("-quick -nthreads 1 --outfile=x.exr a.pbrt").status, 0);
  EXPECT_EQ(readImage(folder_.path() / "x.exr").width(), 4);
  EXPECT_EQ(pbrt("--cropwindow 0 0.5 0 0.25 --outfile y.exr a.pbrt").status, 0);
  EXPECT_EQ(readImage(folder_.path() / "y.exr").width(), 8);
  EXPECT_EQ(readImage(folder_.path() / "y.exr").height(), 2);
  EXPECT_EQ(pbrt("--spp 9 --outfile z.png a.pbrt").status, 0);
  EXPECT_TRUE(folder_.has("z.png"));
  for (const char* format : {"pfm", "tga"}) {
    EXPECT_EQ(pbrt(std::string("--outfile f.") + format + " a.pbrt").status, 0);
    EXPECT_TRUE(folder_.has(std::string("f.") + format));
  }
}

TEST_F(Pbrt, StoresExrFilesAsAsked) {
  folder_.write("a.pbrt",
                "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\nWorldBegin\n"
                "LightSource \"infinite\" \"rgb L\" [ 0.1 100000 1 ]\nWorldEnd\n");
  ASSERT_EQ(pbrt("--pixeltype float --compression piz --outfile f.exr a.pbrt").status, 0);
  EXPECT_EQ(firstPixel("f.exr"), Rgb(0.1f, 100000, 1));
  ASSERT_EQ(pbrt("--compression none --outfile h.exr a.pbrt").status, 0);
  EXPECT_NEAR(firstPixel("h.exr").r, 0.1f, 1e-4f);
  EXPECT_NE(firstPixel("h.exr").r, 0.1f) << "half numbers have 11 bits";
  EXPECT_EQ(pbrt("--pixeltype double --outfile d.exr a.pbrt").status, 1);
}

TEST_F(Pbrt, ReadsStandardInput) {
  folder_.write("a.pbrt", kScene);
  EXPECT_EQ(pbrt("--outfile in.exr < a.pbrt").status, 0);
  EXPECT_EQ(pbrt("--outfile dash.exr - < a.pbrt").status, 0);
  EXPECT_TRUE(folder_.has("in.exr"));
  EXPECT_TRUE(folder_.has("dash.exr"));
}

TEST_F(Pbrt, PrintsHelpAndEndsWell) {
  const ProcessResult r = pbrt("--help");
  EXPECT_EQ(r.status, 0);
  for (const char* option : {"--nthreads", "--outfile", "--cropwindow", "--quick", "--quiet", "--cat",
                             "--toply", "--spp", "--seed", "--stats", "--progress", "--time", "--pixeltype",
                             "--compression", "--strict", "--lenient", "--verbose"}) {
    EXPECT_NE(r.output.find(option), std::string::npos) << option;
  }
}

TEST_F(Pbrt, TakesEveryOptionWithOneDashAsPbrtDoes) {
  folder_.write("a.pbrt", kScene);
  EXPECT_EQ(pbrt("-quick -outfile=one.exr -nthreads 1 -tile-size 8 a.pbrt").status, 0);
  EXPECT_TRUE(folder_.has("one.exr"));
  EXPECT_EQ(pbrt("-quick -o two.exr a.pbrt").status, 0);
  EXPECT_TRUE(folder_.has("two.exr"));
  EXPECT_EQ(pbrt("-version").status, 0);
  EXPECT_EQ(pbrt("-quicker a.pbrt").status, 1);
}

TEST_F(Pbrt, PrintsEveryOptionThatTheReadmeTells) {
  const std::string help = pbrt("--help").output;
  std::ifstream readme(test::sourceDir() / "README.md");
  int options = 0;
  bool isTable = false;
  for (std::string line; std::getline(readme, line);) {
    if (line == "| option | meaning |") isTable = true;
    if (line.empty()) isTable = false;
    const std::string names = line.substr(0, line.find(" | "));
    for (std::size_t at = isTable ? names.find("`--") : std::string::npos; at != std::string::npos;
         at = names.find("`--", at + 1)) {
      const std::string name = names.substr(at + 1, names.find_first_of(" `", at + 1) - at - 1);
      EXPECT_NE(help.find(name), std::string::npos) << name;
      ++options;
    }
  }
  EXPECT_GT(options, 15);
}

TEST_F(Pbrt, RejectsUnknownOptionsWithTheNearestName) {
  const ProcessResult r = pbrt("--nthread 2 a.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("nthreads"), std::string::npos) << r.output;
}

TEST_F(Pbrt, RejectsValuesThatMeanNothing) {
  folder_.write("a.pbrt", kScene);
  for (const char* options : {"--time nan", "--time inf", "--time 0", "--time -3", "--spp 0", "--spp 1.5",
                              "--nthreads -1", "--tile-size 0", "--progress sometimes", "--pixeltype quarter",
                              "--compression rar", "--minloglevel 9", "--cropwindow 0 2 0 1",
                              "--cropwindow 0 nan 0 1", "--cropwindow 0 1 0", "--seed x"}) {
    const ProcessResult r = pbrt(std::string(options) + " a.pbrt");
    EXPECT_EQ(r.status, 1) << options << '\n' << r.output;
    EXPECT_NE(r.output.find("error"), std::string::npos) << options << '\n' << r.output;
  }
  for (const char* options : {"--time -1", "--time 0", "--spp 99999999999999999999", "--seed -1",
                              "--nthreads 5000", "--tile-size 0", "--minloglevel 9", "--v x"}) {
    const ProcessResult r = pbrt(std::string(options) + " a.pbrt");
    EXPECT_EQ(r.output.find("pbrt: error: --"), 0u) << r.output;
    EXPECT_NE(r.output.find(", expected a "), std::string::npos) << r.output;
    EXPECT_LT(r.output.find('\n'), 120u) << "a short range: " << r.output;
  }
  EXPECT_EQ(folder_.fileCount(), 1u) << "nothing may be written";
}

TEST_F(Pbrt, CropsAsTheCommandLineSaysUnlessTheSceneDoes) {
  folder_.write("a.pbrt", kScene);
  ASSERT_EQ(pbrt("--cropwindow 0 0.5 0.25 1 a.pbrt").status, 0);
  const Image cropped = readImage(folder_.path() / "named.exr");
  EXPECT_EQ(cropped.width(), 8);
  EXPECT_EQ(cropped.height(), 6);
  std::string own = kScene;
  own.insert(own.find("\"string filename\""), "\"float cropwindow\" [ 0 1 0 0.5 ] ");
  folder_.write("own.pbrt", own);
  const ProcessResult r = pbrt("--cropwindow 0 0.5 0.25 1 own.pbrt");
  EXPECT_EQ(r.status, 0);
  EXPECT_NE(r.output.find("wins over --cropwindow"), std::string::npos) << r.output;
  EXPECT_EQ(readImage(folder_.path() / "named.exr").width(), 16);
}

TEST_F(Pbrt, TellsWhatItBuiltAndWarnsUnlessQuiet) {
  folder_.write("a.pbrt",
                "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4\nWorldBegin\n"
                "MakeNamedMedium \"spare\" \"string type\" \"homogeneous\"\n"
                "Shape \"sphere\"\nWorldEnd\n");
  const ProcessResult verbose = pbrt("--verbose --spp 1 --outfile o.exr a.pbrt");
  EXPECT_EQ(verbose.status, 0) << verbose.output;
  EXPECT_NE(verbose.output.find("medium \"spare\": not used, left out"), std::string::npos) << verbose.output;
  EXPECT_NE(verbose.output.find("no lights"), std::string::npos) << verbose.output;
  EXPECT_EQ(pbrt("--quiet --spp 1 --outfile o.exr a.pbrt").output, "");
  folder_.write("bad.pbrt", "WorldBegin\nShape \"sphear\"\nWorldEnd\n");
  const ProcessResult bad = pbrt("--quiet --strict --outfile o.exr bad.pbrt");
  EXPECT_EQ(bad.status, 1);
  EXPECT_NE(bad.output.find("sphear"), std::string::npos) << "errors stay: " << bad.output;
  folder_.write("bad.pbrt", "WorldBegin\nShpae \"sphere\"\nWorldEnd\n");
  const ProcessResult unreadable = pbrt("--quiet --outfile o.exr bad.pbrt");
  EXPECT_EQ(unreadable.status, 1);
  EXPECT_NE(unreadable.output.find("Shpae"), std::string::npos) << unreadable.output;
}

TEST_F(Pbrt, SaysWhenThereIsNothingToRender) {
  folder_.write("options.pbrt", "Film \"image\"\n");
  const ProcessResult r = pbrt("options.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_TRUE(r.output.starts_with("pbrt: error: ")) << r.output;
  EXPECT_NE(r.output.find("WorldBegin"), std::string::npos) << r.output;
}

TEST_F(Pbrt, ShowsEveryProblemOfASceneAtOnceAndWritesNothing) {
  folder_.write("bad.pbrt",
                "Film \"image\" \"integer xresolutoin\" 16\n"
                "WorldBegin\n"
                "Material \"matt\"\n"
                "Shape \"sphere\" \"float radius\" -1\n"
                "LightSource \"infinite\" \"string mapname\" \"nowhere.exr\"\n"
                "WorldEnd\n");
  const ProcessResult r = pbrt("--strict --outfile o.exr bad.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("bad.pbrt:1:"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("xresolution"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("bad.pbrt:3:"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("matte"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("bad.pbrt:4:"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("bad.pbrt:5:"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("nowhere.exr"), std::string::npos) << r.output;
  EXPECT_FALSE(folder_.has("o.exr"));
}

TEST_F(Pbrt, StrictTurnsWarningsOfMistakesIntoErrors) {
  folder_.write("odd.pbrt",
                "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"integer spam\" 16\n"
                "WorldBegin\nMaterial \"matt\"\nShape \"blob\"\nLightSource \"infinite\"\nWorldEnd\n");
  const ProcessResult strict = pbrt("--strict --outfile o.exr odd.pbrt");
  EXPECT_EQ(strict.status, 1);
  EXPECT_NE(strict.output.find("error: Film \"image\": unknown parameter \"spam\""), std::string::npos)
      << strict.output;
  EXPECT_FALSE(folder_.has("o.exr"));
  for (const char* options : {"", "--lenient "}) {
    const ProcessResult r = pbrt(std::string(options) + "--outfile o.exr odd.pbrt");
    EXPECT_EQ(r.status, 0) << r.output;
    EXPECT_NE(r.output.find("warning: Film \"image\": unknown parameter \"spam\""), std::string::npos)
        << r.output;
    EXPECT_NE(r.output.find("[an error with --strict]"), std::string::npos) << r.output;
    EXPECT_TRUE(folder_.has("o.exr"));
    std::filesystem::remove(folder_.path() / "o.exr");
  }
}

TEST_F(Pbrt, RefusesAnOutputThatCouldNotBeWrittenBeforeRendering) {
  folder_.write("a.pbrt", kScene);
  EXPECT_EQ(pbrt("--outfile x.jpg a.pbrt").status, 1);
  EXPECT_EQ(pbrt("--outfile no/such/folder/x.exr a.pbrt").status, 1);
  const ProcessResult r = pbrt("--outfile x.jpg a.pbrt");
  EXPECT_NE(r.output.find(".exr, .png, .pfm, .tga"), std::string::npos) << r.output;
}

TEST_F(Pbrt, MissingSceneIsAnError) {
  const ProcessResult r = pbrt("nothing.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("nothing.pbrt"), std::string::npos) << r.output;
}

TEST_F(Pbrt, WritesStatisticsAsJson) {
  folder_.write("a.pbrt", kScene);
  ASSERT_EQ(pbrt("--stats s.json a.pbrt").status, 0);
  const auto json = nlohmann::json::parse(folder_.read("s.json"));
  const auto& render = json.at("renders").at(0);
  EXPECT_EQ(render.at("counters").at("cameraSamples"), 16 * 8 * 4);
  EXPECT_EQ(render.at("samplesTaken"), 16 * 8 * 4);
  for (const char* phase : {"parse", "construct", "render", "write"}) {
    EXPECT_GE(render.at("seconds").at(phase).at("wall").get<double>(), 0) << phase;
    EXPECT_GE(render.at("seconds").at(phase).at("cpu").get<double>(), 0) << phase;
  }
  for (const char* cause : {"nan", "infinite", "negative"}) {
    EXPECT_EQ(render.at("counters").at("droppedSamples").at(cause), 0) << cause;
  }
  EXPECT_GT(render.at("peakMemoryBytes").get<std::size_t>(), 1u << 20);
}

TEST_F(Pbrt, TellsItsOwnMemoryAndNotThatOfWhoStartedIt) {
  constexpr std::size_t kBallast = std::size_t{600} << 20;
  const std::vector<char> ballast(kBallast, 1);
  folder_.write("a.pbrt", kScene);
  ASSERT_EQ(pbrt("--stats s.json a.pbrt").status, 0);
  const auto json = nlohmann::json::parse(folder_.read("s.json"));
  EXPECT_LT(json.at("renders").at(0).at("peakMemoryBytes").get<std::size_t>(), kBallast);
  EXPECT_EQ(ballast[kBallast / 2], 1);
}

TEST_F(Pbrt, WritesEachCountUnderItsOwnName) {
  // A wall before the left half of the picture: every sample is a ray, every other meets the wall and asks
  // for the light.
  folder_.write(
      "wall.pbrt",
      "Film \"image\" \"integer xresolution\" 16 \"integer yresolution\" 8\n"
      "Sampler \"random\" \"integer pixelsamples\" 4 Integrator \"whitted\" Camera \"orthographic\"\n"
      "WorldBegin\nLightSource \"point\" \"point from\" [ 0 0 -1 ]\nShape \"trianglemesh\" "
      "\"point P\" [ -9 -9 1  0 -9 1  0 9 1  -9 9 1 ] \"integer indices\" [ 0 1 2 0 2 3 ]\nWorldEnd\n");
  ASSERT_EQ(pbrt("--stats s.json wall.pbrt").status, 0);
  const auto json = nlohmann::json::parse(folder_.read("s.json"));
  const auto& counters = json.at("renders").at(0).at("counters");
  constexpr int kSamples = 16 * 8 * 4;
  EXPECT_EQ(counters.at("cameraSamples"), kSamples);
  EXPECT_EQ(counters.at("rays"), kSamples);
  EXPECT_EQ(counters.at("shadowRays"), kSamples / 2);
  EXPECT_EQ(counters.at("surfaceScatterings"), kSamples / 2);
  for (const char* none : {"densityLookups", "nullCollisions", "mediumScatterings", "boundViolations",
                           "stuckPaths", "cappedEstimates", "mediumMismatches", "boundaryRepairs"}) {
    EXPECT_EQ(counters.at(none), 0) << none;
  }
}

TEST_F(Pbrt, ChecksTheFolderOfTheStatisticsBeforeRendering) {
  folder_.write("a.pbrt", kScene);
  const ProcessResult r = pbrt("--stats no/such/s.json a.pbrt");
  EXPECT_EQ(r.status, 1);
  EXPECT_EQ(r.output.find("pbrt: error: --stats \"no/such/s.json\": cannot be written"), 0u) << r.output;
  EXPECT_FALSE(folder_.has("named.exr"));
}

TEST_F(Pbrt, WritesStatisticsOfScenesWhoseNameIsNoText) {
  folder_.write("a\xff.pbrt", kScene);
  EXPECT_EQ(pbrt("--stats s.json a$(printf '\\377').pbrt").status, 0);
  EXPECT_EQ(nlohmann::json::parse(folder_.read("s.json")).at("renders").size(), 1u);
}

/// Fog of unknown bounds around the camera's rays.
std::string learningScene(const std::string& more = "") {
  return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" "
         "\"fog.exr\"\n"
         "Sampler \"random\" \"integer pixelsamples\" 64\nIntegrator \"volpath\"\n"
         "LookAt .5 .5 -2  .5 .5 0  0 1 0 Camera \"perspective\" \"float fov\" 20\nWorldBegin\n"
         "LightSource \"infinite\"\nMakeNamedMedium \"fog\" \"string type\" \"analytic\" \"string function\" "
         "\"ramp\" \"integer supervoxels\" 1 \"string bounds\" \"progressive\" \"integer warmup\" 0 \"float "
         "epsilon\" 20 " +
         more +
         "\nMaterial \"none\" MediumInterface \"fog\" \"\"\nTranslate .5 .5 .5\nShape \"sphere\" \"float "
         "radius\" 1.5\n"
         "WorldEnd\n";
}

TEST_F(Pbrt, KeepsLearnedBoundsForTheNextRender) {
  folder_.write("a.pbrt", learningScene());
  const auto violations = [&] {
    const auto passes =
        nlohmann::json::parse(folder_.read("s.json"))["renders"][0]["learnedBounds"][0]["passes"];
    EXPECT_EQ(passes.size(), 64u);
    std::uint64_t sum = 0;
    for (const auto& pass : passes) sum += pass["violations"].get<std::uint64_t>();
    return sum;
  };
  const std::string options = "--quiet --bounds-cache b.bounds --stats s.json a.pbrt";
  const ProcessResult first = pbrt(options);
  ASSERT_EQ(first.status, 0) << first.output;
  EXPECT_EQ(first.output, "");
  EXPECT_GT(violations(), 0u);
  ASSERT_EQ(pbrt(options).status, 0);
  EXPECT_EQ(violations(), 0u);
  EXPECT_EQ(folder_.fileCount(), 4u) << "no temporary file may stay";

  folder_.write("a.pbrt", learningScene("\"float boundslack\" 0.5"));
  const ProcessResult other = pbrt("--bounds-cache b.bounds a.pbrt");
  EXPECT_EQ(other.status, 0);
  EXPECT_NE(other.output.find("warning: medium \"fog\" starts with unknown bounds: the cache has 1 x 1 x 1"),
            std::string::npos)
      << other.output;
}

TEST_F(Pbrt, KeepsLearnedBoundsOfEveryWorldApart) {
  std::string other = learningScene();
  const std::string cells = "\"integer supervoxels\" 1 ";
  ASSERT_NE(other.find(cells), std::string::npos);
  other.replace(other.find(cells), cells.size(), "\"integer supervoxels\" 2 ");
  folder_.write("two.pbrt", learningScene() + other);
  ASSERT_EQ(pbrt("--bounds-cache b.bounds two.pbrt").status, 0);
  const ProcessResult again = pbrt("--bounds-cache b.bounds two.pbrt");
  EXPECT_EQ(again.status, 0);
  EXPECT_EQ(again.output.find("starts with unknown bounds"), std::string::npos) << again.output;
}

TEST_F(Pbrt, SaysWhetherLearnedBoundsHadSettled) {
  // As in the paper, without a warm-up, two samples see little; explored, or with the bounds of an earlier
  // render, they see all.
  const auto stateOf = [&](const std::string& file) {
    return readImage(folder_.path() / file).metadata.at("boundsState");
  };
  std::string scene = learningScene();
  folder_.write("blind.pbrt", scene);
  const auto warmUp = scene.find("\"integer warmup\" 0");
  ASSERT_NE(warmUp, std::string::npos);
  scene.erase(warmUp, 18);
  folder_.write("a.pbrt", scene);
  const ProcessResult blind = pbrt("--spp 2 --outfile blind.exr blind.pbrt");
  EXPECT_EQ(blind.status, 0);
  EXPECT_NE(blind.output.find("bounds of medium \"fog\" were still rising"), std::string::npos)
      << blind.output;
  EXPECT_EQ(stateOf("blind.exr"), "rising");
  const ProcessResult warm = pbrt("--spp 2 --stats s.json --bounds-cache b.bounds --outfile warm.exr a.pbrt");
  EXPECT_EQ(warm.output.find("still rising"), std::string::npos) << warm.output;
  EXPECT_NE(warm.output.find("4 passes of warm-up took 64 lookups"), std::string::npos) << warm.output;
  EXPECT_EQ(stateOf("warm.exr"), "settled");
  const auto learned = [&] {
    return nlohmann::json::parse(folder_.read("s.json"))["renders"][0]["learnedBounds"][0];
  };
  EXPECT_EQ(learned()["warmUp"]["densityLookups"], 64);
  const ProcessResult cached = pbrt("--spp 2 --stats s.json --bounds-cache b.bounds --outfile c.exr a.pbrt");
  EXPECT_EQ(cached.output.find("warm-up"), std::string::npos) << cached.output;
  EXPECT_EQ(stateOf("c.exr"), "cached");
  EXPECT_EQ(learned()["warmUp"]["densityLookups"], 0);
  EXPECT_EQ(learned()["restored"], true);
}

TEST_F(Pbrt, RefusesABrokenBoundsCacheAndWarnsOfAUselessOne) {
  folder_.write("a.pbrt", learningScene());
  folder_.write("b.bounds", "something else");
  const ProcessResult broken = pbrt("--bounds-cache b.bounds a.pbrt");
  EXPECT_EQ(broken.status, 1);
  EXPECT_NE(broken.output.find("b.bounds: error: bounds cache: this is no such file"), std::string::npos)
      << broken.output;
  EXPECT_FALSE(folder_.has("fog.exr"));
  EXPECT_EQ(pbrt("--bounds-cache nowhere/b.bounds a.pbrt").status, 1);
  folder_.write("plain.pbrt", kScene);
  const ProcessResult plain = pbrt("--bounds-cache c.bounds plain.pbrt");
  EXPECT_EQ(plain.status, 0);
  EXPECT_NE(plain.output.find("no medium has progressive bounds"), std::string::npos) << plain.output;
}

TEST_F(Pbrt, TellsTheRayOfAViolatedBoundAndStrictMinds) {
  std::string scene = learningScene("\"float majorant\" 0.5");
  scene.replace(scene.find("progressive"), 11, "constant");
  const auto first = scene.find("\"integer warmup\" 0"), last = scene.find("20 \"float majorant\"");
  scene.erase(first, last + 2 - first);
  folder_.write("a.pbrt", scene);
  const ProcessResult r = pbrt("--strict a.pbrt");
  EXPECT_EQ(r.status, 2);
  EXPECT_NE(r.output.find("density lookups exceeded their bound"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("seed 0: medium \"fog\" has density "), std::string::npos) << r.output;
  EXPECT_NE(r.output.find(" of the ray from "), std::string::npos) << r.output;
}

TEST_F(Pbrt, WarnsOfTexturesThatAreNoDensity) {
  std::string scene = learningScene();
  scene.replace(scene.find("\"analytic\" \"string function\" \"ramp\""), 35,
                "\"texture\" \"texture density\" \"bad\"");
  scene.insert(scene.find("MakeNamedMedium"), "Texture \"bad\" \"float\" \"constant\" \"float value\" -1 ");
  folder_.write("a.pbrt", scene);
  const ProcessResult r = pbrt("a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("warning: medium \"fog\": texture \"bad\" has negative values"), std::string::npos)
      << r.output;
}

TEST_F(Pbrt, StopsAtTheTimeLimitWithAValidImage) {
  folder_.write("endless.pbrt", kEndless);
  ProcessResult r;
  EXPECT_LT(cpuSecondsOf([&] { r = pbrt("--nthreads 1 --time 1 --stats s.json endless.pbrt", kAtMost); }), 3);
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_EQ(firstPixel("endless.exr"), Rgb(0.5f, 0.25f, 1)) << "the image must be rightly normalised";
  EXPECT_TRUE(
      nlohmann::json::parse(folder_.read("s.json")).at("renders").at(0).at("interrupted").get<bool>());
}

TEST_F(Pbrt, ShowsALiveLineOnATerminalAndNoneWhenTold) {
  folder_.write("endless.pbrt", kEndless);
  const auto onTerminal = [&](const std::string& arguments) {
    return run("cd '" + folder_.path().string() + "' && script -qec \"'" PBRT_PROGRAM "' " + arguments +
               "\" /dev/null < /dev/null");
  };
  const ProcessResult live = onTerminal("--time 1 endless.pbrt");
  EXPECT_EQ(live.status, 0) << live.output;
  EXPECT_NE(live.output.find("\rendless.exr ["), std::string::npos) << live.output;
  EXPECT_NE(live.output.find("samples/s"), std::string::npos) << live.output;
  EXPECT_EQ(onTerminal("--progress none --time 1 endless.pbrt").output.find("samples/s"), std::string::npos);
}

TEST_F(Pbrt, NarrowTerminalsAreNotFlooded) {
  const std::string name = "a_long_name_of_a_shot_that_alone_fills_a_line.exr";
  folder_.write("endless.pbrt", kEndless);
  const ProcessResult r = run("cd '" + folder_.path().string() +
                              "' && script -qec \"stty cols 40; '" PBRT_PROGRAM "' --time 1 --outfile " +
                              name + " endless.pbrt\" /dev/null < /dev/null");
  EXPECT_EQ(r.status, 0) << r.output;
  const std::size_t first = r.output.find("\ra_lo");
  ASSERT_NE(first, std::string::npos) << r.output;
  for (std::size_t at = first; at != std::string::npos; at = r.output.find("\ra_lo", at + 1)) {
    EXPECT_LT(r.output.find("\033[K", at) - at, 41u) << r.output.substr(at, 80);
  }
}

TEST_F(Pbrt, SaysThatReadingGoesOn) {
  // A pipe that stays open keeps the program reading.
  const ProcessResult r = run("cd '" + folder_.path().string() +
                              "' && (sleep 6; echo WorldBegin) | '" PBRT_PROGRAM "' --progress plain -");
  EXPECT_EQ(r.status, 1);
  EXPECT_NE(r.output.find("reading -, 5.0s\n"), std::string::npos) << r.output;
}

TEST_F(Pbrt, PlainProgressIsALineNowAndThen) {
  folder_.write("endless.pbrt", kEndless);
  const ProcessResult r = pbrt("--progress plain --time 6 endless.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  const std::size_t line = r.output.find("endless.exr:  ");
  ASSERT_NE(line, std::string::npos) << r.output;
  EXPECT_NE(r.output.find(" left, ", line), std::string::npos) << r.output;
  EXPECT_EQ(r.output.find('\r'), std::string::npos) << "for logs: no redrawing";
}

TEST_F(Pbrt, WritesAValidImageOnInterrupt) {
  folder_.write("endless.pbrt", kEndless);
  const ProcessResult r = pbrt("--nthreads 2 endless.pbrt", "timeout -s INT 2");
  EXPECT_TRUE(folder_.has("endless.exr")) << r.output;
  const Image image = readImage(folder_.path() / "endless.exr");
  for (int y = 0; y < image.height(); ++y) {
    for (int x = 0; x < image.width(); ++x) ASSERT_EQ(image.rgb(x, y), Rgb(0.5f, 0.25f, 1)) << x << ' ' << y;
  }
}

TEST_F(Pbrt, WritesAValidImageWhenItsTerminalOrReaderGoes) {
  folder_.write("endless.pbrt", kEndless);
  pbrt("endless.pbrt", "timeout -s HUP 2");
  ASSERT_TRUE(folder_.has("endless.exr"));
  EXPECT_EQ(firstPixel("endless.exr"), Rgb(0.5f, 0.25f, 1));
  std::filesystem::remove(folder_.path() / "endless.exr");
  // Nobody reads what it says, as when Ctrl-C ends "| tee log" first.
  pbrt("endless.pbrt 2>&1 | true", "timeout -s INT 2");
  ASSERT_TRUE(folder_.has("endless.exr"));
  EXPECT_EQ(firstPixel("endless.exr"), Rgb(0.5f, 0.25f, 1));
}

/// Inside a mirroring sphere with an opening: rays leave through it at once, or go round for ever.
std::string mirrorSphere(const std::string& zmax) {
  return "LookAt 0 0.1 0.2  0 0.1 1  0 1 0\nCamera \"perspective\" \"float fov\" 120\n"
         "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 \"string filename\" \"m.exr\"\n"
         "Sampler \"random\" \"integer pixelsamples\" 4\n"
         "Integrator \"path\" \"integer maxdepth\" 1000000000 \"float rrthreshold\" 0\nWorldBegin\n"
         "LightSource \"infinite\" \"rgb L\" [ 0.5 0.25 1 ]\nMaterial \"mirror\" \"rgb Kr\" [ 1 1 1 ]\n"
         "Shape \"sphere\" " +
         zmax + "\nWorldEnd\n";
}

TEST_F(Pbrt, LeavesPathsThatDoNotEndWhenTheTimeIsUp) {
  folder_.write("open.pbrt", mirrorSphere("\"float zmax\" 0.9"));
  ProcessResult r;
  EXPECT_LT(cpuSecondsOf([&] { r = pbrt("--nthreads 1 --time 1 open.pbrt", kAtMost); }), 3);
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("1 paths did not end within 0.1 s of the stop and were left"), std::string::npos)
      << r.output;
  EXPECT_NE(r.output.find("of 64 pixels have no sample of their own"), std::string::npos) << r.output;
  const Image image = readImage(folder_.path() / "m.exr");
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      EXPECT_TRUE(image.rgb(x, y) == Rgb(0) || image.rgb(x, y) == Rgb(0.5f, 0.25f, 1)) << x << ' ' << y;
    }
  }
}

TEST_F(Pbrt, EndsPathsThatScatterWhereCoordinatesCannotTell) {
  folder_.write(
      "dense.pbrt",
      "LookAt .5 .4 .3  0 0 1  0 1 0 Camera \"perspective\" \"float fov\" 10 "
      "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 \"string filename\" \"d.exr\" "
      "Sampler \"random\" \"integer pixelsamples\" 1 "
      "Integrator \"volpath\" \"integer maxdepth\" 1000000000 \"float rrthreshold\" 0 WorldBegin "
      "LightSource \"infinite\" MakeNamedMedium \"m\" \"string type\" \"homogeneous\" "
      "\"rgb sigma_s\" [1e20 1e20 1e20] \"rgb sigma_a\" [0 0 0] "
      "MediumInterface \"m\" \"\" Material \"\" Shape \"sphere\" WorldEnd");
  const ProcessResult r = pbrt("--stats d.json dense.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("4 paths were ended in media so dense"), std::string::npos) << r.output;
  const auto stats = nlohmann::json::parse(folder_.read("d.json"));
  EXPECT_EQ(stats.at("renders").at(0).at("counters").at("stuckPaths").get<int>(), 4);
}

TEST_F(Pbrt, SaysWhichExtinctionComesOutRightWhereOneIsTooLargeForCoordinates) {
  const auto outputAt = [&](const std::string& sigma, const std::string& type = "\"homogeneous\"") {
    folder_.write(
        "milk.pbrt",
        "LookAt 0 0 -5  0 0 0  0 1 0 Camera \"perspective\" \"float fov\" 10 "
        "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 \"string filename\" \"m.exr\" "
        "Sampler \"random\" \"integer pixelsamples\" 1 Integrator \"volpath\" WorldBegin "
        "LightSource \"infinite\" MakeNamedMedium \"milk\" \"string type\" " +
            type + " \"rgb sigma_s\" [" + sigma + " " + sigma + " " + sigma +
            "] \"rgb sigma_a\" [0 0 0] "
            "MediumInterface \"milk\" \"\" Material \"\" Shape \"sphere\" WorldEnd");
    const ProcessResult r = pbrt("milk.pbrt");
    EXPECT_EQ(r.status, 0) << r.output;
    return r.output;
  };
  const std::string dense = outputAt("1e15");
  EXPECT_NE(dense.find("medium \"milk\": its mean free path, 1e-15"), std::string::npos) << dense;
  EXPECT_NE(dense.find("an extinction of at most 1.41e+13 looks the same"), std::string::npos) << dense;
  EXPECT_EQ(outputAt("1e12").find("mean free path"), std::string::npos);
  // The box of a grid is told less well.
  const std::string grid =
      "\"heterogeneous\" \"point p0\" [-1 -1 -1] \"point p1\" [1 1 1] \"float density\" [2] \"integer nx\" 1 "
      "\"integer ny\" 1 \"integer nz\" 1";
  const std::string box = outputAt("1e6", grid);
  EXPECT_NE(box.find("its mean free path, 5e-07"), std::string::npos) << box;
  EXPECT_NE(box.find("an extinction of at most 8.39e+05 looks the same"), std::string::npos) << box;
  EXPECT_EQ(outputAt("4e5", grid).find("mean free path"), std::string::npos);
}

TEST_F(Pbrt, WritesNoImageWhenItIsStoppedBeforeTheFirstSample) {
  folder_.write("closed.pbrt", mirrorSphere(""));
  ProcessResult r;
  EXPECT_LT(cpuSecondsOf([&] { r = pbrt("--nthreads 1 --time 0.3 closed.pbrt", kAtMost); }), 2.5);
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("pbrt: error: --time 0.3: stopped after "), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("before the first sample; no image is written"), std::string::npos) << r.output;
  EXPECT_FALSE(folder_.has("m.exr"));
}

TEST_F(Pbrt, TimeCountsFromTheStartOfTheProgram) {
  // Subdivided to the limit: some 20 seconds of construction.
  folder_.write(
      "loop.pbrt",
      "WorldBegin LightSource \"infinite\" Shape \"loopsubdiv\" \"integer levels\" 11 \"integer indices\" "
      "[0 2 1 0 1 3 1 2 3 2 0 3] \"point P\" [0 0 0 1 0 0 0 1 0 0 0 1] WorldEnd");
  ProcessResult r;
  EXPECT_LT(cpuSecondsOf([&] { r = pbrt("--nthreads 1 --time 0.3 loop.pbrt", kAtMost); }), 3);
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("before the first sample; no image is written"), std::string::npos) << r.output;
  r = pbrt("loop.pbrt", "timeout -s INT 2");
  EXPECT_NE(r.output.find("stopping before the first sample"), std::string::npos) << r.output;
  EXPECT_EQ(folder_.fileCount(), 1u) << "nothing half-written";
}

TEST_F(Pbrt, TimeEndsTheWaitForAPipeThatStaysSilent) {
  // Open for writing too, it never ends.
  const ProcessResult r = pbrt(
      "--time 0.3 - <&3", "mkfifo pipe && exec 3<>pipe && echo WorldBegin >&3 && " + std::string(kAtMost));
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("while the scene was read; no image is written"), std::string::npos) << r.output;
}

TEST_F(Pbrt, QuietSaysNothingWhenAllIsWell) {
  folder_.write("a.pbrt", kScene);
  EXPECT_EQ(pbrt("--quiet a.pbrt").output, "");
}

TEST_F(Pbrt, CatPrintsASceneThatParsesToTheSameImage) {
  folder_.write("a.pbrt", kScene);
  ASSERT_EQ(pbrt("--seed 3 --outfile one.exr a.pbrt").status, 0);
  const ProcessResult printed = pbrt("--cat a.pbrt");
  ASSERT_EQ(printed.status, 0);
  folder_.write("b.pbrt", printed.output);
  ASSERT_EQ(pbrt("--seed 3 --outfile two.exr b.pbrt").status, 0) << printed.output;
  EXPECT_EQ(readImage(folder_.path() / "one.exr").data(), readImage(folder_.path() / "two.exr").data());
}

TEST_F(Pbrt, MediumParametersOfTheCommandLineAreCheckedAndMustFindAMedium) {
  folder_.write("a.pbrt", kScene);
  const ProcessResult wrong = pbrt("--mediumparams '\"float majorant\" \"x\"' a.pbrt");
  EXPECT_EQ(wrong.status, 1);
  EXPECT_NE(wrong.output.find("--mediumparams:1:18: error: parameter \"float majorant\""), std::string::npos)
      << wrong.output;
  const ProcessResult none = pbrt("--mediumparams '\"float majorant\" 2' a.pbrt");
  EXPECT_EQ(none.status, 0);
  EXPECT_NE(none.output.find("the scene has no medium with a density field: nothing was set"),
            std::string::npos)
      << none.output;
}

TEST_F(Pbrt, CatPrintsWhatIsTolerated) {
  folder_.write(
      "a.pbrt",
      "LookAt 0, 0, -4,  0, 0, 0,  0, 1, 0\nWorldBegin\nShape \"sphere\" \"float radius\" 0x2\nWorldEnd\n");
  const ProcessResult r = pbrt("--cat a.pbrt 2> said.txt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("LookAt 0 0 -4 0 0 0 0 1 0\n"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("\"float radius\" [ 2 ]"), std::string::npos) << r.output;
  EXPECT_EQ(pbrt("--cat --strict a.pbrt").status, 1);
}

TEST_F(Pbrt, CatSaysWhenItCannotWrite) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full here";
  folder_.write("a.pbrt", kScene);
  const ProcessResult full =
      pbrt("--cat a.pbrt > /dev/full 2> said.txt; status=$?; cat said.txt; exit $status");
  EXPECT_EQ(full.status, 1);
  EXPECT_NE(full.output.find("error: cannot write to standard output"), std::string::npos) << full.output;
}

TEST_F(Pbrt, RendersEveryWorldOfAFile) {
  folder_.write(
      "two.pbrt",
      "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 \"string filename\" \"one.exr\"\n"
      "WorldBegin\nLightSource \"infinite\"\nWorldEnd\n"
      "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 \"string filename\" \"two.exr\"\n"
      "WorldBegin\nLightSource \"infinite\" \"rgb L\" [ 2 2 2 ]\nWorldEnd\n");
  ASSERT_EQ(pbrt("two.pbrt").status, 0);
  EXPECT_EQ(firstPixel("one.exr"), Rgb(1));
  EXPECT_EQ(firstPixel("two.exr"), Rgb(2));
}

TEST_F(Pbrt, TellsOfWorldsThatWriteOneFile) {
  const std::string world = "WorldBegin\nLightSource \"infinite\"\nWorldEnd\n";
  const std::string film =
      "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2 \"string filename\" ";
  folder_.write("two.pbrt", film + "\"o.exr\"\n" + world + film + "\"./o.exr\"\n" + world);
  folder_.write("png.pbrt", film + "\"o.exr\"\n" + world + film + "\"o.pfm\"\n" + world);
  EXPECT_EQ(pbrt("png.pbrt").output.find("only the last one"), std::string::npos);
  EXPECT_NE(pbrt("--png png.pbrt").output.find("only the last one rendered stays"), std::string::npos);
  const ProcessResult r = pbrt("two.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("two.pbrt:5:"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("only the last one rendered stays"), std::string::npos) << r.output;
  std::filesystem::remove(folder_.path() / "o.exr");
  EXPECT_EQ(pbrt("--strict two.pbrt").status, 1);
  EXPECT_FALSE(folder_.has("o.exr"));
  folder_.write("own.pbrt", film + "\"a.exr\"\n" + world + film + "\"b.exr\"\n" + world);
  EXPECT_EQ(pbrt("--strict own.pbrt").status, 0);
  const ProcessResult outfile = pbrt("--outfile c.exr own.pbrt");
  EXPECT_NE(outfile.output.find("leave --outfile out"), std::string::npos) << outfile.output;
}

TEST_F(Pbrt, WritesOverNothingThatItReadsOrWrites) {
  folder_.write("a.pbrt", kScene);
  ASSERT_EQ(pbrt("a.pbrt").status, 0);
  const std::string image = folder_.read("named.exr");
  const std::pair<std::string, std::string> wrong[] = {
      {"--stats a.pbrt", "--stats \"a.pbrt\" is the file of the scene too"},
      {"--convergence ./a.pbrt", "--convergence \"./a.pbrt\" is the file of the scene too"},
      {"--convergence c.csv --reference named.exr", "the image \"named.exr\" is the file of --reference too"},
      {"--convergence c.csv --stats c.csv", "--convergence \"c.csv\" is the file of --stats too"},
      {"--outfile b.exr --checkpoint b.exr", "--checkpoint \"b.exr\" is the file of the image too"},
      {"--png --stats named.png", "--stats \"named.png\" is the file of the image too"}};
  for (const auto& [arguments, part] : wrong) {
    const ProcessResult r = pbrt(arguments + " a.pbrt");
    EXPECT_EQ(r.status, 1) << r.output;
    EXPECT_NE(r.output.find(part), std::string::npos) << r.output;
  }
  EXPECT_EQ(folder_.read("named.exr"), image);
  EXPECT_EQ(pbrt("--stats /dev/null --convergence /dev/null a.pbrt").status, 0);
}

TEST_F(Pbrt, TakesNoEmptyNameForAFile) {
  folder_.write("a.pbrt", kScene);
  for (const char* option : {"--outfile", "--stats", "--bounds-cache", "--checkpoint", "--resume"}) {
    const ProcessResult r = pbrt(std::string(option) + " '' a.pbrt");
    EXPECT_EQ(r.status, 1) << r.output;
    EXPECT_NE(r.output.find("found an empty name, expected a file"), std::string::npos) << r.output;
  }
}

TEST_F(Pbrt, WritesAPngToo) {
  folder_.write("a.pbrt", kScene);
  const ProcessResult r = pbrt("--png a.pbrt");
  EXPECT_EQ(r.status, 0) << r.output;
  EXPECT_NE(r.output.find("wrote named.exr and named.png\n"), std::string::npos) << r.output;
  EXPECT_EQ(readImage(folder_.path() / "named.png").width(), 16);
  const ProcessResult only = pbrt("--png --outfile only.png a.pbrt");
  EXPECT_NE(only.output.find("wrote only.png\n"), std::string::npos) << only.output;
}

TEST_F(Pbrt, FindsOutBeforeRenderingThatAFileCannotBeWritten) {
  folder_.write("endless.pbrt", kEndless);
  folder_.write("folder.exr/a", "");
  for (const char* option : {"--stats folder.exr", "--bounds-cache folder.exr", "--outfile folder.exr",
                             "--stats no/s.json", "--outfile no/a.exr"}) {
    const ProcessResult r = pbrt(std::string(option) + " endless.pbrt", "timeout 20");
    EXPECT_EQ(r.status, 1) << option << ": " << r.output;
    EXPECT_NE(r.output.find("cannot be written"), std::string::npos) << r.output;
  }
  const ProcessResult r = pbrt("--outfile " + std::string(300, 'x') + ".exr endless.pbrt", "timeout 20");
  EXPECT_NE(r.output.find("File name too long"), std::string::npos) << r.output;
}

TEST_F(Pbrt, AnImageThatCannotBeWrittenAfterAllIsRescued) {
  folder_.write("endless.pbrt", kEndless);
  folder_.write("out/a", "");
  const ProcessResult r = run("cd '" + folder_.path().string() +
                              "' && ( (sleep 0.7; rm -r out) & '" PBRT_PROGRAM
                              "' --time 2 --stats s.json --outfile out/x.exr endless.pbrt )");
  EXPECT_EQ(r.status, 1) << r.output;
  EXPECT_NE(r.output.find("cannot write \"out/x.exr\""), std::string::npos) << r.output;
  const std::size_t at = r.output.find("x-rescued-");
  ASSERT_NE(at, std::string::npos) << r.output;
  const std::string name = r.output.substr(at, r.output.find(".exr", at) + 4 - at);
  EXPECT_EQ(firstPixel(name), Rgb(0.5f, 0.25f, 1));
  EXPECT_TRUE(folder_.has("s.json")) << "the numbers are worth as much as before";
}

TEST_F(Pbrt, StrictTellsDroppedSamplesByItsExitStatus) {
  // A light of 3e38 seen through a weight of 2 overflows to infinity.
  folder_.write("hot.pbrt",
                "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2\nWorldBegin\n"
                "LightSource \"infinite\" \"rgb L\" [ 3e38 3e38 3e38 ]\nLightSource \"infinite\" \"rgb L\" [ "
                "3e38 3e38 3e38 ]\n"
                "WorldEnd\n");
  const ProcessResult plain = pbrt("--outfile h.exr --stats s.json hot.pbrt");
  EXPECT_EQ(plain.status, 0);
  EXPECT_NE(plain.output.find("WARNING"), std::string::npos) << plain.output;
  EXPECT_NE(plain.output.find("pixel 0 0, sample 0, seed 0"), std::string::npos) << plain.output;
  const auto render = nlohmann::json::parse(folder_.read("s.json")).at("renders").at(0);
  EXPECT_EQ(render.at("counters").at("droppedSamples").at("infinite"), render.at("samplesTaken"));
  EXPECT_EQ(pbrt("--strict --outfile h.exr hot.pbrt").status, 2);
  EXPECT_TRUE(folder_.has("h.exr"));
}

/// Of several worlds the worst counts: 1, 2, 3, 0.
TEST_F(Pbrt, TheExitStatusOfSeveralWorldsIsTheWorst) {
  const auto world = [](const std::string& name, const std::string& lights) {
    return "Film \"image\" \"integer xresolution\" 4 \"integer yresolution\" 4 \"string filename\" \"" +
           name + "\"\nSampler \"random\" \"integer pixelsamples\" 64\nWorldBegin\n" + lights + "WorldEnd\n";
  };
  const std::string good = "LightSource \"infinite\"\n",
                    tooBright = "LightSource \"infinite\" \"rgb L\" [ 3e38 3e38 3e38 ]\n";
  folder_.write("early.pbrt", world("a.exr", good));
  folder_.write("early-faulty.pbrt", world("a.exr", good) + world("b.exr", tooBright + tooBright));
  folder_.write("faulty-early.pbrt", world("b.exr", tooBright + tooBright) + world("a.exr", good));
  const std::string options = "--quiet --strict --error 1000 ";
  EXPECT_EQ(pbrt("--quiet --strict early.pbrt").status, 0);
  EXPECT_EQ(pbrt(options + "early.pbrt").status, 3);
  EXPECT_EQ(pbrt(options + "early-faulty.pbrt").status, 2);
  EXPECT_EQ(pbrt(options + "faulty-early.pbrt").status, 2);
  EXPECT_EQ(pbrt(options + "--frames 1:2 --outfile f-#.exr early.pbrt").status, 3);
}

}  // namespace
}  // namespace pbrtmedia::test
