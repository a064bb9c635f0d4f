// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include "exporters/vdb_samples.h"
#include "support/process.h"
#include "support/temporary_folder.h"

// Runs the built program, as a user would.
namespace pbrtmedia {
namespace {

using test::ProcessResult;
using test::VdbKind;
using test::writeVdb;

class Vdb2PbrtProgram : public testing::Test {
 protected:
  ProcessResult run(const std::string& arguments) const {
    return test::run("cd '" + folder_.path().string() + "' && '" PBRT_MEDIA_VDB2PBRT "' " + arguments);
  }
  std::filesystem::path in(const std::string& name) const { return folder_.path() / name; }
  void expectMistake(const std::string& arguments, const std::string& part) const {
    const ProcessResult result = run(arguments);
    EXPECT_EQ(result.status, 1) << result.output;
    EXPECT_NE(result.output.find(part), std::string::npos) << result.output;
  }

  TemporaryFolder folder_;
};

TEST_F(Vdb2PbrtProgram, ConvertsBesideTheInput) {
  writeVdb(in("cloud.vdb"), VdbKind::Placed);
  const ProcessResult result = run("cloud.vdb --half --sigma-s 3 2 1 --medium fog --scale 2");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(result.output, "");
  const std::string text = folder_.read("cloud.pbrt");
  EXPECT_NE(
      text.find("MakeNamedMedium \"fog\" \"string type\" \"nanovdb\"\n  \"string filename\" \"cloud.nvdb\" "
                "\"string grid\" \"density\"\n  \"rgb sigma_a\" [ 0 0 0 ] \"rgb sigma_s\" [ 3 2 1 ] \"float "
                "scale\" 2"),
      std::string::npos)
      << text;
  EXPECT_EQ(folder_.fileCount(), 3u) << "no temporary file is left";
  EXPECT_EQ(run("--info cloud.nvdb").status, 0);
}

TEST_F(Vdb2PbrtProgram, ConvertsSequences) {
  for (const char* name : {"s.0008.vdb", "s.0009.vdb", "s.0011.vdb"}) writeVdb(in(name), VdbKind::OneVoxel);
  expectMistake("s.%04d.vdb --frames 8to11", "expected FIRST-LAST or FIRST-LAST:STEP");
  expectMistake("s.%04d.vdb --frames 8-11", "1 frames of s.%04d.vdb are missing; nothing was converted");
  EXPECT_FALSE(folder_.has("s.0008.pbrt"));
  expectMistake("s.%04d.vdb --frames 8-11 -o one.pbrt", "--outfile needs a place");
  const ProcessResult result = run("s.%04d.vdb --frames 8-11 --skip-missing -o out%02d.pbrt");
  EXPECT_EQ(result.status, 0) << result.output;
  for (const char* name : {"out08.nvdb", "out09.pbrt", "out11.pbrt"}) EXPECT_TRUE(folder_.has(name)) << name;
  EXPECT_FALSE(folder_.has("out10.pbrt"));
  EXPECT_NE(folder_.read("out11.pbrt").find("\"out11.nvdb\""), std::string::npos);
  EXPECT_NE(result.output.find("left out, not there: s.0010.vdb"), std::string::npos) << result.output;
  EXPECT_EQ(run("s.%04d.vdb --frames 9").status, 0);
  expectMistake("s.0008.vdb --frames 1-2", "--frames needs a place");
  expectMistake("s.%04d.vdb --frames 100-200 --skip-missing", "no frame of");
}

TEST_F(Vdb2PbrtProgram, ConvertsAllFramesThatAreThere) {
  for (const char* name : {"s.0008.vdb", "s.0009.vdb", "s.0012.vdb", "s.0012-old.vdb"}) {
    writeVdb(in(name), VdbKind::OneVoxel);
  }
  for (const char* name :
       {"'s.$F4.vdb' -o 'a.$F.pbrt'", "s.####.vdb -o a.#.pbrt", "s.%04d.vdb -o a.%d.pbrt"}) {
    const ProcessResult result = run(name);
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_NE(result.output.find("frames 8 to 12, 3 files; not there: 10-11"), std::string::npos)
        << result.output;
    for (const char* made : {"a.8.nvdb", "a.9.pbrt", "a.12.pbrt"}) {
      EXPECT_TRUE(folder_.has(made)) << made << " by " << name;
      std::filesystem::remove(in(made));
    }
  }
  expectMistake("t.####.vdb", "no frame of t.####.vdb is there");
  expectMistake("s.####.vdb -o one.pbrt", "--outfile needs a place");
  expectMistake("s.####.vdb --scene one.pbrt", "--scene needs a place");
  // A name that is there as it stands is no sequence.
  writeVdb(in("take#1.vdb"), VdbKind::OneVoxel);
  EXPECT_EQ(run("take#1.vdb").status, 0);
  EXPECT_TRUE(folder_.has("take#1.pbrt"));
}

TEST_F(Vdb2PbrtProgram, SequencesKeepCameraAndLook) {
  test::writeFireVdb(in("f.1.vdb"), 0.5f);
  test::writeFireVdb(in("f.2.vdb"), 0.75f);
  writeVdb(in("g.vdb"), VdbKind::Placed);
  const ProcessResult result = run("f.#.vdb --temperature temperature --scene f-scene.#.pbrt");
  EXPECT_EQ(result.status, 0) << result.output;
  const std::string first = folder_.read("f-scene.1.pbrt"), second = folder_.read("f-scene.2.pbrt");
  const std::string lookAt = first.substr(first.find("LookAt"), 60);
  EXPECT_NE(second.find(lookAt), std::string::npos) << lookAt << " in " << second;
  EXPECT_NE(second.find("Include \"f.2.pbrt\""), std::string::npos) << second;
  EXPECT_NE(second.find("\"f-scene.2.exr\""), std::string::npos) << second;
  for (const char* key : {"\"float temperaturescale\" ", "\"float Lescale\" ", "\"float scale\" "}) {
    const std::string one = folder_.read("f.1.pbrt"), two = folder_.read("f.2.pbrt");
    const std::size_t at = one.find(key);
    ASSERT_NE(at, std::string::npos) << key << " in " << one;
    EXPECT_NE(two.find(one.substr(at, one.find_first_of("\n\"", at + std::string(key).size()) - at)),
              std::string::npos)
        << key;
  }
  // Said for one frame.
  EXPECT_EQ(result.output.find("\"heat\"; it looks"), result.output.rfind("\"heat\"; it looks"))
      << result.output;
}

TEST_F(Vdb2PbrtProgram, OptionsThatDoNotGoTogether) {
  writeVdb(in("t.vdb"), VdbKind::OneVoxel);
  expectMistake("t.vdb --temperaturescale 3", "belong to --temperature");
  expectMistake("t.vdb --Lescale 3", "belong to --temperature GRID or --Legrid");
  expectMistake("t.vdb --temperature density --Le 1 1 1", "the colour comes from --temperature already");
  expectMistake("t.vdb --scene t.pbrt", "another name for one of them");
  expectMistake("t.vdb --scene t.exr", "expected a name that ends with .pbrt");
  expectMistake("t.vdb --nan keep", "--nan");
  EXPECT_EQ(run("-g density t.vdb --scene show.pbrt").status, 0)
      << "an option does not take the input's name";
  EXPECT_TRUE(folder_.has("show.pbrt"));
}

TEST_F(Vdb2PbrtProgram, MistakesEndWithStatusOneAndLeaveOldFiles) {
  writeVdb(in("t.vdb"), VdbKind::NotANumber);
  folder_.write("t.pbrt", "old");
  expectMistake("t.vdb", "voxel (1, 2, 3) is nan");
  EXPECT_EQ(folder_.read("t.pbrt"), "old");
  expectMistake("", "input");
  expectMistake("nothing.vdb", "nothing.vdb: it cannot be opened");
  expectMistake("t.vdb --precision fp17", "fp17");
  expectMistake("t.vdb --half --precision fp8", "--half");
  expectMistake("t.vdb --dense gz --half", "--dense writes no .nvdb");
  expectMistake("t.vdb --sigma-a 1 -1 1", "--sigma-a");
  expectMistake("t.vdb --tolerance 0", "--tolerance");
  expectMistake("--info nothing.vdb", "cannot be opened");
  writeVdb(in("good.vdb"), VdbKind::OneVoxel);
  expectMistake("good.vdb -o missing/folder/t.pbrt", "folder \"missing/folder\" does not exist");
  expectMistake("good.vdb --scene missing/t.pbrt", "folder \"missing\" does not exist");
  EXPECT_FALSE(std::filesystem::exists(in("good.pbrt"))) << "the question comes before the work";
  expectMistake("good.vdb -o good.nvdb", "the output is a .pbrt include");
  EXPECT_EQ(run("--help").status, 0);
}

}  // namespace
}  // namespace pbrtmedia
