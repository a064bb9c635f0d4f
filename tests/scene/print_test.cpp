// SPDX-License-Identifier: BSD-2-Clause
#include "scene/print.h"

#include <gtest/gtest.h>

#include <iterator>
#include <random>
#include <span>
#include <sstream>
#include <string>

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

TEST(Print, WhatIsToleratedComesOutAsItIsRead) {
  std::ostringstream out;
  Diagnostics d;
  printText(
      "LookAt 0, 0, -4,  0, 0, 0,  0, 1, 0\nTranslate nan 0 -inf Film \"image\" \"rgb L\" [.5, .5, .5] \"int "
      "n\" 3 \"float "
      "f\" [0x10 2f] \"float g\" inf \"float s\" \"x\"\nWorldBegin AttributeEnd WorldEnd % the end",
      "t.pbrt", "", out, d);
  EXPECT_FALSE(d.hasErrors()) << d.format();
  EXPECT_EQ(
      out.str(),
      "LookAt 0 0 -4 0 0 0 0 1 0\nTranslate nan 0 -inf\nFilm \"image\"\n    \"rgb L\" [ 0.5 0.5 0.5 ]\n"
      "    \"float f\" [ 16 2 ]\n    \"float g\" [ 3.4028235e+38 ]\n\nWorldBegin\nAttributeEnd\nWorldEnd\n");
  std::ostringstream again;
  printText(out.str(), "t.pbrt", "", again, d);
  EXPECT_EQ(again.str(), out.str());
}

TEST(Print, OddScenesAreStableAfterOnePrinting) {
  std::mt19937_64 random(29);
  const auto pick = [&](std::span<const std::string_view> from) {
    return std::string(from[random() % from.size()]);
  };
  constexpr std::string_view kNumbers[] = {"0",   "1,",   "-2.5f", "0x1F", "1e",   "3#x",   "1e39", "inf",
                                           "nan", "-nan", "-inf",  "1.5",  "7;8,", "1e-50", "+4",   "0x1p-3"};
  constexpr std::string_view kStrings[] = {R"("a")", R"("")", R"("true")", R"("a\"b")", R"("float x")"};
  constexpr std::string_view kTypes[] = {"float",  "integer", "int",     "rgb", "point",  "bool",
                                         "string", "",        "texture", "xyz", "normal", "vector2"};
  constexpr std::string_view kTransforms[] = {"Translate", "Scale",  "ConcatTransform",
                                              "LookAt",    "Rotate", "TransformTimes"};
  constexpr std::size_t kCounts[] = {3, 3, 16, 9, 4, 2};
  std::size_t printed = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (std::uint64_t k = 1 + random() % 3; k > 0; --k) {
      if (random() % 2 == 0) {
        const std::size_t which = random() % std::size(kTransforms);
        text += std::string(kTransforms[which]) + (kCounts[which] == 16 ? " [" : " ");
        for (std::size_t i = 0; i < kCounts[which]; ++i) text += pick(kNumbers) + ' ';
        text += kCounts[which] == 16 ? "]\n" : "\n";
        continue;
      }
      text += "Film \"image\" ";
      for (std::uint64_t n = random() % 3; n > 0; --n) {
        text += '"' + pick(kTypes) + " p" + std::to_string(n) + (random() % 8 == 0 ? " more\" [" : "\" [");
        const bool strings = random() % 3 == 0;
        for (std::uint64_t v = random() % 5; v > 0; --v)
          text += ' ' + (strings ? pick(kStrings) : pick(kNumbers));
        text += " ]\n";
      }
    }
    std::ostringstream once, twice;
    Diagnostics first, second;
    printText(text, "t.pbrt", "", once, first);
    if (first.hasErrors()) continue;
    ++printed;
    printText(once.str(), "t.pbrt", "", twice, second);
    ASSERT_FALSE(second.hasErrors()) << text << "\n" << second.format();
    ASSERT_EQ(once.str(), twice.str()) << text;
  }
  EXPECT_GT(printed, 4000u);  // else nothing was tested
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
