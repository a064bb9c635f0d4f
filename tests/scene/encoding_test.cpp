// SPDX-License-Identifier: BSD-2-Clause
#include <gtest/gtest.h>

#include <random>

#include "scene/parse.h"
#include "support/gzip.h"
#include "support/temporary_folder.h"

namespace pbrtmedia {
namespace {

constexpr std::string_view kScene =
    "Film \"image\" \"integer xresolution\" [4]\nWorldBegin\nShape \"sphere\"\nWorldEnd\n";

std::string withLineEnds(std::string_view text, std::string_view end) {
  std::string out;
  for (const char c : text) c == '\n' ? out.append(end) : out.append(1, c);
  return out;
}

std::string utf16(std::string_view text, bool bigEndian, bool mark) {
  std::string out = mark ? (bigEndian ? "\xfe\xff" : "\xff\xfe") : "";
  for (const char c : text) {
    if (bigEndian) out += '\0';
    out += c;
    if (!bigEndian) out += '\0';
  }
  return out;
}

TEST(Encoding, ByteOrderMarkAndLineEndsDoNotMatter) {
  for (const std::string& text : {"\xef\xbb\xbf" + std::string(kScene), withLineEnds(kScene, "\r\n"),
                                  withLineEnds(kScene, "\r"), withLineEnds(kScene, "\f\v ")}) {
    Parsed p = parse(text);
    EXPECT_EQ(p.messages(), "");
    EXPECT_EQ(p.scene().shapes.size(), 1u);
  }
  EXPECT_EQ(parse("\xef\xbb\xbf"
                  "Foo\nWorldBegin WorldEnd")
                .messages()
                .substr(0, 11),
            "t.pbrt:1:1:");
}

TEST(Encoding, NamesMayBeUtf8) {
  Parsed p =
      parseWorld("MakeNamedMaterial \"blé\" \"string type\" \"matte\" NamedMaterial \"blé\" Shape \"s\"");
  EXPECT_EQ(p.messages(), "");
  EXPECT_EQ(p.scene().materials.at(0).name, "blé");
}

TEST(Encoding, OtherEncodingsAndBinaryFilesAreNamed) {
  const auto message = [](const std::string& text) { return parse(text).messages(); };
  EXPECT_EQ(message(utf16(kScene, false, true)), "t.pbrt: error: this is UTF-16 text; save it as UTF-8\n");
  EXPECT_EQ(message(utf16(kScene, true, true)), "t.pbrt: error: this is UTF-16 text; save it as UTF-8\n");
  EXPECT_NE(message(utf16(kScene, false, false)).find("UTF-16 text without a byte order mark"),
            std::string::npos);
  EXPECT_NE(message(std::string("\xff\xfe\0\0W\0\0\0", 8)).find("UTF-32"), std::string::npos);
  EXPECT_NE(message(std::string(kScene) + '\0').find("binary data (it has NUL bytes)"), std::string::npos);
  EXPECT_NE(message("ply\nformat ascii 1.0\n").find("this is a PLY mesh"), std::string::npos);
  EXPECT_NE(message("\x76\x2f\x31\x01").find("OpenEXR"), std::string::npos);
}

TEST(Encoding, GzipScenesAreReadAndDamageIsNamed) {
  const TemporaryFolder folder;
  const std::string packed = gzipped(kScene);
  Diagnostics d;
  const std::filesystem::path good[] = {folder.write("a.pbrt.gz", packed)};
  EXPECT_EQ(parseFiles(good, d).at(0).shapes.size(), 1u);
  EXPECT_EQ(d.format(), "");
  const std::filesystem::path bad[] = {folder.write("b.pbrt.gz", packed.substr(0, packed.size() - 9))};
  parseFiles(bad, d);
  EXPECT_NE(d.format().find("the gzip data is truncated"), std::string::npos);
}

TEST(Encoding, MessagesShowLinesOfGzipFiles) {
  const TemporaryFolder folder;
  Diagnostics d;
  const std::filesystem::path files[] = {
      folder.write("a.pbrt.gz", gzipped("\n\n  Flim \"image\"\nWorldBegin WorldEnd"))};
  parseFiles(files, d);
  EXPECT_NE(d.format().find(":3:3: error: unknown directive Flim"), std::string::npos);
  EXPECT_NE(d.format().find("\n    Flim \"image\"\n    ^~~~\n"), std::string::npos);
}

TEST(Encoding, AnythingAtAllIsSurvived) {
  // Bytes drawn from what the language is made of, so that deep states are reached.
  constexpr std::string_view kPieces[] = {"Shape ",
                                          "\"sphere\" ",
                                          "\"float radius\" ",
                                          "[",
                                          "]",
                                          "1 ",
                                          "-.5e3 ",
                                          "WorldBegin ",
                                          "\"",
                                          "\n",
                                          "\\",
                                          "#",
                                          "Include \"x\" ",
                                          "\xff",
                                          "WorldEnd ",
                                          "Texture ",
                                          "AttributeBegin ",
                                          "ObjectBegin \"a\" ",
                                          "ObjectInstance \"a\" ",
                                          "AttributeEnd ",
                                          "ObjectEnd ",
                                          "\"rgb L\" ",
                                          "Transform [",
                                          "MediumInterface ",
                                          "LookAt ",
                                          "ActiveTransform All "};
  std::mt19937 random(3);
  for (int i = 0; i < 3000; ++i) {
    std::string text;
    for (std::size_t k = random() % 60; k > 0; --k) text += kPieces[random() % std::size(kPieces)];
    const Parsed p = parse(text);
    EXPECT_TRUE(p.diagnostics.hasErrors() || !p.scenes.empty()) << text;
    EXPECT_LT(p.messages().size(), 200000u);
  }
}

}  // namespace
}  // namespace pbrtmedia
