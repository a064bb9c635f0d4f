// SPDX-License-Identifier: BSD-2-Clause
#include "scene/print.h"

#include <gtest/gtest.h>

#include <sstream>

#include "base/files.h"
#include "scene/parse.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

std::string print(std::string_view text, const PrintOptions& options = {}) {
  std::ostringstream out;
  Diagnostics d;
  printText(text, "t.pbrt", "", out, d, options);
  EXPECT_EQ(d.format(), "");
  return out.str();
}

TEST(Print, NormalisesLayoutKeepsCommentsAndDoesNotFollowInclude) {
  EXPECT_EQ(
      print("# head\nFilm   \"image\" \"integer xresolution\" 64 # size\n\"string filename\" \"a\\\"b\"\n"
            "LookAt 0 0 5 0 0 0 0 1 0 Transform [1 0 0 0 0 1 0 0 0 0 1 0 .1 6 7 1]\n"
            "WorldBegin AttributeBegin ActiveTransform StartTime\n# inner\nInclude \"x.pbrt\" "
            "Shape \"sphere\" \"color Kd\" [.1 .2 .3] \"bool b\" \"true\" AttributeEnd WorldEnd # tail"),
      R"(# head
# size
Film "image"
    "integer xresolution" [ 64 ]
    "string filename" [ "a\"b" ]
LookAt 0 0 5 0 0 0 0 1 0
Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 0.1 6 7 1 ]

WorldBegin
  AttributeBegin
    ActiveTransform StartTime
    # inner
    Include "x.pbrt"
    Shape "sphere"
        "rgb Kd" [ 0.1 0.2 0.3 ]
        "bool b" [ "true" ]
  AttributeEnd
WorldEnd
# tail
)");
}

TEST(Print, WhatIsPrintedParsesToTheSameAndPrintsTheSame) {
  std::string numbers;
  for (int i = 0; i < 300; ++i) numbers += std::to_string(i * 0.37) + " ";
  const std::string once = print(
      "Camera \"perspective\" \"float fov\" 39.000001\nMediumInterface \"\" \"fog\" MediumInterface \"fog\"\n"
      "WorldBegin Texture \"t\" \"color\" \"scale\" \"texture tex1\" \"a b\" \"blackbody c\" [5000 1 3000 "
      "2]\n"
      "Shape \"x\" \"point P\" [1 2 3 4 5 6] \"point2 q\" [1 2] \"normal N\" [0 0 1] \"vector v\" [1 2 3] "
      "\"vector2 w\" [1 2] \"float f\" [" +
      numbers + "] \"string s\" [\"\\n\\\\\"] WorldEnd");
  EXPECT_EQ(print(once), once);
  for (std::istringstream lines(once); !lines.eof();) {
    std::string line;
    std::getline(lines, line);
    EXPECT_LE(line.size(), 102u);
  }
}

TEST(Print, StopsAtAStatementThatCannotBeRead) {
  std::ostringstream out;
  Diagnostics d;
  printText("Film \"image\"\nFoo\nSampler \"halton\"", "t.pbrt", "", out, d);
  EXPECT_EQ(out.str(), "Film \"image\"\n");
  EXPECT_EQ(d.errorCount(), 1u);
}

TEST(Print, LargeMeshesBecomePlyFiles) {
  const TemporaryFolder folder;
  PrintOptions options;
  options.meshesToPly = true;
  options.minPlyIndices = 6;
  options.plyFolder = folder.path();
  options.plyPrefix = "part";
  const std::string mesh =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [0 0 0 1 0 0 1 1 0 0 1 0] "
      "\"normal N\" [0 0 1 0 0 1 0 0 1 0 0 1] \"float uv\" [0 0 1 0 1 1 0 1] \"float alpha\" 0.5 ";
  const std::string small =
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 1 1 0] ";
  const std::string tangents = mesh + "\"vector S\" [1 0 0 1 0 0 1 0 0 1 0 0] ";
  const std::string out = print("WorldBegin " + mesh + mesh + small + tangents + "WorldEnd", options);
  EXPECT_NE(out.find("Shape \"plymesh\"\n      \"string filename\" [ \"part_00001.ply\" ]\n      \"float "
                     "alpha\" [ 0.5 ]"),
            std::string::npos)
      << out;
  EXPECT_NE(out.find("part_00002.ply"), std::string::npos);
  EXPECT_EQ(out.find("part_00003.ply"), std::string::npos);
  EXPECT_NE(out.find("\"vector S\""), std::string::npos);
  const FileBytes ply = FileBytes::open(folder.path() / "part_00001.ply");
  const std::string_view text = ply.text();
  const std::string_view end = "end_header\n";
  ASSERT_NE(text.find(end), text.npos);
  EXPECT_EQ(text.substr(0, text.find(end)),
            "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
            "property float z\nproperty float nx\nproperty float ny\nproperty float nz\nproperty float u\n"
            "property float v\nelement face 2\nproperty list uchar int vertex_indices\n");
  const std::string_view body = text.substr(text.find(end) + end.size());
  EXPECT_EQ(body.size(), 4u * 32 + 2 * 13);
  EXPECT_EQ(body.substr(32, 4), std::string_view("\0\0\x80\x3f", 4));        // x of the second point is 1
  EXPECT_EQ(body.substr(128 + 13, 5), std::string_view("\x03\0\0\0\0", 5));  // second triangle starts at 0
}

}  // namespace
}  // namespace pbrtmedia
