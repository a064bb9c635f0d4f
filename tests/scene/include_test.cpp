// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "scene/parse.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

Parsed parsePath(const std::filesystem::path& file, const ParseOptions& options = {}, bool strict = false) {
  Parsed p;
  p.diagnostics.strict = strict;
  const std::filesystem::path files[] = {file};
  p.scenes = parseFiles(files, p.diagnostics, options);
  return p;
}

TEST(Include, ReadsTheFileInPlaceAndStatePersists) {
  const TemporaryFolder folder;
  folder.write("inc.pbrt", "Translate 1 0 0\nShape \"a\"\nMaterial \"glass\"");
  Parsed p = parsePath(folder.write("main.pbrt", "WorldBegin Include \"inc.pbrt\" Shape \"b\" WorldEnd"));
  EXPECT_EQ(p.messages(), "");
  ASSERT_EQ(p.scene().shapes.size(), 2u);
  EXPECT_EQ(p.scene().shapes[1].material, 0);
  EXPECT_EQ(p.scene().shapes[1].ctm->start.point(Vec3d{}).x, 1);
  EXPECT_EQ(p.scene().shapes[0].location.toString(), (folder.path() / "inc.pbrt").string() + ":2:1");
}

TEST(Include, NamesResolveAgainstTheTopLevelFileAtEveryDepth) {
  const TemporaryFolder folder;
  folder.write("sub/a.pbrt", "Include \"sub/b.pbrt\"");
  folder.write("sub/b.pbrt", "Shape \"b\"");
  folder.write("b.pbrt", "Shape \"wrong\"");
  Parsed p = parsePath(folder.write("main.pbrt", "WorldBegin Include \"sub/a.pbrt\" WorldEnd"));
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().shapes.at(0).type, "b");
  EXPECT_EQ(p.scene().shapes.at(0).folders->base, folder.path());
  EXPECT_EQ(p.scene().shapes.at(0).folders->own, folder.path() / "sub");
}

TEST(Include, AFileBesideTheIncluderIsUsedWithAWarning) {
  const TemporaryFolder folder;
  folder.write("sub/a.pbrt", "Include \"b.pbrt\"");
  folder.write("sub/b.pbrt", "Shape \"b\"");
  Parsed p = parsePath(folder.write("main.pbrt", "WorldBegin Include \"sub/a.pbrt\" WorldEnd"));
  EXPECT_FALSE(p.diagnostics.hasErrors());
  EXPECT_EQ(p.scene().shapes.size(), 1u);
  EXPECT_NE(p.messages().find("a.pbrt:1:9: warning: using \"" + (folder.path() / "sub/b.pbrt").string() +
                              "\"; PBRT-v3 looks for \"" + (folder.path() / "b.pbrt").string()),
            std::string::npos)
      << p.messages();
}

TEST(Include, AbsoluteNamesAreUsedUnchanged) {
  const TemporaryFolder folder, other;
  const auto inc = other.write("inc.pbrt", "Shape \"a\"");
  Parsed p = parsePath(folder.write("main.pbrt", "WorldBegin Include \"" + inc.string() + "\" WorldEnd"));
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().shapes.size(), 1u);
}

TEST(Include, AllMissingFilesAreListed) {
  const TemporaryFolder folder;
  const auto main = folder.write("main.pbrt", "Include \"x.pbrt\"\nInclude \"y.pbrt\"\nWorldBegin WorldEnd");
  const Parsed p = parsePath(main);
  EXPECT_FALSE(p.diagnostics.hasErrors());
  EXPECT_EQ(p.diagnostics.all().size(), 2u);
  EXPECT_NE(
      p.messages().find("main.pbrt:2:9: warning: there is no file \"" + (folder.path() / "y.pbrt").string() +
                        "\"; the Include is left out, as in PBRT-v3 [an error with --strict]"),
      std::string::npos)
      << p.messages();
  EXPECT_EQ(p.scenes.size(), 1u);
  Diagnostics strict;
  strict.strict = true;
  const std::filesystem::path files[] = {main};
  parseFiles(files, strict);
  EXPECT_EQ(strict.errorCount(), 2u);
}

TEST(Include, CyclesAreErrorsWithTheChain) {
  const TemporaryFolder folder;
  folder.write("a.pbrt", "\nInclude \"b.pbrt\"");
  folder.write("b.pbrt", "Include \"./a.pbrt\"");
  Parsed p = parsePath(folder.write("main.pbrt", "Include \"a.pbrt\" WorldBegin WorldEnd"));
  EXPECT_EQ(p.diagnostics.errorCount(), 1u) << p.messages();
  const std::string chain = (folder.path() / "a.pbrt").string() + ":2:1 -> " +
                            (folder.path() / "b.pbrt").string() + ":1:1 -> " +
                            (folder.path() / "./a.pbrt").string();
  EXPECT_NE(p.messages().find("Include would never end: " + chain), std::string::npos) << p.messages();
  Parsed self = parsePath(folder.write("self.pbrt", "Include \"self.pbrt\" WorldBegin WorldEnd"));
  EXPECT_EQ(self.diagnostics.errorCount(), 1u);
}

