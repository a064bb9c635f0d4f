// SPDX-License-Identifier: BSD-2-Clause
#include "shapes/ply.h"
#include "support/source_dir.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <bit>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace pbrtmedia {
namespace {

/// A PLY body in any of the three forms from one list of values.
class PlyWriter {
 public:
  explicit PlyWriter(std::string_view form)
      : form_(form), text_("ply\nformat " + std::string(form) + " 1.0\n") {}

  PlyWriter& line(const std::string& header) {
    text_ += header + "\n";
    return *this;
  }
  template <class T>
  PlyWriter& value(T v) {
    if (form_ == "ascii") {
      text_ += std::to_string(v) + " ";
      return *this;
    }
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &v, sizeof(T));
    const bool wantsBig = form_ == "binary_big_endian";
    if (wantsBig != (std::endian::native == std::endian::big)) std::ranges::reverse(bytes);
    text_.append(bytes.data(), bytes.size());
    return *this;
  }
  PlyWriter& endOfElement() {
    if (form_ == "ascii") text_ += "\n";
    return *this;
  }
  const std::string& text() const { return text_; }

 private:
  std::string_view form_;
  std::string text_;
};

constexpr std::string_view kForms[] = {"ascii", "binary_little_endian", "binary_big_endian"};

std::string richFile(std::string_view form) {
  PlyWriter w(form);
  w.line("comment all the trimmings").line("obj_info nothing");
  w.line("element vertex 5").line("property float x").line("property double y").line("property float z");
  w.line("property uchar red").line("property float nx").line("property float ny").line("property float nz");
  w.line("property float s").line("property short t");
  w.line("element tag 2").line("property list ushort char bytes").line("property int weight");
  w.line("element face 3").line("property int face_indices").line("property list uchar uint vertex_indices");
  w.line("property float quality").line("end_header");
  for (int i = 0; i < 5; ++i) {
    const auto f = static_cast<float>(i);
    w.value(f).value(2.0 * i).value(-0.5f * f).value(static_cast<unsigned char>(200 + i));
    w.value(0.0f).value(f).value(1.0f).value(0.25f * f).value(static_cast<short>(-i)).endOfElement();
  }
  w.value(std::uint16_t{3})
      .value(std::int8_t{1})
      .value(std::int8_t{2})
      .value(std::int8_t{3})
      .value(7)
      .endOfElement();
  w.value(std::uint16_t{0}).value(8).endOfElement();
  const auto face = [&](int number, std::initializer_list<unsigned> corners) {
    w.value(number).value(static_cast<unsigned char>(corners.size()));
    for (const unsigned c : corners) w.value(c);
    w.value(0.5f).endOfElement();
  };
  face(10, {0, 1, 2});
  face(11, {0, 1, 2, 3});
  face(12, {4, 3, 2, 1, 0});
  return w.text();
}

TEST(Ply, ReadsAllThreeForms) {
  for (const std::string_view form : kForms) {
    SCOPED_TRACE(form);
    const PlyMesh ply = parsePly(richFile(form), "rich.ply");
    const auto& m = ply.mesh;
    ASSERT_EQ(m.P.size(), 5u);
    EXPECT_EQ(m.P[3], Point3f(3, 6, -1.5f));
    ASSERT_EQ(m.N.size(), 5u);
    EXPECT_EQ(m.N[2], Normal3f(0, 2, 1));
    ASSERT_EQ(m.uv.size(), 5u);
    EXPECT_EQ(m.uv[4], Point2f(1, -4));
    // A quad (0,1,2,3) gives (0,1,2), (3,0,2); a pentagon a fan around its first corner.
    EXPECT_EQ(m.indices, (std::vector<int>{0, 1, 2, 0, 1, 2, 3, 0, 2, 4, 3, 2, 4, 2, 1, 4, 1, 0}));
    EXPECT_EQ(m.faceIndices, (std::vector<int>{10, 11, 11, 12, 12, 12}));
    ASSERT_EQ(ply.notices.size(), 1u);
    EXPECT_EQ(ply.notices[0],
              "1 polygons of more than four corners are split into fans around their first corner");
    EXPECT_TRUE(TriangleMesh::validate(m).empty());
  }
}

std::string triangle(const std::string& listName, const std::string& extra = "") {
  return "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty float x\r\nproperty float y\r\n"
         "property float z\r\n" +
         extra + "element face 1\r\nproperty list uchar int " + listName + "\r\nend_header\r\n";
}

