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
  expectMistake("s.%04d.vdb", "expected --frames FIRST-LAST");
  expectMistake("s.%04d.vdb --frames 8-11", "1 frames of s.%04d.vdb are missing; nothing was converted");
  EXPECT_FALSE(folder_.has("s.0008.pbrt"));
  expectMistake("s.%04d.vdb --frames 8-11 -o one.pbrt", "--outfile needs %d or %04d");
  const ProcessResult result = run("s.%04d.vdb --frames 8-11 --skip-missing -o out%02d.pbrt");
  EXPECT_EQ(result.status, 0) << result.output;
  for (const char* name : {"out08.nvdb", "out09.pbrt", "out11.pbrt"}) EXPECT_TRUE(folder_.has(name)) << name;
  EXPECT_FALSE(folder_.has("out10.pbrt"));
  EXPECT_NE(folder_.read("out11.pbrt").find("\"out11.nvdb\""), std::string::npos);
  EXPECT_NE(result.output.find("left out, not there: s.0010.vdb"), std::string::npos) << result.output;
  EXPECT_EQ(run("s.%04d.vdb --frames 9").status, 0);
  expectMistake("s.0008.vdb --frames 1-2", "--frames needs %d");
  expectMistake("s.%04d.vdb --frames 100-200 --skip-missing", "no frame of");
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
  expectMistake("good.vdb -o missing/folder/t.pbrt", "there is no folder");
  expectMistake("good.vdb -o good.nvdb", "the output is a .pbrt include");
  EXPECT_EQ(run("--help").status, 0);
}

}  // namespace
}  // namespace pbrtmedia