TEST(Include, DepthAndNumberAreBounded) {
  const TemporaryFolder folder;
  for (int i = 0; i < 20; ++i) {
    const std::string next = "Include \"" + std::to_string(i + 1) + ".pbrt\"\n";
    folder.write(std::to_string(i) + ".pbrt", next + next);
  }
  folder.write("20.pbrt", "");
  ParseOptions options;
  options.maxIncludes = 100;
  const auto main = folder.write("main.pbrt", "Include \"0.pbrt\" WorldBegin WorldEnd");
  EXPECT_NE(parsePath(main, options).messages().find("more than 100 Include directives"), std::string::npos);
  options = {};
  options.maxIncludeDepth = 5;
  EXPECT_NE(parsePath(main, options).messages().find("Include goes deeper than 5 files"), std::string::npos);
}

TEST(Include, AParameterListGoesOnInTheIncluder) {
  const TemporaryFolder folder;
  folder.write("inc.pbrt", "Shape \"sphere\" \"float radius\" 2");
  Parsed p = parsePath(folder.write(
      "main.pbrt", "WorldBegin Include \"inc.pbrt\" \"float zmin\" [-1] Shape \"disk\" WorldEnd"));
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().shapes.at(0).params.size(), 2u);
}

TEST(Include, ListsAndTransformationsGoOnInTheIncluder) {
  const TemporaryFolder folder;
  folder.write("list.pbrt", "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [ 0 0 0  1 0");
  folder.write("numbers.pbrt", "Translate 1 2");
  folder.write("value.pbrt", "Shape \"sphere\" \"float radius\"");
  Parsed p =
      parsePath(folder.write("main.pbrt",
                             "WorldBegin Include \"numbers.pbrt\" 3\nInclude \"list.pbrt\" 0  0 1 0 ]\n"
                             "Include \"value.pbrt\" 2 WorldEnd"));
  EXPECT_EQ(p.messages(), "");
  ASSERT_EQ(p.scene().shapes.size(), 2u);
  EXPECT_EQ(p.scene().shapes[0].ctm->start.point(Vec3d{}).z, 3);
  EXPECT_EQ(p.scene().shapes[0].params.find(ParamKind::Point3, "P")->size(), 3u);
  EXPECT_EQ(p.scene().shapes[1].params.find(ParamKind::Float, "radius")->size(), 1u);
}

// ---- A string that is not closed ends the included file, and the includer goes on -----------------------

TEST(UnclosedString, DropsTheRestOfAnIncludedFile) {
  const TemporaryFolder folder;
  folder.write("inc.pbrt",
               "Shape \"a\"\nShape \"b\" \"float radius\" 2 \"float zmin -1\nShape \"c\"\nShape \"d\"\n");
  const auto main = folder.write("main.pbrt", "WorldBegin\n  Include \"inc.pbrt\"\nShape \"e\"\nWorldEnd");
  Parsed p = parsePath(main);
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), 1u);
  EXPECT_NE(
      p.messages().find("inc.pbrt:2:28: warning: the string has no closing \" on its line; from here on "
                        "this file, lines 2 to 4, is left out, as in PBRT-v3, which goes on behind the "
                        "Include at " +
                        main.string() + ":2:3 [an error with --strict]"),
      std::string::npos)
      << p.messages();
  ASSERT_EQ(p.scene().shapes.size(), 3u);
  EXPECT_EQ(p.scene().shapes[1].type, "b");
  EXPECT_EQ(p.scene().shapes[1].params.size(), 1u);
  EXPECT_EQ(p.scene().shapes[2].type, "e");
  const Parsed strict = parsePath(main, {}, true);
  EXPECT_EQ(strict.diagnostics.errorCount(), 1u) << strict.messages();
}

TEST(UnclosedString, EndsOnlyTheFileItStandsIn) {
  const TemporaryFolder folder;
  folder.write("outer.pbrt", "Include \"inner.pbrt\"\nShape \"outer\"");
  folder.write("inner.pbrt", "Shape \"inner\"\n\"oops");
  Parsed p =
      parsePath(folder.write("main.pbrt", "WorldBegin Include \"outer.pbrt\" Shape \"main\" WorldEnd"));
  EXPECT_FALSE(p.diagnostics.hasErrors()) << p.messages();
  EXPECT_NE(
      p.messages().find("inner.pbrt:2:1: warning: the string has no closing \" on its line; the rest of "
                        "this line, the last of the file, is left out"),
      std::string::npos)
      << p.messages();
  ASSERT_EQ(p.scene().shapes.size(), 3u);
  EXPECT_EQ(p.scene().shapes[1].type, "outer");
}