TEST(Ply, AcceptsVertexIndexAndCarriageReturns) {
  const PlyMesh ply = parsePly(triangle("vertex_index") + "0 0 0\r\n1 0 0\r\n+0 1e0 0\r\n3 0 1 2", "t.ply");
  EXPECT_EQ(ply.mesh.indices, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(ply.mesh.P[2], Point3f(0, 1, 0));
  EXPECT_TRUE(ply.mesh.N.empty());
  EXPECT_TRUE(ply.mesh.uv.empty());
  EXPECT_TRUE(ply.notices.empty());
}

TEST(Ply, ReadsEveryNameOfTextureCoordinates) {
  for (const auto& [u, v] : {std::pair{"u", "v"}, std::pair{"s", "t"}, std::pair{"texture_u", "texture_v"},
                             std::pair{"texture_s", "texture_t"}}) {
    const std::string extra = std::string("property float ") + v + "\r\nproperty float " + u + "\r\n";
    const PlyMesh ply =
        parsePly(triangle("vertex_indices", extra) + "0 0 0 1 2\n1 0 0 3 4\n0 1 0 5 6\n3 0 1 2\n", "t.ply");
    ASSERT_EQ(ply.mesh.uv.size(), 3u) << u;
    EXPECT_EQ(ply.mesh.uv[1], Point2f(4, 3));
  }
}

TEST(Ply, LeavesOutFacesOfFewerThanThreeCornersWithANotice) {
  const PlyMesh ply = parsePly(
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 3\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 1 0 0 0 1 0\n2 0 1\n3 0 1 2\n0\n",
      "t.ply");
  EXPECT_EQ(ply.mesh.indices.size(), 3u);
  ASSERT_EQ(ply.notices.size(), 1u);
  EXPECT_EQ(ply.notices[0], "2 faces of fewer than three corners are left out");
}

/// "line: message"
std::string errorOf(const std::string& bytes) {
  try {
    parsePly(bytes, "bad.ply");
  } catch (const SceneError& e) {
    EXPECT_EQ(*e.location().file, "bad.ply");
    return std::to_string(e.location().line) + ": " + e.what();
  }
  return "no error";
}

TEST(Ply, ErrorsNameTheLine) {
  EXPECT_EQ(errorOf(""), "1: not a PLY file: expected \"ply\" in the first line");
  EXPECT_EQ(errorOf("solid stl\nfacet\n"), "1: not a PLY file: expected \"ply\" in the first line");
  EXPECT_EQ(errorOf("ply\nformat ascii 1.0\nelement vertex 3\n"), "4: the header has no end_header line");
  EXPECT_EQ(errorOf("ply\nformat ebcdic 1.0\nend_header\n"),
            "2: unknown format \"ebcdic\"; known: ascii, binary_big_endian, binary_little_endian");
  EXPECT_EQ(errorOf("ply\nend_header\n"), "2: the header has no format line");
  EXPECT_EQ(errorOf("ply\nformat ascii 1.0\nelement vertex -3\nend_header\n"),
            "3: element \"vertex\": expected a count, found \"-3\"");
  EXPECT_EQ(errorOf("ply\nformat ascii 1.0\nproperty float x\nend_header\n"),
            "3: a property before the first element");
  EXPECT_EQ(errorOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty half x\nend_header\n"),
            "4: unknown type \"half\"; known: char, uchar, short, ushort, int, uint, float, double");
  EXPECT_EQ(
      errorOf(
          "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nend_header\n1 1\n"),
      "3: element \"vertex\" has no property \"z\"");
  EXPECT_EQ(errorOf(triangle("corners") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
            "7: element \"face\" has no list \"vertex_indices\" of integers");
  EXPECT_EQ(errorOf(triangle("vertex_indices") + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"),
            "11: property \"y\": expected a number, found \"x\"");
  EXPECT_EQ(errorOf(triangle("vertex_indices") + "0 0 0\n1 0 0\n0 1 0\n3 0 1.5 2\n"),
            "13: property \"vertex_indices\": expected an integer, found \"1.5\"");
  EXPECT_EQ(errorOf(triangle("vertex_indices") + "0 0 0\n1 0 0\n0 1 0\n-3 0 1 2\n"),
            "13: list \"vertex_indices\": length -3 does not fit into the file");
  EXPECT_EQ(errorOf(triangle("vertex_indices") + "0 0 0\n1 0 0\n0 1 0\n2500000000000000000000000 0 1 2\n"),
            "13: list \"vertex_indices\": length 2.5e+24 does not fit into the file");
  EXPECT_EQ(errorOf(triangle("vertex_indices") + "0 0 0\n1 0 0\n0 1 0\n4 0 1 2 \n"),
            "14: ends before property \"vertex_indices\"");
  EXPECT_EQ(errorOf(triangle("vertex_indices") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3000000000\n"),
            "13: property \"vertex_indices\": 3000000000.000000 does not fit into 31 bits");
  EXPECT_EQ(errorOf("ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\n"
                    "property float z\nend_header\n"),
            "0: has no vertices");
}

TEST(Ply, ChecksCountsAgainstTheBytesThatAreThere) {
  EXPECT_EQ(errorOf("ply\nformat binary_little_endian 1.0\nelement vertex 1000000000000\nproperty float x\n"
                    "property float y\nproperty float z\nend_header\n0123456789ab"),
            "3: element \"vertex\": the header says 1000000000000, but the file is too short for that many");
  EXPECT_EQ(errorOf("ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nelement vertex 9000\n"
                    "property float x\nproperty float y\nproperty float z\nend_header\n1 2 3\n"),
            "4: element \"vertex\": the header says 9000, but the file is too short for that many");
  PlyWriter w("binary_big_endian");
  w.line("element vertex 1").line("property float x").line("property float y").line("property float z");
  w.line("element face 1").line("property list uint int vertex_indices").line("end_header");
  w.value(0.0f).value(0.0f).value(0.0f).value(0xfffffff0u);
  EXPECT_EQ(errorOf(w.text()), "0: list \"vertex_indices\": length 4294967280 does not fit into the file");
}

TEST(Ply, NoPrefixOfAFileIsAcceptedOrCrashes) {
  for (const std::string_view form : kForms) {
    const std::string whole = richFile(form);
    // The last number of the ASCII form may lose its trailing white space and digits.
    for (std::size_t size = 0; size + 12 < whole.size(); ++size) {
      EXPECT_NE(errorOf(whole.substr(0, size)), "no error") << form << ' ' << size;
    }
  }
}

TEST(Ply, IndicesOutOfRangeAreFoundByTheMesh) {
  const PlyMesh ply = parsePly(triangle("vertex_indices") + "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "t.ply");
  const auto problems = TriangleMesh::validate(ply.mesh);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].message, "indices[2] is 7, expected 0 to 2 for the 3 vertices in P");
}

TEST(Ply, ReadsFilesPlainAndCompressed) {
  const auto folder = std::filesystem::temp_directory_path();
  const auto plain = folder / "pbrt_media_ply_test.ply", packed = folder / "pbrt_media_ply_test.ply.gz";
  const std::string bytes = richFile("binary_little_endian");
  std::ofstream(plain, std::ios::binary) << bytes;
  gzFile gz = gzopen(packed.c_str(), "wb");
  ASSERT_EQ(gzwrite(gz, bytes.data(), static_cast<unsigned>(bytes.size())), static_cast<int>(bytes.size()));
  gzclose(gz);
  EXPECT_EQ(readPly(plain).mesh.P.size(), 5u);
  EXPECT_EQ(readPly(packed).mesh.indices, readPly(plain).mesh.indices);
  std::filesystem::remove(plain);
  std::filesystem::remove(packed);
  EXPECT_THROW(readPly(plain), SceneError);
}

TEST(Ply, ReadsRealFiles) {
  const std::filesystem::path folder = test::sourceDir() / "../shared/scenes/pbrt-v3/geometry";
  if (!std::filesystem::exists(folder / "knot.ply")) GTEST_SKIP() << "no sample scenes";
  const PlyMesh knot = readPly(folder / "knot.ply"), smoke = readPly(folder / "smoke-box.ply");
  EXPECT_EQ(knot.mesh.P.size(), 19200u);
  EXPECT_EQ(knot.mesh.N.size(), 19200u);
  EXPECT_EQ(knot.mesh.indices.size(), 3 * 38400u);
  EXPECT_TRUE(TriangleMesh::validate(knot.mesh).empty());
  EXPECT_TRUE(TriangleMesh(knot.mesh, {}).isClosed());
  EXPECT_EQ(smoke.mesh.P.size(), 8u);
  EXPECT_EQ(smoke.mesh.indices.size(), 36u);
  EXPECT_TRUE(TriangleMesh(smoke.mesh, {}).isClosed());
}

}  // namespace
}  // namespace pbrtmedia
