// SPDX-License-Identifier: BSD-2-Clause
#include "scene/ply_output.h"

#include <bit>
#include <cstdint>
#include <fstream>
#include <stdexcept>
#include <string>

#include "base/files.h"

namespace pbrtmedia {
namespace {

/// Collects little-endian bytes and writes them in large pieces.
class ByteWriter {
 public:
  explicit ByteWriter(std::ofstream& out) : out_(out) {}
  void byte(std::uint8_t b) { buffer_ += static_cast<char>(b); }
  void word(std::uint32_t w) {
    for (int shift = 0; shift < 32; shift += 8) buffer_ += static_cast<char>(w >> shift & 0xff);
    if (buffer_.size() > kFlush) flush();
  }
  void number(float x) { word(std::bit_cast<std::uint32_t>(x)); }
  void flush() {
    out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    buffer_.clear();
  }

 private:
  static constexpr std::size_t kFlush = std::size_t{1} << 16;
  std::ofstream& out_;
  std::string buffer_;
};

void write(std::ofstream& out, const PlyMesh& mesh) {
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << mesh.points.size()
      << "\nproperty float x\nproperty float y\nproperty float z\n";
  if (!mesh.normals.empty()) out << "property float nx\nproperty float ny\nproperty float nz\n";
  if (!mesh.uv.empty()) out << "property float u\nproperty float v\n";
  out << "element face " << mesh.indices.size() / 3
      << "\nproperty list uchar int vertex_indices\nend_header\n";
  ByteWriter bytes(out);
  const auto vector = [&](Vector3f v) {
    bytes.number(v.x);
    bytes.number(v.y);
    bytes.number(v.z);
  };
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    vector(mesh.points[i]);
    if (!mesh.normals.empty()) vector(mesh.normals[i]);
    if (!mesh.uv.empty()) {
      bytes.number(mesh.uv[i].x);
      bytes.number(mesh.uv[i].y);
    }
  }
  for (std::size_t i = 0; i + 3 <= mesh.indices.size(); i += 3) {
    bytes.byte(3);
    for (std::size_t k = 0; k < 3; ++k) bytes.word(static_cast<std::uint32_t>(mesh.indices[i + k]));
  }
  bytes.flush();
}

}  // namespace

void writePly(const std::filesystem::path& path, const PlyMesh& mesh) {
  writeFileAtomically(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    write(out, mesh);
    out.close();
    if (!out) throw std::runtime_error("cannot write \"" + path.string() + "\"");
  });
}

}  // namespace pbrtmedia