TEST(UnclosedString, OfTheMainFileIsAnError) {
  const TemporaryFolder folder;
  const Parsed p = parsePath(folder.write("main.pbrt", "WorldBegin\nShape \"a\" \"float radius\nWorldEnd"));
  EXPECT_EQ(p.diagnostics.errorCount(), 1u);
  EXPECT_NE(p.messages().find("main.pbrt:2:11: error: the string has no closing"), std::string::npos)
      << p.messages();
  // Behind the last world the image is there.
  const Parsed behind = parsePath(folder.write("behind.pbrt", "WorldBegin WorldEnd\nFilm \"image"));
  EXPECT_FALSE(behind.diagnostics.hasErrors()) << behind.messages();
  EXPECT_EQ(behind.scenes.size(), 1u);
}

TEST(UnclosedString, MayLeaveTheIncluderWithWhatIsNoValue) {
  // PBRT-v3 takes the next word of the includer for the value, and ends at it.
  const TemporaryFolder folder;
  folder.write("inc.pbrt", "Shape \"a\" \"string filename\" \"x.ply\nShape \"b\"");
  const Parsed p =
      parsePath(folder.write("main.pbrt", "WorldBegin Include \"inc.pbrt\"\nShape \"c\" WorldEnd"));
  EXPECT_EQ(p.diagnostics.errorCount(), 1u) << p.messages();
  EXPECT_NE(
      p.messages().find("main.pbrt:2:1: error: parameter \"string filename\": found the directive Shape, "
                        "expected a value"),
      std::string::npos)
      << p.messages();
}

TEST(UnclosedString, BehindAnErrorDoesNotHideTheOthersOfItsFile) {
  const TemporaryFolder folder;
  folder.write("inc.pbrt", "Shape sphere\"\nActiveTransform Both\nTexture 1\nShape \"d\" \"e\n");
  const Parsed p = parsePath(folder.write("main.pbrt", "WorldBegin Include \"inc.pbrt\" WorldEnd"));
  EXPECT_EQ(p.diagnostics.errorCount(), 3u) << p.messages();
  EXPECT_EQ(p.diagnostics.all().size(), 4u) << p.messages();
}

TEST(Include, DirectoriesAndForeignFilesAreNamed) {
  const TemporaryFolder folder;
  folder.write("dir/x", "");
  folder.write("mesh.ply", "ply\nformat");
  Parsed p =
      parsePath(folder.write("main.pbrt", "Include \"dir\"\nInclude \"mesh.ply\"\nWorldBegin WorldEnd"));
  EXPECT_EQ(p.diagnostics.errorCount(), 1u);
  EXPECT_NE(p.messages().find("main.pbrt:1:9: warning: cannot read the file \""), std::string::npos)
      << p.messages();
  EXPECT_NE(p.messages().find("this is a PLY mesh"), std::string::npos);
  EXPECT_NE(p.messages().find("main.pbrt:2:9: note: the file is named here"), std::string::npos);
}

TEST(Include, SeveralFilesShareOneState) {
  const TemporaryFolder folder;
  folder.write("sub/inc.pbrt", "Shape \"a\"");
  const std::filesystem::path files[] = {
      folder.write("options.pbrt", "Film \"image\" Translate 1 0 0"),
      folder.write("sub/world.pbrt", "WorldBegin Include \"inc.pbrt\" WorldEnd")};
  Diagnostics d;
  const auto scenes = parseFiles(files, d);
  EXPECT_EQ(d.format(), "");
  ASSERT_EQ(scenes.size(), 1u);
  EXPECT_TRUE(scenes[0].film.given);
  EXPECT_EQ(scenes[0].shapes.size(), 1u);
}

TEST(Include, AMissingTopLevelFileIsAnError) {
  const Parsed p = parsePath("/no/such/scene.pbrt");
  EXPECT_EQ(p.messages(),
            "/no/such/scene.pbrt: error: cannot open \"/no/such/scene.pbrt\": No such file or directory\n");
}

TEST(Include, WithoutFilesIncludeAndSpectrumFilesAreOnlyChecked) {
  Diagnostics d;
  ParseOptions options;
  options.readFiles = false;
  const auto scenes = parseText("Include \"x\" Film \"image\" \"spectrum L\" \"y.spd\" WorldBegin WorldEnd",
                                "t", "", d, options);
  EXPECT_EQ(d.format(), "");
  EXPECT_EQ(scenes.at(0).film.params.find(ParamKind::Spectrum, "L")->size(), 1u);
}

}  // namespace
}  // namespace pbrtmedia
